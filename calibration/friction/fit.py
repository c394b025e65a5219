"""Fit of friction laws to measured coefficients.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", eqs. (5)-(8), Table 2.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pandas as pd

from calibration.data import DataError
from calibration.fitting import (
    FitResult,
    Loss,
    Problem,
    evenly_spread,
    fit,
    refuse_no_fit,
    stage,
)
from calibration.friction.curves import HUEMER_SCALE, FrictionCurve, forms
from calibration.friction.data import FrictionData, read_friction
from contact.friction import FrictionLaw, shifted
from fem.files import version_of
from materials.arrays import FloatArray
from materials.wlf import WLF

_SCALED = [0, 1, 4, 5, 6]  # places of alpha, beta, a, b, c
_POINTS_OF_THE_STARTS = 2_000  # points that starts are made from
_ONE_TEMPERATURE_K = 5.0  # data that span more were not measured at one temperature
#: Pressures [N/mm^2] and speeds [mm/s] of tread blocks, up to ten times the mean at the edges.
_OF_A_BLOCK = ((1e-3, 10.0), (1.0, 1e5))
_LN10 = float(np.log(10.0))
#: Friction by the parameters, and its derivatives.
_Curve = Callable[[FloatArray], tuple[FloatArray, ...]]


def fit_friction(
    table: pd.DataFrame | str | Path | FrictionData,
    law: str = "huemer",
    *,
    wlf: WLF | Literal["fit"] | None = None,
    T_ref_C: float = 20.0,
    fixed: Mapping[str, float] | None = None,
    starts: int = 20,
    loss: Loss = "linear",
    noise: float = 0.05,
) -> FitResult:
    """Fit a friction law to measured coefficients.

    Parameters
    ----------
    table : DataFrame or path of a CSV file
        Columns ``p_N_per_mm2``, ``v_mm_per_s``, ``mu`` and optionally ``T_C``.
    law : str
        "huemer", "exponential", or another one that has been registered.
    wlf : WLF, "fit" or None
        Shift of the speed by the temperature: given, fitted together with the law (needs
        ``T_C`` at several temperatures), or none.
    T_ref_C : float
        Reference temperature of the shift [deg C].
    fixed : mapping, optional
        Parameters to hold. Huemer's ``a`` is held at 0.9203 besides (the redundancy of scale),
        unless one of those that share the scale is given.
    starts : int
        Number of starting points.
    loss, noise
        Robust loss and the residual of mu where it begins to act [-].

    Returns
    -------
    FitResult
        ``values`` by the names of the law (and d1, d2_K), ``model`` a ThermalFriction.

    Examples
    --------
    >>> from calibration.synthetic import synthetic_friction
    >>> from contact import ExponentialFriction
    >>> fit = fit_friction(synthetic_friction(ExponentialFriction()), law="exponential")
    >>> round(fit.r2, 2)
    1.0
    """
    if law not in forms():
        raise ValueError(f"law is {law!r}; expected one of {', '.join(forms())}")
    if isinstance(wlf, str) and wlf != "fit":
        raise ValueError(f'wlf is {wlf!r}; expected a WLF, "fit" or None')
    data, form = read_friction(table), forms()[law]
    held = form.with_scale(dict(fixed or {}))
    _require_data(data, form, law, wlf, held)
    problem = _problem(form, data, wlf, T_ref_C, data.coldest)
    few = data.at(evenly_spread(data.mu.size, _POINTS_OF_THE_STARTS))
    begin = _starts(form, few, wlf, T_ref_C, starts)
    if law == "huemer":
        begin[:, _SCALED] *= held.get("a", HUEMER_SCALE) / HUEMER_SCALE
    result = fit(problem, begin, fixed=held, loss=loss, noise=noise)
    if wlf == "fit":
        wlf = WLF(d1=result.values["d1"], d2_K=result.values["d2_K"])
    return _completed(result, law, form, data, wlf, T_ref_C)


def _require_data(
    data: FrictionData, form: FrictionCurve, law: str, wlf: Any, held: Mapping[str, float]
) -> None:
    names = (*form.names, "d1", "d2_K") if wlf == "fit" else form.names
    free = sum(name not in held for name in names)
    data.table.require_rows(free, f"the {free} free parameters of {law}")
    if wlf is None:
        return
    if data.T is None:
        data.table.require(("T_C",))
    elif wlf == "fit" and np.unique(data.T).size < 2:
        data.table.refuse(
            column="T_C", found="one temperature", expected="two or more to fit the WLF shift to"
        )


def _problem(
    form: FrictionCurve, data: FrictionData, wlf: Any, T_ref_C: float, coldest: float
) -> Problem:
    names, lower, upper = form.names, tuple(form.lower), tuple(form.upper)
    if wlf == "fit":
        pole = max(T_ref_C - coldest, 0.0) + 5.0  # keeps every temperature 5 K above the pole
        names, lower, upper = (*names, "d1", "d2_K"), (*lower, 1e-3, pole), (*upper, 1e3, 1e4)
        curve: _Curve = _shifting_curve(form, data, T_ref_C)
    else:
        curve = partial(form.curve, p=data.p, v=_shifted_speed(data, wlf, T_ref_C))
    return Problem(
        names=names,
        observed=data.mu,
        predict=lambda theta: curve(theta)[0],
        jacobian=lambda theta: curve(theta)[1],
        lower=np.array(lower),
        upper=np.array(upper),
        subset=lambda rows: _problem(form, data.at(rows), wlf, T_ref_C, coldest),
    )


def _shifting_curve(form: FrictionCurve, data: FrictionData, T_ref_C: float) -> _Curve:
    """Friction and its derivatives by the parameters of the law, d1 and d2."""
    assert data.T is not None
    dT = data.T - T_ref_C
    k = len(form.names)

    def curve(theta: FloatArray) -> tuple[FloatArray, ...]:
        d1, d2 = theta[k:]
        reached = d2 + dT
        v = data.v * 10.0 ** (-d1 * dT / reached)
        mu, J, by_log_v = form.curve(theta[:k], data.p, v)
        by_d1 = -_LN10 * dT / reached * by_log_v
        by_d2 = _LN10 * d1 * dT / reached**2 * by_log_v
        return mu, np.column_stack([J, by_d1, by_d2])

    return curve


def _shifted_speed(data: FrictionData, wlf: WLF | None, T_ref_C: float) -> FloatArray:
    if wlf is None or data.T is None:
        return data.v
    return wlf.equivalent_velocity(data.v, data.T, T_ref_C)


def _starts(
    form: FrictionCurve, data: FrictionData, wlf: Any, T_ref_C: float, count: int
) -> FloatArray:
    if wlf != "fit":
        return form.starts(data.p, _shifted_speed(data, wlf, T_ref_C), data.mu, count)
    points = []
    for d2 in (60.0, 200.0, 600.0):
        for decades_per_kelvin in (0.02, 0.06, 0.15):
            shift = WLF(d1=decades_per_kelvin * d2, d2_K=d2 + max(T_ref_C - data.coldest, 0.0))
            v = _shifted_speed(data, shift, T_ref_C)
            law = form.starts(data.p, v, data.mu, max(4, count // 4))
            points.append(np.column_stack([law, np.tile([shift.d1, shift.d2_K], (len(law), 1))]))
    return np.concatenate(points)


def _completed(
    result: FitResult,
    law: str,
    form: FrictionCurve,
    data: FrictionData,
    wlf: WLF | None,
    T_ref_C: float,
) -> FitResult:
    refuse_no_fit(result, data.table.file, "mu")
    own = {name: result.values[name] for name in form.names}
    speed = _shifted_speed(data, wlf, T_ref_C)
    floors = _floors(data, speed)
    try:
        friction = shifted(form.build(own, **floors), wlf, T_ref_C)
    except ValueError as error:
        found = f"data whose best {law} fit is no admissible law ({error})"
        expected = "friction over a wider range of speed and pressure, or another law"
        raise DataError(file=data.table.file, found=found, expected=expected) from None
    section = {
        "law": law,
        **own,
        "wlf": wlf is not None,
        **_shift_keys(data, wlf, T_ref_C),
        "p_min_N_per_mm2": floors["p_min"],
        "v_min_mm_per_s": floors["v_min"],
        "window": _window(p_N_per_mm2=data.p, v_mm_per_s=speed, T_C=data.T),
    }
    metadata = {
        "kind": "friction",
        "model": law,
        **data.table.origin,
        "T_ref_C": section.get("T_ref_C", "not known: the data hold no temperatures"),
        "rows_used": len(data.table),
        "normalisation": _normalisation(result) if law == "huemer" else "none needed",
        "version": version_of(),
    }
    negative = _negative_warnings(friction.law, data, speed)
    return replace(
        result,
        model=friction,
        metadata=metadata,
        section={"friction": section},
        warnings=(*result.warnings, *_data_warnings(data, wlf), *negative),
    )


def _shift_keys(data: FrictionData, wlf: WLF | None, T_ref_C: float) -> dict[str, float]:
    """Keys of the shift; without one, the temperature of the data if they have just one."""
    if wlf is not None:
        return {"d1": wlf.d1, "d2_K": wlf.d2_K, "T_ref_C": float(T_ref_C)}
    if data.T is not None and np.ptp(data.T) <= _ONE_TEMPERATURE_K:
        return {"T_ref_C": float(data.T.mean())}
    return {}


def _window(**ranges: FloatArray | None) -> dict[str, list[float]]:
    """Lowest and highest value of what was measured."""
    return {
        key: [float(values.min()), float(values.max())]
        for key, values in ranges.items()
        if values is not None
    }


def _negative_warnings(law: FrictionLaw, data: FrictionData, speed: FloatArray) -> tuple[str, ...]:
    """Where the law gives no friction or less: refused at the data, a warning beyond them.

    Pressures and speeds are those of tread blocks and their edges.
    """
    at_data = law.coefficient(data.p, speed)
    if np.any(at_data <= 0.0):
        i = int(np.argmin(at_data))
        data.table.refuse_at(
            i,
            "mu",
            f"a best fit that gives {at_data[i]:.3g} there",
            "a law that is positive over its data: another one, or fewer outliers",
        )
    p, v = (np.geomspace(*limits, 200) for limits in _OF_A_BLOCK)
    positive = law.coefficient(p[:, None], v) > 0.0
    if np.all(positive):
        return ()
    sound_p, sound_v = p[np.all(positive, axis=1)], v[np.all(positive, axis=0)]
    if sound_p.size:
        where = f"at pressures outside {sound_p.min():.3g} to {sound_p.max():.3g} N/mm^2"
    elif sound_v.size:
        where = f"at speeds outside {sound_v.min():.3g} to {sound_v.max():.3g} mm/s"
    else:
        where = "at some speed for every pressure"
    return (f"outside the data the law gives a friction coefficient below zero, {where}",)


def _normalisation(result: FitResult) -> str:
    held = {name: value for name, value in result.fixed.items() if name not in ("n", "inverse_m")}
    return ", ".join(f"{name} = {value:g}" for name, value in held.items())


def _floors(data: FrictionData, speed: FloatArray) -> dict[str, float]:
    """Floors of the law: the usual ones, or lower where the data reach below them."""
    return {"p_min": min(1e-3, float(data.p.min())), "v_min": min(1.0, float(speed.min()))}


def _data_warnings(data: FrictionData, wlf: WLF | None) -> tuple[str, ...]:
    if wlf is None and data.T is not None and np.ptp(data.T) > _ONE_TEMPERATURE_K:
        span = f"{data.T.min():g} to {data.T.max():g} deg C"
        return (f"the data span {span}, but no WLF shift takes part in the fit",)
    return ()


def compare_laws(
    table: pd.DataFrame | str | Path | FrictionData,
    laws: tuple[str, ...] | None = None,
    **options: Any,
) -> pd.DataFrame:
    """Fit several laws to the same data.

    Returns
    -------
    DataFrame
        ``law, parameters, n_data, rmse, r2, aic, mu_largest_difference`` (the largest difference
        between the law's curve and the best law's curve over the data), best AIC first, and
        ``reason``. A law the data cannot carry has NaN and the reason.
    """
    data = read_friction(table)
    found, refused = {}, {}
    for law in forms() if laws is None else laws:
        stage(f"comparing with {law}")
        try:
            found[law] = fit_friction(data, law, **options)
        except ValueError as error:
            refused[law] = str(error)
    best = min(found.values(), key=lambda result: result.aic, default=None)
    rows = [
        {
            "law": law,
            "parameters": len(result.names),
            "n_data": result.n_data,
            "rmse": result.rmse,
            "r2": result.r2,
            "aic": result.aic,
            "mu_largest_difference": float(np.abs(result.predicted - best.predicted).max()),
            "reason": "",
        }
        for law, result in found.items()
        if best is not None
    ]
    nothing = dict.fromkeys(("rmse", "r2", "aic", "mu_largest_difference"), np.nan)
    rows += [
        {"law": law, "parameters": len(forms()[law].names), "n_data": 0, **nothing, "reason": why}
        for law, why in refused.items()
    ]
    return pd.DataFrame(rows).sort_values("aic", na_position="last").reset_index(drop=True)
