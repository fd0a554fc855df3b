"""A replay: a scene as one file of limited size, which opens without a network."""

from __future__ import annotations

from dataclasses import replace

from regkit.system.errors import DataError
from regkit.viewer.page import page
from regkit.viewer.points import FramePoints
from regkit.viewer.scene import MethodScene, Scene
from regkit.viewer.shapes import MeshShape

BYTES, ALL_BYTES = 5_000_000, 20_000_000
"""Maximum size of a replay of one recording and of several."""

SPARE = 0.95
"""Part of the room that points may take, since how well they shrink is only known afterwards."""

MOST_DOTS = 300
"""Number of points that stand for a mesh where there is no room for it."""


def replay(scene: Scene) -> str:
    """Returns the page of a scene, of at most 5 MB for one recording and 20 MB for several.

    Points are thinned until it has that size, and meshes become points if that is not enough; the
    page tells it.

    Args:
        scene: The scene.

    Raises:
        DataError: If it is larger even so.
    """
    most = BYTES if len(scene.recordings) == 1 else ALL_BYTES
    whole = page(scene.title, scene.json())
    if len(whole.encode()) <= most:
        return whole
    bare = _size(with_points(scene, 0.0))
    if bare > most:
        scene = _noted(_without_meshes(scene), "Meshes are shown as points.")
        bare = _size(with_points(scene, 0.0))
    if bare > most:
        raise DataError(
            f"the replay has {bare / 1e6:.1f} MB without any points, more than {most / 1e6:g} MB"
        )
    share = 1.0
    while (size := len(whole.encode())) > most:
        share *= min(SPARE * (most - bare) / (size - bare), SPARE)
        told = f"{100.0 * share:.0f} % of the points are shown."
        whole = page(scene.title, _noted(with_points(scene, share), told).json())
    return whole


def with_points(scene: Scene, share: float) -> Scene:
    """Returns a scene with a share of the points of each frame, from 0 to 1."""
    recordings = [
        replace(one, points=one.points.thinned(share))
        if isinstance(one.points, FramePoints)
        else one
        for one in scene.recordings
    ]
    return replace(scene, recordings=tuple(recordings))


def _size(scene: Scene) -> int:
    return len(page(scene.title, scene.json()).encode())


def _noted(scene: Scene, told: str) -> Scene:
    return replace(scene, note=f"{scene.note} {told}".strip())


def _without_meshes(scene: Scene) -> Scene:
    """Returns a scene whose methods show their shape model alone, and meshes as points."""

    def lighter(method: MethodScene) -> MethodScene:
        model = method.track.shapes[0]
        shape = model.dots(MOST_DOTS) if isinstance(model, MeshShape) else model
        return replace(method, track=replace(method.track, shapes=(shape,)))

    recordings = [
        replace(one, methods=tuple(map(lighter, one.methods))) for one in scene.recordings
    ]
    return replace(scene, recordings=tuple(recordings))
