"""Export of tracked motion in all supported formats."""

from __future__ import annotations

from pathlib import Path

from regkit.interchange.bvh.motion import bvh_of
from regkit.interchange.csv_motion import write_csv
from regkit.interchange.gltf.motion import write_gltf
from regkit.interchange.gltf.shown_mesh import shown_mesh
from regkit.interchange.motion import UPRIGHT_CAMERA, TrackedMotion
from regkit.system.errors import ConfigError

FORMATS = (".bvh", ".csv", ".glb")
"""Suffixes of the supported formats."""


def write_motion(motion: TrackedMotion, path: Path, *, scale: float = 1.0) -> None:
    """Writes a motion in the format of the file's suffix.

    Args:
        motion: The motion.
        path: The file.
        scale: Metres per unit of a BVH file, a format without units.

    Raises:
        ConfigError: If the suffix is unknown.
        DataError: If the file cannot be written.
    """
    match path.suffix.lower():
        case ".bvh":
            bvh_of(motion).write(path, scale=scale)
        case ".csv":
            write_csv(motion, path)
        case ".glb":
            mesh = shown_mesh(motion.body, motion.skin)
            write_gltf(path, mesh, motion.transforms, motion.fps, motion.name, UPRIGHT_CAMERA)
        case suffix:
            raise ConfigError(
                f"'{suffix}' is none of {', '.join(FORMATS)}; the suffix names the format",
                place=str(path),
            )
