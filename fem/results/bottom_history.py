"""Stick, slip and pressure along the bottom at every accepted step, kept compactly."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from materials.arrays import AnyArray

#: Name of the file in the folder of a run.
BOTTOM_FILE = "bottom.npz"


@dataclass(frozen=True, kw_only=True)
class BottomHistory:
    """A row per accepted step, those of `history.csv`, a column per bottom node.

    Attributes
    ----------
    X_mm : (m,) float array
        Distance of the nodes from the trailing corner [mm].
    kind : (n, m) int8 array
        0 open, 1 stick, 2 slip.
    pressure : (n, m) float32 array
        Contact pressure [N/mm^2].
    """

    X_mm: AnyArray
    kind: AnyArray
    pressure: AnyArray

    def write(self, path: str | Path) -> None:
        """Write a NumPy archive."""
        np.savez_compressed(path, X_mm=self.X_mm, kind=self.kind, pressure_N_per_mm2=self.pressure)

    @classmethod
    def read(cls, path: str | Path) -> BottomHistory:
        """Read what `write` wrote.

        Raises
        ------
        ValueError
            If the file is damaged, naming it.
        """
        try:
            with np.load(path, allow_pickle=False) as kept:
                X, kind, p = (kept[k] for k in ("X_mm", "kind", "pressure_N_per_mm2"))
        # A damaged archive makes the reading libraries raise almost anything.
        except Exception as error:
            raise ValueError(f"{path} is damaged ({error or type(error).__name__})") from None
        if kind.ndim != 2 or kind.shape != p.shape or kind.shape[1:] != X.shape:
            raise ValueError(f"{path} is damaged (arrays of {X.shape}, {kind.shape}, {p.shape})")
        return cls(X_mm=X, kind=kind, pressure=p)
