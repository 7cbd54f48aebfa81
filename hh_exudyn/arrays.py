"""Array types that signatures name: what an array holds; its shape stands in the docstring."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
IndexArray = NDArray[np.intp]
ComplexArray = NDArray[np.complex128]
