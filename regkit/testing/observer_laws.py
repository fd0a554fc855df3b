"""Laws of observers."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.geometry.rigid import moved, rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import Observer
from regkit.observation import Frame
from regkit.system.errors import DataError
from regkit.testing.laws import Laws
from regkit.testing.samples import CAMERA, lump_points
from regkit.testing.verdict import copied, require, same


class ObserverLaws(Laws):
    """Laws of observers."""

    @pytest.fixture(params=["cloud", "depth"])
    def frame(self, request: pytest.FixtureRequest) -> Frame:
        """A cloud, and the depth image of a ball and a wall."""
        if request.param == "cloud":
            return Frame(lump_points(600) + np.array([0.0, 0.0, 1.0]), place="a cloud")
        v, u = np.mgrid[: CAMERA.height, : CAMERA.width]
        apart = np.hypot(u - CAMERA.cx, v - CAMERA.cy)
        depth = np.where(apart < 30.0, 1.2 - 0.002 * (30.0 - apart), 0.0)
        return Frame(CAMERA.back_projected(depth), CAMERA, depth, place="a depth image")

    def test_observer_gives_finite_points_with_positive_weights(
        self, observer: Observer, frame: Frame
    ) -> None:
        """(N, 3) points, (N,) weights and variances, unit normals if there are any."""
        seen, at = observer.observe(frame), type(observer).observe
        count = len(seen.points)
        require(
            0 < count <= len(frame.points) and seen.points.shape == (count, 3)
            and np.isfinite(seen.points).all(), observer,
            f"makes points of the shape {seen.points.shape} of {len(frame.points)}, or not finite",
            look_at=at,
        )  # fmt: skip
        for name in ("weights", "variances"):
            values = getattr(seen, name)
            require(
                values.shape == (count,) and np.isfinite(values).all() and (values > 0.0).all(),
                observer, f"makes {name} of the shape {values.shape}, or not positive; they must "
                f"be {(count,)}", look_at=at,
            )  # fmt: skip
        if seen.normals is not None:
            off = np.abs(np.linalg.norm(seen.normals, axis=1) - 1.0).max()
            require(
                seen.normals.shape == (count, 3) and off < 1e-6, observer,
                f"makes normals whose length is off by {off:.2g}", look_at=at,
            )  # fmt: skip
        require(
            seen.camera is frame.camera, observer, "does not hand on the frame's camera",
            look_at=at,
        )  # fmt: skip

    def test_observer_moves_with_the_frame(self, observer: Observer, frame: Frame) -> None:
        """The data's centre is that of the moved points, within the data's own deviation."""
        turn = vector_to_matrix(np.array([0.1, -0.2, 0.3]))
        motion = rigid(turn, np.array([0.05, 0.02, 0.1]))
        before = observer.observe(Frame(frame.points))
        after = observer.observe(Frame(moved(motion, frame.points)))
        first, second = (
            np.average(each.points, axis=0, weights=each.weights) for each in (before, after)
        )
        by = np.linalg.norm(moved(motion, first[None])[0] - second)
        allowed = float(np.sqrt(max(before.variances.max(), after.variances.max())))
        require(
            by <= allowed, observer, f"does not move with the frame: the centre of its data is off "
            f"by {by:.2g} m, more than their deviation of {allowed:.2g} m",
            look_at=type(observer).observe,
        )  # fmt: skip

    @pytest.mark.parametrize("points", ["empty", "nan", "infinite"])
    def test_observer_refuses_what_is_no_cloud(self, observer: Observer, points: str) -> None:
        """With a ``DataError``: an empty frame, and coordinates that are not finite."""
        cloud = lump_points(100)
        if points == "empty":
            cloud = cloud[:0]
        else:
            cloud[7, 1] = np.nan if points == "nan" else np.inf
        refused = False
        try:
            observer.observe(Frame(cloud, place="a frame"))
        except DataError:
            refused = True
        require(
            refused, observer, f"takes a frame whose points are {points}; it must raise a "
            "DataError, as regkit.system.arrays.checked_points", look_at=type(observer).observe,
        )  # fmt: skip

    def test_observer_is_deterministic_and_changes_nothing(
        self, observer: Observer, frame: Frame
    ) -> None:
        """Asked twice it sees the same, and the frame stays as it was."""
        before, at = copied((frame.points, frame.depth)), type(observer).observe
        first, second = observer.observe(frame), observer.observe(frame)
        require(
            same(first, second), observer, "sees something else when it looks again", look_at=at
        )
        require(
            same(before, (frame.points, frame.depth)), observer,
            "changes the frame that it is given", look_at=at,
        )  # fmt: skip
