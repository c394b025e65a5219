"""Numbers of a case that are out of their range."""

from __future__ import annotations

from tests.wrong_inputs.cases import LOADING, loading, value, whole, wrong

#: Numbers that no run can mean: other units, or steps and sizes that never end.
RANGES = [
    value("kelvin", "heat", "ambient_C = 293", "293.0, which looks like kelvin", "-90 to 200"),
    value("hot", "heat", "ambient_C = 2000", "2000", "from -90 to 200 deg C"),
    value("kelvin of the law", "friction", "T_ref_C = 293.15", "kelvin (20 deg C)", "-200 to 250"),
    value("density in t/mm^3", "road", "density_kg_per_m3 = 2e-9", "t/mm^3 (2000", "100 to 25000"),
    value("density in g/cm^3", "rubber", "density_kg_per_m3 = 1.2", "g/cm^3 (1200", "100 to 6000"),
    value(
        "specific heat in J",
        "rubber",
        "specific_heat_kJ_per_kgK = 1450",
        "J/(kg K) (1.45",
        "0.05 to 20",
    ),
    value("block in micrometres", "block", "length_mm = 20000", "micrometres (20 mm)", "to 1000"),
    value("block in metres", "block", "height_mm = 0.008", "metres (8 mm)", "0.1 to 1000"),
    value("block of a kilometre", "block", "length_mm = 1e6", "1000000.0", "to 1000 mm"),
    value("huge factor on steps", "solver", "steps_scale = 1e20", "1e+20", "at most 100"),
    value("tiny factor on steps", "solver", "steps_scale = 1e-20", "1e-20", "at least 0.001"),
    value("tiny heat step", "solver", "heat_step_mm = 1e-300", "1e-300", "at least 1e-07"),
    value("small heat step", "solver", "heat_step_mm = 1e-9", "1e-09", "at least 1e-07"),
    value("tiny step", "solver", "step_mm_min = 1e-300", "1e-300", "at least 1e-07"),
    value(
        "pressure of the heat partition in kPa",
        "heat.partition",
        "pressure = 300",
        "300.0, which looks like kPa",
        "from 1e-06 to 20",
    ),
    value(
        "word for a pressure", "heat.partition", 'pressure = "maen"', '"maen"', '"mean" (or "local"'
    ),
    value("tiny radius", "solver", "edge_radius_mm = 1e-300", "1e-300", "at least 1e-06"),
    value("seven passes", "solver", "friction_passes = 7", "7", "at most 6"),
    value("huge friction", "friction", "alpha = 1e300", "1e+300", "at most 1e+06"),
    whole(
        "friction in per cent",
        '[friction]\nlaw = "coulomb"\nmu = 90\n' + LOADING,
        "friction.mu",
        "90.0, which looks like per cent (0.9)",
        "from 0 to 6",
    ),
    wrong(
        "law in per cent",
        '[friction]\nlaw = "exponential"\nA = 70',
        "friction.law",
        "exponential with the coefficient",
        "a friction coefficient from 0 to 6",
    ),
    wrong(
        "friction that pushes",
        "[friction]\nalpha = 0.0\nbeta = -0.2",
        "friction.law",
        "huemer with the coefficient -0.2",
        "0 or more at every pressure and speed of the run",
    ),
    wrong(
        "friction that pushes at the peak pressure",
        "[friction]\nbeta = -0.1",
        "friction.law",
        "N/mm^2 and 1 mm/s",
        "(to 25 N/mm^2)",
    ),
    wrong(
        "rubber in kPa",
        '[rubber]\nmodel = "neo-hooke"\nG_N_per_mm2 = 600.0',
        "rubber.G_N_per_mm2",
        "600 N/mm^2, which looks like kPa (0.6 N/mm^2)",
        "a shear modulus of rubber",
    ),
    whole(
        "distance of km", loading(distance_mm="1e9"), "loading.distance_mm", "1000000000", "1e+06"
    ),
    wrong(
        "integer of 5000 digits", "[block]\nlength_mm = " + 5000 * "9", "syntax", "limit", "TOML"
    ),
    wrong(
        "hexadecimal of 5000 digits",
        "[block]\nlength_mm = 0x" + 5000 * "9",
        "block.length_mm",
        "a whole number of 6021 digits",
        "a number",
    ),
    wrong(
        "unknown user",
        '[heat]\nparameters = "~nobody9/heat.toml"',
        "heat.parameters",
        "~nobody9",
        "a user of this machine",
    ),
    wrong(
        "a month of steps",
        "[solver]\nheat_step_mm = 1e-7\nsteps_scale = 0.001",
        "solver.steps_scale",
        "days on one core",
        "within 30 days",
    ),
]
