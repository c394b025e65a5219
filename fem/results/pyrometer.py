"""The profile that a pyrometer reads along the bottom of a block that runs off the road."""

from __future__ import annotations

import pandas as pd

from materials.arrays import FloatArray

PYROMETER_FILE = "pyrometer.csv"
#: `pyrometer.csv`: a row per bottom node, from the trailing to the leading corner. The pyrometer's
#: reading with the middle of the spot there, the temperature at the end of the last contact, and
#: the share of the spot that lies on the bottom.
PYROMETER = ("X_mm", "T_pyrometer_C", "T_C", "spot_covered")


def pyrometer_table(
    X_mm: FloatArray, seen: FloatArray, T_C: FloatArray, covered: FloatArray
) -> pd.DataFrame:
    """Table of a reading from columns (m,) in the order of `PYROMETER`."""
    return pd.DataFrame(dict(zip(PYROMETER, (X_mm, seen, T_C, covered), strict=True)))
