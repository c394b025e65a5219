"""Hyperelastic material of an input deck for ABAQUS and CalculiX.

Both programs add volumetric terms ``sum_i (J - 1)^(2 i)/D_i`` to the polynomial energies of the
isochoric invariants [1]_, [2]_. With ``D1 = 2/K`` the first is ``K/2 (J - 1)^2``, the volumetric
energy used here. There the ratio J is taken at each integration point (or, for elements with
B-bar, from averaged gradients), here it is the mean of the element; with one integration point
the two agree.

References
----------
.. [1] ABAQUS Analysis User's Guide, "Hyperelastic behavior of rubberlike materials".
.. [2] Dhondt, G., CalculiX CrunchiX User's Manual, version 2.20, "Hyperelastic materials".
"""

from fem.case import Case, CaseError
from materials.hyperelastic import MooneyRivlin, NeoHooke, Yeoh
from materials.ogden import Ogden

#: Compliance D [mm^2/N] that switches a volumetric term off. Zero does not: CalculiX 2.20 then
#: takes a default of its own (0.0174 and 0.0023 for D2 and D3 of the rubber in the tests).
OFF = 1.0e20
#: Terms of Ogden's energy that CalculiX takes.
MOST_OGDEN_TERMS = 4


def hyperelastic_card(case: Case) -> list[str]:
    """Lines of the *HYPERELASTIC card of a case, constants in N/mm^2 and mm^2/N."""
    model, D1 = case.rubber.model(), 2.0 / case.rubber.bulk_modulus
    for key in ("viscoelastic", "mullins"):
        if getattr(case.rubber, key) is not None:
            expected = "an elastic rubber: the deck has no such material"
            raise CaseError(case.source, f"rubber.{key}", "rubber that remembers", expected)
    if isinstance(model, NeoHooke):
        return ["*HYPERELASTIC, NEO HOOKE", numbers(0.5 * model.G, D1)]
    if isinstance(model, MooneyRivlin):
        return ["*HYPERELASTIC, MOONEY-RIVLIN", numbers(model.C10, model.C01, D1)]
    if isinstance(model, Yeoh):
        return ["*HYPERELASTIC, YEOH", numbers(model.C10, model.C20, model.C30, D1, OFF, OFF)]
    if isinstance(model, Ogden) and len(model.mu) <= MOST_OGDEN_TERMS:
        pairs = [value for pair in zip(model.mu, model.alpha, strict=True) for value in pair]
        values = [*pairs, D1, *[OFF] * (len(model.mu) - 1)]
        lines = [numbers(*values[i : i + 8]) for i in range(0, len(values), 8)]
        return [f"*HYPERELASTIC, OGDEN, N={len(model.mu)}", *lines]
    key = "rubber.compound" if case.rubber.compound is not None else "rubber.model"
    found = f'"{case.rubber.compound or case.rubber.model_name}" ({type(model).__name__})'
    expected = (
        "a Yeoh, Mooney-Rivlin, neo-Hookean or Ogden rubber: no other energy here is "
        "the same in CalculiX"
    )
    raise CaseError(case.source, key, found, expected)


def numbers(*values: float) -> str:
    """Data line of an input deck."""
    return ", ".join(f"{value:.12g}" for value in values)
