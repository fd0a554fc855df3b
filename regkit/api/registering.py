"""A body registered to one frame, or tracked through many."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from typing import Any

import numpy as np

from regkit.api.choices import Choice, chosen_method, described_start, load_template, told
from regkit.api.frames import Frames, GivenFrames, Intrinsics, Measured, frame_of, recording_of
from regkit.api.numbers import check_metres
from regkit.api.results import Registration, Tracking
from regkit.body import Body
from regkit.clouds import spacing, voxel_for
from regkit.interfaces import Method, Preprocessor, Recording, Template, Tracker
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose
from regkit.start import Start, found_start, given_start
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit.system.optional import one_thread
from regkit.system.renamed import renamed_arguments
from regkit.tracking import Track, TrackedFrame, tracked

POINTS = 900
"""Without a preprocessor, a frame is downsampled to about so many points."""

WIDTH = 0.5
"""Their standard deviation, as a part of the voxel's side."""


@renamed_arguments(observer="preprocessor")
def register(
    cloud: Measured,
    template: Choice[Template],
    method: Choice[Method] = "best",
    *,
    camera: Intrinsics | None = None,
    preprocessor: Choice[Preprocessor] | None = None,
    start: Pose | Mapping[str, Any] | None = None,
) -> Registration:
    """Find the pose of a body in one frame.

    Args:
        cloud: Points (N, 3) [m] in the camera's frame (x right, y down, z forward); or a depth
            image (H, W) [m], zero where nothing was measured. Nothing but the body is in it, or
            ``preprocessor`` crops the rest away.
        template: What is seen: ``"human"``, ``"hand"``, a file, or what ``load_template`` made.
        method: A preset such as ``"best"``, ``"spheres"``, ``"icp"`` or ``"paper"``, a method's
            mapping as in an experiment's YAML, or a method.
        camera: Of a depth image: a ``Camera``, a ``camera.json``, or its matrix K (3, 3) [px]. With
            a ``Camera``, points are taken for what it sees of a body; without one, for all of it.
        preprocessor: How points become data; without it they are downsampled to some 900.
        start: Where to set out from: a pose, or a mapping as an experiment's ``start``, which needs
            the template's size. Without it, it is found, and the size with it.

    Raises:
        RegkitError: If an argument cannot be, or the body cannot be registered; it says which.
    """
    frame = frame_of(cloud, camera, place="cloud")
    recording = GivenFrames(name="cloud", fps=1.0, length=1, given=(frame,))
    return _tracked(
        recording, template, method, preprocessor, "constant_pose", start, "regkit.register"
    )[0]


@renamed_arguments(observer="preprocessor")
def track(
    frames: Frames,
    template: Choice[Template],
    method: Choice[Method] = "best",
    *,
    camera: Intrinsics | None = None,
    fps: float = 30.0,
    preprocessor: Choice[Preprocessor] | None = None,
    tracker: Choice[Tracker] = "constant_pose",
    start: Pose | Mapping[str, Any] | None = None,
) -> Tracking:
    """Track a body through a recording.

    Args:
        frames: Depth images (T, H, W) [m], zero where nothing was measured; a list of clouds (N, 3)
            [m] in the camera's frame (x right, y down, z forward); the folder of a recording; or a
            ``Recording`` or ``Dataset``.
        template: As in ``register``.
        method: As in ``register``.
        camera: Of depth images, as in ``register``.
        fps: Frames per second of arrays; recordings know their own.
        preprocessor: As in ``register``.
        tracker: How one frame's pose leads to the next, where the method brings no tracker.
        start: As in ``register``, for the first frame.

    Raises:
        RegkitError: If an argument cannot be, or a frame cannot be registered; it says which.
    """
    recording = recording_of(frames, camera, fps)
    return _tracked(recording, template, method, preprocessor, tracker, start, "regkit.track")


def _tracked(
    recording: Recording,
    template: Choice[Template],
    method: Choice[Method],
    preprocessor: Choice[Preprocessor] | None,
    tracker: Choice[Tracker],
    start: Pose | Mapping[str, Any] | None,
    place: str,
) -> Tracking:
    loaded = load_template(template)
    chosen, its_preprocessor, its_tracker = chosen_method(
        method, preprocessor, tracker, place=place
    )
    recording.prepare()
    first = next(iter(recording.frames()), None)
    if first is None:
        raise DataError("the recording has no frame", place=recording.name)
    where = first.place or recording.name
    check_metres(first.points, loaded.candidate_sizes(), place=where)
    observed = its_preprocessor or _preprocessor_for(first)
    with one_thread():
        begin = _start(recording, loaded, observed, start, place)
        registrar = chosen.bind(begin.body)
        steps = tracked(recording, observed, registrar, its_tracker, begin.pose)
        done = tuple(_shown(steps, recording.length))
    return Tracking(
        name=recording.name,
        method=told(method),
        fps=recording.fps,
        registrar=registrar,
        frames=done,
        track=Track.of(list(done), registrar),
    )


def _preprocessor_for(frame: Frame) -> Preprocessor:
    """The preprocessor that thins a frame to some ``POINTS`` Gaussians, each half a voxel wide."""
    voxel = voxel_for(frame.points, POINTS)
    side = voxel or spacing(frame.points)
    data = {"kind": "points", "voxel": voxel, "sigma": WIDTH * side}
    return Preprocessor.load("points").model_validate(data)


def _start(
    recording: Recording,
    template: Template,
    preprocessor: Preprocessor,
    start: Pose | Mapping[str, Any] | None,
    place: str,
) -> Start:
    """The start that was given, or the one found in the first frame, its size in a few."""
    if isinstance(start, Pose):
        size = template.given_size()
        if size is None:
            raise ConfigError("a given start needs the template's size too", place="start")
        body = template.body(size)
        _check_fits(start, body)
        return Start(body, start)
    if start is not None:
        try:
            return given_start(template, described_start(start, place=place))
        except RegkitError as error:
            raise error.at("start") from None
    return found_start(template, *_looked_at(recording, template, preprocessor))


def _check_fits(pose: Pose, body: Body) -> None:
    """Refuse a pose of another skeleton.

    Raises:
        ConfigError: If it has another number of joints than the body.
    """
    rest = body.skeleton.rest()
    for name in ("root", "balls", "hinges"):
        given, wanted = np.shape(getattr(pose, name)), np.shape(getattr(rest, name))
        if given != wanted:
            raise ConfigError(
                f"a pose of another body: its {name} are {given}, those of '{body.name}' {wanted}",
                place="start",
            )


def _looked_at(
    recording: Recording, template: Template, preprocessor: Preprocessor
) -> Iterator[Observation]:
    """The first frame, and two later ones where the size is to be found."""
    last = recording.length - 1
    wanted = {0} if template.given_size() is not None else {0, last // 2, last}
    for index, frame in enumerate(islice(recording.frames(), 1 + max(wanted))):
        if index in wanted:
            try:
                yield preprocessor.preprocess(frame)
            except RegkitError as error:
                raise error.at(frame.place or f"{recording.name}: frame {index}") from None


def _shown(steps: Iterator[TrackedFrame], length: int) -> Iterator[TrackedFrame]:
    """The frames as they come, with a bar on a terminal if there are many."""
    from rich.console import Console
    from rich.progress import track as shown

    console = Console(stderr=True)
    quiet = length < 2 or not console.is_terminal
    yield from shown(
        steps, "tracking", total=length, console=console, transient=True, disable=quiet
    )
