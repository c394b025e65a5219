"""Rubber with a memory, and histories of it, for several tests."""

import numpy as np

from materials import COMPOUNDS, NeoHooke, Ogden, OgdenRoxburgh, Prony, Rubber, VanDerWaals
from tests.reference_solutions.plane_strain import deformation_of

SPECTRUM = Prony(g=[0.6, 0.4, 0.3, 0.2], tau_s=[1e-3, 0.02, 0.4, 9.0])
SOFTENING = OgdenRoxburgh(r=1.8, m=0.15, beta=0.2)

#: Every kind of elastic law with branches, with softening and with both.
RUBBERS = {
    "branches": Rubber(elastic=NeoHooke(G=0.7), viscous=SPECTRUM),
    "softening": Rubber(elastic=COMPOUNDS["yeoh-bars-series-1"], damage=SOFTENING),
    "yeoh": Rubber(elastic=COMPOUNDS["yeoh-bars-series-2"], viscous=SPECTRUM, damage=SOFTENING),
    "mooney-rivlin": Rubber(
        elastic=COMPOUNDS["mooney-rivlin-dumbbells"], viscous=SPECTRUM, damage=SOFTENING
    ),
    "van-der-waals": Rubber(
        elastic=VanDerWaals(G=0.7, lambda_m=4.0, a=0.4, beta=0.3),
        viscous=Prony(g=[0.3, 0.2], tau_s=[0.05, 1.0], moduli="instantaneous"),
        damage=SOFTENING,
    ),
    "ogden": Rubber(
        elastic=Ogden(mu=(0.4, 0.01, 0.05), alpha=(1.3, 5.0, -2.0)),
        viscous=SPECTRUM,
        damage=SOFTENING,
    ),
}


def random_deformations(rng, size, spread=0.3):
    F = np.eye(2) + spread * rng.uniform(-1, 1, (size, 2, 2))
    return (
        F / np.sqrt(np.abs(np.linalg.det(F)))[:, None, None] * rng.uniform(0.9, 1.1, (size, 1, 1))
    )


def after(rubber, states, dt):
    """State of the rubber after steps of length dt through deformations (steps, points, 2, 2)."""
    state = rubber.virgin(states[0].shape[:1])
    for F in states:
        state = rubber.step(state, dt).end(deformation_of(F)).state
    return state
