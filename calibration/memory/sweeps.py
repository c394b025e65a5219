"""Fit of branches to frequency sweeps: master curve, then relaxation times."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from calibration.data import Table, read_table
from calibration.fitting import FitResult, Loss, Problem, fit, minimise, refuse_no_fit
from calibration.memory.spectrum import Candidate, MemoryCurve, candidates, memory_problem
from calibration.memory.viscoelastic import (
    chosen,
    correlation_warnings,
    criterion,
    spectrum_of,
    viscoelastic_keys,
)
from calibration.shifting import LOSS, MODULUS, TAN_DELTA, MasterCurve, one_sweep, shift_sweeps
from calibration.wlf import fit_wlf
from fem.files import version_of
from materials.arrays import FloatArray, IntArray
from materials.prony import Prony
from materials.wlf import WLF

SLOW = "slow_modulus_N_per_mm2"
_MARGIN = 10.0**0.5  # relaxation times that far beyond the frequencies still show
_LEAST_TEMPERATURES = 3


@dataclass(frozen=True, kw_only=True)
class Moduli:
    """Storage and loss moduli over reduced frequency, and where they come from.

    Attributes
    ----------
    omega : (n,) array
        Reduced angular frequency of each point, rising [rad/s].
    dT : (n,) array
        Temperature above T_ref_C [K].
    measured : (n,) array
        Angular frequency before the shift [rad/s].
    storage, loss : (n,) array or None
        Moduli at T_ref_C, the vertical shift taken off [N/mm^2].
    shift : WLF or None
        Shift of the sweeps; None of one sweep, or of too few for it.
    """

    omega: FloatArray
    dT: FloatArray
    measured: FloatArray
    storage: FloatArray | None
    loss: FloatArray | None
    T_ref_C: float
    rows: IntArray
    table: Table
    master: MasterCurve | None = None
    shift: WLF | None = None
    about: Mapping[str, Any]
    warnings: tuple[str, ...] = ()

    @property
    def observed(self) -> FloatArray:
        """Storage moduli, then loss moduli [N/mm^2]."""
        return np.concatenate([part for part in (self.storage, self.loss) if part is not None])

    def shifted(self, shift: WLF) -> "Moduli":
        """The same points at the reduced frequencies of a shift."""
        omega = self.measured * 10.0 ** shift.log10_shift_factor(self.dT, 0.0)
        order = np.argsort(omega, kind="stable")
        storage, loss = (None if y is None else y[order] for y in (self.storage, self.loss))
        return replace(
            self,
            omega=omega[order],
            dT=self.dT[order],
            measured=self.measured[order],
            storage=storage,
            loss=loss,
            rows=self.rows[order],
            shift=shift,
        )


def read_moduli(
    table: pd.DataFrame | str | Path, *, T_ref_C: float | None = None, **shifting: Any
) -> Moduli:
    """Read sweeps and shift them onto one curve (options of `calibration.shift_sweeps`)."""
    source = read_table(table, ())
    if not source.has(MODULUS) and not source.has(LOSS):
        source.require((MODULUS,))
    if not source.has("T_C") or np.unique(source.numbers("T_C")).size == 1:
        points, T = one_sweep(source)
        curve = points.assign(reduced_frequency_Hz=points["frequency_Hz"])
        reference = 20.0 if T is None else T
        if T_ref_C is not None and T_ref_C != reference:
            raise ValueError(
                f"T_ref_C is {T_ref_C:g} with one sweep at {reference:g} deg C; "
                "expected sweeps at several temperatures to shift by"
            )
        return _moduli(source, curve, reference, "")
    master = shift_sweeps(source, T_ref_C, **shifting)
    found = _moduli(source, master.curve, master.T_ref_C, "reduced_")
    notes, shift, warnings = list(master.notes), None, master.warnings
    if len(master.shifts) >= _LEAST_TEMPERATURES:
        wlf = fit_wlf(master, T_ref_C=master.T_ref_C)
        shift, warnings = wlf.model, tuple(dict.fromkeys((*warnings, *wlf.warnings)))
    else:
        notes.append("two temperatures give no WLF constants: the relaxation times do not shift")
    about = {
        "vertical_shift": master.vertical,
        "overlap_error_decades": master.overlap_error,
        "notes": notes,
    }
    return replace(
        found, master=master, shift=shift, about={**found.about, **about}, warnings=warnings
    )


def _moduli(source: Table, curve: pd.DataFrame, T_ref_C: float, prefix: str) -> Moduli:
    curve = curve.sort_values("reduced_frequency_Hz", kind="stable")
    storage, loss = (
        curve[f"{prefix}{name}"].to_numpy(dtype=float) if f"{prefix}{name}" in curve else None
        for name in (MODULUS, LOSS)
    )
    if TAN_DELTA in curve:
        tan = curve[TAN_DELTA].to_numpy(dtype=float)
        loss = storage * tan if loss is None and storage is not None else loss
        storage = loss / tan if storage is None and loss is not None else storage
    frequency = curve["reduced_frequency_Hz"].to_numpy(dtype=float)
    limits = [float(frequency.min()), float(frequency.max())]
    return Moduli(
        omega=2.0 * np.pi * frequency,
        dT=curve["T_C"].to_numpy(dtype=float) - T_ref_C if "T_C" in curve else 0.0 * frequency,
        measured=2.0 * np.pi * curve["frequency_Hz"].to_numpy(dtype=float),
        storage=storage,
        loss=loss,
        T_ref_C=T_ref_C,
        rows=curve["row"].to_numpy(),
        table=source,
        about={"rows_used": len(curve), "T_ref_C": T_ref_C, "frequency_window_Hz": limits},
    )


def fit_sweeps(
    data: Moduli, *, branches: int | None = None, loss: Loss = "linear", noise: float = 0.05
) -> FitResult:
    """Fit a slow modulus and branches to storage and loss moduli, all relative to their size.

    See `calibration.fit_viscoelastic` for the parameters; the result's model is the spectrum.
    """
    data, found, best, independent = _searched(data, branches)
    result = fit(shifted_problem(data, best.count), _start(data, best), loss=loss, noise=noise)
    refuse_no_fit(result, data.table.file, MODULUS)
    _refuse_no_plateau(result, data)
    g, tau = spectrum_of(result, best.count)
    shift = data.shift
    if shift is not None:
        shift = WLF(d1=result.values["C1"], d2_K=result.values["C2_K"])
    prony = Prony(g=g, tau_s=tau, shift=shift, T_ref_C=data.T_ref_C)
    relative = result.predicted / result.observed - 1.0
    metadata = {
        "kind": "viscoelastic",
        "model": "sweeps",
        **data.table.origin,
        **data.about,
        "version": version_of(),
        "tau_window_s": list(moduli_curve(data).tau_s),
        **criterion(found, best),
        "relative_rmse": float(np.sqrt(np.mean(relative**2))),
    }
    return replace(
        result,
        model=prony,
        metadata=metadata,
        section={"rubber": {"viscoelastic": viscoelastic_keys(prony)}},
        warnings=(*result.warnings, *data.warnings, *correlation_warnings(independent)),
    )


def _searched(
    data: Moduli, branches: int | None
) -> tuple[Moduli, list[Candidate], Candidate, float]:
    """Number of branches on the master curve; a second time on one that the shift is fitted to."""
    for again in (True, False):
        found, independent = candidates(moduli_curve(data), branches)
        best = chosen(found, branches, data.table.file)
        if data.shift is None or not again:
            break
        joint = minimise(shifted_problem(data, best.count), _start(data, best)[None, :])
        data = data.shifted(WLF(d1=joint.x[-2], d2_K=joint.x[-1]))
    return data, found, best, independent


def _start(data: Moduli, best: Candidate) -> FloatArray:
    shift = () if data.shift is None else (data.shift.d1, data.shift.d2_K)
    return np.array([*best.theta, *shift])


def shifted_problem(data: Moduli, count: int) -> Problem:
    """Least-squares problem of slow modulus, branches and, where there are sweeps, the shift."""
    if data.shift is None:
        return memory_problem(moduli_curve(data), count)
    still = memory_problem(moduli_curve(data), count)
    times = slice(1 + count, 1 + 2 * count)

    def moved(theta: FloatArray) -> Problem:
        return memory_problem(
            moduli_curve(data, WLF(d1=float(theta[-2]), d2_K=float(theta[-1]))), count
        )

    def jacobian(theta: FloatArray) -> FloatArray:
        slopes = moved(theta).jacobian
        assert slopes is not None
        J = slopes(theta[:-2])
        by_log_frequency = J[:, times] @ theta[times]  # all depends on omega tau
        reached = theta[-1] + np.tile(data.dT, by_log_frequency.size // data.dT.size)
        dT = reached - theta[-1]
        slope = np.log(10.0) * by_log_frequency
        return np.column_stack([J, -slope * dT / reached, slope * theta[-2] * dT / reached**2])

    pole = max(0.0, float(-data.dT.min())) + 1.0
    return replace(
        still,
        names=(*still.names, "C1", "C2_K"),
        predict=lambda theta: moved(theta).predict(theta[:-2]),
        jacobian=jacobian,
        lower=np.append(still.lower, [1e-3, pole]),
        upper=np.append(still.upper, [1e4, 1e5]),
    )


def moduli_curve(data: Moduli, shift: WLF | None = None) -> MemoryCurve:
    """Storage and loss moduli as a slow modulus and branches, at another shift than their own."""
    omega = data.omega
    if shift is not None:
        omega = data.measured * 10.0 ** shift.log10_shift_factor(data.dT, 0.0)
    stored, lost = data.storage is not None, data.loss is not None
    unit = np.concatenate([np.ones(omega.size * stored), np.zeros(omega.size * lost)])

    def branch(log_tau: FloatArray) -> tuple[FloatArray, FloatArray]:
        x = omega[:, None] * np.exp(log_tau)
        share = 1.0 / (1.0 + x * x)
        parts = [(x * x * share, 2.0 * x * x * share**2)] * stored
        parts += [(x * share, x * share * (1.0 - x * x) * share)] * lost
        values, slopes = zip(*parts, strict=True)
        return np.concatenate(values), np.concatenate(slopes)

    observed = data.observed
    return MemoryCurve(
        names=(SLOW,),
        slow=lambda theta: theta[0] * unit,
        slow_slopes=lambda theta: unit[:, None],
        modulus=lambda theta: (float(theta[0]), np.ones(1)),
        branch=branch,
        lower=np.array([1e-6 * float(observed.max())]),
        upper=np.array([np.inf]),
        starts=np.array([[0.5 * float(observed.min())]]),
        moduli=np.array([True]),
        tau_s=(1.0 / (_MARGIN * float(data.omega.max())), _MARGIN / float(data.omega.min())),
        observed=observed,
        weights=1.0 / observed,
    )


def _refuse_no_plateau(result: FitResult, data: Moduli) -> None:
    """Moduli relative to a slow one that the sweeps do not reach would be any numbers."""
    value, error = result.values[SLOW], result.stderr[SLOW]
    if np.isfinite(error) and error < 0.5 * value:
        return
    data.table.refuse(
        column=MODULUS if data.storage is not None else LOSS,
        found=f"no rubbery plateau (slow modulus {value:.3g} +- {error:.2g} N/mm^2)",
        expected="sweeps that reach the plateau at low frequencies or high temperatures",
    )
