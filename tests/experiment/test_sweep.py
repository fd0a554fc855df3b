"""Lists in an experiment's YAML make variants of its methods, and settings of the rest."""

import json
import re
from dataclasses import replace

import pytest
from small_experiment import QUICK, TIMES, add_method, figures_but_times

from regkit.experiment import Experiment, Study
from regkit.experiment.sweeps.labels import variants
from regkit.system.errors import ConfigError

SIGMAS = "sweep: {methods.gsog.solver.max_iterations: [1, 4]}\n"
VOXELS = (
    "sweep:\n  preprocessor.voxel: [0.05, 0.08]\n  methods.gsog.solver.max_iterations: [1, 4]\n"
)


def append(files, text: str) -> None:
    with files.experiment.open("a") as stream:
        stream.write(text)


def complaint(files, text: str) -> str:
    append(files, text)
    with pytest.raises(ConfigError) as caught:
        Study.read(files.experiment)
    return str(caught.value).replace(str(files.experiment), "FILE")


def test_variants_of_a_method_stand_side_by_side(regkit, files):
    add_method(files.experiment, "sog", "sog")
    append(files, SIGMAS)
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    few, more, sog = files.metrics().items()
    assert (few[0], more[0], sog[0]) == ("gsog,max_iterations=1", "gsog,max_iterations=4", "sog")
    assert few[1]["mean"]["evaluations_per_frame"] < more[1]["mean"]["evaluations_per_frame"]
    # What was written is an experiment without a sweep, and is run again as it is.
    before = figures_but_times(files.out)
    again = files.out.with_name("again")
    assert regkit("run", files.out / "config.yaml", "--out", again, "--no-figures").code == 0
    assert figures_but_times(again) == before


def test_only_a_method_means_all_its_variants(regkit, files):
    add_method(files.experiment, "sog", "sog")
    append(files, SIGMAS)
    arguments = ("run", files.experiment, "--out", files.out, *QUICK)
    assert regkit(*arguments, "--only", "gsog").code == 0
    assert list(files.metrics()) == ["gsog,max_iterations=1", "gsog,max_iterations=4"]
    assert regkit(*arguments, "--only", "gsog,max_iterations=9").code == 1


def test_settings_have_folders_of_their_own_and_one_table(regkit, files):
    append(files, VOXELS)
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
    assert ended.code == 0, ended.err
    settings = ("voxel=0.05", "voxel=0.08")
    methods = ("gsog,max_iterations=1", "gsog,max_iterations=4")
    names = [f"{setting}/{method}" for setting in settings for method in methods]
    assert list(files.metrics()) == names
    assert "…" not in ended.out  # However long the names are, all figures are there.
    for name in names:
        assert all(part in ended.out for part in re.split(r"(?<=[,/])", name))
        assert name in (files.out / "report.md").read_text()
        setting, method = name.split("/")
        own = json.loads((files.out / setting / "metrics.json").read_text())["methods"][method]
        assert own == files.metrics()[name]
    coarse = (files.out / "voxel=0.08" / "config.yaml").read_text()
    assert "voxel: 0.08" in coarse
    # The whole is run again from what was written, and has nothing to do.
    before = {path: path.stat().st_mtime_ns for path in files.out.rglob("measure.json")}
    assert regkit("run", files.out / "config.yaml", "--out", files.out, "--no-figures").code == 0
    assert before == {path: path.stat().st_mtime_ns for path in files.out.rglob("measure.json")}


def test_setting_is_what_setting_it_by_hand_is(regkit, files):
    append(files, VOXELS)
    regkit("run", files.experiment, "--out", files.out, *QUICK)
    hand = files.out.with_name("hand")
    options = ("--set", "sweep={}", "--set", "preprocessor.voxel=0.08")
    assert regkit("run", files.experiment, "--out", hand, *QUICK, *options).code == 0
    (by_hand,) = json.loads((hand / "metrics.json").read_text())["methods"].values()
    swept = files.metrics()["voxel=0.08/gsog,max_iterations=4"]
    for figures in (by_hand["mean"], swept["mean"]):
        for time in TIMES:
            figures.pop(time)
    assert by_hand["mean"] == swept["mean"]


def test_another_sweep_does_not_go_into_the_same_folder(regkit, files):
    append(files, VOXELS)
    regkit("run", files.experiment, "--out", files.out, *QUICK)
    files.experiment.write_text(files.experiment.read_text().replace("0.08", "0.07"))
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
    assert ended.code == 1
    assert "sweep.preprocessor.voxel.1 is 0.08 there and 0.07 here" in ended.err


@pytest.mark.parametrize(
    ("sweep", "expected"),
    [
        (
            "sweep: {methods.gsgo.kernel: [correlation]}",
            "FILE:9: sweep.methods.gsgo.kernel: no method 'gsgo' (there are: gsog); did you mean",
        ),
        (
            "sweep: {methods.gsog.solver.memry: [3]}",
            "FILE:9: methods.gsog,memry=3.solver.memry: no such field (there are: ",
        ),
        ("sweep: {preprocessor.voxle: [0.1]}", "FILE:9: preprocessor.voxle: no such field"),
        (
            "sweep: {preprocessor.voxel: 0.1}",
            "FILE:9: sweep.preprocessor.voxel: input should be a valid",
        ),
        (
            "sweep: {preprocessor.voxel: []}",
            "FILE:9: sweep.preprocessor.voxel: list should have at least",
        ),
        (
            "sweep:\n  preprocessor.voxel:\n    - 0.05\n    - thick",
            "FILE:12: preprocessor.voxel: input",
        ),
        (
            "sweep: {preprocessor.voxel: [0.1, 0.1]}",
            "FILE:9: sweep.preprocessor.voxel: 0.1 is listed twice",
        ),
        ("sweep: {name: [a, b]}", "FILE:9: sweep.name: 'name' cannot be swept"),
        ("sweep: {methods: [a, b]}", "FILE:9: sweep.methods: 'methods' cannot be swept"),
        (
            "sweep: {preprocessor..voxel: [1]}",
            "FILE:9: sweep.preprocessor..voxel: a field must read a.b.c",
        ),
        ("sweep: [1, 2]", "FILE:9: sweep: input should be a valid dictionary"),
        (
            "sweep: {preprocessor.voxel: MANY, preprocessor.sigma: MANY}".replace(
                "MANY", str(list(range(1, 52)))
            ),
            "FILE:9: sweep: 51 x 51 = 2601 combinations; the maximum is 1000",
        ),
    ],
)
def test_sweep_that_cannot_be_is_told_with_its_line(files, sweep, expected):
    assert complaint(files, sweep + "\n").startswith(expected)


def test_one_experiment_is_not_read_from_a_sweep(files):
    append(files, SIGMAS)
    with pytest.raises(ConfigError, match=r"small.yaml:9: sweep: .*several experiments"):
        Experiment.read(files.experiment)
    assert list(Experiment.read(files.experiment, ["sweep={}"]).methods) == ["gsog"]


def test_items_of_a_presets_list_are_swept(files):
    append(files, "  best: {preset: best}\nsweep: {methods.best.terms.0.least: [0.1, 0.3]}\n")
    methods = Study.read(files.experiment).experiments[""].methods
    assert [methods[f"best,least={least}"].terms[0].least for least in (0.1, 0.3)] == [0.1, 0.3]
    kinds = [term.kind for term in methods["best,least=0.1"].terms]
    assert kinds == [term.kind for term in methods["best,least=0.3"].terms]
    text = files.experiment.read_text()
    for wrong, expected in (
        ("terms.0.lest", "small.yaml:10: methods.best,lest=0.1.terms.0.lest: no such field"),
        ("terms.9.least", "terms is a list of 5"),
    ):
        files.experiment.write_text(text.replace("terms.0.least", wrong))
        with pytest.raises(ConfigError, match=re.escape(expected)):
            Study.read(files.experiment)


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ({("kernel", "sigma"): [0.01, 1e-5]}, ["m,sigma=0.01", "m,sigma=1e-05"]),
        ({("a", "s"): [1], ("b", "s"): [True, None]}, ["m,a.s=1,b.s=true", "m,a.s=1,b.s=null"]),
        ({("solver",): [{"kind": "lbfgs"}, "ipopt"]}, ["m,solver=lbfgs", "m,solver=ipopt"]),
        ({("solver",): [{"kind": "lbfgs"}, {"kind": "lbfgs", "memory": 3}]},
         ["m,solver=v1", "m,solver=v2"]),
        ({("terms",): [["a", "b"], []]}, ["m,terms=a_b", "m,terms=v2"]),
        ({("path",): ["a/b", "c d"]}, ["m,path=v1", "m,path=v2"]),
        ({("terms", "0"): ["a"]}, ["m,terms.0=a"]),
        ({(): ["a", {"kind": "b"}], ("s",): [1]}, ["m,a,s=1", "m,b,s=1"]),
        ({("joints", "a/b"): [1], ("joints", "c d"): [2]}, ["m,a_b=1,c_d=2"]),
        ({("joints", "a/b"): [1], ("joints", "a b"): [2]}, ["m,a_b.1=1,a_b.2=2"]),
        ({("path",): ["v2", "a/b"]}, ["m,path=v1", "m,path=v2"]),
        ({tuple("abcdefgh"): ["x" * 40], tuple("abcdefgi"): ["y" * 40]}, ["m,001"]),
    ],
)  # fmt: skip
def test_variants_have_names_fit_for_folders(values, expected):
    assert variants("m", values) == expected


def test_subject_that_nobody_is_is_refused(regkit, files):
    append(files, "subjects: {anna: {kind: human, height: 1.6}}\n")
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures")
    assert ended.code == 1
    line = len(files.experiment.read_text().splitlines())
    assert ended.err.startswith(f"error: {files.experiment}:{line}: subjects.anna: no recording")
    assert not files.out.exists()


def test_subject_has_a_template_of_its_own(files):
    append(files, "subjects: {anna: {kind: human, height: 1.6}}\n")
    experiment = Experiment.read(files.experiment)
    (recording, _) = experiment.dataset.chosen()
    heights = [
        experiment.session(replace(recording, subject=subject)).template.given_size()
        for subject in ("anna", "bert", None)
    ]
    assert heights == [1.6, 1.7, 1.7]
