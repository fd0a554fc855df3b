"""Arrays as JSON: base64 of their bytes, with type and shape."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

Packed = dict[str, Any]
"""An array as a JSON object: ``dtype``, ``shape``, and ``data`` in base64, little endian."""


def packed(array: Any, dtype: str) -> Packed:
    """Returns an array as JSON.

    Args:
        array: The array.
        dtype: Its type in JSON: ``f4``, ``i2``, ``u2`` or ``u4``.
    """
    stored = np.ascontiguousarray(array, dtype=f"<{dtype}")
    data = base64.b64encode(stored.tobytes()).decode("ascii")
    return {"dtype": dtype, "shape": list(stored.shape), "data": data}


def unpacked(one: Packed) -> np.ndarray[Any, Any]:
    """Returns the array of ``packed``."""
    data = base64.b64decode(one["data"])
    return np.frombuffer(data, dtype=f"<{one['dtype']}").reshape(one["shape"])
