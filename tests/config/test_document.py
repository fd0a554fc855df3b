"""Errors in YAML name the file, the line, the field, what is wrong and what would be right."""

from pathlib import Path

import pytest
from messages import tells

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.experiment import Experiment
from regkit.interfaces import Kernel, ShapeModel
from regkit.skeleton import SkeletonDescription
from regkit.system.errors import ConfigError, DataError, RegkitError

EXPERIMENT = """\
name: test
dataset:
  kind: depth
  root: data
template: {kind: human, height: 1.7}
methods:
  gsog:
    kind: direct
    shape: gsog
    kernel: {kind: correlation}
    solver: {kind: lbfgs}
"""


def complaint(path: Path, text: str, model: type, settings: tuple[str, ...] = ()) -> str:
    path.write_text(text)
    with pytest.raises(RegkitError) as caught:
        Document.read(path).overridden(settings).validated(model)
    return str(caught.value).replace(str(path), "FILE")


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "experiment.yaml"


def test_valid_experiment_is_read(file):
    file.write_text(EXPERIMENT)
    experiment = Experiment.read(file)
    assert experiment.methods["gsog"].shape.kind == "gsog"
    assert experiment.tracker.kind == "constant_pose"


@pytest.mark.parametrize(
    ("old", "new", "at", "of"),
    [
        ("shape: gsog", "shape: gsg", "FILE:9: methods.gsog.shape",
         ("'gsg'", "regkit.shapes", *ShapeModel.available(), "did you mean 'gsog'?")),
        ("kind: lbfgs", "kind: lbfgs, max_iteration: 5", "FILE:11: "
         "methods.gsog.solver.max_iteration", ("no such field", "value_tolerance",
         "did you mean 'max_iterations'?")),
        ("kind: lbfgs", "kind: lbfgs, max_iterations: many", "FILE:11: "
         "methods.gsog.solver.max_iterations", ("integer", "'many'")),
        ("kind: lbfgs", "kind: lbfgs, max_iterations: 0", "FILE:11: "
         "methods.gsog.solver.max_iterations", ("greater than or equal to 1", "it is 0")),
        ("height: 1.7", "height: .nan", "FILE:5: template.height", ("finite", "nan")),
        ("kind: correlation", "covariance: exact", "FILE:10: methods.gsog.kernel",
         ("'kind'", *Kernel.available())),
        ("    shape: gsog\n", "", "FILE:7: methods.gsog.shape", "required"),
        ("name: test", "name: a/b", "FILE:1: name", ("'a/b'", "letters, digits")),
        ("  gsog:", "  Figures:", "FILE:7: methods.Figures", "'Figures'"),
    ],
)  # fmt: skip
def test_experiment_error_names_the_place(file, old, new, at, of):
    message = complaint(file, EXPERIMENT.replace(old, new), Experiment)
    assert len(message.splitlines()) == 1
    assert tells(message, at=at, of=of), message


def test_every_error_is_told_at_once(file):
    text = EXPERIMENT.replace("shape: gsog", "shape: x").replace("height: 1.7", "height: tall")
    lines = complaint(file, text, Experiment).splitlines()
    assert len(lines) == 2
    assert lines[0].startswith("FILE:5: template.height")
    assert lines[1].startswith("FILE:9: methods.gsog.shape")


def test_repeated_key_is_refused(file):
    message = complaint(file, EXPERIMENT + "name: again\n", Experiment)
    assert tells(message, at="FILE:12", of=("duplicate key", "'name'", "line 1"))


def test_broken_yaml_is_told_with_its_line(file):
    message = complaint(file, "name: [1, 2\nmore: 3\n", Experiment)
    assert tells(message, at="FILE:2", of="not valid YAML")


def test_missing_file_is_told(tmp_path):
    with pytest.raises(DataError, match="there is no such file"):
        Document.read(tmp_path / "nothing.yaml")


def test_document_that_is_no_mapping_is_refused(file):
    assert tells(complaint(file, "- 1\n", Experiment), at="FILE:1", of="mapping")


def test_setting_changes_a_value_and_is_named_in_errors(file):
    file.write_text(EXPERIMENT)
    changed = Experiment.read(file, ["methods.gsog.solver.max_iterations=7"])
    assert changed.methods["gsog"].solver.max_iterations == 7
    message = complaint(file, EXPERIMENT, Experiment, ("template.height=tall",))
    assert message.startswith("setting template.height=tall: template.height: input should be")
    message = complaint(file, EXPERIMENT, Experiment, ("template.height",))
    assert tells(message, at="setting template.height", of="a.b.c=value")


def test_setting_reaches_into_a_short_form(file):
    file.write_text(EXPERIMENT)
    changed = Experiment.read(file, ["methods.gsog.shape.kind=sog", "template=human"])
    assert changed.methods["gsog"].shape.kind == "sog"
    assert changed.template.height is None


def test_path_is_meant_from_the_file_and_a_setting_from_here(file, monkeypatch, tmp_path):
    file.write_text(EXPERIMENT)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    assert Experiment.read(file).dataset.root == tmp_path / "data"
    assert Experiment.read(file, ["dataset.root=data"]).dataset.root == elsewhere / "data"


SKELETON = """\
segments:
  root: {joint: {type: free}}
  arm: {parent: root, joint: {type: hinge, axis: x, limits_deg: [0, 90]}}
  hand: {parent: arm, joint: {type: fixed}}
"""


@pytest.mark.parametrize(
    ("old", "new", "at", "of"),
    [
        ("parent: root", "parent: hand", "FILE:3: segments.arm.parent", ("arm, hand", "cycle")),
        ("parent: arm", "parent: amr", "FILE:4: segments.hand.parent",
         ("'hand'", "orphan", "'amr'", "root, arm, hand")),
        ("parent: arm, ", "", "FILE:4: segments.hand", ("no parent", "root, hand")),
        ("  hand:", "  arm:", "FILE:4", ("duplicate key", "arm")),
        ("[0, 90]", "[90, 0]", "FILE:3: segments.arm.joint.limits_deg",
         ("reversed", "[90.0, 0.0]", "[0.0, 90.0]")),
        ("axis: x", "axis: [0, 0, 0]", "FILE:3: segments.arm.joint.axis", "zero"),
        ("type: hinge", "type: hing", "FILE:3: segments.arm.joint",
         ("'hing'", "'free', 'fixed', 'hinge', 'prismatic', 'universal', 'ball'")),
    ],
)  # fmt: skip
def test_skeleton_error_names_the_place(file, old, new, at, of):
    message = complaint(file, SKELETON.replace(old, new), SkeletonDescription)
    first = message.splitlines()[0]
    assert tells(first, at=at, of=of), message


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ("shapes: {gsog: {base: [{centre: [0, 0, 0], sigma: [0.1, 0, 0.1]}]}}",
         "shapes.gsog.base[0].sigma"),
        ("shapes: {sog: {nothing: [{centre: [0, 0, 0], sigma: 0.1}]}}",
         "shapes.sog.nothing: 'nothing' is not a segment (there are: base, arm,"),
    ],
)  # fmt: skip
def test_template_error_names_the_place(file, linkage_text, more, expected):
    assert expected in complaint(file, linkage_text + more + "\n", BodyDescription)


def test_unknown_joint_of_a_stance_is_refused_with_its_line(file, linkage_text):
    text = linkage_text + "stances: {odd: {joints: {elbow: 10}}}\n"
    message = complaint(file, text, BodyDescription)
    line = len(text.splitlines())
    assert tells(message, at=f"FILE:{line}: stances.odd.joints.elbow", of=("'elbow'", "forearm"))


def test_setting_that_replaces_a_mapping_is_blamed_for_what_is_in_it(file):
    setting = "methods.gsog.solver={kind: lbfgs, memory: -1}"
    message = complaint(file, EXPERIMENT, Experiment, (setting,))
    assert message.startswith(f"setting {setting}: methods.gsog.solver.memory: ")


def test_setting_reaches_into_a_list(file):
    text = EXPERIMENT + "    terms: [clamp, {kind: limits}]\n"
    file.write_text(text)
    changed = Experiment.read(file, ["methods.gsog.terms.1=visibility"])
    assert [term.kind for term in changed.methods["gsog"].terms] == ["clamp", "visibility"]
    changed = Experiment.read(file, ["methods.gsog.terms.0.kind=visibility"])
    assert changed.methods["gsog"].terms[0].kind == "visibility"
    assert complaint(file, text, Experiment, ("methods.gsog.terms.2=clamp",)).startswith(
        "setting methods.gsog.terms.2=clamp: methods.gsog.terms is a list of 2"
    )


@pytest.mark.parametrize("places", [{}, {("methods",): "here"}])
def test_document_without_places_names_the_fields(places):
    document = Document({"name": "a/b", "methods": {}}, places)
    with pytest.raises(ConfigError) as caught:
        document.validated(Experiment)
    lines = str(caught.value).splitlines()
    assert lines[0].startswith("name: 'a/b'")
    assert any(line.startswith("dataset: field required") for line in lines)
    assert document.place(()) == ""


def test_mapping_that_a_setting_adds_has_the_place_of_the_setting(file):
    message = complaint(file, EXPERIMENT, Experiment, ("trackr.kind=constant_pose",))
    assert message.startswith("setting trackr.kind=constant_pose: trackr: no such field")
