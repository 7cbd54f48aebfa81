"""Names of array types for signatures; shapes are in the docstrings."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
IndexArray = NDArray[np.intp]
ComplexArray = NDArray[np.complex128]
