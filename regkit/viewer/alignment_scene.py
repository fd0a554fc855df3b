"""The scene of an alignment: a target, and a source before and after."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array
from regkit.viewer.points import FramePoints
from regkit.viewer.scene import Cloud, RecordingScene, Scene

MOST_POINTS = 30_000
"""Maximum number of points of a cloud."""

COLOURS = {"target": "#7F7F7F", "source": "#D55E00", "result": "#0072B2"}
"""Colours of the three clouds."""


def alignment_scene(title: str, source: Array, target: Array, result: Array) -> Scene:
    """Returns the scene of a rigid alignment.

    Args:
        title: The title.
        source: Source points, (N, 3) [m].
        target: Target points, (M, 3) [m].
        result: Source points after the alignment, (N, 3) [m].
    """
    return clouds_scene(title, {"target": target, "source": source, "result": result}, COLOURS)


def clouds_scene(title: str, clouds: dict[str, Array], colours: dict[str, str]) -> Scene:
    """Returns the scene of clouds (N, 3) [m] that do not move, by their names.

    Args:
        title: The title.
        clouds: The clouds by name.
        colours: Colours by name, #rrggbb.
    """
    shown = {name: one[:: max(1, -(-len(one) // MOST_POINTS))] for name, one in clouds.items()}
    left_out = [
        f"{len(shown[name])} of the {len(one)} points of the {name} are shown."
        for name, one in clouds.items()
        if len(shown[name]) < len(one)
    ]
    recording = RecordingScene(
        name=title,
        fps=1.0,
        length=1,
        frames=np.zeros(1, dtype=np.intp),
        points=FramePoints.of({0: np.zeros((0, 3))}),
        clouds=tuple(Cloud(name, colours[name], one) for name, one in shown.items()),
    )
    return Scene(title, (recording,), " ".join(left_out))
