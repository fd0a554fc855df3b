"""``regkit tune``: a template tuned to a method, with its figures, and what it refuses."""

import shutil
from pathlib import Path

import pytest
from few_samples import make_few
from places import ROOT

from regkit.body import BodyDescription
from regkit.config.document import Document

KITE = ROOT / "tests" / "tuning" / "kite.yaml"
FEW = ("--samples", 4, "--jobs", 1)


@pytest.fixture
def out(tmp_path, monkeypatch) -> Path:
    make_few(monkeypatch)
    return tmp_path / "tuned.yaml"


def test_tune_writes_a_template_and_says_how_to_use_it(regkit, out):
    wrong = out.with_name("wrong.yaml")
    wrong.write_text(
        KITE.read_text().replace("14, 0, 0.02]", "14, 0, 0.05]").replace("0.19, 0]", "0.19, 0.03]")
    )
    ended = regkit("tune", wrong, "--name", "mine", *FEW, "--out", out)
    assert ended.code == 0, ended.err
    assert ended.err.startswith("before: cost ")
    assert "\nstep 1: cost " in ended.err
    for told in ("frames", "motion", "all round", "proportions 5 % off", "mean [cm]", "lost [%]"):
        assert told in ended.out
    assert f"written: {out}" in ended.out
    assert f"template: {{kind: file, path: {out}}}" in ended.out
    assert "shape: {kind: gsog, tuned: mine}" in ended.out
    assert regkit("validate", out).code == 0
    description = Document.read(out).validated(BodyDescription)
    assert {"gsog", "gsog/mine"} < set(description.shapes)
    assert "4 samples, seed 0" in description.sources[-1]


def test_tune_refuses_what_is_not_better(regkit, out, monkeypatch):
    monkeypatch.setattr("regkit.tuning.trials.DOUBT", 1e6)
    ended = regkit("tune", KITE, *FEW, "--out", out)
    assert ended.code == 1
    assert "mean [cm]" in ended.out
    assert "written" not in ended.out
    for told in ("error: tuning helped in no trial", "frames", " cm", "more samples"):
        assert told in ended.err
    assert not out.exists()


def test_mesh_is_written_beside_a_tuned_template(regkit, out, monkeypatch):
    # A person's own samples take too long here; all that matters is what is written.
    def pretended(sets, *_: object, **__: object):
        from regkit.tuning import TunedList
        from regkit.tuning.trials import Comparison, Errors

        errors = Errors(0.02, 0.02, 0.0), Errors(0.01, 0.01, 0.0)
        comparison = Comparison("frames", 60, 1, *errors, -0.01, 0.001)
        return TunedList(sets.template.description(), "gsog", (), (comparison,))

    monkeypatch.setattr("regkit.api.tuning.tuned", pretended)
    ended = regkit("tune", "human", "--out", out)
    assert ended.code == 0, ended.err
    assert out.with_name("tuned_mesh.npz").is_file()
    shutil.move(out, out.with_name("moved.yaml"))
    moved = Document.read(out.with_name("moved.yaml")).validated(BodyDescription)
    assert moved.body("moved", moved.size.value).surface is not None


@pytest.mark.parametrize(
    ("options", "at", "of"),
    [
        (("humn",), "TEMPLATE humn: template", "no plug-in 'humn'"),
        (("none.yaml",), "TEMPLATE none.yaml: template", "no such file"),
        (("{kind",), "TEMPLATE {kind", "not valid YAML"),
        ((KITE, "--method", "bst"), "--method bst: method", "no plug-in 'bst'"),
        ((KITE, "--method", "small_gicp"), "", "no shape model"),
        ((KITE, "--camera", "sr400"), "--camera", "'sr400'"),
        ((KITE, "--camera", "none.json"), "", "none.json"),
        ((KITE, "--camera", "{width: 3}"), "--camera {width: 3}: camera.height", "required"),
        ((KITE, "--noise", "-1"), "--noise -1: noise", "greater"),
        ((KITE, "--noise", "loud"), "--noise loud: noise", "'loud'"),
        ((KITE, "--name", "a/b"), "--name a/b: name", "'a/b'"),
        ((KITE, "--body", "hand"), "", "joint by joint"),
        ((KITE, "--primitives", "1"), "", "primitives"),
        ((KITE, "--body", "nobody"), "--body nobody", "no plug-in 'nobody'"),
        ((KITE, "--preprocessor", "none"), "--preprocessor none", "no plug-in 'none'"),
        ((KITE, "--plugin", "none.py"), "none.py", "no such Python file"),
    ],
)
def test_tune_refuses_what_it_cannot_use(regkit, out, options, at, of):
    ended = regkit("tune", *options, *FEW, "--out", out)
    assert ended.code == 1
    assert ended.err.removeprefix("error: ").startswith(at)
    assert of in ended.err
    assert not out.exists()


@pytest.mark.parametrize("option", ["--samples", "--jobs"])
def test_numbers_out_of_range_are_wrong_usage(regkit, out, option):
    assert regkit("tune", KITE, option, 0, "--out", out).code == 2


def test_tune_overwrites_templates_only(regkit, out):
    out.write_text("kind: direct\n")
    ended = regkit("tune", KITE, *FEW, "--out", out)
    assert ended.code == 1
    assert "--out" in ended.err
    assert out.read_text() == "kind: direct\n"
