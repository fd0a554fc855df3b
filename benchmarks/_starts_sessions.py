"""Recordings of the dataset `synthetic` as a user tracks them: with the default segmentation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from regkit.config.document import Document
from regkit.experiment import Experiment


def experiment(
    kind: str, template: Mapping[str, Any], takes: Mapping[str, Any], **defaults: Any
) -> Experiment:
    """Returns an experiment on synthetic takes before a Kinect, with the method `best`.

    Args:
        kind: Name of the search for the start.
        template: The template.
        takes: The takes by name.
        defaults: Fields that all takes share.
    """
    data = {
        "name": "starts",
        "dataset": {
            "kind": "synthetic",
            "camera": "kinect_v1_320x240",
            "defaults": defaults,
            "takes": dict(takes),
        },
        "template": dict(template),
        "preprocessor": {"kind": "points", "voxel": 0.03, "sigma": 0.01},
        "start": {"kind": kind},
        "methods": {"best": {"preset": "best"}},
    }
    return Document(data, {(): "benchmark"}).validated(Experiment)
