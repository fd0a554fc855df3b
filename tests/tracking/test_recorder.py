"""Sessions and recorders: what is kept of a track, and what a start needs."""

import gc
import weakref
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pytest
from places import DATA

import regkit
from regkit.geometry.rigid import rigid
from regkit.interfaces import Chain, Evaluation, Past, Preprocessor, Recording, Registrar
from regkit.interfaces import RegistrationResult as Result
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose
from regkit.system.compiled import compiled
from regkit.system.errors import ConfigError, DataError, NoDataError
from regkit.tracking import Follower, Session, TrackRecorder, TrackVerdict, Verdict, tracked
from regkit_plugins.preprocessors.points import PointsPreprocessor
from regkit_plugins.templates.human import Human
from regkit_plugins.trackers.constant_pose import ConstantPose

WALK = DATA / "human_walk"
SIZED = Human(height=1.7)
BODY = SIZED.body(1.7)


def pose(depth: float = 2.0) -> Pose:
    return BODY.skeleton.rest(rigid(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, depth])))


@dataclass(frozen=True)
class Made(Recording):
    """Points on a body in frames made on request, each with an offset in depth; NaN is blank."""

    offsets: tuple[float, ...] = ()

    def frames(self) -> Iterator[Frame]:
        axes = BODY.capsules.axis_points(0.05)
        on_surface = axes.place(BODY.place(pose()).transforms) + axes.radii[:, None] * [0, 0, -1]
        for offset in self.offsets:
            seen = on_surface if np.isfinite(offset) else on_surface[:0]
            yield Frame(seen + np.array([0.0, 0.0, offset]))

    def truth(self) -> None:
        """None."""


def made(*offsets: float) -> Made:
    return Made("made", 30.0, len(offsets), offsets=offsets)


@dataclass
class Still(Registrar):
    """Finds the pose that it is given; the energy tells the frames apart."""

    body: object = BODY
    calls: int = 0

    def register(self, observation, candidates, *, prior=None, warm_start=None):
        self.calls += 1
        energy = float(observation.points[:, 2].mean())
        return Result(candidates[0], energy, 0.9, True, 1, 2, "still")

    def evaluate(self, observation, pose) -> Evaluation:
        return Evaluation(0.0, np.ones(len(observation.points)))


def recorded(session: Session, registrar: Registrar) -> TrackRecorder:
    recorder = TrackRecorder(registrar, session.recording.fps, session.observation)
    for frame in session.tracked(registrar, ConstantPose(), pose()):
        recorder.add(frame)
    return recorder


OFFSETS = (0.0, 0.01, 0.05, 0.02, 0.0)


def test_recorder_holds_the_numbers_of_every_frame():
    session = Session(made(*OFFSETS), SIZED, PointsPreprocessor(), pose())
    recorder = recorded(session, Still())
    track = recorder.track()
    assert len(track) == len(recorder) == len(OFFSETS)
    np.testing.assert_array_equal(track.root, [pose().root] * len(OFFSETS))
    assert track.markers.shape == (len(OFFSETS), len(BODY.markers.names), 3)
    np.testing.assert_allclose(track.energies - track.energies[0], OFFSETS)
    assert (track.inlier_shares > 0.9).all()
    assert track.surface_distances.argmax() == 2
    assert recorder.message(3) == "still"
    np.testing.assert_array_equal(track[1:3].energies, track.energies[1:3])


@pytest.mark.parametrize("index", range(len(OFFSETS)))
def test_every_frame_has_a_snapshot_kept_or_read_again(index):
    session = Session(made(*OFFSETS), SIZED, PointsPreprocessor(), pose())
    snapshot = recorded(session, Still()).snapshot(index)
    frames = [PointsPreprocessor().preprocess(frame) for frame in session.recording.frames()]
    assert snapshot.frame == index
    np.testing.assert_array_equal(snapshot.points, frames[index].points)
    np.testing.assert_array_equal(snapshot.pose.root, pose().root)


@pytest.mark.long
def test_no_more_images_are_kept_than_pictures_need():
    """Observations die when their frame is over, however long the track is."""
    alive: list[weakref.ref[Observation]] = []

    class Watched(Preprocessor):
        kind: str = "watched"

        def preprocess(self, frame: Frame) -> Observation:
            points = frame.points
            observation = Observation(points, np.ones(len(points)), np.ones(len(points)))
            alive.append(weakref.ref(observation))
            return observation

    session = Session(made(*np.linspace(0.0, 0.1, 40)), SIZED, Watched(), pose())
    recorder = recorded(session, Still())
    gc.collect()
    assert len(recorder) == 40
    assert sum(one() is not None for one in alive) == 0


def test_start_is_given_or_says_what_it_lacks():
    recording = made(0.0)
    begin = Session(recording, SIZED, PointsPreprocessor(), pose()).begin()
    assert begin.body.size == 1.7
    np.testing.assert_array_equal(begin.pose.root, pose().root)
    with pytest.raises(ConfigError, match="size"):
        Session(recording, Human(), PointsPreprocessor(), pose()).begin()
    wrong = Pose(np.eye(4), np.zeros((2, 4)), np.zeros(3))
    with pytest.raises(ConfigError, match="balls"):
        Session(recording, SIZED, PointsPreprocessor(), wrong).begin()


def test_start_without_a_frame_is_told():
    with pytest.raises(DataError, match="no frame"):
        Session(made(), SIZED, PointsPreprocessor()).begin()


def test_frame_without_data_is_bridged_and_told():
    """What was tracked before and after it is kept."""
    session = Session(made(0.0, np.nan, 0.01), SIZED, PointsPreprocessor(), pose())
    recorder = recorded(session, Still())
    track = recorder.track()
    np.testing.assert_array_equal(track.seen, [True, False, True])
    assert track.verdicts[1] is Verdict.NO_DATA
    np.testing.assert_array_equal(track.root[1], track.root[0])
    assert np.isnan([track.inlier_shares[1], track.surface_distances[1]]).all()
    assert "empty" in recorder.message(1)
    judged = TrackVerdict.of(track)
    assert judged.verdict is Verdict.DOUBTFUL
    assert "1 of 3 frames have no data" in judged.reason
    assert "template" not in judged.reason, "the template is not to blame for a blank frame"
    with pytest.raises(NoDataError):
        recorder.snapshot(1)


@pytest.mark.long
# Points on the axes are no surface, so the start is doubtful, but its size is right.
@pytest.mark.filterwarnings("ignore::regkit.system.notes.RegkitWarning")
def test_start_is_in_the_first_frame_with_data():
    session = Session(made(np.nan, np.nan, 0.0), Human(), PointsPreprocessor(voxel=0.03))
    assert session.begin().body.size == pytest.approx(1.7, abs=0.15)
    with pytest.raises(NoDataError, match="made: frame 0"):
        Session(made(np.nan, np.nan), Human(), PointsPreprocessor()).begin()


@pytest.mark.parametrize("kind", ["folder", "made"])
def test_some_frames_are_those_of_all(kind):
    recording = regkit.load_recording(WALK, frames=5) if kind == "folder" else made(*OFFSETS)
    frames = list(recording.frames())
    found = list(recording.some([4, 1, 1]))
    assert [index for index, _ in found] == [1, 4]
    for index, frame in found:
        np.testing.assert_array_equal(frame.points, frames[index].points)
    assert list(recording.some([])) == []


def test_step_that_loads_loops_is_repeated_and_gives_the_same_track():
    """Its first time is that of compiling."""

    @compiled
    def doubled(x):
        return 2.0 * x

    class Loading(Still):
        def register(self, observation, candidates, **given):
            doubled(1.0 if self.calls < 2 else 1)  # Another type in the third call.
            return super().register(observation, candidates, **given)

    registrar = Loading()
    frames = list(
        tracked(
            made(*OFFSETS),
            Follower(Chain(), PointsPreprocessor(), registrar, ConstantPose(), pose()),
        )
    )
    assert registrar.calls == len(OFFSETS) + 2
    assert len(frames) == len(OFFSETS)
    past = Past.start(pose())
    for frame in frames:
        past = past.followed_by(frame.registered)
    assert past.frames == len(OFFSETS)
