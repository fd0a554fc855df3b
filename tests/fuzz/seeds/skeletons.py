"""Skeletons of other programs: BVH and URDF."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from regkit.interchange.imported import ImportedSkeleton
from regkit.interchange.skeletons import read_skeleton
from tests.fuzz import oracles
from tests.fuzz.kind import Damaged, Files, Kind

BVH = """\
HIERARCHY
ROOT hips
{
  OFFSET 0 0.9 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
  JOINT spine
  {
    OFFSET 0 0.4 0.1
    CHANNELS 3 Zrotation Xrotation Yrotation
    JOINT head
    {
      OFFSET 0 0.3 0
      CHANNELS 1 Yrotation
      End Site
      {
        OFFSET 0 0.2 0
      }
    }
  }
  JOINT leg
  {
    OFFSET 0.1 0 0
    CHANNELS 3 Yrotation Xrotation Zrotation
    End Site
    {
      OFFSET 0 -0.6 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.0333333
0 0.9 0 10 20 30 40 50 60 2 70 -80 15
0 0.9 0.1 10 20 30 40 50 60 2 70 -80 15
0 0.9 0.2 11 21 31 41 51 61 3 71 -81 16
"""

URDF = """\
<?xml version="1.0" encoding="utf-8"?>
<robot name="arm">
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base"><visual>
    <geometry><cylinder radius="0.05" length="0.1"/></geometry></visual></link>
  <link name="upper"><visual><origin xyz="0 0 0.15" rpy="0 0 0"/>
    <geometry><box size="0.06 0.06 0.3"/></geometry></visual></link>
  <link name="fore"><collision><geometry><sphere radius="0.04"/></geometry></collision></link>
  <link name="finger"/>
  <link name="thumb"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.1" rpy="0 0 0.2"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" effort="10" velocity="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/>
    <origin xyz="0 0 0.3"/><axis xyz="1 0 0"/></joint>
  <joint name="grip" type="revolute"><parent link="fore"/><child link="finger"/>
    <origin xyz="0 0.02 0.1"/><axis xyz="1 0 0"/><limit lower="0" upper="1"/></joint>
  <joint name="hold" type="revolute"><parent link="fore"/><child link="thumb"/>
    <origin xyz="0 -0.02 0.1"/><axis xyz="1 0 0"/><limit lower="-1" upper="0"/>
    <mimic joint="grip" multiplier="-1" offset="0"/></joint>
</robot>
"""


def _seeds(file: str, text: str) -> list[Files]:
    return [{file: text.encode()}]


def _read(path: Path) -> ImportedSkeleton:
    return read_skeleton(path)


def nonsense(value: ImportedSkeleton, file: Damaged) -> Iterator[str]:
    """What is imported is a template, as good as one that is written by hand."""
    size = value.description.size
    low, high = size.range
    if not 0.0 < low <= size.value <= high:
        yield f"size: {size.value} of {size.range}"
    yield from oracles.body(value.description.body("imported", size.value))


def bvh_nonsense(value: ImportedSkeleton, file: Damaged) -> Iterator[str]:
    yield from nonsense(value, file)
    words = oracles.decoded(file.content).replace("\0", "").split("MOTION")[0].split()
    joints = words.count("JOINT") + words.count("ROOT")
    if not file.noted and len(value.description.segments) != joints:
        yield f"segments: {len(value.description.segments)} of {joints} joints"


SKELETONS = (
    Kind(
        "skeletons/bvh",
        lambda: _seeds("skeleton.bvh", BVH),
        {"skeleton.bvh": "text"},
        _read,
        bvh_nonsense,
        suffixes=(".urdf", ".BVH", ".glb"),
        weight=4.0,
    ),
    Kind(
        "skeletons/urdf",
        lambda: _seeds("robot.urdf", URDF),
        {"robot.urdf": "text"},
        _read,
        nonsense,
        suffixes=(".bvh", ".xml"),
        weight=5.0,
    ),
)
