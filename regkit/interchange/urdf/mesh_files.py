"""The mesh files of a URDF file, found by their addresses."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree

SCHEMES = ("package", "model")
"""Schemes of addresses that begin with the name of a package."""

VARIABLES = ("ROS_PACKAGE_PATH", "GAZEBO_MODEL_PATH")
"""Environment variables with folders of packages."""


@dataclass(frozen=True)
class MeshFiles:
    """Where the meshes of a URDF file are looked for.

    A package is a folder of its name, or one whose ``package.xml`` has its name. It is looked for
    in the folders that the user names, in those of ``ROS_PACKAGE_PATH``, and from the file upwards.

    Attributes:
        folder: Folder of the URDF file.
        packages: Folders named by the user: packages, or folders of packages.
    """

    folder: Path
    packages: Sequence[Path] = ()

    def find(self, address: str) -> Path | None:
        """Returns the file of an address, or None if there is none.

        Args:
            address: ``package://NAME/PATH``, ``model://NAME/PATH``, ``file://PATH``, or a path
                relative to the URDF file or to a folder above it.
        """
        scheme, separator, rest = address.strip().replace("\\", "/").partition("://")
        if not separator:
            places = [folder / scheme for folder in (self.folder, *self.folder.parents)]
        elif scheme.lower() == "file":
            places = [self.folder / rest.removeprefix("localhost")]
        elif scheme.lower() in SCHEMES:
            name, _, within = rest.partition("/")
            places = [package / within for package in self._packages(name)]
        else:
            places = []
        for place in places:
            for spelled in (place, Path(unquote(str(place)))):
                if _is_file(spelled):
                    return spelled
        return None

    def _packages(self, name: str) -> Iterator[Path]:
        """Yields the folders that may be the package of a name."""
        variables = [os.environ.get(variable, "") for variable in VARIABLES]
        listed = [Path(one) for text in variables for one in text.split(os.pathsep) if one]
        for folder in (*self.packages, *listed, self.folder, *self.folder.parents):
            if folder.name == name or _package_name(folder) == name:
                yield folder
            yield folder / name


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    # The name may be too long, or hold a null byte.
    except (OSError, ValueError):
        return False


def _package_name(folder: Path) -> str | None:
    """Returns the name in a folder's ``package.xml``; None without a readable one."""
    try:
        return (ElementTree.parse(folder / "package.xml").findtext("name") or "").strip() or None
    except (OSError, ValueError, ElementTree.ParseError):
        return None
