"""Numbers behind the claims of section 2.1: what the material model leaves out."""

from validation.analysis import number, onset_difference, shape
from validation.claims.claim import Numbers
from validation.claims.evidence import Evidence
from validation.claims.statements import case_keys

#: Motion up to which a block is in its onset [mm]: one of 8 mm slides in full after some 3 mm.
ONSET_MM = 5.0


def bulk_may_be_elastic(evidence: Evidence) -> Numbers:
    return _without(evidence, "branches")


def damage_may_be_left_out(evidence: Evidence) -> Numbers:
    return _without(evidence, "softening")


def _without(evidence: Evidence, change: str) -> Numbers:
    """What a slide loses by leaving a memory of the rubber out."""
    elastic, remembers = evidence.introductory, evidence.changed(case_keys(change))
    off = {name: abs(of(elastic) / of(remembers) - 1.0) for name, of in shape.BEARING.items()}
    off["onset"] = onset_difference(elastic.history, remembers.history, ONSET_MM)
    T = abs(number(elastic, "T_max_C") - number(remembers, "T_max_C"))
    values = {name.replace(" ", "_"): value for name, value in off.items()} | {"T_max_K": T}
    return values, off | {"T_max": T, "onset_mm": ONSET_MM}
