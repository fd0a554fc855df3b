"""Laws of preprocessors."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import Preprocessor
from regkit.observation import Frame
from regkit.system.errors import DataError
from regkit.testing.laws import Laws
from regkit.testing.samples import CAMERA, lump_points
from regkit.testing.verdict import copied, require, same


class PreprocessorLaws(Laws):
    """Laws of preprocessors."""

    @pytest.fixture(params=["cloud", "depth"])
    def frame(self, request: pytest.FixtureRequest) -> Frame:
        """Returns a cloud, or the depth image of a ball in front of a wall."""
        if request.param == "cloud":
            return Frame(lump_points(600) + np.array([0.0, 0.0, 1.0]), place="a cloud")
        v, u = np.mgrid[: CAMERA.height, : CAMERA.width]
        apart = np.hypot(u - CAMERA.cx, v - CAMERA.cy)
        depth = np.where(apart < 30.0, 1.2 - 0.002 * (30.0 - apart), 0.0)
        return Frame(CAMERA.back_projected(depth), CAMERA, depth, place="a depth image")

    def test_preprocessor_gives_finite_points_with_positive_weights(
        self, preprocessor: Preprocessor, frame: Frame
    ) -> None:
        """Points are (N, 3), weights and variances (N,), normals of unit length or None."""
        seen, at = preprocessor.preprocess(frame), type(preprocessor).preprocess
        count = len(seen.points)
        require(
            0 < count <= len(frame.points) and seen.points.shape == (count, 3)
            and np.isfinite(seen.points).all(), preprocessor,
            f"makes points of shape {seen.points.shape} from {len(frame.points)}, or not finite",
            look_at=at,
        )  # fmt: skip
        for name in ("weights", "variances"):
            values = getattr(seen, name)
            require(
                values.shape == (count,) and np.isfinite(values).all() and (values > 0.0).all(),
                preprocessor,
                f"makes {name} of shape {values.shape}, or not positive; they must be {(count,)}",
                look_at=at,
            )
        if seen.normals is not None:
            off = np.abs(np.linalg.norm(seen.normals, axis=1) - 1.0).max()
            require(
                seen.normals.shape == (count, 3) and off < 1e-6, preprocessor,
                f"makes normals whose length is off by {off:.2g}", look_at=at,
            )  # fmt: skip
        require(
            seen.camera is frame.camera, preprocessor, "does not pass on the frame's camera",
            look_at=at,
        )  # fmt: skip

    def test_preprocessor_moves_with_the_frame(
        self, preprocessor: Preprocessor, frame: Frame
    ) -> None:
        """The data's centre moves with the points, within the data's standard deviation."""
        turn = vector_to_matrix(np.array([0.1, -0.2, 0.3]))
        motion = rigid(turn, np.array([0.05, 0.02, 0.1]))
        before = preprocessor.preprocess(Frame(frame.points))
        after = preprocessor.preprocess(Frame(transformed(motion, frame.points)))
        first, second = (
            np.average(each.points, axis=0, weights=each.weights) for each in (before, after)
        )
        by = np.linalg.norm(transformed(motion, first[None])[0] - second)
        allowed = float(np.sqrt(max(before.variances.max(), after.variances.max())))
        require(
            by <= allowed,
            preprocessor,
            f"does not move with the frame: the centre of its data is off "
            f"by {by:.2g} m, more than their standard deviation of {allowed:.2g} m",
            look_at=type(preprocessor).preprocess,
        )

    @pytest.mark.parametrize("points", ["empty", "nan", "infinite"])
    def test_preprocessor_refuses_what_is_no_cloud(
        self, preprocessor: Preprocessor, points: str
    ) -> None:
        """Raises ``DataError`` for an empty frame, or coordinates that are not finite."""
        cloud = lump_points(100)
        if points == "empty":
            cloud = cloud[:0]
        else:
            cloud[7, 1] = np.nan if points == "nan" else np.inf
        refused = False
        try:
            preprocessor.preprocess(Frame(cloud, place="a frame"))
        except DataError:
            refused = True
        require(
            refused,
            preprocessor,
            f"accepts a frame with points {points}; it must raise a "
            "DataError, like regkit.system.arrays.checked_points",
            look_at=type(preprocessor).preprocess,
        )

    def test_preprocessor_is_deterministic_and_changes_nothing(
        self, preprocessor: Preprocessor, frame: Frame
    ) -> None:
        """Repeated, it returns the same, and it does not modify the frame."""
        before, at = copied((frame.points, frame.depth)), type(preprocessor).preprocess
        first, second = preprocessor.preprocess(frame), preprocessor.preprocess(frame)
        require(
            same(first, second), preprocessor, "returns another result when repeated", look_at=at
        )
        require(
            same(before, (frame.points, frame.depth)), preprocessor,
            "modifies the frame", look_at=at,
        )  # fmt: skip
