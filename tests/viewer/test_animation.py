"""Animated pictures of tracks."""

from dataclasses import replace

import numpy as np
import pytest
from made_tracks import made_scene
from PIL import Image
from scipy.ndimage import maximum_filter

from regkit.system.errors import ConfigError
from regkit.viewer.animation import film
from regkit.viewer.animation.film import drawing_of, durations, write_film
from regkit.viewer.animation.pose import ShownPose
from regkit.viewer.animation.view import FINER, Sheet
from regkit.viewer.points import FramePoints
from regkit.viewer.track_scene import TrackScene
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.shapes.mesh import Mesh
from regkit_plugins.shapes.sphere import SphereMesh
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human

HUMAN, HAND = Human(height=1.7).body(1.7), Hand().body(0.19)
SMALL = Sheet(240, 160)


@pytest.fixture(autouse=True)
def small(monkeypatch):
    monkeypatch.setattr(film, "SHEET", SMALL)


@pytest.fixture
def track() -> TrackScene:
    return made_scene(HUMAN, GeneralizedSumOfGaussians().bind(HUMAN), 6, lost=2)


def drawn(track: TrackScene, frame: int, presence: float = 1.0) -> np.ndarray:
    poses = [ShownPose.of(track, frame, track.points.at(frame))]
    return np.array(drawing_of(track, poses, SMALL).picture(poses[0], presence)).astype(int)


@pytest.mark.parametrize("suffix", [".gif", ".webp"])
def test_film_has_the_frames_and_the_pace_of_the_track(track, tmp_path, suffix):
    written = write_film(track, tmp_path / f"track{suffix}")
    with Image.open(tmp_path / f"track{suffix}") as image:
        assert image.n_frames == written.frames == 6
        shown = 0
        for frame in range(6):
            image.seek(frame)
            image.load()
            shown += image.info["duration"]
        assert image.info["loop"] == 0
    assert shown == 200
    assert written.seconds == pytest.approx(0.2)


def test_film_is_thinned_where_frames_are_too_short_or_the_file_too_large(
    track, tmp_path, monkeypatch
):
    assert write_film(track, tmp_path / "fast.gif", fps=100.0).frames == 3
    assert write_film(track, tmp_path / "slow.gif", fps=10.0).seconds == pytest.approx(0.6)
    monkeypatch.setattr(film, "BYTES", (tmp_path / "slow.gif").stat().st_size - 1)
    halved = write_film(track, tmp_path / "half.gif", fps=10.0)
    assert (halved.frames, halved.length) == (3, 6)
    assert halved.seconds == pytest.approx(0.6)
    with pytest.raises(ConfigError, match=r"\.mp4"):
        write_film(track, tmp_path / "track.mp4")


def test_durations_are_of_whole_hundredths_and_add_up():
    begins = np.arange(61) / 30.0
    assert sum(durations(begins)) == 2000
    assert {*durations(begins)} == {30, 40}


@pytest.mark.parametrize("body", [HUMAN, HAND], ids=["human", "hand"])
@pytest.mark.parametrize(
    "model", [GeneralizedSumOfGaussians(), SphereMesh(), Mesh()], ids=["gsog", "sphere", "mesh"]
)
def test_model_is_drawn_where_its_projection_is(body, model):
    track = made_scene(body, model.bind(body), 2)
    track = replace(track, points=FramePoints.of({0: np.zeros((0, 3)), 1: np.zeros((0, 3))}))
    poses = [ShownPose.of(track, 0, np.zeros((0, 3)))]
    drawing = drawing_of(track, poses, SMALL)
    picture = np.array(drawing.picture(poses[0])).astype(int)
    blank = np.array(drawing.picture(poses[0], 0.0)).astype(int)
    changed = np.abs(picture - blank).sum(axis=2) > 20
    for column, view in enumerate(drawing.views):
        half = changed[:, 120 * column : 120 * (column + 1)]
        rows, columns = np.nonzero(half)
        placed = track.shapes[0].placed(poses[0].transforms).reshape(-1, 3)
        pixels = view.pixels(view.moved(placed)) / FINER - [120 * column, 0]
        assert half.mean() > 0.02
        assert columns.min() < pixels[:, 0].min() + 6
        assert rows.max() > pixels[:, 1].max() - 6
        inside = pixels.round().astype(int)
        # The ends of bones are as white as the paper in their middle.
        near = maximum_filter(half, size=5)
        assert near[inside[:, 1], inside[:, 0]].mean() > 0.98


def test_frames_in_which_the_body_is_lost_are_labelled(track):
    found, lost = drawn(track, 0), drawn(track, 5)
    red = [(one[..., 0] > 150) & (one[..., 1] < 80) & (one[..., 2] < 90) for one in (found, lost)]
    assert not red[0].any()
    assert red[1][:30].sum() > 200


def test_segments_without_data_are_grey(track):
    sure = replace(track, supports=np.ones_like(track.supports))
    unsure = replace(track, supports=np.zeros_like(track.supports))
    colourful = [(np.ptp(drawn(one, 0), axis=2) > 60).sum() for one in (sure, unsure)]
    assert colourful[0] > 100
    assert colourful[1] == 0
