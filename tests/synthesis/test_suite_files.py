"""The command that makes the evaluation suite writes what can be read."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest

from regkit_plugins.datasets.depth import DepthFolders
from regkit_plugins.templates.reading import FOLDER, description_in
from regkit_synthesis.__main__ import main
from regkit_synthesis.recordings import suite
from regkit_synthesis.recordings.scene import FPS, SR305
from regkit_synthesis.recordings.suite import SUITE, rendered
from regkit_synthesis.templates.templates import FittedTemplate


class _Fixed:
    """A take whose scene is given."""

    def __init__(self, scene):
        self._scene = scene

    def scene(self, name, body, mesh):
        return self._scene


def _untouched(mesh):
    """A template that nothing was fitted for."""
    human = description_in(FOLDER / "human.yaml")
    return FittedTemplate(human, mesh, lambda description: "title: none\n")


def _few(name, take):
    """The first and the last image of a recording, as a scene."""
    body = SUITE[name]
    scene = body.takes[take].scene(take, body.what, body.mesh())
    last = (scene.frames - 1) / FPS
    return replace(
        scene, frames=2, bone_poses=lambda time: scene.bone_poses(last if time > 0.0 else 0.0)
    )


def test_rendering_depends_on_the_seed_in_noise_only(monkeypatch):
    body = SUITE["hand_slim"]
    scene = _few("hand_slim", "fists")
    monkeypatch.setattr(
        suite, "SUITE", {"hand_slim": replace(body, takes={"fists": _Fixed(scene)})}
    )
    first, again, other = (rendered("hand_slim", "fists", seed) for seed in (0, 0, 1))
    assert np.array_equal(first.depth, again.depth)
    assert np.array_equal(first.truth, other.truth)
    assert np.array_equal(first.depth > 0, other.depth > 0)
    seen = first.depth > 0
    difference = (other.depth.astype(float) - first.depth)[seen] / SR305.depth_scale
    assert difference.std() == pytest.approx(np.sqrt(2.0) * SR305.noise, rel=0.03)


def test_command_writes_templates_and_recordings_that_can_be_read(tmp_path, monkeypatch, capsys):
    scenes = {
        "human_small": _few("human_small", "jump"),
        "hand_slim": _few("hand_slim", "signs"),
    }
    small = {
        name: replace(SUITE[name], template=_untouched, takes={"some": _Fixed(scene)})
        for name, scene in scenes.items()
    }
    for module in ("recordings.suite", "__main__"):
        monkeypatch.setattr(f"regkit_synthesis.{module}.SUITE", small)
    monkeypatch.setattr(sys, "argv", ["synthesis", str(tmp_path), "--suite"])
    assert main() == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(
        [*small, *(name + end for name in small for end in (".yaml", "_mesh.npz"))]
    )
    assert "hand_slim.yaml" in capsys.readouterr().out
    for name, scene in scenes.items():
        (recording,) = DepthFolders(root=tmp_path / name).found()
        assert recording.length == 2
        truth = recording.truth()
        assert truth is not None
        assert np.allclose(truth.positions, scene.truth(), atol=1e-6)
        for frame in recording.frames():
            assert len(frame.points) > 1000


def test_command_answers_a_place_that_is_a_file(tmp_path, monkeypatch, capsys):
    (tmp_path / "out").write_text("")
    monkeypatch.setattr(sys, "argv", ["synthesis", str(tmp_path / "out"), "--suite"])
    assert main() == 1
    assert "error: " in capsys.readouterr().err
