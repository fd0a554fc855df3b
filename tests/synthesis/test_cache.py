"""The cache of rendered recordings: kept by content, whole or not at all, made again if damaged."""

from __future__ import annotations

import os
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.system.cache import cache_folder
from regkit.system.errors import DataError
from regkit_plugins.datasets.depth import DepthFolders
from regkit_synthesis.recordings import digest as digest_module
from regkit_synthesis.recordings.cache import RecordingCache
from regkit_synthesis.recordings.digest import digest
from regkit_synthesis.recordings.recording import DepthRecording
from regkit_synthesis.recordings.scene import SR4000
from regkit_synthesis.recordings.take import Take

KEY = "0123"


def recording(units=1000):
    return DepthRecording(
        name="tiny",
        fps=30.0,
        depth_scale=1000.0,
        source="",
        licence="",
        camera=Camera(width=20, height=16, fx=20.0, fy=20.0, cx=9.5, cy=7.5),
        depth=np.full((2, 16, 20), units, dtype=np.uint16),
        joints=("a",),
        truth=np.ones((2, 1, 3)),
    )


class Counted:
    """Makes a recording, and knows how often."""

    def __init__(self):
        self.times = 0

    def __call__(self):
        self.times += 1
        return recording()


@pytest.fixture
def cache(tmp_path):
    return RecordingCache(tmp_path / "cache")


def test_entry_is_made_once_and_is_a_depth_folder(cache):
    make = Counted()
    folders = {cache.entry(KEY, make) for _ in range(3)}
    assert make.times == 1
    (recorded,) = DepthFolders(root=folders.pop()).found()
    assert [frame.depth.max() for frame in recorded.frames()] == [1.0, 1.0]
    assert recorded.truth().joints == ("a",)
    assert [path.name for path in cache.folder.iterdir()] == [KEY]


@pytest.mark.parametrize(
    "damage",
    [
        lambda entry: (entry / "depth" / "000001.png").unlink(),
        lambda entry: (entry / "depth" / "000000.png").write_bytes(b"cut"),
        lambda entry: (entry / "truth.csv").write_text("frame,joint,x,y,z\n"),
        lambda entry: (entry / "checksums.json").write_text("{"),
        lambda entry: (entry / "checksums.json").unlink(),
        lambda entry: (entry / "depth" / "000002.png").write_bytes(b"more"),
    ],
)
def test_damaged_entry_is_made_again(cache, damage):
    make = Counted()
    entry = cache.entry(KEY, make)
    before = {path.name: path.read_bytes() for path in entry.rglob("*.*")}
    damage(entry)
    cache.entry(KEY, make)
    assert make.times == 2
    assert {path.name: path.read_bytes() for path in entry.rglob("*.*")} == before
    assert [path.name for path in cache.folder.iterdir()] == [KEY]


def test_failed_making_leaves_nothing(cache):
    def fail():
        raise DataError("no")

    with pytest.raises(DataError, match="no"):
        cache.entry(KEY, fail)
    assert not cache.folder.exists()


def test_what_a_killed_writer_left_is_removed_by_a_later_one_but_no_living_writers(cache):
    hours = {".new-killed": 25.0, ".new-living": 1.0, "entry": 25.0}
    for name, age in hours.items():
        (cache.folder / name / KEY / "depth").mkdir(parents=True)
        then = time.time() - 3600.0 * age
        os.utime(cache.folder / name, (then, then))
    cache.entry(KEY, recording)
    assert {path.name for path in cache.folder.iterdir()} == {KEY, ".new-living", "entry"}


def test_many_who_want_the_same_entry_find_it_whole(cache):
    def want(_):
        (recorded,) = DepthFolders(root=cache.entry(KEY, recording)).found()
        return [frame.depth.sum() for frame in recorded.frames()]

    with ThreadPoolExecutor(8) as pool:
        sums = list(pool.map(want, range(32)))
    assert sums == [[320.0, 320.0]] * 32
    assert [path.name for path in cache.folder.iterdir()] == [KEY]


def test_cache_that_cannot_be_written_is_told_with_the_variable(tmp_path):
    (tmp_path / "cache").write_text("")
    with pytest.raises(DataError, match="REGKIT_CACHE can name another folder"):
        RecordingCache(tmp_path / "cache").entry(KEY, recording)


def test_folder_is_named_by_the_environment_or_is_the_users(monkeypatch, tmp_path):
    monkeypatch.setenv("REGKIT_CACHE", str(tmp_path))
    assert cache_folder() == tmp_path
    monkeypatch.delenv("REGKIT_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert cache_folder().name == "regkit"
    assert cache_folder() != Path("regkit")


def _scene(sensor=SR4000, **fields):
    take = Take(motion={"kind": "clip", "name": "walk", **fields.pop("motion", {})}, **fields)
    return take.scene("walk", sensor, 30.0, 2)


def test_digest_is_the_same_for_the_same_and_differs_for_anything_that_is_seen(monkeypatch):
    scene = _scene()
    first = digest(scene, 0)
    assert digest(_scene(), 0) == first
    others = [
        digest(scene, 1),
        digest(replace(scene, name="other"), 0),
        digest(replace(scene, fps=25.0), 0),
        digest(replace(scene, frames=1), 0),
        digest(_scene(body="small"), 0),
        digest(_scene(motion={"speed": 1.1}), 0),
        digest(_scene(view={"heading_deg": 1.0}), 0),
        digest(_scene(markers={"nose": 3}), 0),
        digest(_scene(replace(SR4000, noise=0.009)), 0),
        digest(_scene(replace(SR4000, depth_scale=500.0)), 0),
    ]
    monkeypatch.setattr(digest_module, "RENDERER", digest_module.RENDERER + 1)
    others.append(digest(scene, 0))
    assert len({first, *others}) == len(others) + 1
