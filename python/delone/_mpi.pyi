# SPDX-License-Identifier: BSD-3-Clause
from typing import Any, Dict, List, Union

import numpy as np
import numpy.typing as npt

size_of_communicator: int
library_version: str

def make_tiles(input: Union[List[bytes], npt.NDArray[np.float64]], folder: bytes, communicator: int, *, memory: int, tiles: int,
               threads: int, weighted: bool, format: str, columns: int, lattice: List[float], dimension: int, unit: float, resume: bool) -> Dict[str, Any]: ...
