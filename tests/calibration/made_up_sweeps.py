"""Made-up frequency sweeps of a rubber whose WLF constants are known."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from materials.wlf import WLF

_FREQUENCIES = tuple(np.geomspace(0.1, 100.0, 16))


def synthetic_sweeps(
    wlf: WLF,
    temperatures_C: Sequence[float],
    *,
    T_ref_C: float = 20.0,
    frequencies_Hz: ArrayLike = _FREQUENCIES,
    noise_decades: float = 0.0,
    seed: int = 0,
) -> pd.DataFrame:
    """Frequency sweeps of a storage modulus that rises from 1 to 100 N/mm^2 over eight decades.

    Returns
    -------
    DataFrame
        ``T_C, frequency_Hz, modulus_N_per_mm2`` with normal noise on log10 of the modulus.
    """
    T, f = (axis.ravel() for axis in np.meshgrid(temperatures_C, frequencies_Hz, indexing="ij"))
    reduced = np.log10(f) + wlf.log10_shift_factor(T, T_ref_C)
    log_E = 1.0 + np.tanh(0.25 * (reduced - 1.0))
    log_E = log_E + np.random.default_rng(seed).normal(0.0, 1.0, log_E.size) * noise_decades
    return pd.DataFrame({"T_C": T, "frequency_Hz": f, "modulus_N_per_mm2": 10.0**log_E})
