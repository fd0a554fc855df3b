"""The JSON Schemas: that editors accept and refuse what regkit accepts and refuses."""

import copy
import math
import re
from collections.abc import Iterator
from functools import cache
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any, Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from places import ROOT
from pydantic import BaseModel, TypeAdapter, ValidationError

import regkit.config.installed
import regkit.config.registry
from regkit.body import BodyDescription
from regkit.body.template_file import write_template
from regkit.config.document import Document
from regkit.config.plugin import register
from regkit.config.schema_line import MARK, schema_line
from regkit.experiment.schemas import schemas
from regkit.experiment.sweeps.sweep import SweptExperiment
from regkit.interfaces import Dataset, Method, Problem, Solution, Solver
from regkit.skeleton import SkeletonDescription

EXPERIMENTS = sorted((ROOT / "docs" / "examples").glob("*.yaml"))
PLUGINS = ROOT / "plugins" / "regkit_plugins"
TEMPLATES = sorted((PLUGINS / "templates").glob("*.yaml"))
DATASETS = [
    PLUGINS / "presets" / f"{name}.yaml" for name in ("hands", "people", "smmc_like", "two_hands")
]
METHODS = sorted(set((PLUGINS / "presets").glob("*.yaml")) - set(DATASETS))

Location = tuple[str | int, ...]

MORE = {
    r"compares \w+, but shape|looks at \w+, but shape|has no width that": "two plug-ins must fit",
    r"does not keep the limits of ball joints": "the solver's class knows what it keeps",
    r"near \(.*\) must be less than far": "two fields are compared",
    r"is an orphan|several segments have no parent|form a cycle": "the segments must be a tree",
    r"the root '.*' has no joint": "whose root moves",
    r"marker '.*' is on '.*' and on": "a marker's name is that of one segment",
    r"is itself coupled|is not a hinge|cannot follow itself|no angle of '": "a coupling's leader",
    r"is not a segment \(there are": "Gaussians are on segments",
    r"has a moving joint|the pose gives|is coupled to another": "a start fits the template",
    r"a given start needs the template's size": "and needs its size",
    r"limits are reversed|twist limits must be|is outside the range": "two numbers in order",
    r"times its size|degrees exceed the joint's limits": "a template's fields fit together",
    r"must not be zero|must be perpendicular": "geometry of a joint",
    r"the ratio .* is too (small|large)": "a magnitude, of either sign",
    r"is not taken by IPOPT|is the field .* here": "IPOPT itself knows its options",
    r"each of x, y and z must be named once": "three axes in one list",
    r"not a regular expression|it must have one group": "Python's regular expressions",
    r"it has no motion|give either a path or a name": "one of two fields",
    r"no .* called '.*' ships|no such joint": "what ships is looked up by name",
    r"there is no such file": "a file that is named must be there",
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
        if "capsules" in segment:
            segment["capsules"] = segment["capsules"][:2]
    shapes = {
        kind: {name: rows[:2] for name, rows in by_segment.items() if name in segments}
        for kind, by_segment in template["shapes"].items()
    }
    return {**template, "segments": segments, "shapes": shapes}


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
    [], {}, [1, 2], [2, 1], [0, 0, 0], [1, 2, 3], [1, "2", 3], ["a"],
    [[1, 2], [3, 4]], {"a": 1},
    {"kind": "unknown"}, {"kind": 3}, {"kind": None}, "direct", "gsog", "lbfgs", "best", "depth",
    {"kind": "gauss_newton"}, {"kind": "gsog", "surface": "visible"}, {"kind": "ipopt"},
    {"preset": "best"}, {"preset": "bst"}, {"preset": 3}, {"preset": "paper", "shape": "sog"},
    {"preset": "best", "solver": {"max_iterations": 3}}, {"preset": "best", "kind": "direct"},
    {"preset": "best", "kind": "coarse_to_fine"}, {"preset": "best", "terms": None},
    {"preset": "best", "solver": {"max_itrations": 3}}, {"preset": "best", "solver": "lbfgs"},
    {"preset": "best", "kernel": {"kind": "correlation"}}, {"preset": "best", "shape": {}},
    {"preset": "icp", "kernel": {"max_correspondence_distance": "x"}},
    {"preset": "icp", "kernel": {"max_correspondence_distance": 3}},
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


BEST = {"preset": "best"}


@pytest.mark.parametrize(
    ("field", "value", "right"),
    [
        ("methods.sog.solver", "gauss_newton", True),
        ("methods.sog.solver", {"kind": "gauss_newton", "max_iterations": 3.0}, True),
        ("methods.sog.solver", {"kind": "gauss_newton", "max_iterations": "3"}, False),
        ("methods.sog.solver", {"kind": "gauss_newton", "max_iterations": True}, False),
        ("methods.sog.solver", {"kind": "gauss_newton", "max_iterations": 0}, False),
        ("methods.sog.solver", {"kind": "gauss_newton", "max_itrations": 3}, False),
        ("methods.sog.solver", {"max_iterations": 3}, False),
        ("methods.sog.solver", "gaus_newton", False),
        ("methods.sog.solver", None, False),
        ("methods.sog.kernel", {"kind": "correlation", "covariance": "frosen"}, False),
        ("methods.sog.annealing", [0.1, 0], True),
        ("methods.sog.annealing", [], False),
        ("methods.sog.annealing", 0.1, False),
        ("methods.sog.hard_limits", "no", False),
        ("methods.sog.hard_limits", 0, False),
        ("methods.sog", "direct", False),  # It needs a shape, a kernel and a solver.
        ("methods.best", {**BEST, "solver": {"max_iterations": 3}}, True),
        ("methods.best", {**BEST, "solver": {"max_itrations": 3}}, False),
        ("methods.best", {**BEST, "solver": "lbfgs"}, True),
        ("methods.best", {**BEST, "solver": {"kind": "lbfgs", "damping": 1.0}}, False),
        ("methods.best", {**BEST, "terms": []}, True),
        ("methods.best", {**BEST, "term": []}, False),
        ("methods.best", {**BEST, "kind": "direct"}, True),
        ("methods.best", {**BEST, "kind": "small_gicp"}, False),
        ("methods.best", {"preset": "icp", "kernel": {"robust": {"loss": "huber"}}}, True),
        ("methods.best", {"preset": "icp", "kernel": {"robust": {"los": "huber"}}}, False),
        ("methods.best", {"preset": "bst"}, False),
        ("methods.a/b", BEST, False),
        ("methods", {}, False),
        ("name", "a b", False),
        ("template", {"kind": "human", "height": 1.75}, True),
        ("template", {"kind": "human", "height": 175}, False),
        ("template", {"kind": "human", "height": None}, True),
        ("template", {"kind": "file"}, False),
        ("dataset", "depth", False),  # It needs a root.
        ("dataset.root", 3, False),
        ("dataset.recordings", ["a"], True),
        ("dataset.recordings", "a", False),
        ("preprocessor", {"kind": "points", "crop": {"far": 3}}, True),
        ("preprocessor", {"kind": "points", "crop": {"far": 0}}, False),
        ("seed", 1, False),
    ],
)
def test_experiment_is_right_or_wrong_for_both(field, value, right):
    data = copy.deepcopy(data_of(ROOT / "docs" / "examples" / "demo.yaml"))
    *path, last = field.split(".")
    get(data, tuple(path))[last] = value
    assert validator("experiment").is_valid(data) == right
    assert (not complaints(SweptExperiment, data)) == right


@pytest.mark.parametrize("value", [float("inf"), float("nan")])
def test_numbers_that_json_does_not_have_are_refused_by_regkit_alone(value):
    """YAML can write them; a schema has no word for them, and only bounds keep infinity out."""
    data = copy.deepcopy(data_of(ROOT / "docs" / "examples" / "demo.yaml"))
    data["preprocessor"]["sigma"] = value
    assert validator("experiment").is_valid(data) == math.isnan(value)
    assert complaints(SweptExperiment, data) == [
        "preprocessor.sigma: Input should be a finite number"
    ]


@pytest.mark.parametrize(
    ("field", "value", "right"),
    [
        ("axis", "-x", True),
        ("axis", [0, 2, 0], True),
        ("axis", "--x", False),
        ("axis", [0, 1], False),
        ("axis", ["0", 1, 0], False),
        ("limits_deg", [-10, 140], True),
        ("limits_deg", None, True),
        ("limits_deg", [-10], False),
        ("limit_deg", [-10, 140], False),
        ("type", "hinges", False),
    ],
)
@pytest.mark.parametrize("name", ["template", "skeleton"])
def test_joint_is_right_or_wrong_for_both(name, field, value, right):
    hinge = {"type": "hinge", "axis": "x"}
    segments = {
        "base": {"joint": {"type": "free"}},
        "arm": {"parent": "base", "joint": {**hinge, field: value}},
    }
    body = {"title": "Two.", "size": {"name": "length", "value": 1, "range": [0.5, 2]}}
    data = {"segments": segments, **(body if name == "template" else {})}
    model = BodyDescription if name == "template" else SkeletonDescription
    assert validator(name).is_valid(data) == right
    assert (not complaints(model, data)) == right


@given(mutants(EXPERIMENTS))
def test_experiments_are_accepted_by_both_or_refused_by_both(mutant):
    check_alike("experiment", SweptExperiment, *mutant)


@given(mutants(TEMPLATES))
def test_templates_are_accepted_by_both_or_refused_by_both(mutant):
    check_alike("template", BodyDescription, *mutant)


@given(mutants(DATASETS))
def test_datasets_are_accepted_by_both_or_refused_by_both(mutant):
    data, told = mutant
    if isinstance(data.get("kind"), str):
        check_alike("dataset", Dataset, data, told)


@given(mutants(METHODS))
def test_methods_are_accepted_by_both_or_refused_by_both(mutant):
    data, told = mutant
    if isinstance(data.get("kind"), str):  # A preset must say its kind, which a method need not.
        check_alike("method", Method, data, told)


# What plug-ins do to schemas.


def with_entry_points(monkeypatch: pytest.MonkeyPatch, *points: EntryPoint) -> None:
    """As if a distribution had brought these too."""
    before = regkit.config.installed.entry_points

    def entry_points(group: str) -> list[EntryPoint]:
        return [*before(group), *(point for point in points if point.group == group)]

    monkeypatch.setattr(regkit.config.installed, "entry_points", entry_points)


def test_broken_plugins_and_presets_are_not_in_the_schema_and_harm_no_other(monkeypatch):
    before = schemas()
    with_entry_points(
        monkeypatch,
        EntryPoint("broken", "there_is_no_such_module:Solver", "regkit.solvers"),
        EntryPoint("no_class", "json:dumps", "regkit.methods"),
        EntryPoint("lost", "there_is_no_such_module:PATH", "regkit.methods.presets"),
        EntryPoint("nowhere", "test_schemas:NOWHERE", "regkit.methods.presets"),
    )
    assert "broken" in Solver.available()
    assert schemas() == before


def test_plugin_that_holds_others_of_its_own_group_is_described(monkeypatch):
    monkeypatch.setattr(regkit.config.registry, "_REGISTERED", {})
    register(Twice)
    checked = Draft202012Validator(schemas()["experiment"])
    data = copy.deepcopy(data_of(ROOT / "docs" / "examples" / "demo.yaml"))
    inner = {"kind": "twice", "inner": "lbfgs"}
    data["methods"]["sog"]["solver"] = {"kind": "twice", "inner": inner}
    assert checked.is_valid(data)
    assert not complaints(SweptExperiment, data)
    inner["inner"] = "lbfg"
    assert not checked.is_valid(data)
    assert complaints(SweptExperiment, data)


class Twice(Solver):
    """Solves, and solves again from there."""

    kind: Literal["twice"] = "twice"

    inner: Solver
    """What solves."""

    def minimize(self, problem: Problem) -> Solution:
        return self.inner.minimize(problem)


# What an editor is told.


@pytest.mark.parametrize(
    ("key", "sigma", "right"),
    [
        ("sog", 0.1, True), ("sog/paper", 0.1, True), ("sog/best-2.0", 0.1, True),
        ("sog", "wide", False), ("sog/paper", "wide", False), ("unheard/paper", "wide", True),
        ("sog/", 0.1, False), ("sog/a/b", 0.1, False), ("sog/-a", 0.1, False),
    ],
)  # fmt: skip
def test_list_of_primitives_is_right_or_wrong_for_both(key, sigma, right):
    listed = {"foot": [{"centre": [0, 0, 0], "sigma": sigma}]}
    data = {
        "title": "A lamp",
        "size": {"name": "height", "value": 1, "range": [1, 2]},
        "segments": {"foot": {"joint": {"type": "free"}}},
        "shapes": {key: listed},
    }
    assert validator("template").is_valid(data) is right
    assert (not complaints(BodyDescription, data)) is right


def test_fields_have_descriptions_and_no_titles():
    """A title would only repeat the field's name; what is referred to describes itself."""

    def fields(part: Any) -> Iterator[tuple[str, dict[str, Any]]]:
        if isinstance(part, dict):
            if part.get("type") == "object":
                yield from part.get("properties", {}).items()
            for inner in part.values():
                yield from fields(inner)
        elif isinstance(part, list):
            for inner in part:
                yield from fields(inner)

    for schema in schemas().values():
        Draft202012Validator.check_schema(schema)
        for name, field in fields(schema):
            assert "title" not in field, name
            assert "description" in field or "const" in field or "$ref" in field, name


def test_preset_shows_its_own_values_as_defaults():
    """What holds if nothing is changed, rather than what holds without the preset."""
    methods = schemas()["experiment"]["$defs"]["methods"]["anyOf"]
    (best,) = (form for form in methods if form.get("title") == "preset best")
    solver = best["properties"]["solver"]
    assert solver["default"]["max_iterations"] == 6
    assert solver["anyOf"][1]["properties"]["max_iterations"]["default"] == 6
    assert solver["anyOf"][1]["properties"]["max_iterations"]["minimum"] == 1


@pytest.mark.parametrize(
    ("kind", "file"),
    [
        *(("experiment", path) for path in EXPERIMENTS),
        *(("template", path) for path in TEMPLATES),
        *(("method", path) for path in METHODS),
        *(("dataset", path) for path in DATASETS),
    ],
    ids=lambda value: value.name if isinstance(value, Path) else value,
)
def test_shipped_file_names_its_schema(kind, file):
    """The other YAML files, recordings (five fields) and maps (free names), have no schema."""
    first = file.read_text(encoding="utf-8").partition("\n")[0]
    assert first == schema_line(file, kind), f"begin {file} with: {schema_line(file, kind)}"
    schema = file.parent / first.removeprefix(MARK)
    assert schema.resolve() == ROOT / "schemas" / f"{kind}.json"
    assert validator(kind).is_valid(Document.read(file).data)


def test_schema_line_is_that_of_the_nearest_folder_of_schemas(tmp_path):
    assert schema_line(tmp_path / "a.yaml", "template") is None
    for folder in (tmp_path, tmp_path / "inner"):
        (folder / "schemas").mkdir(parents=True)
        (folder / "schemas" / "template.json").write_text("{}")
    assert schema_line(tmp_path / "a.yaml", "template") == f"{MARK}schemas/template.json"
    assert schema_line(tmp_path / "inner" / "b" / "a.yaml", "template") == (
        f"{MARK}../schemas/template.json"
    )
    assert schema_line(tmp_path / "inner" / "a.yaml", "experiment") is None


def test_written_template_names_the_schema_that_is_nearby(tmp_path):
    description = Document.read(TEMPLATES[0]).validated(BodyDescription)
    description = description.model_copy(update={"mesh": None})
    write_template(tmp_path / "without.yaml", description, None, "A test.")
    assert (tmp_path / "without.yaml").read_text().startswith("# A test.")
    (tmp_path / "schemas").mkdir()
    (tmp_path / "schemas" / "template.json").write_text("{}")
    write_template(tmp_path / "with.yaml", description, None, "A test.")
    text = (tmp_path / "with.yaml").read_text()
    assert text.startswith(f"{MARK}schemas/template.json\n# A test.")
    again = Document.read(tmp_path / "with.yaml").validated(BodyDescription)
    assert list(again.segments) == list(description.segments)
