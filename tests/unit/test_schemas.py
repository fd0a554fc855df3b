"""The JSON Schemas: that editors accept and refuse what regkit accepts and refuses."""

import copy
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from pydantic import BaseModel, TypeAdapter, ValidationError

import regkit.installed
from regkit.body import BodyDescription
from regkit.cli.schema import schemas
from regkit.document import Document
from regkit.experiment import Experiment
from regkit.interfaces import Method

ROOT = Path(__file__).parents[2]
EXPERIMENTS = sorted((ROOT / "docs" / "examples").glob("*.yaml"))
PLUGINS = ROOT / "plugins" / "regkit_plugins"
TEMPLATES = sorted((PLUGINS / "templates").glob("*.yaml"))
PRESETS = sorted((PLUGINS / "presets").glob("*.yaml"))

Location = tuple[str | int, ...]

MORE = {
    r"finite number": "JSON has neither infinity nor NaN, YAML has both",
    r"compares \w+, but shape|looks at \w+, but shape|has no width that": "two plug-ins must fit",
    r"does not keep the limits of ball joints": "the solver's class knows what it keeps",
    r"near \(.*\) must be less than far": "two fields are compared",
    r"is an orphan|several segments have no parent|form a cycle": "the segments must be a tree",
    r"has a free joint; only the root may|the root '.*' has no joint": "whose root moves",
    r"marker '.*' is on '.*' and on": "a marker's name is that of one segment",
    r"follows another itself|is no hinge|cannot follow itself|no angle of '": "a coupling's leader",
    r"is not a segment \(there are": "Gaussians are on segments",
    r"no joint '|'.*' is a .* joint|given pose|joint '.*' (has|needs|takes)": "a pose fits a skeleton",
    r"limits are reversed|a twist is between|a length must be positive": "two numbers in order",
    r"an axis must not be zero|must be at right angles|a ratio is at least": "geometry of a joint",
    r"is not taken by IPOPT|is the field .* here": "IPOPT itself knows its options",
    r"each of x, y and z must be named once": "three axes in one list",
    r"not a regular expression|it must have one group": "Python's regular expressions",
    r"there is no such file": "a file that is named must be there",
    r"a start needs the template's size|size": "a given start needs the template's size",
}
"""What pydantic refuses beyond the schema, by its message, and why JSON Schema cannot say it."""


@cache
def validator(name: str) -> Draft202012Validator:
    return Draft202012Validator(schemas()[name])


@cache
def data_of(path: Path) -> dict[str, Any]:
    data = Document.read(path).data
    return shortened(data) if "segments" in data else data


def shortened(template: dict[str, Any]) -> dict[str, Any]:
    """A template of the first segments alone, which is as good and quicker to check."""
    segments = dict(list(template["segments"].items())[:5])
    for segment in segments.values():
        segment["capsules"] = segment["capsules"][:2]
    gaussians = {
        kind: {name: rows[:2] for name, rows in by_segment.items() if name in segments}
        for kind, by_segment in template["gaussians"].items()
    }
    return {**template, "segments": segments, "gaussians": gaussians}


@pytest.fixture(scope="module", autouse=True)
def _quick_look_at_what_is_installed() -> Iterator[None]:
    """The distributions are read once, not for each name in each mutant."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(regkit.installed, "entry_points", cache(regkit.installed.entry_points))
        yield


def complaints(model: type[BaseModel], data: Any) -> list[str]:
    try:
        TypeAdapter(model).validate_python(data)
    except ValidationError as error:
        return [f"{'.'.join(map(str, e['loc']))}: {e['msg']}" for e in error.errors()]
    return []


def locations(value: Any, at: Location = ()) -> Iterator[Location]:
    inner = value.items() if isinstance(value, dict) else enumerate(value)
    for key, item in inner:
        yield (*at, key)
        if isinstance(item, (dict, list)):
            yield from locations(item, (*at, key))


def get(data: Any, at: Location) -> Any:
    for key in at:
        data = data[key]
    return data


VALUES = (
    None, True, False, "", "3", "text", "x", "-y", "--x", 0, 1, 3, -1, 3.0, 0.5, -0.5, 1e9, 361,
    float("inf"), [], {}, [1, 2], [2, 1], [0, 0, 0], [1, 2, 3], [1, "2", 3], ["a"], [[1, 2], [3, 4]], {"a": 1},
    {"kind": "unknown"}, {"kind": 3}, {"kind": None}, "direct", "gsog", "lbfgs", "best", "depth",
    {"kind": "gauss_newton"}, {"kind": "gsog", "surface": "visible"}, {"kind": "ipopt"},
    {"preset": "best"}, {"preset": "bst"}, {"preset": 3}, {"preset": "paper", "shape": "sog"},
    {"preset": "best", "solver": {"max_iterations": 3}}, {"preset": "best", "kind": "direct"},
    {"preset": "best", "kind": "coarse_to_fine"}, {"preset": "best", "terms": None},
    {"preset": "best", "solver": {"max_itrations": 3}}, {"preset": "best", "solver": "lbfgs"},
    {"preset": "best", "kernel": {"kind": "correlation"}}, {"preset": "best", "shape": {}},
    {"preset": "icp", "kernel": {"reach": "x"}}, {"preset": "icp", "kernel": {"reach": 3}},
    {"preset": "icp", "kernel": {"robust": {"loss": "huber"}}},
    {"preset": "icp", "kernel": {"robust": {"los": "huber"}}},
    {"type": "free"}, {"type": "ball"}, {"type": "hinge", "axis": "x"}, {"type": "bal"},
    {"type": "hinge", "axis": [1, 0]}, {"type": "universal", "axes": ["x", "-z"]},
)  # fmt: skip
"""What a value is changed to, among it what would be right elsewhere."""


@st.composite
def mutants(draw: Any, paths: list[Path]) -> tuple[Any, str]:
    """A file's data with one or two changes, and what they were."""
    path = draw(st.sampled_from(paths))
    data = copy.deepcopy(data_of(path))
    told = path.name
    for _ in range(draw(st.integers(1, 2))):
        at = draw(st.sampled_from(list(locations(data)) or [()]))
        if not at:
            break
        holder, key = get(data, at[:-1]), at[-1]
        what = draw(st.sampled_from(["drop", "misspell", "add", "value", "number", "wrap"]))
        told += f"; {what} {'.'.join(map(str, at))}"
        if what == "drop":
            del holder[key]
        elif what == "misspell" and isinstance(key, str):
            holder[key + draw(st.sampled_from("sx"))] = holder.pop(key)
        elif what == "add" and isinstance(holder[key], dict):
            holder[key][draw(st.sampled_from(["kind", "preset", "type", "weight"]))] = "x"
        elif what == "number" and type(holder[key]) in (int, float):
            factor = draw(st.sampled_from([-1, 0, 1000, 1e-9, 0.5]))
            holder[key] = factor * holder[key]
        elif what == "wrap":
            holder[key] = [holder[key]]
        else:
            holder[key] = copy.deepcopy(draw(st.sampled_from(VALUES)))
            told += f" = {holder[key]!r}"
    return data, told


def check_alike(name: str, model: type[BaseModel], data: Any, told: str) -> None:
    refused = [error.message[:200] for error in validator(name).iter_errors(data)]
    wrong = complaints(model, data)
    if not wrong:
        assert not refused, f"{told}: only the schema refuses it: {refused}"
    elif not refused:
        unknown = [text for text in wrong if not any(re.search(known, text) for known in MORE)]
        assert not unknown, f"{told}: only pydantic refuses it: {unknown}"


def alike(count: int) -> Any:
    return settings(max_examples=count, deadline=None, derandomize=True)


@alike(400)
@given(mutants(EXPERIMENTS))
def test_experiments_are_accepted_by_both_or_refused_by_both(mutant):
    check_alike("experiment", Experiment, *mutant)


@alike(100)
@given(mutants(TEMPLATES))
def test_templates_are_accepted_by_both_or_refused_by_both(mutant):
    check_alike("template", BodyDescription, *mutant)


@alike(200)
@given(mutants(PRESETS))
def test_presets_are_accepted_by_both_or_refused_by_both(mutant):
    data, told = mutant
    if isinstance(data.get("kind"), str):  # A preset must say its kind, which a method need not.
        check_alike("method", Method, data, told)
