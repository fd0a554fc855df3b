"""A body registered to one frame, or tracked through many."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from typing import Any

import numpy as np

from regkit.api.choices import Choice, chosen_method, described_start, load_template, told
from regkit.api.frames import Frames, GivenFrames, Intrinsics, Measured, frame_of, sequence_of
from regkit.api.numbers import check_metres
from regkit.api.results import Registration, Tracking
from regkit.body import Body
from regkit.clouds import spacing, voxel_for
from regkit.interfaces import Method, Observer, Sequence, Template, Tracker
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose
from regkit.start import Start, found_start, given_start
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit.system.optional import one_thread
from regkit.tracking import Track, TrackedFrame, tracked

POINTS = 900
"""Without an observer, a frame is thinned to about so many points."""

WIDTH = 0.5
"""Their standard deviation, as a part of the voxel's side."""


def register(
    cloud: Measured,
    template: Choice[Template],
    method: Choice[Method] = "best",
    *,
    camera: Intrinsics | None = None,
    observer: Choice[Observer] | None = None,
    start: Pose | Mapping[str, Any] | None = None,
) -> Registration:
    """Find the pose of a body in one frame.

    Args:
        cloud: Points (N, 3) [m] in the camera's frame (x right, y down, z forward); or a depth
            image (H, W) [m], zero where nothing was measured. Nothing but the body is in it, or
            ``observer`` crops the rest away.
        template: What is seen: ``"human"``, ``"hand"``, a file, or what ``load_template`` made.
        method: A preset such as ``"best"``, ``"spheres"``, ``"icp"`` or ``"paper"``, a method's
            mapping as in an experiment's YAML, or a method.
        camera: Of a depth image: a ``Camera``, a ``camera.json``, or its matrix K (3, 3) [px]. With
            a ``Camera``, points are taken for what it sees of a body; without one, for all of it.
        observer: How points become data; without it they are thinned to some 900.
        start: Where to set out from: a pose, or a mapping as an experiment's ``start``, which needs
            the template's size. Without it, it is found, and the size with it.

    Raises:
        RegkitError: If an argument cannot be, or the body cannot be registered; it says which.
    """
    frame = frame_of(cloud, camera, place="cloud")
    sequence = GivenFrames(name="cloud", fps=1.0, length=1, given=(frame,))
    return _tracked(sequence, template, method, observer, "hold", start, "regkit.register")[0]


def track(
    frames: Frames,
    template: Choice[Template],
    method: Choice[Method] = "best",
    *,
    camera: Intrinsics | None = None,
    fps: float = 30.0,
    observer: Choice[Observer] | None = None,
    tracker: Choice[Tracker] = "hold",
    start: Pose | Mapping[str, Any] | None = None,
) -> Tracking:
    """Track a body through a sequence.

    Args:
        frames: Depth images (T, H, W) [m], zero where nothing was measured; a list of clouds (N, 3)
            [m] in the camera's frame (x right, y down, z forward); the folder of a recording; or a
            ``Sequence`` or ``Dataset``.
        template: As in ``register``.
        method: As in ``register``.
        camera: Of depth images, as in ``register``.
        fps: Frames per second of arrays; recordings know their own.
        observer: As in ``register``.
        tracker: How one frame's pose leads to the next, where the method brings no tracker.
        start: As in ``register``, for the first frame.

    Raises:
        RegkitError: If an argument cannot be, or a frame cannot be registered; it says which.
    """
    sequence = sequence_of(frames, camera, fps)
    return _tracked(sequence, template, method, observer, tracker, start, "regkit.track")


def _tracked(
    sequence: Sequence,
    template: Choice[Template],
    method: Choice[Method],
    observer: Choice[Observer] | None,
    tracker: Choice[Tracker],
    start: Pose | Mapping[str, Any] | None,
    place: str,
) -> Tracking:
    loaded = load_template(template)
    chosen, its_observer, its_tracker = chosen_method(method, observer, tracker, place=place)
    sequence.prepare()
    first = next(iter(sequence.frames()), None)
    if first is None:
        raise DataError("the sequence has no frame", place=sequence.name)
    where = first.place or sequence.name
    check_metres(first.points, loaded.candidate_sizes(), place=where)
    observed = its_observer or _observer_for(first)
    with one_thread():
        begin = _start(sequence, loaded, observed, start, place)
        registrar = chosen.prepare(begin.body)
        steps = tracked(sequence, observed, registrar, its_tracker, begin.pose)
        done = tuple(_shown(steps, sequence.length))
    return Tracking(
        name=sequence.name,
        method=told(method),
        fps=sequence.fps,
        registrar=registrar,
        frames=done,
        track=Track.of(list(done), registrar),
    )


def _observer_for(frame: Frame) -> Observer:
    """The observer that thins a frame to some ``POINTS`` Gaussians, each half a voxel wide."""
    voxel = voxel_for(frame.points, POINTS)
    side = voxel or spacing(frame.points)
    data = {"kind": "points", "voxel": voxel, "sigma": WIDTH * side}
    return Observer.load("points").model_validate(data)


def _start(
    sequence: Sequence,
    template: Template,
    observer: Observer,
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
    return found_start(template, *_looked_at(sequence, template, observer))


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


def _looked_at(sequence: Sequence, template: Template, observer: Observer) -> Iterator[Observation]:
    """The first frame, and two later ones where the size is to be found."""
    last = sequence.length - 1
    wanted = {0} if template.given_size() is not None else {0, last // 2, last}
    for index, frame in enumerate(islice(sequence.frames(), 1 + max(wanted))):
        if index in wanted:
            try:
                yield observer.observe(frame)
            except RegkitError as error:
                raise error.at(frame.place or f"{sequence.name}: frame {index}") from None


def _shown(steps: Iterator[TrackedFrame], length: int) -> Iterator[TrackedFrame]:
    """The frames as they come, with a bar on a terminal if there are many."""
    from rich.console import Console
    from rich.progress import track as shown

    console = Console(stderr=True)
    quiet = length < 2 or not console.is_terminal
    yield from shown(
        steps, "tracking", total=length, console=console, transient=True, disable=quiet
    )
