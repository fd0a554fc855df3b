"""URDF files as people write them: what is passed over is told, and the robot is what it was."""

import struct
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from places import CASES
from scipy.spatial.transform import Rotation

from regkit.interchange.imported import ImportedSkeleton
from regkit.interchange.skeletons import read_skeleton
from regkit.interchange.urdf.mesh_capsule import mesh_capsule
from regkit.interchange.urdf.urdf import Urdf
from regkit.system.errors import RegkitError
from regkit.system.notes import RegkitWarning

ARM = """<robot name="arm">
  <link name="base"><visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual></link>
  <link name="upper"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="lower"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.4"/><axis xyz="0 0 2"/><limit lower="-1" upper="1"/></joint>
  <joint name="bend" type="continuous"><parent link="upper"/><child link="lower"/>
    <origin xyz="0 0 0.3"/></joint>
</robot>
"""


def _read(folder: Path, text: str | bytes, packages: Sequence[Path] = ()) -> ImportedSkeleton:
    path = folder / "arm.urdf"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return read_skeleton(path, packages=packages)


def _kinds(imported: ImportedSkeleton) -> dict[str, str]:
    return {name: one.joint.type for name, one in imported.description.segments.items()}


def test_placeholders_of_unused_fields_are_passed_over_with_a_note() -> None:
    with pytest.warns(RegkitWarning, match=r"fixed_zero_axis.urdf:6: .*flange"):
        imported = read_skeleton(CASES / "16-urdf" / "fixed_zero_axis.urdf")
    assert _kinds(imported) == {"base": "free", "upper": "hinge", "tool": "fixed"}
    with pytest.warns(RegkitWarning) as told:
        imported = read_skeleton(CASES / "16-urdf" / "zero_radius.urdf")
    assert {str(one.message).rsplit("(")[-1] for one in told} == {
        'sphere radius="0.0")',
        "world -> pelvis)",
    }
    assert _kinds(imported) == {"pelvis": "free", "leg": "hinge"}
    with pytest.warns(RegkitWarning, match="jb: 0"):
        imported = read_skeleton(CASES / "16-urdf" / "mimic_zero.urdf")
    assert _kinds(imported) == {"palm": "free", "a": "hinge", "b": "hinge"}
    hinge = imported.description.segments["b"].joint
    assert hinge.coupled is None
    assert hinge.limits_deg == pytest.approx((-np.degrees(1.0), 0.0))


@pytest.mark.parametrize("kind", ["floating", "fixed"])
def test_a_body_below_an_empty_frame_is_the_free_root_upright(tmp_path: Path, kind: str) -> None:
    world = f"""<link name="world"/><joint name="float" type="{kind}"><parent link="world"/>
      <child link="base"/><origin xyz="0 0 1" rpy="0.3 0 0"/></joint></robot>"""
    plain = _read(tmp_path, ARM)
    with pytest.warns(RegkitWarning, match="world -> base"):
        imported = _read(tmp_path, ARM.replace("</robot>", world))
    assert _kinds(imported) == _kinds(plain)
    # The world's axes stay those in which the robot stands: x forward is the body's z.
    turn = Rotation.from_euler("z", 0.3).as_matrix()
    for name, one in plain.description.segments.items():
        other = imported.description.segments[name]
        np.testing.assert_allclose(other.offset, turn @ one.offset, atol=1e-12)


def test_joints_in_a_plane_or_without_any_are_named_in_one_sentence(tmp_path: Path) -> None:
    text = ARM.replace('"turn" type="revolute"', '"turn" type="planar"')
    text = text.replace('type="continuous"', 'type="floating"')
    with pytest.raises(RegkitError) as caught:
        _read(tmp_path, text)
    assert "floating: bend; planar: turn" in caught.value.message
    assert caught.value.place == f"{tmp_path / 'arm.urdf'}:5"


@pytest.mark.parametrize(
    ("old", "new", "note", "limits"),
    [
        ('<limit lower="-1" upper="1"/>', "", "need.*turn", None),
        ('lower="-1"', 'lower="3"', "turn: 3 > 1", None),
        ('lower="-1" upper="1"', 'effort="0" velocity="-2"', "cannot turn.*turn", (0.0, 0.0)),
        ('lower="-1" upper="1"', 'lower="-inf" upper="1e16"', None, None),
        ('lower="-1"', 'lower="-1" effort="0" velocity="-3"', None, (-1.0, 1.0)),
        ('lower="-1"', 'lower="-0,5"', None, (-0.5, 1.0)),
    ],
)
def test_limits_that_say_nothing_are_none(
    tmp_path: Path, old: str, new: str, note: str | None, limits: tuple[float, float] | None
) -> None:
    if note is None:
        imported = _read(tmp_path, ARM.replace(old, new))
    else:
        with pytest.warns(RegkitWarning, match=note):
            imported = _read(tmp_path, ARM.replace(old, new))
    found = imported.description.segments["upper"].joint.limits_deg
    assert found == (None if limits is None else pytest.approx(np.degrees(limits)))


@pytest.mark.parametrize(
    ("mimic", "note"),
    [
        ('<mimic joint="none"/>', "bend follows 'none', which is no joint"),
        ('<mimic joint="" multiplier="0"/>', None),
        ('<mimic joint="turn" multiplier="1e-9"/>', "bend: 1e-09"),
    ],
)
def test_a_joint_that_follows_nothing_turns_by_itself(
    tmp_path: Path, mimic: str, note: str | None
) -> None:
    text = ARM.replace('<origin xyz="0 0 0.3"/>', f'<origin xyz="0 0 0.3"/>{mimic}')
    if note is None:
        imported = _read(tmp_path, text)
    else:
        with pytest.warns(RegkitWarning, match=note):
            imported = _read(tmp_path, text)
    assert imported.description.segments["lower"].joint.coupled is None


@pytest.mark.parametrize(
    "text",
    [
        b"\0\n".join([ARM.encode(), b"\0"]),
        b"\n\n<?xml version='1.0' encoding='utf-8'?>\n" + ARM.encode(),
        b"\xef\xbb\xbf<?xml version='1.0'?>" + ARM.encode(),
        b"<!-- made by xacro --><?xml version='1.0' encoding='no-such'?>" + ARM.encode(),
        ARM.encode("utf-16"),
        ARM.replace("0 0 0.4", "0,0,\t0.4").encode(),
        ARM.replace("0 0 0.4", "0 0, 0,4").encode(),
        ARM.replace("<robot ", "<robot xmlns:xacro='x' xmlns='y' ").encode(),
        ARM.replace("<link", "<transmission/><gazebo><link/></gazebo><link", 1).encode(),
        ARM.replace('name="base"', 'name="base" type="x"').encode(),
    ],
)
def test_what_stands_around_a_robot_does_not_change_it(tmp_path: Path, text: bytes) -> None:
    expected = _read(tmp_path, ARM).description
    assert _read(tmp_path, text).description == expected


@pytest.mark.parametrize(
    ("text", "note"),
    [
        (ARM.encode() + b"end", "passed over"),
        (ARM.replace("</robot>", '<link name="stray"/></robot>').encode(), "stray"),
        (ARM.replace("0 0 0.4", "0 0 0.4 1").encode(), "4 numbers; the first 3"),
        (ARM.replace("<robot", "<!-- \xe9 --><robot").encode("latin-1"), "Latin-1"),
    ],
)
def test_what_is_left_out_is_told(tmp_path: Path, text: bytes, note: str) -> None:
    expected = _read(tmp_path, ARM).description
    with pytest.warns(RegkitWarning, match=note):
        assert _read(tmp_path, text).description == expected


def test_a_declared_encoding_is_obeyed(tmp_path: Path) -> None:
    for encoding, name in (("shift-jis", "腕"), ("windows-1252", "Möbel")):
        text = f"<?xml version='1.0' encoding='{encoding}'?>" + ARM.replace("lower", name, 1)
        text = text.replace('child link="lower"', f'child link="{name}"').replace("low_", "")
        assert name in _read(tmp_path, text.encode(encoding)).description.segments


def test_a_root_that_only_joints_name_is_an_empty_one(tmp_path: Path) -> None:
    mount = """<joint name="mount" type="revolute"><parent link="table"/><child link="base"/>
      <limit lower="0" upper="1"/></joint></robot>"""
    with pytest.warns(RegkitWarning, match="table"):
        imported = _read(tmp_path, ARM.replace("</robot>", mount))
    assert list(_kinds(imported)) == ["table", "base", "upper", "lower"]


LAUGHS = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 10))


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        (f'<!DOCTYPE r [<!ENTITY a0 "ha">{LAUGHS}]><robot>&a9;</robot>', 1, "entity 'a0'"),
        (ARM.replace("0 0 0.4", "${height} 0 0"), 6, "xacro FILE > robot.urdf"),
        (ARM.replace("<link", "<xacro:macro name='a'/><link", 1), 2, "xacro FILE > robot.urdf"),
        (ARM.replace("0 0 2", "0 0 0"), 6, "axis of joint 'turn' is zero"),
        ("<robot/>", 1, "no <link>"),
        (ARM.replace('child link="upper"', 'child link="uper"'), 5, "did you mean 'upper'"),
        (ARM.replace('<link name="lower"/>', '<link name="upper"/>'), 4, "second link"),
        (ARM.replace('parent link="base"', 'parent link="lower"'), 1, "cycle|no parent"),
    ],
)
def test_what_remains_refused_says_why(tmp_path: Path, text: str, line: int, words: str) -> None:
    import re

    with pytest.raises(RegkitError) as caught:
        _read(tmp_path, text)
    assert re.search(words, caught.value.message)
    assert caught.value.place == f"{tmp_path / 'arm.urdf'}:{line}"


def test_a_xacro_file_is_refused_with_the_command_that_expands_it(tmp_path: Path) -> None:
    with pytest.raises(RegkitError, match="xacro FILE"):
        read_skeleton(tmp_path / "arm.urdf.xacro")


def _tube(radius: float, length: float, count: int = 48) -> np.ndarray:
    """The triangles of an open tube along x whose middle is at (1, 0, 0)."""
    angles = 2.0 * np.pi * np.arange(count) / count
    ring = np.stack([0.0 * angles, radius * np.cos(angles), radius * np.sin(angles)], axis=1)
    low, high = (ring + np.array([1.0 + end * length, 0.0, 0.0]) for end in (-0.5, 0.5))
    there = np.roll(np.arange(count), -1)
    return np.concatenate(
        [np.stack([low, low[there], high], 1), np.stack([low[there], high[there], high], 1)]
    )


def _stl(triangles: np.ndarray) -> bytes:
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *triangle.ravel(), 0) for triangle in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + rows


def _obj(triangles: np.ndarray) -> bytes:
    corners = "".join(f"v {x} {y} {z}\n" for x, y, z in triangles.reshape(-1, 3))
    faces = "".join(f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}\n" for k in range(len(triangles)))
    return (corners + faces).encode()


def test_a_mesh_becomes_a_capsule_of_its_length_and_width() -> None:
    start, end, radius = mesh_capsule(_tube(0.1, 0.6))
    assert radius == pytest.approx(0.1, rel=0.01)
    ends = sorted([start.tolist(), end.tolist()])
    np.testing.assert_allclose(ends, [[0.8, 0, 0], [1.2, 0, 0]], atol=2e-3)
    start, end, _ = mesh_capsule(_tube(0.1, 0.05))
    np.testing.assert_array_equal(start, end)


@pytest.mark.parametrize(
    ("address", "file", "packages"),
    [
        ("meshes/tube.stl", "meshes/tube.stl", ()),
        ("meshes/tube.stl", "../meshes/tube.stl", ()),
        ("package://arm_description/tube.obj", "../../arm_description/tube.obj", ()),
        ("package://other/tube.stl", "../../packages/other/tube.stl", ("packages",)),
        ("package://other/tube.stl", "../../elsewhere/tube.stl", ("elsewhere",)),
        ("model://other/a%20tube.stl", "../../packages/other/a tube.stl", ("packages",)),
        ("file://FOLDER/tube.stl", "../../tube.stl", ()),
    ],
)
def test_meshes_are_found_by_their_addresses(
    tmp_path: Path, address: str, file: str, packages: tuple[str, ...]
) -> None:
    folder = tmp_path / "arm_description" / "urdf"
    folder.mkdir(parents=True)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "package.xml").write_text("<package><name>other</name></package>")
    mesh = (folder / file).resolve()
    mesh.parent.mkdir(parents=True, exist_ok=True)
    # In millimetres, mirrored in x.
    mesh.write_bytes((_obj if file.endswith("obj") else _stl)(1000.0 * _tube(0.1, 0.6)))
    filename = address.replace("FOLDER", str(tmp_path))
    shape = f'<mesh filename="{filename}" scale="-0.001 0.001 0.001"/>'
    text = ARM.replace('<sphere radius="0.1"/>', shape)
    imported = _read(folder, text, [tmp_path / name for name in packages])
    (capsule,) = imported.description.segments["upper"].capsules
    assert capsule.radius == pytest.approx(0.1, rel=0.01)
    # The file's x is the body's z.
    ends = sorted([capsule.start[2], capsule.end[2]])
    np.testing.assert_allclose(ends, [-1.2, -0.8], atol=2e-3)


@pytest.mark.parametrize(
    ("content", "note"), [(None, "missing.*tube.stl"), (b"solid x", "cannot be read.*tube.stl")]
)
def test_a_mesh_that_cannot_be_had_is_told_and_a_shape_is_made(
    tmp_path: Path, content: bytes | None, note: str
) -> None:
    if content is not None:
        (tmp_path / "tube.stl").write_bytes(content)
    text = ARM.replace('<sphere radius="0.1"/>', '<mesh filename="tube.stl"/>')
    with pytest.warns(RegkitWarning, match=note):
        imported = _read(tmp_path, text)
    (capsule,) = imported.description.segments["upper"].capsules
    assert imported.shaped == 1
    assert capsule.end == imported.description.segments["lower"].offset


def test_visual_shapes_stand_in_for_collision_shapes_without_extent(tmp_path: Path) -> None:
    shapes = """<collision><geometry><cylinder radius="0" length="0"/></geometry></collision>
      <visual><geometry><sphere radius="0.07"/></geometry></visual>"""
    old = '<collision><geometry><sphere radius="0.1"/></geometry></collision>'
    with pytest.warns(RegkitWarning, match="without extent"):
        imported = _read(tmp_path, ARM.replace(old, shapes))
    (capsule,) = imported.description.segments["upper"].capsules
    assert capsule.radius == pytest.approx(0.07)


def test_the_links_of_a_file_are_read_in_time(tmp_path: Path) -> None:
    links = "".join(f'<link name="a{k}"/>' for k in range(300))
    joints = "".join(
        f'<joint name="j{k}" type="continuous"><parent link="a{k}"/><child link="a{k + 1}"/>'
        '<origin xyz="0 0 1"/></joint>'
        for k in range(299)
    )
    (tmp_path / "arm.urdf").write_text(f"<robot>{links}{joints}</robot>")
    assert len(Urdf.read(tmp_path / "arm.urdf").links) == 300


def test_link_without_a_name_is_refused_with_its_line(tmp_path: Path) -> None:
    with pytest.raises(RegkitError, match=r"arm.urdf:4: .*empty"):
        _read(tmp_path, ARM.replace('"lower"', '""'))


def test_a_prismatic_joint_without_limits_is_told(tmp_path: Path) -> None:
    """A sliding part without ends has no range to search."""
    text = ARM.replace('type="revolute"', 'type="prismatic"', 1)
    with pytest.raises(RegkitError, match=r"arm\.urdf:\d+: .*'turn' has no <limit>"):
        _read(tmp_path, text.replace('<limit lower="-1" upper="1"/>', "", 1))


def test_limits_that_may_be_degrees_are_told(tmp_path: Path) -> None:
    with pytest.warns(RegkitWarning, match="turn.*-90 to 90 rad"):
        _read(tmp_path, ARM.replace('lower="-1" upper="1"', 'lower="-90" upper="90"'))
