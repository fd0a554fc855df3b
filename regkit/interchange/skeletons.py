"""Skeletons in any format that regkit reads."""

from __future__ import annotations

from pathlib import Path

from regkit.interchange.axes import body_axes
from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.bvh.template import bvh_template
from regkit.interchange.imported import ImportedSkeleton
from regkit.interchange.urdf.template import urdf_template
from regkit.interchange.urdf.urdf import Urdf
from regkit.system.errors import ConfigError


def read_skeleton(
    path: Path,
    *,
    scale: float = 1.0,
    title: str | None = None,
    up: str | None = None,
    front: str | None = None,
) -> ImportedSkeleton:
    """The skeleton in a ``.bvh`` or ``.urdf`` file as a template.

    Args:
        path: The file.
        scale: Metres per unit of the file.
        title: What it is, in a line; without it the file's name, or the robot's.
        up: The file's axis that points up; by custom y of BVH and z of URDF.
        front: The one that points to the front; by custom z of BVH and x of URDF.

    Raises:
        ConfigError: If the file is of another format, or the axes are none.
        DataError: If the file is missing or wrong.
    """
    match path.suffix.lower():
        case ".bvh":
            axes = body_axes(up or "y", front or "z")
            motion = Bvh.read(path, scale=scale)
            return bvh_template(motion, path, title or f"The skeleton of {path.name}", axes)
        case ".urdf":
            axes = body_axes(up or "z", front or "x")
            robot = Urdf.read(path)
            return urdf_template(robot, path, title or f"The robot {robot.name}", axes, scale)
        case suffix:
            raise ConfigError(
                f"'{suffix}' is no format that is imported (.bvh, .urdf); `regkit fit` makes a "
                "template of a rigged .glb or .gltf",
                place=str(path),
            )
