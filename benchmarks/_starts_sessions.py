"""Recordings as a user tracks them: with the default segmentation, and the method `best`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from regkit.config.document import Document
from regkit.experiment import Experiment
from regkit.interfaces import Start
from regkit.observation import Frame
from regkit.system.optional import one_thread
from regkit.tracking import TrackedFrame
from regkit.tracking.given_frames import GivenFrames


def experiment(kind: str, template: Mapping[str, Any], dataset: Mapping[str, Any]) -> Experiment:
    """Returns an experiment.

    Args:
        kind: Name of the search for the start.
        template: The template, in YAML's form.
        dataset: The dataset, in YAML's form.
    """
    data = {
        "name": "starts",
        "dataset": dict(dataset),
        "template": dict(template),
        "preprocessor": {"kind": "points", "voxel": 0.03, "sigma": 0.01},
        "start": {"kind": kind},
        "methods": {"best": {"preset": "best"}},
    }
    return Document(data, {(): "benchmark"}).validated(Experiment)


def synthetic(takes: Mapping[str, Any], **defaults: Any) -> dict[str, Any]:
    """Returns a dataset of synthetic takes before a Kinect, in YAML's form.

    Args:
        takes: The takes by name.
        defaults: Fields that all takes share.
    """
    camera = "kinect_v1_320x240"
    return {"kind": "synthetic", "camera": camera, "defaults": defaults, "takes": dict(takes)}


def single(chosen: Experiment, frames: Sequence[Frame]) -> tuple[Start, TrackedFrame]:
    """Returns the start in the first of some frames, and its registration.

    Raises:
        RegkitError: If no start is found.
    """
    recording = GivenFrames(name="frames", fps=1.0, length=len(frames), given=tuple(frames))
    session, method = chosen.session(recording), chosen.methods["best"]
    with one_thread():
        start = session.begin()
        tracker = method.tracker or chosen.tracker
        return start, next(session.tracked(method.bind(start.body), tracker, start.pose))
