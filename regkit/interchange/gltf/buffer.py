"""The binary buffer of a glTF file for export."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

_KINDS = {"<u2": 5123, "<u4": 5125, "<f4": 5126}
_TYPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class GltfBuffer:
    """Arrays packed into one buffer, with their views and accessors.

    Args:
        pygltflib: The module ``pygltflib``.

    Attributes:
        content: The buffer.
        views: The ``pygltflib.BufferView`` of each array.
        accessors: The ``pygltflib.Accessor`` of each array.
    """

    def __init__(self, pygltflib: Any) -> None:
        self._gltf = pygltflib
        self.content = bytearray()
        self.views: list[Any] = []
        self.accessors: list[Any] = []

    def add(self, values: NDArray[Any], kind: str, *, bounds: bool = False) -> int:
        """Adds an array, and returns the index of its accessor.

        Args:
            values: The array, (N, C).
            kind: Storage type: ``<f4``, ``<u2`` or ``<u4``.
            bounds: Whether to store minimum and maximum, which positions and times require.
        """
        rows = np.ascontiguousarray(values, dtype=kind)
        view = self._gltf.BufferView(buffer=0, byteOffset=len(self.content), byteLength=rows.nbytes)
        self.content += rows.tobytes()
        # Arrays are aligned to four bytes.
        self.content += bytes(-len(self.content) % 4)
        accessor = self._gltf.Accessor(
            bufferView=len(self.views),
            componentType=_KINDS[kind],
            count=len(rows),
            type=_TYPES[rows.shape[1]],
        )
        if bounds:
            accessor.min = rows.min(axis=0).astype(float).tolist()
            accessor.max = rows.max(axis=0).astype(float).tolist()
        self.views.append(view)
        self.accessors.append(accessor)
        return len(self.accessors) - 1
