"""Presets: methods used by name, changed in places, or copied."""

import pytest

from regkit.config.document import Document
from regkit.config.preset import preset_file, presets_of
from regkit.experiment import Experiment
from regkit.system.errors import ConfigError

INSTALLED = ", ".join(presets_of("regkit.methods"))

EXPERIMENT = """\
name: presets
dataset: {{kind: depth, root: nowhere}}
template: human
methods:
  mine: {method}
"""


def method_of(tmp_path, text, *settings):
    file = tmp_path / "experiment.yaml"
    file.write_text(EXPERIMENT.format(method=text))
    return Experiment.read(file, settings).methods["mine"]


@pytest.mark.parametrize("name", ["best", "icp", "paper", "spheres"])
def test_preset_is_what_its_file_says(tmp_path, name):
    assert name in presets_of("regkit.methods")
    copied = preset_file("regkit.methods", name).read_text()
    (tmp_path / "copy.yaml").write_text(copied)
    by_name = method_of(tmp_path, f"{{preset: {name}}}")
    assert by_name == method_of(tmp_path, "{preset: copy.yaml}")
    data = Document.read(tmp_path / "copy.yaml").data
    said = [term if isinstance(term, str) else term["kind"] for term in data["terms"]]
    assert [term.kind for term in by_name.terms] == said
    assert by_name.tracker is not None


def test_preset_is_changed_where_it_is_told(tmp_path):
    best = method_of(tmp_path, "{preset: best}")
    less = method_of(tmp_path, "{preset: best, terms: [], kernel: {outliers: 0.2}}")
    assert less.terms == ()
    assert less.kernel == best.kernel.model_copy(update={"outliers": 0.2})
    assert less.solver == best.solver
    frozen = method_of(tmp_path, "{preset: best}", "methods.mine.kernel.covariance=frozen")
    assert frozen.kernel.covariance == "frozen"


def test_another_kind_takes_the_place_of_all_that_the_preset_said_of_it(tmp_path):
    method = method_of(tmp_path, "{preset: best, solver: {kind: lbfgs}, shape: sog}")
    assert method.solver.max_iterations == 100
    assert (method.shape.kind, method.shape.surface) == ("sog", "volume")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("{preset: bets}", f"no preset 'bets' (installed: {INSTALLED}; "
         "or name a .yaml file); did you mean 'best'?"),
        ("{preset: nothing.yaml}", "nothing.yaml: there is no such file"),
        ("{preset: best, kernell: 1}", "methods.mine.kernell: no such field"),
        ("{preset: spheres, shape: gsog}", "kernel 'sphere_distance' compares TaperedCapsules, but "
         "shape 'gsog' makes Gaussians"),
        ("{preset: spheres, terms: [clamp]}", "term 'clamp' looks at Gaussians, but shape 'sphere' "
         "makes TaperedCapsules"),
    ],
)  # fmt: skip
def test_mistake_is_told_at_its_place(tmp_path, text, expected):
    with pytest.raises(ConfigError) as caught:
        method_of(tmp_path, text)
    assert str(caught.value).startswith(f"{tmp_path}/experiment.yaml:5: methods.mine")
    assert expected in str(caught.value)


def test_mistake_in_a_preset_is_told_in_its_own_file(tmp_path):
    copy = tmp_path / "mine.yaml"
    text = preset_file("regkit.methods", "best").read_text()
    copy.write_text(text.replace("kernel: likelihood", "kernel: likelyhood"))
    line = 1 + text[: text.index("kernel:")].count("\n")
    with pytest.raises(ConfigError, match=rf"{copy}:{line}: kernel: no plug-in 'likelyhood'"):
        method_of(tmp_path, "{preset: mine.yaml}")
    copy.write_text("shape: gsog\n")
    with pytest.raises(ConfigError, match=rf"{copy}:1: a preset must name its kind"):
        method_of(tmp_path, "{preset: mine.yaml}")
