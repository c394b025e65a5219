"""Quasi-static cases with constant friction, as an independent code can compute them."""

from __future__ import annotations

from fem.case.case import Case


def sliding_case(nx=8, ny=4, height=8.0, **overrides) -> Case:
    """A 20 mm long block on a uniform mesh; `overrides` are dotted keys with dots as __."""
    tables = {
        "block": {
            "height_mm": height,
            "mesh": {
                "cells_x": nx,
                "cells_y": ny,
                "smallest_x_mm": 20.0 / nx,
                "smallest_y_mm": height / ny,
            },
        },
        "rubber": {"compound": "yeoh-bars-series-1-load"},
        "friction": {"law": "coulomb", "mu": 0.3},
        "loading": {
            "mean_pressure_N_per_mm2": 0.25,
            "velocity_mm_per_s": 300.0,
            "distance_mm": 2.0,
        },
        "solver": {"inertia": False, "viscous_distance_mm": 0.0},
    }
    dotted = {key.replace("__", "."): value for key, value in overrides.items()}
    return Case.from_dict(tables, overrides=dotted)
