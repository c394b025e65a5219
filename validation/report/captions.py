"""What the report says under the figures and above the tables of the paper."""

_SYNTHETIC = "The paper's measurements are not published: the test shown is synthetic, made from "

#: By the number of the figure.
FIGURES = {
    2: "Cyclic test of a dumbbell and the parameter sets of Table 1. "
    f"{_SYNTHETIC}the paper's own parameter set with stated noise.",
    3: "Cyclic tests of bars, series 1 and 2, and the parameter sets of Table 1. "
    f"{_SYNTHETIC}the paper's own parameter sets with stated noise.",
    4: "Friction coefficient over sliding velocity and contact pressure: the exponential law (5) "
    "and the law by Huemer (6), with the parameters of Table 2.",
    6: "Heating experiment that identifies the gap conductance: rubber block between a heated "
    f"copper block and asphalt. {_SYNTHETIC}a simulation with stated noise.",
    7: "The block with its mesh, and the two steps of the event: pressing, then sliding.",
    8: "State of the block after 120 mm of sliding at 300 mm/s: deformed mesh, temperature and "
    "vertical normal stress, with details of the front edge. The introductory example.",
    9: "Vertical normal stress on the deformed block for the six parameter sets of Table 1.",
    10: "Temperature of the bottom surface for the six parameter sets of Table 1.",
    11: "Temperature of the bottom surface at three sliding velocities with both friction laws.",
    12: "Highest temperature of the interior and area under the temperature curve over the mean "
    "contact pressure, for velocities, friction laws and compounds.",
}

#: Figures of the paper that cannot be computed.
NOT_COMPUTED = (
    "Figures 1 and 5 of the paper are a sketch and photographs; there is nothing to compute."
)

#: By the number of the table.
TABLES = {
    1: "Parameters of the hyperelastic models, recovered by the calibration",
    2: "Parameters of the friction laws, recovered by the calibration",
    3: "Thermo-mechanical parameters of rubber and asphalt",
    4: "Friction force in the slip phase, computed and published",
}

SENSITIVITY = (
    "One parameter at a time: what the paper leaves open, and numerical settings on which the "
    "results should not depend. The strongest influence on T_max comes first."
)
ROBUSTNESS = (
    "All parameter sets, friction coefficients from 0.3 to 1.2 and both friction laws, pressures "
    "from 0.1 to 0.5 N/mm²: one set of solver settings, 40 mm of sliding."
)
