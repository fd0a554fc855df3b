"""A glTF 2.0 file and the numbers in it.

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
    """A file's description and its buffers.

    Attributes:
        path: Where it is.
        content: What it describes, as ``pygltflib.GLTF2``.
    """

    path: Path
    content: Any

    @classmethod
    def read(cls, path: Path) -> GltfFile:
        """Read a ``.glb`` or ``.gltf`` file.

        Raises:
            DataError: If the file is missing, is no glTF, or is compressed.
        """
        gltf = pygltflib()
        if not path.is_file():
            raise DataError("the file is missing; it holds a glTF model", place=str(path))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                content = gltf.GLTF2().load(path)
        # A damaged file fails anywhere in the library, with any of Python's errors.
        except Exception as error:
            raise DataError(
                f"not a glTF 2.0 file ({type(error).__name__}: {error})", place=str(path)
            ) from None
        file = cls(path, content)
        if content is None or not str(content.asset.version).startswith("2"):
            raise file.wrong("not a glTF 2.0 file")
        for extension in content.extensionsRequired or ():
            if extension.endswith("compression"):
                raise file.wrong(f"is compressed ({extension}); export it without compression")
        return file

    def wrong(self, message: str) -> DataError:
        """An error at this file."""
        return DataError(message, place=str(self.path))

    def floats(self, accessor: int) -> Array:
        """The numbers of an accessor as (N, C); normalized integers are fractions.

        Raises:
            DataError: If they are not there.
        """
        numbers = self._numbers(accessor)
        values = numbers.astype(np.float64)
        # Some exporters say normalized of floats too, for which it means nothing.
        if self.content.accessors[accessor].normalized and numbers.dtype.kind != "f":
            # Section 3.11: a signed integer's most negative value stands for -1 too.
            values = np.maximum(values / np.iinfo(numbers.dtype).max, -1.0)
        if not np.isfinite(values).all():
            raise self.wrong(f"accessor {accessor} has a NaN or infinite number")
        return values

    def integers(self, accessor: int) -> np.ndarray[Any, np.dtype[np.intp]]:
        """The whole numbers of an accessor as (N, C).

        Raises:
            DataError: If they are not there.
        """
        return self._numbers(accessor).astype(np.intp)

    def _numbers(self, accessor: int) -> np.ndarray[Any, np.dtype[Any]]:
        if not 0 <= accessor < len(self.content.accessors):
            raise self.wrong(f"there is no accessor {accessor}")
        try:
            described = self.content.accessors[accessor]
            if described.sparse is not None or described.bufferView is None:
                raise self.wrong(f"accessor {accessor} is sparse, which is not read")
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
            DataError: If one is missing.
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
                raise self.wrong(f"the buffer{name} is missing; it must lie beside the file")
            buffers.append(bytes(data))
        return buffers


def pygltflib() -> Any:
    """The module ``pygltflib``.

    Raises:
        DependencyError: If it is missing.
    """
    return load_library("pygltflib")
