"""Tracking of a stream: as of a recording, but for what cameras and dirty files do."""

import time
from dataclasses import replace
from threading import Event

import numpy as np
import pytest
from streams import FPS, WALK, Scripted, empty_frame, walk_frames

import regkit
from regkit.api.live import live_track, track_live
from regkit.api.live_track import LiveTrack
from regkit.api.pipeline import Pipeline
from regkit.interfaces import TimedFrame
from regkit.system.errors import ConfigError, DataError, NoBodyError, NoDataError, SourceLostError
from regkit.system.notes import RegkitWarning

HUMAN = {"kind": "human", "height": 1.63}
START = {
    "kind": "given",
    "root": {"position": [-0.05, -0.05, 3.25], "rotation_deg": [180, 0, 0]},
}
COUNT = 8


@pytest.fixture(scope="module")
def frames() -> list[TimedFrame]:
    return walk_frames(COUNT)


@pytest.fixture(scope="module")
def usual(frames):
    """The markers of the same frames as a recording."""
    recording = regkit.load_recording(WALK, frames=COUNT)
    return regkit.track(recording, HUMAN, start=START).markers


def following(script, *, live=False, **options) -> LiveTrack:
    """A track of the script, which begins with the known start where it is a recording."""
    pipeline = Pipeline.of(HUMAN, start=START, place="test")
    return live_track(lambda: Scripted(list(script), live=live), pipeline, **options)


def tracked(script, **options):
    """Numbers, markers and faults of a script."""
    with following(script, **options) as track:
        poses = list(track)
        return [one.number for one in poses], [one.markers for one in poses], track.faults


def test_stream_is_tracked_as_its_recording(frames, usual):
    numbers, markers, faults = tracked(frames)
    assert numbers == list(range(COUNT))
    np.testing.assert_array_equal(markers, usual)
    assert not faults


def test_every_frame_of_a_camera_is_tracked_if_asked_for(frames, usual):
    numbers, markers, _ = tracked(frames, live=True, every_frame=True)
    assert numbers == list(range(COUNT))
    np.testing.assert_array_equal(markers, usual)


def test_newest_frame_of_a_camera_wins(frames):
    """Frames that come while the last pose is used are dropped, but for the newest."""
    first, begun, used = replace(frames[0], time=-1.0), Event(), Event()
    later = [one for frame in frames[2:] for one in (frame, 0.02)]
    script = [first, 0.1, frames[0], begun.wait, frames[1], used.wait, *later]
    with following(script, live=True, opening=0.01) as track:
        track.begin()
        begun.set()
        numbers = []
        for pose in track:
            numbers.append(pose.number)
            used.set()
            time.sleep(0.4)
        assert numbers == sorted(set(numbers))
        assert (numbers[0], numbers[-1]) == (2, COUNT)
        assert track.dropped == numbers[-1] - numbers[0] + 1 - len(numbers)
        assert track.dropped > 0
        assert track.tracking().numbers == tuple(numbers)


def test_repeated_frame_is_passed_over_and_told(frames, usual):
    with pytest.warns(RegkitWarning, match="frame 3 is the frame before it again"):
        numbers, markers, faults = tracked([*frames[:3], frames[2], *frames[3:]])
    assert numbers == [0, 1, 2, *range(4, COUNT + 1)]
    np.testing.assert_array_equal(markers, usual)
    assert faults == {"repeated": 1}


def test_frozen_picture_is_told_but_tracked(frames):
    frozen = [replace(frames[0], time=at / FPS) for at in range(3)]
    with pytest.warns(RegkitWarning, match="picture of the frame before"):
        numbers, _, faults = tracked(frozen)
    assert numbers == [0, 1, 2]
    assert faults == {"repeated": 2}


def test_damaged_frame_keeps_the_pose_and_the_tracking_goes_on(frames, usual):
    script = [*frames[:3], DataError("cut short", place="000003.png"), *frames[4:]]
    with pytest.warns(RegkitWarning, match="frame 3 is passed over: 000003.png: cut short"):
        numbers, markers, faults = tracked(script)
    assert numbers == list(range(COUNT))
    np.testing.assert_array_equal(markers[3], markers[2])
    assert np.linalg.norm(markers[-1] - usual[-1], axis=1).max() < 0.03
    assert faults == {"damaged": 1}


def test_damaged_frames_before_the_first_whole_one_are_told(frames):
    script = [DataError("cut short", place="000000.png"), *frames[1:4]]
    with pytest.warns(RegkitWarning, match="frame 0 is passed over: 000000.png: cut short"):
        numbers, _, faults = tracked(script)
    assert numbers == [0, 1, 2, 3]
    assert faults == {"damaged": 1}


def test_stream_of_nothing_but_damage_names_it():
    script = [DataError("8 bits instead of 16", place=f"{at}.png") for at in range(3)]
    with pytest.raises(NoBodyError, match=r"2\.png: 8 bits instead of 16"):
        tracked(script)


def test_track_without_a_frame_is_refused(frames):
    with following(frames) as track, pytest.raises(NoDataError, match="iterate"):
        track.tracking()


def test_damaged_frame_has_a_time_on_the_clock_of_the_stream(frames):
    later = [replace(frame, time=1e9 + frame.time) for frame in frames]
    damaged = DataError("cut short")
    script = [damaged, *later[1:3], damaged, *later[4:]]
    with following(script) as track, pytest.warns(RegkitWarning, match="cut short"):
        times = [pose.time for pose in track]
    np.testing.assert_allclose(np.array(times) - 1e9, np.arange(COUNT) / FPS, atol=1e-6)


def test_stream_that_ends_within_a_frame_keeps_the_rest(frames):
    script = [*frames[:3], DataError("ends within the frame")]
    with pytest.warns(RegkitWarning, match="ends within the frame"):
        numbers, _, faults = tracked(script)
    assert numbers == [0, 1, 2, 3]
    assert faults == {"damaged": 1}


def test_time_that_goes_back_is_told_and_tracked(frames, usual):
    script = [*frames[:4], *(replace(frame, time=frame.time - 1.0) for frame in frames[4:])]
    with pytest.warns(RegkitWarning, match=r"frame 4 is 0\.967 s before the last one"):
        numbers, markers, faults = tracked(script)
    assert numbers == list(range(COUNT))
    assert np.linalg.norm(markers[-1] - usual[-1], axis=1).max() < 0.03
    assert faults == {"back in time": 1}


def test_gap_is_told(frames):
    script = [*frames[:4], *(replace(frame, time=frame.time + 1.0) for frame in frames[4:])]
    with pytest.warns(RegkitWarning, match=r"frame 4 comes 1\.03 s after"):
        numbers, _, faults = tracked(script)
    assert numbers == list(range(COUNT))
    assert faults == {"gaps": 1}


def test_slow_stream_is_told_with_its_rate(frames):
    slow = [replace(frames[at % 2], time=0.5 * at) for at in range(24)]
    with (
        pytest.warns(RegkitWarning, match="2 frames per second instead of 30"),
        pytest.warns(RegkitWarning, match=r"comes 0\.5 s after"),
    ):
        _, _, faults = tracked(slow)
    assert faults["slow"] > 0


def test_other_resolution_is_told(frames):
    half = [_halved(frame) for frame in frames[4:]]
    with pytest.warns(RegkitWarning, match="frame 4 has 88x72 pixels, the last one 176x144"):
        numbers, _, faults = tracked([*frames[:4], *half])
    assert numbers == list(range(COUNT))
    assert faults == {"other size": 1}


def _halved(timed: TimedFrame) -> TimedFrame:
    frame = timed.frame
    depth, camera = frame.depth[::2, ::2], frame.camera
    camera = replace(
        camera, width=88, height=72, fx=camera.fx / 2, fy=camera.fy / 2,
        cx=camera.cx / 2, cy=camera.cy / 2,
    )  # fmt: skip
    return replace(timed, frame=replace(
        frame, depth=depth, camera=camera, points=camera.back_projected(depth)
    ))  # fmt: skip


def test_stalled_camera_is_told(frames, monkeypatch):
    monkeypatch.setattr("regkit.tracking.live.live_tracking.STALL", 0.2)
    with pytest.warns(RegkitWarning, match="no frame has come"):
        _, _, faults = tracked([*frames[:-1], 0.8, frames[-1]], live=True, every_frame=True)
    assert faults == {"stalled": 1}


def test_unplugged_camera_keeps_what_was_tracked(frames):
    lost = SourceLostError("unplugged")
    with following([*frames, lost], live=True, every_frame=True, opening=0.1) as track:
        with pytest.raises(SourceLostError, match="scripted: unplugged"):
            list(track)
        assert len(track.tracking()) == COUNT


def test_stream_of_damaged_frames_ends(frames):
    damaged = [DataError(f"damage {at}") for at in range(200)]
    with following([*frames[:2], *damaged]) as track:
        with pytest.warns(RegkitWarning), pytest.raises(SourceLostError, match="in a row"):
            list(track)
        assert len(track.tracking()) < 150


def test_stream_of_frames_that_cannot_be_registered_ends(frames):
    """They are read whole, but a number in them is none."""
    seen = frames[0].frame
    broken = [
        replace(frames[0], time=1.0 + at, frame=replace(seen, points=seen.points * np.nan))
        for at in range(200)
    ]
    script = [*frames[:2], *broken]
    with (
        following(script, opening=0.02) as track,
        pytest.warns(RegkitWarning),
        pytest.raises(SourceLostError, match="in a row"),
    ):
        list(track)
    assert track.faults["damaged"] == 100


def test_stream_that_cannot_be_closed_ends_with_its_error(frames):
    class Stuck(Scripted):
        def close(self):
            raise OSError("stuck")

    pipeline = Pipeline.of(HUMAN, start=START, place="test")
    with (
        live_track(lambda: Stuck(frames), pipeline, opening=0.05) as track,
        pytest.raises(OSError, match="stuck"),
    ):
        list(track)


def test_body_that_comes_into_sight_later_is_found(frames, usual):
    blank = [empty_frame(at / FPS) for at in range(20)]
    later = [replace(frame, time=(20 + at) / FPS) for at, frame in enumerate(frames)]
    with following([*blank, *later], opening=0.5) as track:
        poses = list(track)
        assert [pose.number for pose in poses] == list(range(20 + COUNT))
        assert {str(pose.verdict) for pose in poses[:20]} == {"no data"}
        assert {str(pose.verdict) for pose in poses[20:]} == {"found"}
    assert np.linalg.norm(poses[-1].markers - usual[-1], axis=1).max() < 0.03


def test_stream_without_a_body_is_refused():
    with following([empty_frame(at / FPS) for at in range(20)], opening=0.2) as track:
        with pytest.raises(NoBodyError, match="no body comes into sight"):
            list(track)
        assert not track.is_begun


def test_streams_are_closed(frames):
    opened = []

    def source():
        opened.append(Scripted(frames))
        return opened[-1]

    with live_track(source, Pipeline.of(HUMAN, start=START, place="test")) as track:
        list(track)
    assert len(opened) == 2
    assert all(stream.is_closed for stream in opened)


@pytest.mark.parametrize("opening", [0.0, -1.0, np.nan, np.inf])
def test_opening_must_be_positive(opening):
    with pytest.raises(ConfigError, match="opening"):
        track_live(WALK, HUMAN, opening=opening)
