"""Import of skeletons in all supported formats."""

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
    """Reads the skeleton of a ``.bvh`` or ``.urdf`` file as a template.

    Args:
        path: The file.
        scale: Metres per unit of the file.
        title: Title of the template; by default the name of the file or the robot.
        up: The up axis of the file; by default y for BVH and z for URDF.
        front: The front axis of the file; by default z for BVH and x for URDF.

    Raises:
        ConfigError: If the format is unknown, or the axes are invalid.
        DataError: If the file is missing or invalid.
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
                f"the format '{suffix}' cannot be imported; use .bvh or .urdf, or make a template "
                "from a rigged .glb or .gltf with `regkit fit`",
                place=str(path),
            )
