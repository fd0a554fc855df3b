"""``regkit doctor --warm`` compiles what later commands need, or says why it cannot."""

import importlib
import os
import subprocess
import sys
from pathlib import Path

import regkit as api

DATA = Path(__file__).parents[2] / "docs" / "examples" / "data"


def test_nothing_is_compiled_after_warming(regkit):
    ended = regkit("doctor", "--warm")
    assert ended.code == 0, ended.err
    assert ended.err == ""
    folder = Path(ended.out.strip().rpartition(" kept in ")[2])
    assert any(folder.rglob("*.nbi"))
    event = importlib.import_module("numba.core.event")
    with event.install_recorder("numba:compile") as compiled:
        walk = api.load_recording(DATA / "human_walk", frames=2)
        for method in ("best", "spheres"):
            api.track(walk, api.load_template("human", height=1.63), method)
    assert not compiled.buffer


def test_cache_folder_that_cannot_be_written_is_told(regkit, monkeypatch, tmp_path):
    file = tmp_path / "file"
    file.touch()
    monkeypatch.setenv("REGKIT_CACHE", str(file / "cache"))
    ended = regkit("doctor", "--warm")
    assert ended.code == 1
    assert ended.err.startswith(f"error: {file / 'cache'}: the cache folder cannot be written")
    assert "REGKIT_CACHE" in ended.err


def test_loops_that_cannot_be_kept_are_told():
    # Numba tries the folders of these locators; the one here wants a variable that is not set.
    only = "numba.core.caching._UserProvidedCacheLocator"
    names = {**os.environ, "NUMBA_CACHE_LOCATOR_CLASSES": only}
    names.pop("NUMBA_CACHE_DIR", None)
    command = [sys.executable, "-m", "regkit", "doctor", "--warm"]
    ended = subprocess.run(command, env=names, capture_output=True, text=True, check=False)
    assert ended.returncode == 1
    assert ended.stderr.startswith("error: compiled loops cannot be kept")
    assert "NUMBA_CACHE_DIR" in ended.stderr
