"""Made-up measurements from the paper's published parameters.

The paper's own stress curves, friction coefficients and temperatures are not public. What stands in
for them is made here, with stated noise, and is called synthetic wherever it appears: it shows that
the calibration finds parameters that are known, not that a rubber behaves so.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", section 2.2, Tables 1-2.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from contact.friction import FrictionLaw, shifted
from materials.arrays import FloatArray
from materials.compounds import compound
from materials.hyperelastic import Hyperelastic
from materials.wlf import WLF

STRESS_NOISE_N_PER_MM2 = 0.01
FRICTION_NOISE = 0.002
_SPEEDS = tuple(np.geomspace(1.0, 3000.0, 25))


@dataclass(frozen=True, kw_only=True)
class StrainRange:
    """Model and strain range behind a parameter set of Table 1.

    Parameters
    ----------
    model : str
        Name of the model for the fit.
    low, high : float
        Smallest and largest stretch of the uniaxial tests [-].
    """

    model: str
    low: float
    high: float


#: Dumbbells span strains from -18 % to 40 %, bars reach 150 % (series 1) and 300 % (series 2).
TABLE_1: dict[str, StrainRange] = {
    "mooney-rivlin-dumbbells": StrainRange(model="mooney-rivlin", low=0.82, high=1.40),
    "yeoh-bars-series-1": StrainRange(model="yeoh", low=1.0, high=2.5),
    "yeoh-bars-series-2": StrainRange(model="yeoh", low=1.0, high=4.0),
    "yeoh-bars-series-1-load": StrainRange(model="yeoh", low=1.0, high=2.5),
    "van-der-waals-bars-series-1": StrainRange(model="van-der-waals", low=1.0, high=2.5),
    "van-der-waals-bars-series-2": StrainRange(model="van-der-waals", low=1.0, high=4.0),
}


def synthetic_stress(
    name: str,
    *,
    points: int = 200,
    noise_N_per_mm2: float = STRESS_NOISE_N_PER_MM2,
    seed: int = 0,
) -> pd.DataFrame:
    """Uniaxial test of a compound of Table 1 at the strain range of its own tests.

    Returns
    -------
    DataFrame
        ``stretch, nominal_stress_N_per_mm2, mode``, with normal noise on the stress.
    """
    tests = TABLE_1[name]
    stretch = np.linspace(tests.low, tests.high, points)
    stress = compound(name).nominal_stress(stretch, "uniaxial")
    rng = np.random.default_rng([seed, list(TABLE_1).index(name)])
    noise = rng.normal(0.0, 1.0, points) * noise_N_per_mm2
    return _stress_table(stretch, stress + noise)


def synthetic_bar_cycles(
    series: int,
    *,
    cycles: int = 5,
    points: int = 60,
    noise_N_per_mm2: float = 0.0,
    seed: int = 0,
) -> pd.DataFrame:
    """Cyclic test of a bar: cycles to the full amplitude from zero load, then to failure.

    Parameters
    ----------
    series : {1, 2}
        Amplitude of 150 % or 300 % strain.
    cycles, points : int
        Number of full cycles and points of each path.
    noise_N_per_mm2, seed
        Standard deviation of the noise, and its seed.

    Returns
    -------
    DataFrame
        ``cycle, branch, stretch, nominal_stress_N_per_mm2, mode`` in the order of recording.

    Notes
    -----
    Made so that the paper's choice of data leads to the paper's parameters. The stabilised loop of
    series 1 loads along "yeoh-bars-series-1-load", and load and unload average to
    "yeoh-bars-series-1". Series 2 has no set of its own for loading: its loop opens by 35 % about
    "yeoh-bars-series-2". Earlier cycles load up to 80 % stiffer at small strain and join the same
    curve at the amplitude, a softening that dies out until the last cycle. The path to failure goes
    on to 1.15 times the largest stretch.
    """
    highest = 2.5 if series == 1 else 4.0
    stretch = np.linspace(1.0, highest, points)
    load, unload = _stable_loop(series, stretch, highest)
    rejoin = (highest - stretch) / (highest - 1.0)
    parts = []
    for cycle in range(1, cycles + 1):
        up = load * (1.0 + _softening(cycle, cycles) * rejoin)
        parts += [_path(cycle, "load", stretch, up), _path(cycle, "unload", stretch, unload, True)]
    beyond = np.linspace(1.0, 1.15 * highest, points)
    parts.append(_path(cycles + 1, "load", beyond, _stable_loop(series, beyond, highest)[0]))
    return _noisy(pd.concat(parts, ignore_index=True), noise_N_per_mm2, seed)


def synthetic_dumbbell_cycles(
    *, cycles_per_level: int = 3, points: int = 30, noise_N_per_mm2: float = 0.0, seed: int = 0
) -> pd.DataFrame:
    """Cyclic test of a dumbbell with growing strain levels in tension and compression.

    Returns
    -------
    DataFrame
        As `synthetic_bar_cycles`, with the column ``level`` besides. Four levels end at strains of
        10, 20, 30, 40 % in tension and 4.5, 9, 13.5, 18 % in compression; a last path loads to
        failure. Loops open by 15 % about "mooney-rivlin-dumbbells", and the first cycle of a level
        loads up to 30 % stiffer below its amplitude.
    """
    model, parts, cycle = compound("mooney-rivlin-dumbbells"), [], 0
    for level in range(1, 5):
        for repeat in range(1, cycles_per_level + 1):
            cycle += 1
            for end in (1.0 + 0.1 * level, 1.0 - 0.045 * level):
                stretch = np.linspace(1.0, end, points)
                up, down = _loop(model, stretch, end, 0.15)
                fresh = 0.375 * _softening(repeat, cycles_per_level)
                up = up * (1.0 + fresh * (end - stretch) / (end - 1.0))
                parts += [
                    _path(cycle, "load", stretch, up).assign(level=level),
                    _path(cycle, "unload", stretch, down, True).assign(level=level),
                ]
    failure = np.linspace(1.0, 1.5, points)
    stress = model.nominal_stress(failure, "uniaxial")
    parts.append(_path(cycle + 1, "load", failure, stress).assign(level=5))
    return _noisy(pd.concat(parts, ignore_index=True), noise_N_per_mm2, seed)


def _stable_loop(series: int, stretch: FloatArray, highest: float) -> tuple[FloatArray, FloatArray]:
    if series == 2:
        return _loop(compound("yeoh-bars-series-2"), stretch, highest, 0.35)
    mean = compound("yeoh-bars-series-1").nominal_stress(stretch, "uniaxial")
    load = compound("yeoh-bars-series-1-load").nominal_stress(stretch, "uniaxial")
    return load, 2.0 * mean - load


def _loop(
    model: Hyperelastic, stretch: FloatArray, end: float, width: float
) -> tuple[FloatArray, FloatArray]:
    """Load and unload path that open by `width` about the model and close at both ends."""
    mean = model.nominal_stress(stretch, "uniaxial")
    z = np.clip((stretch - 1.0) / (end - 1.0), 0.0, 1.0)
    opening = 4.0 * width * z * (1.0 - z)
    return mean * (1.0 + opening), mean * (1.0 - opening)


def _softening(cycle: int, cycles: int) -> float:
    """Extra stiffness of a loading path: 0.8 in the first cycle, none in the last."""
    if cycles == 1:
        return 0.0
    last = 0.35 ** (cycles - 1)
    return 0.8 * (0.35 ** (cycle - 1) - last) / (1.0 - last)


def _path(
    cycle: int, branch: str, stretch: FloatArray, stress: FloatArray, backwards: bool = False
) -> pd.DataFrame:
    order = slice(None, None, -1) if backwards else slice(None)
    table = _stress_table(stretch[order], stress[order])
    table.insert(0, "branch", branch)
    table.insert(0, "cycle", cycle)
    return table


def _stress_table(stretch: FloatArray, stress: FloatArray) -> pd.DataFrame:
    return pd.DataFrame(
        {"stretch": stretch, "nominal_stress_N_per_mm2": stress, "mode": "uniaxial"}
    )


def _noisy(table: pd.DataFrame, noise: float, seed: int) -> pd.DataFrame:
    table["nominal_stress_N_per_mm2"] += (
        np.random.default_rng(seed).normal(0, 1, len(table)) * noise
    )
    return table


def synthetic_friction(
    law: FrictionLaw,
    *,
    pressures_N_per_mm2: ArrayLike = (0.05, 0.1, 0.2, 0.4, 0.7, 1.0),
    velocities_mm_per_s: ArrayLike = _SPEEDS,
    temperatures_C: Sequence[float] | None = None,
    wlf: WLF | None = None,
    T_ref_C: float = 20.0,
    repeats: int = 4,
    noise: float = FRICTION_NOISE,
    seed: int = 0,
) -> pd.DataFrame:
    """Friction tests over a full grid of pressure and speed (and temperature).

    Returns
    -------
    DataFrame
        ``p_N_per_mm2, v_mm_per_s, mu`` and ``T_C`` when temperatures are given, with normal noise
        on mu.
    """
    temperatures = [T_ref_C] if temperatures_C is None else list(temperatures_C)
    grid = np.meshgrid(pressures_N_per_mm2, velocities_mm_per_s, temperatures, np.arange(repeats))
    p, v, T = (axis.ravel().astype(float) for axis in grid[:3])
    mu = shifted(law, wlf, T_ref_C).coefficient(p, v, T)
    mu = mu + np.random.default_rng(seed).normal(0.0, 1.0, mu.size) * noise
    table = pd.DataFrame({"p_N_per_mm2": p, "v_mm_per_s": v, "mu": mu})
    return table if temperatures_C is None else table.assign(T_C=T)
