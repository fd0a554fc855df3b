"""Laws of segmenters."""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from regkit.interfaces import BoundSegmenter, Expected, Segmenter
from regkit.observation import Frame
from regkit.system.errors import RegkitError
from regkit.system.notes import RegkitWarning
from regkit.testing.laws import Laws
from regkit.testing.scenes import SceneTemplate, WallScene
from regkit.testing.verdict import copied, require, same

LENGTH = 8
"""Number of frames of the scene."""

KEPT = 0.5
"""Least share of the body's pixels that is kept."""


class SegmenterLaws(Laws):
    """Laws of segmenters."""

    @pytest.fixture
    def wall_scene(self) -> WallScene:
        """Returns a body that moves before a wall."""
        return _scene(images=True)

    @pytest.fixture
    def wall_frames(self, wall_scene: WallScene) -> tuple[Frame, ...]:
        """Returns the frames of the scene."""
        return wall_scene.shots

    @pytest.mark.parametrize("known", [False, True], ids=["at the start", "in tracking"])
    def test_segmenter_keeps_some_of_the_points(
        self,
        segmenter: Segmenter,
        wall_scene: WallScene,
        wall_frames: tuple[Frame, ...],
        known: bool,
    ) -> None:
        """Points stay as they are, and the image holds them; other pixels are 0 or NaN."""
        bound = _bound(segmenter, wall_scene)
        frame, at = wall_frames[-1], type(bound).segmented
        left = bound.segmented(frame, _expected(wall_scene) if known else None)
        rows = {point.tobytes() for point in frame.points}
        require(
            all(point.tobytes() in rows for point in left.points), segmenter,
            "makes points that the frame does not have", look_at=at,
        )  # fmt: skip
        require(
            left.camera is frame.camera and left.place == frame.place, segmenter,
            "does not pass on the frame's camera and place", look_at=at,
        )  # fmt: skip
        assert frame.depth is not None
        require(
            left.depth is not None and left.pixels is not None
            and same(left.depth.flat[left.pixels], left.points[:, 2]), segmenter,
            "leaves an image and points that do not belong together; use Frame.only", look_at=at,
        )  # fmt: skip
        assert left.depth is not None
        changed = ~(left.depth == frame.depth)
        require(
            bool((np.isnan(left.depth) | (left.depth == 0.0))[changed].all()), segmenter,
            "changes depths other than to 0 (free space) or NaN (unknown)", look_at=at,
        )  # fmt: skip

    def test_segmenter_keeps_the_body(
        self, segmenter: Segmenter, wall_scene: WallScene, wall_frames: tuple[Frame, ...]
    ) -> None:
        """Of a body that moves before a wall, at least half is kept where it was expected."""
        bound = _bound(segmenter, wall_scene)
        left = bound.segmented(wall_frames[-1], _expected(wall_scene))
        body = wall_scene.shown(LENGTH - 1)
        assert left.depth is not None
        share = float((left.depth > 0.0)[body].mean())
        require(
            share >= KEPT, segmenter, f"keeps {100.0 * share:.0f} % of the body's pixels",
            look_at=type(bound).segmented,
        )  # fmt: skip

    def test_segmenter_has_no_state(
        self, segmenter: Segmenter, wall_scene: WallScene, wall_frames: tuple[Frame, ...]
    ) -> None:
        """A frame gives the same after others, and is not modified."""
        bound = _bound(segmenter, wall_scene)
        frame, at = wall_frames[2], type(bound).segmented
        before = copied((frame.points, frame.depth))
        first = bound.segmented(frame, None)
        for other in wall_frames[5:]:
            bound.segmented(other, _expected(wall_scene))
        again = bound.segmented(frame, None)
        require(
            same((first.points, first.depth), (again.points, again.depth)), segmenter,
            "gives something else for a frame after other frames", look_at=at,
        )  # fmt: skip
        require(
            same(before, (frame.points, frame.depth)), segmenter, "modifies the frame", look_at=at
        )

    def test_segmenter_passes_an_empty_frame(
        self, segmenter: Segmenter, wall_scene: WallScene, wall_frames: tuple[Frame, ...]
    ) -> None:
        """A frame without points stays one without points."""
        bound = _bound(segmenter, wall_scene)
        depth = np.zeros_like(wall_frames[0].depth)
        empty = replace(wall_frames[0], points=np.zeros((0, 3)), depth=depth)
        left = bound.segmented(empty, _expected(wall_scene))
        require(
            not len(left.points), segmenter, "makes points of an empty frame",
            look_at=type(bound).segmented,
        )  # fmt: skip

    def test_segmenter_takes_or_refuses_clouds(self, segmenter: Segmenter) -> None:
        """Clouds without a camera are segmented, or refused by a ``RegkitError``."""
        clouds = _scene(images=False)
        frame = clouds.shots[-1]
        try:
            left = _bound(segmenter, clouds).segmented(frame, _expected(clouds))
        except RegkitError:
            return
        require(
            left.depth is None and len(left.points) <= len(frame.points), segmenter,
            "makes an image or points of a cloud that has none", look_at=type(segmenter).bind,
        )  # fmt: skip


@lru_cache
def _scene(images: bool) -> WallScene:
    """Returns the scene, made once for all laws."""
    return WallScene("scene", 30.0, LENGTH, images=images)


def _bound(segmenter: Segmenter, scene: WallScene) -> BoundSegmenter:
    with warnings.catch_warnings(action="ignore", category=RegkitWarning):
        return segmenter.bind(scene, SceneTemplate())


def _expected(scene: WallScene) -> Expected:
    """Returns the body in the last frame but one."""
    return Expected(scene.body, scene.pose(LENGTH - 2), scene.pose(LENGTH - 3))
