# SPDX-License-Identifier: BSD-3-Clause
"""Tables of pandas."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas


def as_frame(table: NDArray[np.void]) -> pandas.DataFrame:
    """A structured array as a pandas.DataFrame, a column each."""
    try:
        import pandas
    except ImportError:
        raise ImportError("to_pandas needs pandas (Debian: python3-pandas)") from None
    return pandas.DataFrame({name: table[name] for name in table.dtype.names or ()})
