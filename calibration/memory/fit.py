"""Fit of relaxation times, whatever kind of test the table holds."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from calibration.data import read_table
from calibration.fitting import FitResult, Loss
from calibration.memory.histories import Histories, read_histories
from calibration.memory.sweeps import Moduli, fit_sweeps, read_moduli
from calibration.memory.viscoelastic import Weighting, fit_histories
from calibration.shifting import Vertical, is_sweep_table
from materials.hyperelastic_base import Mode
from materials.wlf import WLF

#: Options that belong to one kind of test, with the options of its reading.
_OF_HISTORIES = ("model", "mode", "from_cycle", "shift", "weights", "fixed")
_OF_SWEEPS = ("vertical", "expansion_per_K", "T_tolerance_K")


def fit_viscoelastic(
    table: pd.DataFrame | str | Path | Histories | Moduli,
    model: str | None = None,
    *,
    branches: int | None = None,
    mode: Mode | None = None,
    from_cycle: int | None = None,
    shift: WLF | None = None,
    T_ref_C: float | None = None,
    weights: Weighting | None = None,
    fixed: Mapping[str, float] | None = None,
    vertical: Vertical | None = None,
    expansion_per_K: float | None = None,
    T_tolerance_K: float | None = None,
    loss: Loss = "linear",
    noise: float = 0.05,
) -> FitResult:
    """Fit Maxwell branches to stress histories, with an elastic law, or to frequency sweeps.

    Parameters
    ----------
    table : DataFrame or path of a CSV file
        Histories (relaxation, stepwise relaxation, cycles): ``time_s``, ``stretch``,
        ``nominal_stress_N_per_mm2`` in the order of recording; optional ``test`` (a name for each
        specimen, which begins at rest), ``mode``, ``T_C``, ``cycle``. Sweeps: ``frequency_Hz`` or
        ``omega_rad_per_s``, two of ``modulus_N_per_mm2``, ``loss_modulus_N_per_mm2``,
        ``tan_delta`` (or a modulus alone), and ``T_C`` where there are several temperatures.
    model : str, optional
        Elastic law of histories (see `calibration.fit_hyperelastic`); default "yeoh".
    branches : int, optional
        Number of branches; default as few as the data support.
    mode : str, optional
        Mode of histories without a column for it; default "uniaxial".
    from_cycle : int, optional
        Rows of earlier cycles load the rubber and are not compared.
    shift : WLF, optional
        Shift of the relaxation times of histories with ``T_C``. Sweeps give their own.
    T_ref_C : float, optional
        Temperature of the relaxation times [deg C]; default 20, or the sweep in the middle.
    weights : {"equal", "tests"}, optional
        Every row of the histories alike, or every test.
    fixed : mapping, optional
        Constants of the elastic law to hold.
    vertical, expansion_per_K, T_tolerance_K
        How sweeps are shifted (see `calibration.shift_sweeps`).
    loss, noise
        Robust loss and the residual where it begins to act [N/mm^2], of sweeps relative.

    Returns
    -------
    FitResult
        ``values`` of the elastic law [N/mm^2] (of sweeps ``slow_modulus_N_per_mm2``, ``C1``,
        ``C2_K``) with ``g1, g2, ...`` relative to the slow shear modulus and ``tau1_s, ...``;
        ``model`` is the rubber, of sweeps the spectrum. Its section goes into a case.

    Examples
    --------
    >>> import numpy as np
    >>> from materials import NeoHooke, Prony, Rubber
    >>> rubber = Rubber(elastic=NeoHooke(G=0.8), viscous=Prony(g=[0.5], tau_s=[2.0]))
    >>> time = np.append(0.0, np.geomspace(0.01, 100.0, 60))
    >>> stretch = np.append(1.0, np.full(60, 1.3))
    >>> stress = rubber.nominal_stress(time, stretch)
    >>> table = pd.DataFrame(
    ...     {"time_s": time, "stretch": stretch, "nominal_stress_N_per_mm2": stress}
    ... )
    >>> fit = fit_viscoelastic(table, model="neo-hooke")
    >>> [round(fit.values[name], 3) for name in ("G", "g1", "tau1_s")]
    [0.8, 0.5, 2.0]
    """
    given: dict[str, Any] = {
        "model": model,
        "mode": mode,
        "from_cycle": from_cycle,
        "shift": shift,
        "weights": weights,
        "fixed": fixed,
        "vertical": vertical,
        "expansion_per_K": expansion_per_K,
        "T_tolerance_K": T_tolerance_K,
        "T_ref_C": T_ref_C,
    }
    options = {name: value for name, value in given.items() if value is not None}
    data = read_memory(table, **options)
    if isinstance(data, Moduli):
        return fit_sweeps(data, branches=branches, loss=loss, noise=noise)
    reading = ("mode", "from_cycle")
    options = {name: value for name, value in options.items() if name not in reading}
    return fit_histories(data, branches=branches, loss=loss, noise_N_per_mm2=noise, **options)


def read_memory(
    table: pd.DataFrame | str | Path | Histories | Moduli, **options: Any
) -> Histories | Moduli:
    """Read the tests of a table; options of the other kind of test are refused."""
    if isinstance(table, Histories | Moduli):
        return table
    sweeps = is_sweep_table(read_table(table, ()))
    wrong = [name for name in options if name in (_OF_HISTORIES if sweeps else _OF_SWEEPS)]
    if wrong:
        kind = "stress histories" if sweeps else "frequency sweeps"
        raise ValueError(f"{wrong[0]} is {options[wrong[0]]!r}; expected it for {kind} only")
    if sweeps:
        return read_moduli(table, **options)
    chosen = {name: options[name] for name in ("mode", "from_cycle") if name in options}
    return read_histories(table, **chosen)
