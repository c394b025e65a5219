"""Types of arrays, in the hints of all packages."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
IndexArray = NDArray[np.intp]
Int32Array = NDArray[np.int32]
BoolArray = NDArray[np.bool_]
WordArray = NDArray[np.str_]
AnyArray = NDArray[Any]
