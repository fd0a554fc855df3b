"""Compilation of the loops before they are needed, by samples that need no files."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryFile
from time import perf_counter
from typing import Any, Literal, cast

import numpy as np

from regkit.api.aligning import align
from regkit.api.registering import register, track
from regkit.body import Body, BodyDescription
from regkit.body.depth import depth_image
from regkit.config.plugin import slot_default
from regkit.config.preset import presets_of
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.interfaces import Method, Template
from regkit.observation import Keypoints
from regkit.primitives.accumulation import accumulated_wrenches
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.cache import VARIABLE, cache_folder
from regkit.system.errors import DataError, NotFoundError, RegkitError
from regkit.system.notes import RegkitWarning
from regkit.system.progress import steps
from regkit.system.shipped import PACKAGE

CAMERA = Camera(width=176, height=144, fx=230.0, fy=230.0, cx=87.5, cy=71.5)
"""Camera of the samples."""

AWAY = 2.2
"""Distance of the body from the camera [size]."""

FRAMES = 2
"""Number of depth images."""


@dataclass(frozen=True)
class Warmed:
    """What ``warm`` did.

    Attributes:
        folder: Folder below which the loops are kept: Numba's, or regkit's own package.
        seconds: Time that it took [s].
        failed: Message of each sample that could not be registered, by its name.
    """

    folder: Path
    seconds: float
    failed: dict[str, str]


class SampleTemplate(Template):
    """The default template, at the size for which its file holds."""

    kind: Literal["sample"] = "sample"

    template: Template = slot_default(Template)
    """The default template."""

    def description(self) -> BodyDescription:
        """Returns the description of the default template."""
        return self.template.description()

    def given_size(self) -> float:
        """Returns the size of the samples [m]."""
        return self.description().size.value

    def name(self) -> str:
        """Returns the name of the default template."""
        return self.template.name()


def warm() -> Warmed:
    """Compiles the loops of all installed presets of methods, of the start and of alignment.

    The samples are depth images and a cloud of the default template's own surface, so that neither
    recordings nor the examples need to be installed. What they compile is kept on disk, as always,
    and with it the default template's atlas.

    Raises:
        DataError: If no folder can be written in which the loops or the atlas are kept.
    """
    began = perf_counter()
    folder = _loops_folder()
    _check_writable(cache_folder())
    failed = {}
    samples = dict(_samples())
    for name in steps(samples, "compiling", len(samples)):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", RegkitWarning)
                samples[name]()
        except NotFoundError:
            pass  # Its loops are compiled all the same.
        except RegkitError as error:
            failed[name] = str(error)
    return Warmed(folder, perf_counter() - began, failed)


def _samples() -> Iterator[tuple[str, Callable[[], object]]]:
    """Yields what compiles the loops, with its name."""
    template = SampleTemplate()
    body = template.body(template.given_size())
    poses = [_pose(body, frame) for frame in range(FRAMES)]
    images = np.stack([_image(body, pose) for pose in poses])
    markers = np.stack([body.markers.place(body.place(pose).transforms) for pose in poses])
    keypoints = Keypoints.in_space(body.markers.names, markers)
    cloud = CAMERA.back_projected(images[0])
    yield "a cloud", partial(register, cloud, template)
    for name in presets_of(Method.group):
        follow = partial(track, images, template, name, camera=CAMERA, keypoints=keypoints)
        yield f"method {name}", follow
    yield "two clouds", partial(align, cloud, cloud + 0.01)


def _pose(body: Body, frame: int) -> Pose:
    """Returns the pose of a body in a stance before the camera."""
    pose = body.stances[0].pose if body.stances else body.skeleton.rest()
    root = rigid(
        np.diag([1.0, -1.0, -1.0]) @ pose.root[:3, :3],
        np.array([0.02 * frame, 0.0, AWAY]) * body.size,
    )
    return replace(pose, root=root)


def _image(body: Body, pose: Pose) -> Array:
    """Returns a depth image (H, W) [m] of a body; 0 where nothing is."""
    depth = depth_image(body, pose, CAMERA)
    return np.where(np.isfinite(depth), depth, 0.0)


def _loops_folder() -> Path:
    """Returns the folder in which Numba keeps loops.

    Raises:
        DataError: If there is none that can be written.
    """
    try:
        folder = Path(cast(Any, accumulated_wrenches.dispatcher).stats.cache_path)
    except RuntimeError as error:
        raise DataError(
            f"compiled loops cannot be kept: neither the folder of the code nor Numba's cache can "
            f"be written ({error}); set NUMBA_CACHE_DIR to a folder that can"
        ) from None
    return PACKAGE if folder.is_relative_to(PACKAGE) else folder.parent


def _check_writable(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        TemporaryFile(dir=folder).close()
    except OSError as error:
        raise DataError(
            f"the cache folder cannot be written ({error.strerror}); set {VARIABLE} to a folder "
            "that can",
            place=str(folder),
        ) from None
