"""Maps from the joints of a motion source to the figure."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from pydantic import field_validator

from regkit.config.model import Model
from regkit.system.errors import ConfigError
from regkit_synthesis.figure.figure import check_joints
from regkit_synthesis.figure.map_files import read_map, shipped
from regkit_synthesis.figure.names import instead_of, meant

_NEEDED = (
    *("pelvis", "chest", "head"),
    *(
        f"{side}_{joint}"
        for side in ("left", "right")
        for joint in ("shoulder", "elbow", "hip", "knee", "ankle")
    ),
)
"""The joints that every map must assign."""


class JointMap(Model):
    """A map from the joints of a motion source to the human figure.

    Joints of the source that it does not name are unused, unless a body's map names them.
    """

    title: str = ""
    """Description of the sources that it is for."""

    joints: dict[str, str | tuple[str, ...]]
    """Joint of the source for each joint of the figure, or several of which the first existing one
    is used. ``NAME.end`` is the end site of a BVH joint. A name without a namespace
    (``mixamorig:``) matches in any namespace. A joint that the source lacks moves with its
    parent."""

    @field_validator("joints")
    @classmethod
    def _of_a_figure(
        cls, joints: dict[str, str | tuple[str, ...]]
    ) -> dict[str, str | tuple[str, ...]]:
        check_joints(joints)
        missing = [joint for joint in _NEEDED if joint not in joints]
        if missing:
            raise ValueError(f"it must say which joint {', '.join(missing)} is")
        return joints

    def parts(self, names: Collection[str]) -> dict[str, str]:
        """Returns the joint of the source for each joint of the figure.

        Args:
            names: Names of the source's joints.

        Raises:
            ConfigError: If a named joint does not exist.
        """
        found = {}
        for joint, wanted in self.joints.items():
            choices = (wanted,) if isinstance(wanted, str) else wanted
            own = _first(choices, names)
            if own is None:
                raise ConfigError(
                    f"the source has no joint '{choices[0]}' for '{joint}'"
                    + instead_of(choices[0], names)
                )
            found[joint] = own
        return found

    def fits(self, names: Collection[str]) -> bool:
        """Returns whether a source with these joints has all that the map names."""
        choices = ((one,) if isinstance(one, str) else one for one in self.joints.values())
        return all(_first(names_of_one, names) for names_of_one in choices)


def _first(choices: Collection[str], names: Collection[str]) -> str | None:
    """Returns the first of ``choices`` that is in ``names``."""
    found = (meant(choice, names) for choice in choices)
    return next((name for name in found if name is not None), None)


def parts_of(names: Collection[str], name: str | None, path: Path) -> dict[str, str]:
    """Returns the joint of a source for each joint of the figure.

    Args:
        names: Names of the source's joints.
        name: Name of a shipped map, or a YAML file; by default the first map that fits.
        path: File of the source, for messages.

    Raises:
        RegkitError: If no map fits, or the map is invalid or names a joint that the source lacks.
    """
    if name is None:
        try:
            return _fitting(names).parts(names)
        except ConfigError as error:
            raise error.at(str(path)) from None
    found = read_map(JointMap, "sources", name)
    try:
        return found.parts(names)
    except ConfigError as error:
        raise error.at(f"{path} with the map {name}") from None


def _fitting(names: Collection[str]) -> JointMap:
    for known in shipped("sources"):
        found = read_map(JointMap, "sources", known)
        if found.fits(names):
            return found
    raise ConfigError(
        f"none of the maps that ship ({', '.join(shipped('sources'))}) is for a source with the "
        f"joints {', '.join(names)}; name a file of your own as its map"
    )
