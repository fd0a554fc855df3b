"""The arrays of a glTF file.

Source: The Khronos Group, glTF 2.0 Specification, section 3.6 (binary data).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from regkit.clouds.formats.gltf.container import read_container
from regkit.clouds.formats.gltf.uri import read_uri
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError

LARGEST = 10_000_000
"""Largest number of zeros in an accessor; other values are in the file, which bounds them."""

_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_COUNTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_DRACO = "KHR_draco_mesh_compression"

_Numbers = np.ndarray[Any, np.dtype[Any]]


@dataclass(frozen=True)
class GltfData:
    """The content of a glTF file.

    Attributes:
        path: Path of the file.
        model: Its JSON.
        binary: The binary chunk of a .glb file; None if there is none.
    """

    path: Path
    model: dict[str, Any]
    binary: bytes | None

    @classmethod
    def load(cls, path: Path) -> GltfData:
        """Reads a ``.glb`` or ``.gltf`` file.

        Raises:
            DataError: If the file is not glTF 2.0, or is compressed.
            OSError: If the file cannot be read.
        """
        data = GltfData(path, *read_container(path))
        for extension in data.model.get("extensionsRequired") or ():
            if str(extension).endswith("compression"):
                raise data.compressed(str(extension))
        return data

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
        if self.model["accessors"][accessor].get("normalized") and numbers.dtype.kind != "f":
            # Section 3.11: the most negative signed integer also means -1.
            values = np.maximum(values / np.iinfo(numbers.dtype).max, -1.0)
        if not np.isfinite(values).all():
            raise self.wrong(f"accessor {accessor} has a NaN or infinite value")
        return values

    def integers(self, accessor: int) -> Indices:
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
        described = self.item(self.model.get("accessors"), accessor, "accessor")
        try:
            kind, width = np.dtype(_TYPES[described["componentType"]]), _COUNTS[described["type"]]
            count, sparse = int(described["count"]), described.get("sparse")
            if count < 0:
                raise self.wrong(f"accessor {accessor} has an invalid size: {count}")
            if described.get("bufferView") is not None:
                values = self._viewed(described, kind, width, count)
            elif sparse is None and _DRACO in (self.model.get("extensionsUsed") or ()):
                raise self.compressed(_DRACO)
            elif count * width > LARGEST:
                raise self.wrong(f"accessor {accessor} has {count} elements and no data")
            else:
                values = np.zeros((count, width), kind)
            return values if sparse is None else self._replaced(values, sparse)
        except KeyError as error:
            raise self.wrong(f"accessor {accessor} cannot be read: {error} is wrong") from None
        # A file may violate the format in many ways.
        except (AttributeError, IndexError, TypeError, ValueError, OverflowError) as error:
            raise self.wrong(f"accessor {accessor} cannot be read ({error})") from None

    def _viewed(
        self, described: dict[str, Any], kind: np.dtype[Any], width: int, count: int
    ) -> _Numbers:
        """Returns the values (count, width) of a view, which others may be interleaved with."""
        view = self.item(self.model.get("bufferViews"), described["bufferView"], "bufferView")
        buffer = self.item(self._buffers, view["buffer"], "buffer")
        start, own = view.get("byteOffset") or 0, kind.itemsize * width
        stride = view.get("byteStride") or own
        if start < 0 or stride < own:
            raise ValueError(f"a view begins at byte {start}, with elements each {stride} bytes")
        # NumPy refuses an array that is larger than what it views.
        held = memoryview(buffer)[start : start + view["byteLength"]]
        offset = described.get("byteOffset") or 0
        return np.ndarray((count, width), kind, held, offset, (stride, kind.itemsize))

    def _replaced(self, values: _Numbers, sparse: dict[str, Any]) -> _Numbers:
        """Returns the values with those that a sparse accessor replaces, section 3.6.2.3."""
        indices, count = sparse["indices"], sparse["count"]
        kind = np.dtype(_TYPES[indices["componentType"]])
        places = self._viewed(indices, kind, 1, count)[:, 0].astype(np.intp)
        if len(places) and not 0 <= places.min() <= places.max() < len(values):
            raise ValueError(f"a sparse index is beyond its {len(values)} elements")
        replaced = values.copy()
        replaced[places] = self._viewed(sparse["values"], values.dtype, values.shape[1], count)
        return replaced

    @cached_property
    def _buffers(self) -> list[bytes]:
        """The contents of all buffers.

        Raises:
            DataError: If a buffer is missing or unreadable.
        """
        buffers = self.model.get("buffers") or ()
        return [self._buffer(index, buffer) for index, buffer in enumerate(buffers)]

    def _buffer(self, index: int, buffer: dict[str, Any]) -> bytes:
        uri = buffer.get("uri")
        if uri is not None:
            try:
                data = read_uri(str(uri), self.path.parent)
            except (OSError, ValueError) as error:
                raise self.wrong(f"buffer {index} cannot be read ({error})") from None
        elif self.binary is None or index > 0:
            raise self.wrong(f"buffer {index} has no data; it needs a uri, or a binary chunk")
        else:
            data = self.binary
        if len(data) < buffer["byteLength"]:
            raise self.wrong(
                f"buffer {index} announces {buffer['byteLength']} bytes, but holds {len(data)}"
            )
        return data
