"""Tables of friction coefficients."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas as pd

from calibration.data import Table, read_table
from materials.arrays import FloatArray, IndexArray

COLUMNS = ("p_N_per_mm2", "v_mm_per_s", "mu")


@dataclass(frozen=True, kw_only=True)
class FrictionData:
    """Measured friction coefficients.

    Parameters
    ----------
    p, v, mu : ndarray, shape (n,)
        Pressure [N/mm^2], speed [mm/s], coefficient [-].
    T : ndarray or None
        Temperature of the rubber's surface [deg C].
    table : Table
    """

    p: FloatArray
    v: FloatArray
    mu: FloatArray
    T: FloatArray | None
    table: Table

    def at(self, rows: IndexArray) -> "FrictionData":
        """Some of the points."""
        T = None if self.T is None else self.T[rows]
        return replace(self, p=self.p[rows], v=self.v[rows], mu=self.mu[rows], T=T)

    @property
    def coldest(self) -> float:
        """Lowest temperature [deg C]; infinite without temperatures."""
        return float("inf") if self.T is None else float(self.T.min())


def read_friction(table: pd.DataFrame | str | Path | FrictionData) -> FrictionData:
    """Read and check a friction table."""
    if isinstance(table, FrictionData):
        return table
    source = read_table(table, COLUMNS)
    p, v, mu = (source.numbers(column) for column in COLUMNS)
    source.require_all("v_mm_per_s", v > 0.0, "a sliding speed above 0 mm/s")
    if not np.any(mu):
        source.refuse_at(0, "mu", "zero in every row", "friction coefficients, not all zero")
    T = source.numbers("T_C") if source.has("T_C") else None
    return FrictionData(p=p, v=v, mu=mu, T=T, table=source)
