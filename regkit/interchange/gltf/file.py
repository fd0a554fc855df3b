"""Access to a glTF 2.0 file and its binary data.

Source: The Khronos Group, glTF 2.0 Specification, section 3.6 (binary data).
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from regkit.interchange.gltf.container import read_container
from regkit.interchange.gltf.uri import read_uri
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.optional import load_library

SUFFIXES = (".glb", ".gltf")

LARGEST = 100_000_000
"""Largest number of values in an accessor; others are read from the file and bounded by it."""

_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_COUNTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}

_Numbers = np.ndarray[Any, np.dtype[Any]]


@dataclass(frozen=True)
class GltfFile:
    """A glTF file.

    Attributes:
        path: Path of the file.
        content: Content of the file as ``pygltflib.GLTF2``.
        binary: The binary chunk of a .glb file; None if there is none.
    """

    path: Path
    content: Any
    binary: bytes | None

    @classmethod
    def read(cls, path: Path) -> GltfFile:
        """Reads a ``.glb`` or ``.gltf`` file.

        Raises:
            DataError: If the file is not glTF 2.0, or is compressed.
            DependencyError: If pygltflib is missing.
            OSError: If the file cannot be read.
        """
        gltf = pygltflib()
        model, binary = read_container(path)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            content = gltf.GLTF2.gltf_from_json(json.dumps(model))
        file = cls(path, content, binary)
        for extension in content.extensionsRequired or ():
            if str(extension).endswith("compression"):
                raise file.compressed(extension)
        return file

    def wrong(self, message: str) -> DataError:
        """Returns an error at this file."""
        return DataError(message, place=str(self.path))

    def compressed(self, extension: str) -> DataError:
        """Returns the error of a file that is compressed."""
        return self.wrong(f"is compressed ({extension}); export it without compression")

    def item(self, items: Sequence[Any] | None, index: Any, what: str) -> Any:
        """Returns an element of one of the file's lists.

        Args:
            items: The list.
            index: Index in the file.
            what: Name of an element in messages.

        Raises:
            DataError: If there is none of this index.
        """
        count = len(items or ())
        if not isinstance(index, int) or isinstance(index, bool) or not 0 <= index < count:
            raise self.wrong(f"there is no {what} {index}; the file has {count}")
        return (items or ())[index]

    def floats(self, accessor: int) -> Array:
        """Returns the values of an accessor as floats (N, C); normalized integers are scaled.

        Raises:
            DataError: If the accessor is missing or invalid, or a value is not finite.
        """
        numbers = self._numbers(accessor)
        values = numbers.astype(np.float64)
        # Some exporters also mark floats as normalized, where it has no meaning.
        if self.content.accessors[accessor].normalized and numbers.dtype.kind != "f":
            # Section 3.11: the most negative signed integer also means -1.
            values = np.maximum(values / np.iinfo(numbers.dtype).max, -1.0)
        if not np.isfinite(values).all():
            raise self.wrong(f"accessor {accessor} has a NaN or infinite value")
        return values

    def integers(self, accessor: int) -> np.ndarray[Any, np.dtype[np.intp]]:
        """Returns the values of an accessor as integers (N, C), none of them negative.

        Raises:
            DataError: If the accessor is missing or invalid, or a value is negative or no integer.
        """
        numbers = self._numbers(accessor)
        whole = numbers.astype(np.float64)
        if not np.isfinite(whole).all() or (whole < 0.0).any() or (whole % 1.0).any():
            raise self.wrong(f"accessor {accessor} has a value that is no index, such as -1 or NaN")
        return numbers.astype(np.intp)

    def _numbers(self, accessor: int) -> _Numbers:
        described = self.item(self.content.accessors, accessor, "accessor")
        try:
            kind, width = np.dtype(_TYPES[described.componentType]), _COUNTS[described.type]
            count = int(described.count)
            if described.bufferView is None:
                if described.sparse is None and "KHR_draco_mesh_compression" in (
                    self.content.extensionsUsed or ()
                ):
                    raise self.compressed("KHR_draco_mesh_compression")
                if not 0 <= count * width <= LARGEST:
                    raise self.wrong(f"accessor {accessor} has {count} elements")
                values: _Numbers = np.zeros((count, width), kind)
            else:
                values = self._viewed(
                    described.bufferView, described.byteOffset, kind, width, count
                )
            return values if described.sparse is None else self._sparse(described, values)
        except (
            AttributeError,
            IndexError,
            KeyError,
            TypeError,
            ValueError,
            OverflowError,
        ) as error:
            raise self.wrong(f"accessor {accessor} cannot be read ({error})") from None

    def _viewed(
        self, index: int, offset: int | None, kind: np.dtype[Any], width: int, count: int
    ) -> _Numbers:
        """Returns the values (count, width) of a view, which others may be interleaved with."""
        view = self.item(self.content.bufferViews, index, "bufferView")
        own = kind.itemsize * width
        return np.ndarray(
            (count, width),
            kind,
            self.item(self._buffers, view.buffer, "buffer"),
            (view.byteOffset or 0) + (offset or 0),
            (view.byteStride or own, kind.itemsize),
        )

    def _sparse(self, described: Any, values: _Numbers) -> _Numbers:
        """Returns the values with those that a sparse accessor replaces, section 3.6.2.3."""
        sparse = described.sparse
        places = self._viewed(
            sparse.indices.bufferView,
            sparse.indices.byteOffset,
            np.dtype(_TYPES[sparse.indices.componentType]),
            1,
            sparse.count,
        )[:, 0].astype(np.intp)
        replaced = values.copy()
        if len(places) and not 0 <= places.min() <= places.max() < len(values):
            raise ValueError(f"a sparse index is beyond its {len(values)} elements")
        replaced[places] = self._viewed(
            sparse.values.bufferView,
            sparse.values.byteOffset,
            values.dtype,
            values.shape[1],
            sparse.count,
        )
        return replaced

    @cached_property
    def _buffers(self) -> list[bytes]:
        """The contents of all buffers.

        Raises:
            DataError: If a buffer is missing or unreadable.
        """
        return [self._buffer(index, buffer) for index, buffer in enumerate(self.content.buffers)]

    def _buffer(self, index: int, buffer: Any) -> bytes:
        if buffer.uri is None:
            if self.binary is None or index > 0:
                raise self.wrong(f"buffer {index} has no data; it needs a uri, or a binary chunk")
            return self.binary
        try:
            return read_uri(str(buffer.uri), self.path.parent)
        except (OSError, ValueError) as error:
            raise self.wrong(f"buffer {index} cannot be read ({error})") from None


def pygltflib() -> Any:
    """Returns the module ``pygltflib``.

    Raises:
        DependencyError: If it is missing.
    """
    return load_library("pygltflib")
