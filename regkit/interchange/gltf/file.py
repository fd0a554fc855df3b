"""Access to a glTF 2.0 file and its binary data.

Source: The Khronos Group, glTF 2.0 Specification, sections 3.6 (binary data) and 4 (GLB).
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.optional import load_library

SUFFIXES = (".glb", ".gltf")

_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_COUNTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


@dataclass(frozen=True)
class GltfFile:
    """A glTF file.

    Attributes:
        path: Path of the file.
        content: Content of the file as ``pygltflib.GLTF2``.
    """

    path: Path
    content: Any

    @classmethod
    def read(cls, path: Path) -> GltfFile:
        """Reads a ``.glb`` or ``.gltf`` file.

        Raises:
            DataError: If the file is missing, is not glTF 2.0, or is compressed.
            DependencyError: If pygltflib is missing.
        """
        gltf = pygltflib()
        if not path.is_file():
            raise DataError("the file is missing; it should hold a glTF model", place=str(path))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                content = gltf.GLTF2().load(path)
        # A damaged file can raise any exception in the library.
        except Exception as error:
            raise DataError(
                f"not a glTF 2.0 file ({type(error).__name__}: {error})", place=str(path)
            ) from None
        file = cls(path, content)
        if content is None or not str(content.asset.version).startswith("2"):
            raise file.wrong("not a glTF 2.0 file; export the model as glTF 2.0")
        for extension in content.extensionsRequired or ():
            if extension.endswith("compression"):
                raise file.wrong(f"is compressed ({extension}); export it without compression")
        return file

    def wrong(self, message: str) -> DataError:
        """Returns an error at this file."""
        return DataError(message, place=str(self.path))

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
        """Returns the values of an accessor as integers (N, C).

        Raises:
            DataError: If the accessor is missing or invalid.
        """
        return self._numbers(accessor).astype(np.intp)

    def _numbers(self, accessor: int) -> np.ndarray[Any, np.dtype[Any]]:
        if not 0 <= accessor < len(self.content.accessors):
            raise self.wrong(
                f"there is no accessor {accessor}; the file has {len(self.content.accessors)}"
            )
        try:
            described = self.content.accessors[accessor]
            if described.sparse is not None or described.bufferView is None:
                raise self.wrong(
                    f"accessor {accessor} is sparse, which is not supported; export without it"
                )
            view = self.content.bufferViews[described.bufferView]
            kind, count = np.dtype(_TYPES[described.componentType]), _COUNTS[described.type]
            own = kind.itemsize * count
            return np.ndarray(
                (described.count, count),
                kind,
                self._buffers[view.buffer],
                (view.byteOffset or 0) + (described.byteOffset or 0),
                (view.byteStride or own, kind.itemsize),
            )
        except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
            raise self.wrong(f"accessor {accessor} cannot be read ({error})") from None

    @cached_property
    def _buffers(self) -> list[bytes]:
        """The contents of all buffers.

        Raises:
            DataError: If a buffer is missing or unreadable.
        """
        buffers = []
        for buffer in self.content.buffers:
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    data = self.content.get_data_from_buffer_uri(buffer.uri)
            except (OSError, ValueError, IndexError) as error:
                raise self.wrong(f"a buffer cannot be read ({error})") from None
            if data is None:
                name = "" if buffer.uri is None else f" {buffer.uri[:60]}"
                raise self.wrong(f"the buffer{name} is missing; it must be in the file's folder")
            buffers.append(bytes(data))
        return buffers


def pygltflib() -> Any:
    """Returns the module ``pygltflib``.

    Raises:
        DependencyError: If it is missing.
    """
    return load_library("pygltflib")
