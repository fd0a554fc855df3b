"""Import of skeletons in all supported formats."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from regkit.interchange.axes import body_axes
from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.bvh.template import bvh_template
from regkit.interchange.imported import ImportedSkeleton
from regkit.interchange.urdf.template import urdf_template
from regkit.interchange.urdf.urdf import Urdf
from regkit.interchange.urdf.xml_lines import XACRO
from regkit.system.errors import ConfigError
from regkit.system.guard import reading


def read_skeleton(
    path: Path,
    *,
    scale: float = 1.0,
    title: str | None = None,
    up: str | None = None,
    front: str | None = None,
    packages: Sequence[Path] = (),
) -> ImportedSkeleton:
    """Reads the skeleton of a ``.bvh`` or ``.urdf`` file as a template.

    Args:
        path: The file.
        scale: Metres per unit of the file.
        title: Title of the template; by default the name of the file or the robot.
        up: The up axis of the file; by default y for BVH and z for URDF.
        front: The front axis of the file; by default z for BVH and x for URDF.
        packages: Folders in which the packages of a URDF file's meshes are looked for first.

    Raises:
        ConfigError: If the format is unknown, or the axes are invalid.
        DataError: If the file is missing or invalid.
    """
    match path.suffix.lower():
        case ".bvh":
            axes = body_axes(up or "y", front or "z")
            motion = Bvh.read(path, scale=scale, posed=False)
            named = title or f"The skeleton of {path.name}"
            with reading(path, "a skeleton that a template can describe"):
                return bvh_template(motion, path, named, axes)
        case ".urdf":
            axes = body_axes(up or "z", front or "x")
            robot = Urdf.read(path)
            named = title or f"The robot {robot.name}"
            with reading(path, "a robot that a template can describe"):
                return urdf_template(robot, path, named, axes, scale, packages)
        case ".xacro":
            raise ConfigError(f"is a template of a URDF file; {XACRO}", place=str(path))
        case suffix:
            raise ConfigError(
                f"the format '{suffix}' cannot be imported; use .bvh, .urdf, or a body model in "
                "the layout of SMPL (.npz, .pkl); other models, such as MHR and GHUM, become "
                "templates by `regkit fit` from a rigged .glb or .gltf",
                place=str(path),
            )
