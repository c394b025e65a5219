"""The commented study file that `treadfem template study` prints."""

from __future__ import annotations

_TEMPLATE = """\
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
    return _TEMPLATE
