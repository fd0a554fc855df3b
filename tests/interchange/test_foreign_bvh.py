"""BVH files as programs write them: the skeleton is theirs, and what was assumed is told."""

import time
from pathlib import Path

import numpy as np
import pytest
from places import CASES

from regkit.interchange.bones import MOST
from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.bvh.motion import _words
from regkit.interchange.imported import ImportedSkeleton
from regkit.interchange.skeletons import read_skeleton
from regkit.system.errors import DataError, RegkitError
from regkit.system.notes import RegkitWarning
from regkit_synthesis.motion.bvh import read_bvh

SMALL = """HIERARCHY
ROOT hip
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
  JOINT knee
  {
    OFFSET 0 -4 0
    CHANNELS 3 Zrotation Yrotation Xrotation
    End Site
    {
      OFFSET 0 -5 1
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.5
0 9 0 0 0 0 10 0 0
1 9 0 0 0 0 20 0 0
"""


def _write(folder: Path, text: str | bytes) -> Path:
    path = folder / "small.bvh"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def _read(folder: Path, text: str | bytes) -> ImportedSkeleton:
    return read_skeleton(_write(folder, text))


@pytest.mark.parametrize(
    ("name", "words"),
    [("count_off_by_one", "Frames is 2, and 3"), ("frame_time_zero", "Frame Time is 0")],
)
def test_a_skeleton_is_read_whatever_its_motion(name: str, words: str) -> None:
    with pytest.warns(RegkitWarning, match=words):
        imported = read_skeleton(CASES / "14-bvh" / f"{name}.bvh", scale=0.01)
    assert imported.description.size.value == pytest.approx(1.7)
    assert len(imported.description.segments) == 5


def test_hips_that_move_below_a_reference_are_the_root() -> None:
    path = CASES / "14-bvh" / "static_root_moving_hips.bvh"
    with pytest.warns(RegkitWarning, match="'Hips' moves below 'Root', and is the root"):
        imported = read_skeleton(path, scale=0.01)
    segments = imported.description.segments
    assert list(segments) == ["Hips", "Spine", "Head", "LeftLeg", "RightLeg"]
    assert segments["Hips"].parent is None
    assert segments["Hips"].joint.type == "free"
    assert imported.description.size.value == pytest.approx(1.7)


def test_a_reference_that_turns_its_axes_keeps_the_body_upright(tmp_path: Path) -> None:
    # A file with z up below a reference that turns z to y.
    joint = SMALL.split("HIERARCHY\n")[1].split("MOTION")[0].replace("ROOT", "JOINT")
    joint = joint.replace("0 -4 0", "0 0 -4").replace("0 -5 1", "0 -1 -5")
    reference = (
        "HIERARCHY\nROOT ref\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
        "JOINT prop\n{\nOFFSET 1 0 0\n}\n"
    )
    frames = "Frames: 2\nFrame Time: 1\n-90 0 0 0 0 9 0 0 0 0 0 0\n-90 0 0 5 0 9 0 0 0 0 0 0\n"
    plain = _read(tmp_path, SMALL)
    with pytest.warns(RegkitWarning, match="joints left out: 2"):
        imported = _read(tmp_path, f"{reference}{joint}}}\nMOTION\n{frames}")
    segments, expected = imported.description.segments, plain.description.segments
    assert list(segments) == ["hip", "knee"]
    for name, one in expected.items():
        np.testing.assert_allclose(segments[name].offset, one.offset, atol=1e-12)
        for marker, point in one.markers.items():
            np.testing.assert_allclose(segments[name].markers[marker], point, atol=1e-12)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("Frames: 2", "FRAMES 2"),
        ("Frame Time: 0.5", "frametime:\t5e-1"),
        ("ROOT hip\n{", "root hip {"),
        ("HIERARCHY\nROOT hip\n{\n", "HIERARCHY ROOT hip {"),
        ("MOTION\nFrames: 2\nFrame", "MOTION Frames: 2 Frame"),
        ("\n  CHANNELS 6", " CHANNELS 6"),
        ("  OFFSET 0 0 0\n  CHANNELS 6 Xp", "  CHANNELS 6 Xp"),
        ("End Site", "EndSite"),
        ("End Site", "END  SITE foot"),
        ("0 9 0 0 0 0 10 0 0", "0,0 9,0 0 0 0 0 10,0 0 0"),
        ("Zrotation Y", "ZROTATION y"),
        ("HIERARCHY", "\ufeffhierarchy"),
        ("20 0 0\n", "20 0 0\n\n\0\0\x1a"),
    ],
)
def test_spellings_do_not_matter(tmp_path: Path, old: str, new: str) -> None:
    expected = Bvh.read(_write(tmp_path, SMALL))
    text = SMALL.replace(old, new, 1)
    if "CHANNELS 6 Xp" in old:
        text = text.replace(
            "Zrotation Yrotation Xrotation\n", "Zrotation Yrotation Xrotation\n  OFFSET 0 0 0\n", 1
        )
    motion = Bvh.read(_write(tmp_path, text))
    assert motion.names == expected.names
    np.testing.assert_array_equal(motion.frames, expected.frames)
    np.testing.assert_array_equal(motion.rest_positions, expected.rest_positions)
    np.testing.assert_array_equal(motion.joints[1].ends, expected.joints[1].ends)
    assert motion.frame_time == 0.5


@pytest.mark.parametrize(
    ("encoding", "name", "told"),
    [
        ("utf-8", "左腕 上", None),
        ("utf-16", "左腕", None),
        ("shift-jis", "左腕", "Shift-JIS"),
        ("latin-1", "Füße links", "Latin-1"),
    ],
)
def test_names_are_read_in_their_encoding(
    tmp_path: Path, encoding: str, name: str, told: str | None
) -> None:
    content = SMALL.replace("knee", name).encode(encoding)
    if told is None:
        imported = _read(tmp_path, content)
    else:
        with pytest.warns(RegkitWarning, match=told):
            imported = _read(tmp_path, content)
    assert list(imported.description.segments) == ["hip", name]


@pytest.mark.parametrize(
    ("text", "told", "frames"),
    [
        (SMALL[: SMALL.index("MOTION")], "no MOTION", 0),
        (SMALL.replace("20 0 0\n", "20"), "unfinished", 1),
        (SMALL.replace("Frames: 2", "Frames: 1"), "Frames is 1, and 2", 2),
        (SMALL.replace("Frames: 2", "Frames: -7"), "Frames is -7, and 2", 2),
        (SMALL.replace("Frames: 2\n", ""), "Frames is nothing", 2),
        (SMALL.replace("Frame Time: 0.5", "Frame Time: -1"), "Frame Time is -1", 2),
        (SMALL.replace("Frame Time: 0.5\n", ""), "Frame Time is 0", 2),
        (SMALL.replace("JOINT knee", "JOINT hip"), "hip -> hip_2", 2),
        (SMALL.replace("JOINT knee", "JOINT"), "-> joint_1", 2),
    ],
)
@pytest.mark.filterwarnings("ignore:.*Frames is 2, and 1 ")
def test_what_is_assumed_is_told(tmp_path: Path, text: str, told: str, frames: int) -> None:
    with pytest.warns(RegkitWarning, match=told):
        motion = Bvh.read(_write(tmp_path, text))
    assert len(motion.frames) == frames
    assert len(motion.joints) == 2
    assert len(set(motion.names)) == 2
    with pytest.warns(RegkitWarning, match=told):
        assert len(_read(tmp_path, text).description.segments) == 2


@pytest.mark.filterwarnings("ignore::regkit.system.notes.RegkitWarning")
@pytest.mark.parametrize("change", [("0.5\n", "0\n"), ("MOTION", "")])
def test_a_file_without_times_is_no_motion(tmp_path: Path, change: tuple[str, str]) -> None:
    text = SMALL.replace(*change)
    path = _write(tmp_path, text[: text.index("Frames")] if change[0] == "MOTION" else text)
    with pytest.raises(DataError):
        Bvh.read(path).at(0.0)
    with pytest.raises(RegkitError, match=r"frames|Frame Time"):
        read_bvh(path)


def test_frames_that_cannot_be_read_leave_the_skeleton(tmp_path: Path) -> None:
    text = SMALL.replace("0 9 0 0 0 0 10", "0 9 0 0 0 0 -nan(ind)")
    with pytest.raises(DataError, match=r"small.bvh:19: .*not a number"):
        Bvh.read(_write(tmp_path, text))
    with pytest.warns(RegkitWarning, match=r"small.bvh:19: .*left out"):
        assert len(_read(tmp_path, text).description.segments) == 2


def _nested(count: int) -> str:
    joints = "".join(f"JOINT j{k}\n{{\nOFFSET 0 1 0\nCHANNELS 0\n" for k in range(count))
    head = f"HIERARCHY\nROOT a\n{{\nOFFSET 0 0 0\nCHANNELS 0\n{joints}"
    return head + "}\n" * (count + 1) + "MOTION\nFrames: 0\nFrame Time: 0.1\n"


def test_a_skeleton_too_large_is_refused_at_once(tmp_path: Path) -> None:
    path = _write(tmp_path, _nested(3000))
    begin = time.thread_time()
    with pytest.raises(DataError, match=f"3001 joints; .* {MOST}"):
        read_skeleton(path)
    assert time.thread_time() - begin < 1.0


def test_a_deep_skeleton_is_a_body_in_time(tmp_path: Path) -> None:
    begin = time.thread_time()
    description = _read(tmp_path, _nested(400)).description
    body = description.body("deep", description.size.value)
    assert time.thread_time() - begin < 2.0
    heights = body.place(body.skeleton.rest()).transforms[:, 1, 3]
    assert heights.max() == pytest.approx(400.0)


def test_names_are_written_so_that_they_read_back(tmp_path: Path) -> None:
    names = ["", "a {b}", "a\tb", "a b", "JOINT End Site", "左腕", "=1+1", "\x1b[31m", "\x85"]
    words = _words(names)
    assert len(set(words)) == len(names)
    joints = "".join(f"JOINT {word}\n{{\nOFFSET 0 {k} 1\n}}\n" for k, word in enumerate(words))
    head, rest = SMALL.split("  JOINT knee")
    path = _write(tmp_path, f"{head}{joints}  JOINT knee{rest}")
    assert list(Bvh.read(path).names[1:-1]) == words


@pytest.mark.parametrize("length", ["1e7", "-1e12", "1e29"])
def test_a_skeleton_of_an_absurd_size_is_refused(tmp_path: Path, length: str) -> None:
    with pytest.raises(DataError, match="extends over"):
        _read(tmp_path, SMALL.replace("OFFSET 0 -5 1", f"OFFSET 0 {length} 1"))


def test_numbers_that_overflow_are_refused_with_their_line(tmp_path: Path) -> None:
    for old, line in (("OFFSET 0 -5 1", 12), ("OFFSET 0 0 0", 4)):
        path = _write(tmp_path, SMALL.replace(old, "OFFSET 0 1e300 0"))
        with pytest.raises(DataError, match=r"1e\+300") as caught:
            Bvh.read(path)
        assert caught.value.place == f"{path}:{line}"
