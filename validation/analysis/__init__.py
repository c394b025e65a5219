"""What the tables and fields of finished runs tell: pure functions that claims, figures and
sensitivity share."""

from validation.analysis.forces import force_at, onset_difference
from validation.analysis.page_blocks import markdown_table, with_block
from validation.analysis.paper_numbers import (
    ACCEPTED_K,
    BAR_STRAIN,
    DUMBBELL_STRAIN,
    MEASURED_TO_K,
    PAPER_N_PER_MM,
    SIMILAR,
)
from validation.analysis.ranges import (
    CRITICAL_RANK_CORRELATION,
    ends,
    names_at_ends,
    number,
    numbers,
    rank_correlation,
    relative_range,
)
from validation.analysis.rubber_curves import TESTED_STRETCH, secant_shear_modulus
from validation.analysis.shape import contour
from validation.analysis.studies import rounded, runs_in
