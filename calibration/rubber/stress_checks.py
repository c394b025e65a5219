"""Whether numbers can be stretches and nominal stresses of rubber, before anything is fitted."""

import numpy as np
from scipy.stats import spearmanr

from calibration.data import DataError, Table
from calibration.fitting import FitResult, refuse_no_fit
from calibration.rubber.stress_models import Kinematics, StressModel
from materials.arrays import FloatArray, WordArray
from materials.hyperelastic_base import Hyperelastic
from materials.plausible import SHEAR_MODULUS, judge

STRESS = "nominal_stress_N_per_mm2"
_AT_REST = 2e-3  # strain below which a row is undeformed
_SURELY = 0.9  # rank correlation that scatter does not bring about
_PRELOAD = 0.05  # share of the largest stress at rest that is worth a word


def check_points(source: Table, stretch: FloatArray, stress: FloatArray, mode: WordArray) -> None:
    """Refuse strains in the column of stretches, as fractions or in per cent."""
    small = stretch < 0.95
    pulled = small & (stress > 0.0)
    if np.count_nonzero(pulled) > 0.5 * np.count_nonzero(small):
        i = int(np.flatnonzero(pulled)[0])
        found = f"{stretch[i]:g} with the tensile stress {stress[i]:g} N/mm^2"
        source.refuse_at(i, "stretch", found, "a stretch (1 = undeformed); these look like strains")
    _refuse_amounts_of_compression(source, stretch, stress, mode)
    _refuse_percent(source, stretch, stress, mode)


def _refuse_amounts_of_compression(
    source: Table, stretch: FloatArray, stress: FloatArray, mode: WordArray
) -> None:
    """Compression given as 0.1, 0.2, 0.3 has a stress that grows towards 1, where it should end."""
    for name in np.unique(mode):
        here = np.flatnonzero((mode == name) & (stretch < 0.95) & (stress < 0.0))
        if np.unique(stretch[here]).size > 2:
            rising = spearmanr(stretch[here], -stress[here]).statistic
            if rising > _SURELY:
                i = int(here[np.argmin(stretch[here])])
                found = f"{stretch[i]:g} with less compressive stress than nearer to 1"
                expected = "a stretch (1 = undeformed); this looks like 1 - stretch"
                source.refuse_at(i, "stretch", found, expected)


def _refuse_percent(
    source: Table, stretch: FloatArray, stress: FloatArray, mode: WordArray
) -> None:
    """Small strains in per cent (2, 4, 6 ...) can be told from stretches by their stress only.

    They are strains where the rows stay clear of the undeformed state as stretches, a neo-Hookean
    curve follows them better as strains, and its modulus is then that of a rubber, as it is not
    before.
    """
    if not np.any(stress) or stretch.min() < 1.5:
        return
    meant = 1.0 + 0.01 * stretch
    (G, misfit), (G_meant, misfit_meant) = (
        _neo_hooke(lam, stress, mode) for lam in (stretch, meant)
    )
    usual = judge([G_meant], SHEAR_MODULUS) is None
    if misfit_meant < misfit and usual and judge([G], SHEAR_MODULUS) is not None:
        source.refuse_at(
            0,
            "stretch",
            f"{stretch[0]:g}, a shear modulus of {G:.3g} N/mm^2 as a stretch",
            f"a stretch (1 = undeformed); this looks like strain in per cent (G {G_meant:.4g})",
        )


def _neo_hooke(stretch: FloatArray, stress: FloatArray, mode: WordArray) -> tuple[float, float]:
    """Shear modulus of the best neo-Hookean curve and its sum of squares."""
    unit = 0.5 * Kinematics.of(stretch, mode).k1
    G = float(unit @ stress) / float(unit @ unit)
    return G, float(np.sum((G * unit - stress) ** 2))


def check_zero(source: Table, stretch: FloatArray, stress: FloatArray) -> None:
    """Say that an undeformed rubber is under stress: a preload, or a shifted zero."""
    rest = np.abs(stretch - 1.0) < _AT_REST
    loaded = rest & (np.abs(stress) > _PRELOAD * np.abs(stress).max())
    if np.any(loaded):
        i = int(np.flatnonzero(loaded)[0])
        source.unusual.append(
            f"row {source.rows[i]}, column {STRESS}: {stress[i]:g} at the stretch {stretch[i]:g} "
            "is unusual; usual is no stress there (--zero first or loop moves the zero)"
        )


def check_sign(used: Table, stretch: FloatArray, stress: FloatArray) -> None:
    """Refuse data whose stress mostly points against the stretch."""
    against = (stretch - 1.0) * stress < 0.0
    if np.count_nonzero(against) > 0.5 * stretch.size:
        i = int(np.flatnonzero(against)[0])
        kind, sign = ("tensile", "positive") if stretch[i] > 1.0 else ("compressive", "negative")
        found = f"{stress[i]:g} at the {kind} stretch {stretch[i]:g}, and mostly so"
        used.refuse_at(i, STRESS, found, f"a {sign} stress there")


def check_modulus(used: Table, energy: Hyperelastic) -> tuple[str, ...]:
    """Refuse a shear modulus no rubber has; a warning for one that is unusual."""
    finding = judge([energy.initial_shear_modulus], SHEAR_MODULUS)
    if finding is None:
        return ()
    if not finding.impossible:
        return (f"shear modulus {finding.sentence}",)
    found = f"stresses with the shear modulus {finding.found}"
    used.refuse(column=STRESS, found=found, expected=finding.expected)


def fitted_energy(law: StressModel, result: FitResult, model: str, file: str) -> Hyperelastic:
    """The energy with the fitted constants.

    Raises
    ------
    DataError
        If the fit does not follow the data (`refuse_no_fit`), or is no admissible energy.
    """
    refuse_no_fit(result, file, STRESS)
    try:
        return law.build({name: result.values[name] for name in law.names})
    except ValueError as error:
        raise DataError(
            file=file,
            found=f"data whose best {model} fit is no admissible energy ({error})",
            expected="tests of a rubber, or another model",
        ) from None
