"""YAML of every kind: experiments, templates, skeletons, presets, maps, motions, settings."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel

import regkit_plugins
import regkit_synthesis
from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.config.yaml import yaml_value
from regkit.experiment import Study
from regkit.fitting.bones import read_bone_map
from regkit.interfaces import Dataset, Method
from regkit.scaffold.scaffold import KINDS, Scaffold
from regkit.skeleton import SkeletonDescription
from regkit.skeleton.compile import compiled
from regkit.testing.samples import LINKAGE
from regkit_synthesis.bodies.body_map import body_map
from regkit_synthesis.figure.joint_map import JointMap
from regkit_synthesis.figure.map_files import FOLDER as MAPS
from regkit_synthesis.figure.map_files import read_map
from regkit_synthesis.hands.config import GesturesConfig
from regkit_synthesis.motion.config import KeyframesConfig
from tests.fuzz import oracles
from tests.fuzz.kind import Damaged, Files, Kind
from tests.fuzz.seeds.motions import motion_nonsense

ROOT = Path(__file__).parents[3]
PLUGINS = Path(regkit_plugins.__file__).parent
ASSETS = Path(regkit_synthesis.__file__).parent / "assets"
FILE = "input.yaml"
INSTALLED = {
    "shape": "gsog",
    "kernel": "correlation",
    "solver": "lbfgs",
    "dataset": "depth",
    "template": "human",
}
DEEPEST = 2_000_000
"""Characters of a configuration; more has grown out of aliases."""


def _files(*folders: tuple[Path, str]) -> list[Files]:
    paths = [path for folder, pattern in folders for path in sorted(folder.glob(pattern))]
    return [{FILE: path.read_bytes()} for path in paths]


def _experiments() -> list[Files]:
    found = _files((ROOT / "docs" / "examples", "*.yaml"))
    with tempfile.TemporaryDirectory() as folder:
        for kind in KINDS:
            Scaffold.checked(kind, f"fuzzed_{kind}").write(Path(folder))
        examples = _files((Path(folder), "*/example*.yaml"))
    # Their plug-ins are not installed; those that are take their places.
    for example in examples:
        text = example[FILE].decode()
        for kind, name in INSTALLED.items():
            text = text.replace(f"fuzzed_{kind}", name)
        found.append({FILE: text.encode()})
    return found


def _templates() -> list[Files]:
    """Mostly the small one: the shipped ones are ten times as long."""
    small = LINKAGE.read_text()
    stances = "stances: {bent: {joints: {forearm: 60, arm: [10, 0, 20]}}}\n"
    shapes = "shapes: {gsog: {base: [{centre: [0, 0.1, 0], sigma: [0.1, 0.2, 0.1]}]}}\n"
    large = _files((PLUGINS / "templates", "hand_left.yaml"), (PLUGINS / "templates", "human.yaml"))
    bare = [one[FILE].partition(b"\nmesh:")[0] + b"\n" for one in large]
    texts = (small, small + stances, small + shapes, small + stances + shapes)
    return [{FILE: content} for content in (*(text.encode() for text in texts * 3), *bare)]


def _skeletons() -> list[Files]:
    lines = LINKAGE.read_text().splitlines(keepends=True)
    kept = [line for line in lines if not line.startswith(("title", "size"))]
    return [{FILE: "".join(kept).encode()}]


def _settings() -> list[Files]:
    texts = (
        "{kind: direct, shape: gsog, kernel: correlation, solver: {kind: lbfgs, memory: 5}}",
        "{preset: best}",
        "{kind: open3d_icp, estimation: generalized}",
    )
    return [{FILE: text.encode()} for text in texts]


def _study(path: Path) -> Study:
    study = Study.read(path)
    study.config()
    return study


def _template(path: Path) -> list[Any]:
    description = Document.read(path).validated(BodyDescription)
    size = description.size
    return [description, *(description.body("fuzzed", at) for at in (size.value, *size.range))]


def _setting(path: Path) -> Any:
    return Method.parse(
        yaml_value(path.read_text(errors="replace")), place="--method", field="method"
    )


def _plain(value: Any, what: str) -> Iterator[str]:
    """Complaints about a configuration, wherever they are in it."""
    waiting, length = [(what, value)], 0
    while waiting:
        place, node = waiting.pop()
        if isinstance(node, BaseModel):
            node = dict(node)
        if isinstance(node, dict):
            waiting.extend((f"{place}.{key}"[-60:], inner) for key, inner in node.items())
        elif isinstance(node, (list, tuple)):
            waiting.extend((place, inner) for inner in node)
        elif isinstance(node, float) and not np.isfinite(node):
            # Some fields declare infinity as their default: no limit.
            if np.isnan(node):
                yield f"{place}: NaN"
        elif isinstance(node, (int, float)) and not isinstance(node, bool) and abs(node) > 1e15:
            yield f"{place}: {float(node):.3g}" if abs(node) < 1e300 else f"{place}: beyond 1e300"
        length += 1
        if length > DEEPEST:
            yield f"{what}: more than {DEEPEST} values"
            return


def _study_nonsense(study: Study, file: Damaged) -> Iterator[str]:
    yield from oracles.name(study.name, "experiment")
    for method in study.methods:
        yield from oracles.name(method, "method")
        if "/" in method or method.startswith(".") or method in ("", ".."):
            yield f"method: the name {method!r} is no folder's"
    yield from _plain(study.config(), "config")


def _template_nonsense(value: list[Any], file: Damaged) -> Iterator[str]:
    description, *bodies = value
    low, high = description.size.range
    if not low <= description.size.value <= high:
        yield f"size: {description.size.value} of {description.size.range}"
    for body in bodies:
        yield from oracles.body(body)


def _model_nonsense(value: Any, file: Damaged) -> Iterator[str]:
    yield from _plain(value, type(value).__name__)


def _kind(
    name: str,
    seeds: Callable[[], list[Files]],
    read: Callable[[Path], Any],
    check: oracles.Oracle,
    weight: float = 1.0,
) -> Kind:
    return Kind(f"yaml/{name}", seeds, {FILE: "yaml"}, read, check, weight=weight)


def _preset(group: type[Dataset] | type[Method], field: str) -> Callable[[Path], Any]:
    return lambda path: group.parse({"preset": str(path)}, place="fuzz", field=field)


METHODS = tuple(
    (PLUGINS / "presets", f"{n}.yaml") for n in ("best", "icp", "paper", "rigid", "spheres")
)
DATASETS = tuple((PLUGINS / "presets", f"{n}.yaml") for n in ("hands", "people", "smmc_like"))

CONFIGS = (
    _kind("experiment", _experiments, _study, _study_nonsense, 4.0),
    _kind("template", _templates, _template, _template_nonsense, 4.0),
    _kind(
        "skeleton",
        _skeletons,
        lambda path: compiled(Document.read(path).validated(SkeletonDescription), 1.0),
        lambda value, file: oracles.every_number(value, "skeleton"),
    ),
    _kind("method-preset", lambda: _files(*METHODS), _preset(Method, "method"), _model_nonsense),
    _kind(
        "dataset-preset", lambda: _files(*DATASETS), _preset(Dataset, "dataset"), _model_nonsense
    ),
    _kind(
        "keyframes",
        lambda: _files((ASSETS / "keyframes", "*.yaml")),
        lambda path: KeyframesConfig(path=path).motion(),
        motion_nonsense,
    ),
    _kind(
        "gestures",
        lambda: _files((ASSETS / "gestures", "*.yaml")),
        lambda path: GesturesConfig(path=path).motion(),
        lambda value, file: oracles.every_number(value, "gestures"),
    ),
    _kind(
        "joint-map",
        lambda: _files((MAPS / "sources", "*.yaml")),
        lambda path: read_map(JointMap, "sources", str(path)),
        _model_nonsense,
    ),
    _kind(
        "body-map",
        lambda: _files((MAPS / "bodies", "*.yaml")),
        lambda path: body_map(str(path)),
        _model_nonsense,
    ),
    _kind(
        "bone-map",
        lambda: _files((ROOT / "docs" / "examples" / "maps", "*.yaml")),
        read_bone_map,
        _model_nonsense,
    ),
    _kind("setting", _settings, _setting, _model_nonsense),
)
