"""A glTF file with its content as objects of pygltflib."""

from __future__ import annotations

import json
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from regkit.clouds.formats.gltf import GltfData
from regkit.system.optional import load_library

SUFFIXES = (".glb", ".gltf")


@dataclass(frozen=True)
class GltfFile(GltfData):
    """A glTF file.

    Attributes:
        content: Content of the file as ``pygltflib.GLTF2``.
    """

    content: Any

    @classmethod
    def read(cls, path: Path) -> GltfFile:
        """Reads a ``.glb`` or ``.gltf`` file.

        Raises:
            DataError: If the file is not glTF 2.0, or is compressed.
            DependencyError: If pygltflib is missing.
            OSError: If the file cannot be read.
        """
        gltf = pygltflib()
        data = GltfData.load(path)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            content = gltf.GLTF2.gltf_from_json(json.dumps(data.model))
        return cls(path, data.model, data.binary, content)


def pygltflib() -> Any:
    """Returns the module ``pygltflib``.

    Raises:
        DependencyError: If it is missing.
    """
    return load_library("pygltflib")
