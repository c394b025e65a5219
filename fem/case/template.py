"""The commented case file that `treadfem template` prints."""

from fem.case.case import Case

_HEADING = """\
A case of treadfem: one sliding event of one rubber tread block. It runs as it is:
    treadfem run case.toml -o results/case
    treadfem check case.toml        (checks it and prints it resolved)
The numbers are those of the paper's introductory example. Everything but [loading] has these
values as defaults and may be left out.

Instead of a compound, [rubber] takes a model with its constants:
    model = "neo-hooke"       G_N_per_mm2
    model = "mooney-rivlin"   C10_N_per_mm2, C01_N_per_mm2
    model = "yeoh"            C10_N_per_mm2, C20_N_per_mm2, C30_N_per_mm2
    model = "van-der-waals"   G_N_per_mm2, lambda_m, a, beta
    model = "arruda-boyce"    C1_N_per_mm2, lambda_m
    model = "ogden"           mu_N_per_mm2 and alpha, arrays with an entry per term
and may remember: viscoelastic = {g = [0.5, 0.2], tau_s = [1e-3, 1e-1]} (moduli, heats, C1, C2_K,
    T_ref_C), mullins = {r = 2.0, m_N_per_mm2 = 0.1, beta = 0.1}.
[friction] takes law = "exponential" with A, B, C, or law = "coulomb" with mu.
[rubber], [friction] and [heat] also take parameters = "file.toml", the result of a calibration;
a relative name is relative to this file, and keys given here win over those given there.
[pyrometer] gap_mm = 10.0, spot_mm = 3.0 gives what a pyrometer behind the end of the road reads.
[block] mesh also takes {cells_x = 80, cells_y = 36, smallest_x_mm = 0.12, smallest_y_mm = 0.04}."""


def case_template() -> str:
    """Return a commented case file, ready to run."""
    case = Case.from_dict(
        {
            "loading": {
                "mean_pressure_N_per_mm2": 0.25,
                "velocity_mm_per_s": 300.0,
                "distance_mm": 120.0,
            }
        }
    )
    return case.to_toml(_HEADING)


_STUDY_TEMPLATE = """\
# A study of treadfem: a base case, and what is varied. It runs as it is, in a few minutes:
#     treadfem sweep study.toml -o results/study
#     treadfem sweep study.toml -o results/study --resume     (goes on after an interruption)

# The paper's introductory example, or your own case file, e.g. "my_case.toml" beside this file.
base = "introductory"

# Every combination of these values is run. Keys are those of the case file.
[grid]
"loading.velocity_mm_per_s" = [50.0, 300.0]
"friction.law" = ["huemer", "exponential"]
"block.mesh" = ["coarse"]
"loading.distance_mm" = [10.0]

# Optional: short names of long keys, for the folders of the runs.
[names]
"loading.velocity_mm_per_s" = "v"

# Optional: each [[case]] is combined with the whole grid. For two block heights, for example:
# [[case]]
# "block.height_mm" = 8.0
# [[case]]
# "block.height_mm" = 10.0
"""


def study_template() -> str:
    """Return a commented study file, ready to run."""
    return _STUDY_TEMPLATE
