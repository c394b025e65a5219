"""Column names of the result tables, each with its unit in the name.

Whoever writes or reads a table uses these names; extra columns may follow them.
"""

#: Energies of the energy audit and of the heat audit, per mm depth and since the start.
ENERGY = (
    "work_in_mJ_per_mm",
    "strain_energy_mJ_per_mm",
    "friction_dissipation_mJ_per_mm",
    "viscous_dissipation_mJ_per_mm",
    "kinetic_energy_mJ_per_mm",
    "frictional_heat_mJ_per_mm",
    "heat_in_rubber_mJ_per_mm",
    "heat_in_road_mJ_per_mm",
    "radiated_mJ_per_mm",
)

#: `history.csv`: one row per accepted step.
HISTORY = (
    "time_s",
    "sliding_distance_mm",
    "velocity_mm_per_s",
    "normal_force_N_per_mm",
    "friction_force_N_per_mm",
    "friction_coefficient",
    "contact_length_mm",
    "mean_contact_pressure_N_per_mm2",
    "max_contact_pressure_N_per_mm2",
    "platen_displacement_mm",
    "T_max_C",
    "T_edge_C",
    "A_T_K_mm",
    "newton_iterations",
    *ENERGY,
)

#: `surface.csv`: the bottom surface at the end, a row per node from the trailing to the leading
#: corner. `X_mm` is the reference coordinate, `x_mm` the current one in the platen's frame.
SURFACE = (
    "X_mm",
    "x_mm",
    "y_mm",
    "in_contact",
    "pressure_N_per_mm2",
    "shear_N_per_mm2",
    "slip_velocity_mm_per_s",
    "T_C",
)

#: `boundary.csv`: every free boundary node at the end, chain by chain. `s_mm` is the undeformed
#: length along the chain, `X_mm` and `Y_mm` are reference coordinates, `x_mm` and `y_mm` current
#: ones in the platen's frame.
BOUNDARY = (
    "block",
    "chain",
    "s_mm",
    "X_mm",
    "Y_mm",
    "x_mm",
    "y_mm",
    "status",
    "pressure_N_per_mm2",
    "shear_N_per_mm2",
    "slip_velocity_mm_per_s",
    "T_C",
)

#: `summary.json` and the one row of `summary.csv`.
SUMMARY = (
    "status",
    "T_max_C",
    "T_edge_C",
    "A_T_K_mm",
    "friction_force_N_per_mm",
    "friction_coefficient",
    "contact_length_mm",
    "mean_contact_pressure_N_per_mm2",
    "elements",
    "dofs",
    "steps",
    "newton_iterations",
    "wall_s",
    "energy_error",
    "heat_error",
    "regularisation_share",
    "capped_heat_share",
    "warnings",
)


def in_order(found: list[str], required: tuple[str, ...], table: str) -> list[str]:
    """Return the column names with the required ones first and extra ones behind them.

    Raises
    ------
    ValueError
        Naming the table and the columns that are missing.
    """
    missing = [name for name in required if name not in found]
    if missing:
        raise ValueError(f"{table} lacks {', '.join(missing)}; it has {', '.join(found) or 'none'}")
    return [*required, *(name for name in found if name not in required)]
