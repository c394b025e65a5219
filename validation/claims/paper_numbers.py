"""Numbers of the paper that serve as thresholds, each with where it stands.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications".
"""

from __future__ import annotations

from validation.paper.table4 import PAPER_N_PER_MM

#: Deviation of the highest temperature that the paper accepts (section 5.2), upper end [K].
ACCEPTED_K = 2.0
#: To what the paper's temperatures could be measured (section 5.2), both ends [K].
MEASURED_TO_K = (0.5, 1.0)

_FORCES = list(PAPER_N_PER_MM.values())
#: Middle of the forces of Table 4 [N/mm].
MIDDLE_FORCE = 0.5 * (max(_FORCES) + min(_FORCES))
#: Range of the forces of Table 4 over their middle [-]. The paper calls these forces similar.
SIMILAR = (max(_FORCES) - min(_FORCES)) / MIDDLE_FORCE
SIMILAR_WORDS = (
    f"{100 * SIMILAR:.0f} %, the range of the forces in Table 4, which the paper calls similar"
)


def relative_range(values: list[float]) -> float:
    """Largest minus smallest value over the mean of the sizes [-]."""
    return (max(values) - min(values)) / (sum(abs(value) for value in values) / len(values))
