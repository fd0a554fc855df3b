"""The buffer of a glTF file that is to be written."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

_KINDS = {"<u2": 5123, "<u4": 5125, "<f4": 5126}
_TYPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class GltfBuffer:
    """Numbers accumulated into one buffer, and what is to be said of them.

    Attributes:
        content: The buffer.
        views: A ``pygltflib.BufferView`` for each array.
        accessors: A ``pygltflib.Accessor`` for each.
    """

    def __init__(self, pygltflib: Any) -> None:
        self._gltf = pygltflib
        self.content = bytearray()
        self.views: list[Any] = []
        self.accessors: list[Any] = []

    def add(self, values: NDArray[Any], kind: str, *, bounds: bool = False) -> int:
        """The index of an accessor of values (N, C).

        Args:
            values: The numbers.
            kind: How they are stored: ``<f4``, ``<u2`` or ``<u4``.
            bounds: Whether the smallest and largest are told, as positions and times need it.
        """
        rows = np.ascontiguousarray(values, dtype=kind)
        view = self._gltf.BufferView(buffer=0, byteOffset=len(self.content), byteLength=rows.nbytes)
        self.content += rows.tobytes()
        # Every array begins at a multiple of four bytes.
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
