"""All kinds of inputs, and all kinds of YAML."""

from __future__ import annotations

from functools import cache

from tests.fuzz.kind import Files, Kind
from tests.fuzz.seeds.body_models import BODY_MODELS
from tests.fuzz.seeds.cloud_files import CLOUDS
from tests.fuzz.seeds.configs import CONFIGS
from tests.fuzz.seeds.keypoint_files import KEYPOINTS
from tests.fuzz.seeds.meshes import MESHES
from tests.fuzz.seeds.motions import MOTIONS
from tests.fuzz.seeds.others import OTHERS
from tests.fuzz.seeds.recordings import RECORDINGS
from tests.fuzz.seeds.results import RESULTS
from tests.fuzz.seeds.skeletons import SKELETONS
from tests.fuzz.seeds.streams import STREAMS

GROUPS: dict[str, tuple[Kind, ...]] = {
    "inputs": (
        *CLOUDS,
        *RECORDINGS,
        *KEYPOINTS,
        *OTHERS,
        *MESHES,
        *SKELETONS,
        *BODY_MODELS,
        *MOTIONS,
        *RESULTS,
        *STREAMS,
    ),
    "yaml": CONFIGS,
}
"""The kinds of the two groups of cases."""


@cache
def seeds_of(group: str, name: str) -> list[Files]:
    """The sound files of a kind, made once per process."""
    (kind,) = (kind for kind in GROUPS[group] if kind.name == name)
    return kind.seeds()
