"""Whole runs of small experiments: what is written, kept, done again and refused."""

import json
import re
import shutil
import sys
from dataclasses import fields
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
import pytest

from regkit.errors import DataError
from regkit.experiment import Experiment, run
from regkit.experiment.runner import Progress
from regkit.interfaces import Registered, Tracker
from regkit.metrics import Measure
from regkit.plugin import register
from regkit_plugins.datasets.depth import DepthFolders

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
FRAMES = 2

EXPERIMENT = """\
name: small
dataset: {{kind: depth, root: {root}}}
template: {{kind: human, height: 1.7}}
observer: {{kind: points, voxel: 0.05, sigma: 0.03}}
start: {{root: {{position: [-0.05, -0.05, 3.25], rotation_deg: [180, 0, 0]}}}}
methods:
  gsog: {{kind: direct, shape: gsog, kernel: correlation, \
solver: {{kind: lbfgs, max_iterations: 4}}}}
"""
ANOTHER = """\
  {name}: {{kind: direct, shape: {shape}, kernel: correlation, \
solver: {{kind: lbfgs, max_iterations: 4}}}}
"""
QUICK = ("--set", "dataset.sequences=[first]", "--set", "dataset.frames=1")
"""For runs of which it only matters that they take place."""


class Files(NamedTuple):
    """A small experiment on two sequences, and where its results go."""

    experiment: Path
    data: Path
    out: Path

    def metrics(self) -> dict:
        return json.loads((self.out / "metrics.json").read_text())["methods"]

    def written(self) -> dict[str, int]:
        """When each file of the sequences was written."""
        return {
            str(path.relative_to(self.out)): path.stat().st_mtime_ns
            for path in sorted(self.out.glob("*/*/*"))
        }


def copy_sequence(folder: Path) -> None:
    source = EXAMPLES / "data" / "human_walk"
    (folder / "depth").mkdir(parents=True)
    for frame in range(FRAMES):
        name = f"depth/{frame:06d}.png"
        shutil.copy(source / name, folder / name)
    for name in ("camera.json", "truth.csv"):
        shutil.copy(source / name, folder / name)
    (folder / "sequence.yaml").write_text(f"name: {folder.name}\n")


def small(folder: Path) -> Files:
    data = folder / "data"
    for name in ("first", "second"):
        copy_sequence(data / name)
    experiment = folder / "small.yaml"
    experiment.write_text(EXPERIMENT.format(root="data"))
    return Files(experiment, data, folder / "out")


def add_method(experiment: Path, name: str, shape: str) -> None:
    with experiment.open("a") as stream:
        stream.write(ANOTHER.format(name=name, shape=shape))


@pytest.fixture
def files(tmp_path) -> Files:
    return small(tmp_path)


class Silence(Progress):
    """Wants to know nothing."""

    def begin(self, method, sequence, frames) -> None:
        pass

    def advance(self) -> None:
        pass

    def end(self, method, sequence, outcome) -> None:
        pass


@pytest.fixture(scope="module")
def done(tmp_path_factory) -> Files:
    """A finished run of two methods, which several tests look at and none changes."""
    files = small(tmp_path_factory.mktemp("done"))
    add_method(files.experiment, "sog", "sog")
    experiment = Experiment.read(files.experiment)
    outcome = run(experiment, files.out, Silence())
    assert outcome.failures == {"sog": {}, "gsog": {}}
    return files


def damage(image: Path) -> bytes:
    content = image.read_bytes()
    image.write_bytes(content[: len(content) // 2])
    return content


def counting() -> list[str]:
    """Register the tracker ``counting``, and return the list that grows with each of its steps."""
    steps: list[str] = []

    @register
    class Counting(Tracker):
        """Holds the last pose and counts."""

        kind: Literal["counting"] = "counting"

        def step(self, registrar, observation, past) -> Registered:
            steps.append(type(registrar.method.shape).__name__)
            return registrar.register(observation, past[-1])

    return steps


def test_run_writes_what_is_documented(done):
    for name in ("config.yaml", "environment.json", "metrics.json", "report.md"):
        assert (done.out / name).is_file()
    expected = {
        f"{method}/{sequence}/{name}"
        for method in ("sog", "gsog")
        for sequence in ("first", "second")
        for name in ("measure.json", "poses.npz", "overlay.png")
    }
    assert set(done.written()) == expected
    assert not list(done.out.rglob(".*"))
    for name in expected:
        if name.endswith(".png"):
            assert (done.out / name).read_bytes().startswith(b"\x89PNG")


def test_metrics_have_every_figure_of_every_sequence_and_the_mean(done):
    names = {field.name for field in fields(Measure)}
    metrics = done.metrics()
    assert set(metrics) == {"sog", "gsog"}
    for method, figures in metrics.items():
        assert set(figures) == {"sequences", "mean"}
        assert set(figures["sequences"]) == {"first", "second"}
        for name in names:
            values = [figures["sequences"][s][name] for s in ("first", "second")]
            assert all(np.isfinite(value) for value in values), name
            assert figures["mean"][name] == pytest.approx(np.mean(values))
        assert set(figures["mean"]) == names
        for sequence in ("first", "second"):
            own = json.loads((done.out / method / sequence / "measure.json").read_text())
            assert own == figures["sequences"][sequence]
        assert figures["mean"]["frames"] == FRAMES
        assert 0.0 < figures["mean"]["joint_error_raw_cm"] < 40.0


def test_poses_are_those_that_the_metrics_tell_of(done):
    """Errors recomputed from the written markers and the truth are the written ones."""
    (first, _) = DepthFolders(root=done.data).chosen()
    truth = first.truth()
    with np.load(done.out / "gsog" / "first" / "poses.npz", allow_pickle=False) as arrays:
        names = [str(name) for name in arrays["marker_names"]]
        assert arrays["root"].shape == (FRAMES, 4, 4)
        assert arrays["balls"].shape == (FRAMES, len(arrays["ball_names"]), 4)
        assert len(arrays["hinges"]) == FRAMES
        assert float(arrays["size"]) == 1.7
        np.testing.assert_allclose(np.linalg.norm(arrays["balls"], axis=2), 1.0)
        columns = [names.index(joint) for joint in truth.joints if joint in names]
        known = [index for index, joint in enumerate(truth.joints) if joint in names]
        distances = np.linalg.norm(
            arrays["markers"][:, columns] - truth.positions[:, known], axis=2
        )
    figures = done.metrics()["gsog"]["sequences"]["first"]
    assert len(columns) >= 15
    assert 100.0 * distances.mean() == pytest.approx(figures["joint_error_raw_cm"])
    assert 100.0 * (distances < 0.1).mean() == pytest.approx(figures["within_10cm_percent"])


def test_environment_names_versions_and_machine(done):
    environment = json.loads((done.out / "environment.json").read_text())
    assert environment["python"] == ".".join(map(str, sys.version_info[:3]))
    assert environment["libraries"]["numpy"] == np.__version__
    assert {"regkit", "system", "processor", "cores"} <= set(environment)


def test_report_shows_every_method_and_links_to_its_pictures(done):
    text = (done.out / "report.md").read_text()
    links = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text)
    assert len(links) == 4
    assert all((done.out / link).is_file() for link in links)
    assert "## Failed" not in text
    raw = done.metrics()["gsog"]["mean"]["joint_error_raw_cm"]
    assert f"| gsog | 2 | {raw:.1f} |" in text


def test_config_holds_every_default_and_runs_again(regkit, done, tmp_path):
    """The written configuration is itself an experiment, with the same outcome."""
    config = done.out / "config.yaml"
    assert "gradient_tolerance: 0.0001" in config.read_text()
    ended = regkit("run", config, "--out", tmp_path / "out", "--only", "gsog")
    assert ended.code == 0
    assert ended.err == ""
    assert "gsog" in ended.out
    assert f"results: {tmp_path / 'out'}" in ended.out
    again = done._replace(out=tmp_path / "out")
    assert config.read_text() == (again.out / "config.yaml").read_text()
    figures = done.metrics()["gsog"]["mean"]
    for name in ("joint_error_raw_cm", "surface_distance_mm", "evaluations_per_frame"):
        assert again.metrics()["gsog"]["mean"][name] == figures[name]


def test_figures_are_null_without_truth(regkit, files):
    for path in files.data.glob("*/truth.csv"):
        path.unlink()
    assert regkit("run", files.experiment, "--out", files.out).code == 0
    figures = files.metrics()["gsog"]
    for row in (figures["mean"], figures["sequences"]["first"]):
        for name in (
            "joint_error_raw_cm",
            "joint_error_adjusted_cm",
            "within_10cm_percent",
            "within_10cm_adjusted_percent",
            "lost_frames",
        ):
            assert row[name] is None
        assert row["surface_distance_mm"] > 0.0
        assert row["fps"] > 0.0


def test_sequence_of_one_frame_is_run(regkit, files):
    ended = regkit("run", files.experiment, "--out", files.out, "--set", "dataset.frames=1")
    assert ended.code == 0
    figures = files.metrics()["gsog"]["sequences"]["second"]
    assert figures["frames"] == 1
    assert figures["joint_error_adjusted_cm"] is None
    assert figures["joint_error_raw_cm"] > 0.0


def test_finished_run_does_nothing_again(regkit, files):
    steps = counting()
    arguments = ("run", files.experiment, "--out", files.out, "--set", "tracker=counting")
    assert regkit(*arguments).code == 0
    assert len(steps) == 2 * FRAMES
    before, metrics = files.written(), files.metrics()
    assert regkit(*arguments).code == 0
    assert len(steps) == 2 * FRAMES
    assert files.written() == before
    assert files.metrics() == metrics


def test_resumed_run_does_only_what_is_missing(regkit, files):
    steps = counting()
    arguments = ("run", files.experiment, "--out", files.out, "--set", "tracker=counting")
    regkit(*arguments)
    before, metrics = files.written(), files.metrics()
    (files.out / "gsog" / "second" / "measure.json").unlink()
    steps.clear()
    assert regkit(*arguments).code == 0
    assert steps == FRAMES * ["GeneralizedSumOfGaussians"]
    after = files.written()
    changed = {name for name, when in after.items() if before[name] != when}
    assert changed == {
        "gsog/second/measure.json",
        "gsog/second/poses.npz",
        "gsog/second/overlay.png",
    }
    for method, figures in files.metrics().items():
        for name in ("joint_error_raw_cm", "evaluations_per_frame"):
            assert figures["mean"][name] == metrics[method]["mean"][name]


def test_interrupted_run_is_completed_later(regkit, files):
    """What is finished when the user interrupts is kept, and the rest is done the next time."""
    steps = counting()

    @register
    class Impatient(Tracker):
        """Is interrupted in the second sequence, once."""

        kind: Literal["impatient"] = "impatient"

        def step(self, registrar, observation, past) -> Registered:
            steps.append("")
            if len(steps) == FRAMES + 2:
                raise KeyboardInterrupt
            return registrar.register(observation, past[-1])

    arguments = ("run", files.experiment, "--out", files.out, "--set", "tracker=impatient")
    ended = regkit(*arguments)
    assert ended.code == 130
    assert ended.err == (f"interrupted; what was finished is kept: repeat with --out {files.out}\n")
    assert {name.rsplit("/", 1)[0] for name in files.written()} == {"gsog/first"}
    begun = len(steps)
    assert regkit(*arguments).code == 0
    assert len(steps) - begun == FRAMES
    assert len(files.written()) == 6


def test_damaged_measure_is_told_and_the_rest_is_kept(regkit, files):
    regkit("run", files.experiment, "--out", files.out)
    damaged = files.out / "gsog" / "first" / "measure.json"
    damaged.write_text("{")
    ended = regkit("run", files.experiment, "--out", files.out)
    assert ended.code == 1
    assert f"gsog on first failed: {damaged}: damaged" in ended.err
    assert "delete the file to have the sequence done again" in ended.err
    second = json.loads((files.out / "gsog" / "second" / "measure.json").read_text())
    assert files.metrics()["gsog"]["mean"] == pytest.approx(second)


def test_folder_of_another_configuration_is_refused(regkit, files):
    regkit("run", files.experiment, "--out", files.out, *QUICK)
    before = files.written()
    ended = regkit(
        "run", files.experiment, "--out", files.out, "--set", "methods.gsog.solver.memory=3"
    )
    assert ended.code == 1
    assert ended.err.startswith(
        f"error: --out {files.out}: the folder holds the results of another configuration"
    )
    assert files.written() == before


def test_folder_with_other_files_is_refused_and_left_alone(regkit, files):
    files.out.mkdir()
    (files.out / "thesis.tex").write_text("precious")
    ended = regkit("run", files.experiment, "--out", files.out)
    assert ended.code == 1
    assert ended.err == (
        f"error: --out {files.out}: the folder holds other files; choose a new or an empty one\n"
    )
    assert [path.name for path in files.out.iterdir()] == ["thesis.tex"]


def test_empty_folder_is_used(regkit, files):
    files.out.mkdir()
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0


def test_out_that_is_a_file_is_refused(regkit, files):
    files.out.write_text("precious")
    ended = regkit("run", files.experiment, "--out", files.out)
    assert ended.code == 1
    assert "this is a file, not a folder" in ended.err
    assert files.out.read_text() == "precious"


def test_results_go_to_a_folder_of_their_own_without_out(regkit, files, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert regkit("run", files.experiment, *QUICK).code == 0
    (folder,) = (tmp_path / "results" / "small").iterdir()
    assert (folder / "metrics.json").is_file()


def test_bad_sequence_does_not_stop_the_others(regkit, files):
    """What was finished is kept, the reason is told, and once mended the run is completed."""
    image = files.data / "first" / "depth" / "000001.png"
    content = damage(image)
    ended = regkit("run", files.experiment, "--out", files.out)
    assert ended.code == 1
    reason = f"{image}: the image is damaged or cut short"
    assert f"gsog on first failed: {reason}" in ended.err
    assert "Traceback" not in ended.out + ended.err
    figures = files.metrics()["gsog"]
    failed = dict(figures["sequences"]["first"])
    assert failed.pop("error").startswith(reason)
    assert set(failed.values()) == {None}
    assert figures["sequences"]["second"]["joint_error_raw_cm"] > 0.0
    assert figures["mean"] == figures["sequences"]["second"]
    text = (files.out / "report.md").read_text()
    assert f"- **gsog** on first: {reason}" in text
    assert {name.split("/")[1] for name in files.written()} == {"second"}

    before = files.written()
    image.write_bytes(content)
    assert regkit("run", files.experiment, "--out", files.out).code == 0
    after = files.written()
    assert {name: after[name] for name in before} == before
    assert len(after) == 2 * len(before)


def test_frame_that_holds_too_little_is_told(regkit, files):
    ended = regkit("run", files.experiment, "--out", files.out, "--set", "observer.crop.far=1.0")
    assert ended.code == 1
    assert "first/depth/000000.png: 0 of the frame's" in ended.err
    assert files.metrics()["gsog"]["mean"]["fps"] is None


def test_method_that_fails_does_not_stop_the_others(regkit, files):
    @register
    class Picky(Tracker):
        """Refuses Gaussians of three axes."""

        kind: Literal["picky"] = "picky"

        def step(self, registrar, observation, past) -> Registered:
            if registrar.method.shape.kind == "gsog":
                raise DataError("not to my taste")
            return registrar.register(observation, past[-1])

    add_method(files.experiment, "sog", "sog")
    ended = regkit("run", files.experiment, "--out", files.out, "--set", "tracker=picky", *QUICK)
    assert ended.code == 1
    place = files.data / "first" / "depth" / "000000.png"
    assert f"gsog on first failed: {place}: not to my taste" in ended.err
    assert {name.split("/")[0] for name in files.written()} == {"sog"}


def test_only_runs_the_named_methods(regkit, files):
    add_method(files.experiment, "sog", "sog")
    assert regkit("run", files.experiment, "--out", files.out, "--only", "gsog", *QUICK).code == 0
    assert {name.split("/")[0] for name in files.written()} == {"gsog"}
    assert set(files.metrics()) == {"gsog"}


def test_only_an_unknown_method_is_refused(regkit, files):
    add_method(files.experiment, "sog", "sog")
    ended = regkit("run", files.experiment, "--out", files.out, "--only", "gsg")
    assert ended.code == 1
    assert ended.err == (
        "error: --only: no method 'gsg' (there are: gsog, sog); did you mean 'gsog'?\n"
    )


def test_setting_changes_the_run(regkit, files):
    def evaluations(out: str, *settings: str) -> float:
        folder = files.out / out
        options = [part for setting in settings for part in ("--set", setting)]
        arguments = ("run", files.experiment, "--out", folder, *QUICK, *options)
        assert regkit(*arguments).code == 0
        metrics = json.loads((folder / "metrics.json").read_text())
        return metrics["methods"]["gsog"]["mean"]["evaluations_per_frame"]

    few = evaluations("few", "methods.gsog.solver.max_iterations=1")
    assert few < evaluations("more")
    assert "max_iterations: 1\n" in (files.out / "few" / "config.yaml").read_text()


def test_setting_that_is_wrong_is_told(regkit, files):
    ended = regkit("run", files.experiment, "--out", files.out, "--set", "dataset.frames=none")
    assert ended.code == 1
    assert ended.err.startswith("error: --set dataset.frames=none: dataset.frames: input should")
    assert not files.out.exists()


def test_joint_that_is_misspelt_is_told_before_anything_is_computed(regkit, files):
    steps = counting()
    ended = regkit(
        "run", files.experiment, "--out", files.out,
        "--set", "tracker=counting", "--set", "dataset.joints={head: haed}",
    )  # fmt: skip
    assert ended.code == 1
    assert "dataset.joints.head: 'human' has no marker 'haed'" in ended.err
    assert "did you mean 'head'?" in ended.err
    assert not steps


SHAPE = '''
from typing import ClassVar, Literal

import numpy as np

from regkit.interfaces import ShapeModel
from regkit.plugin import register
from regkit.primitives import Gaussians, Primitives


@register
class Beads(ShapeModel):
    """One Gaussian in the middle of each capsule."""

    kind: Literal["beads"] = "beads"
    makes: ClassVar[type[Primitives]] = Gaussians

    factor: float = 0.5
    """Standard deviation over the capsule's radius."""

    def attach(self, body):
        capsules = body.capsules
        count = len(capsules)
        scales = self.factor * capsules.radii.mean(axis=1)
        return Gaussians(
            capsules.segments,
            capsules.ends.mean(axis=1),
            np.tile(np.eye(3), (count, 1, 1)),
            np.repeat(scales[:, None], 3, axis=1),
            np.ones(count),
        )
'''


def test_shape_of_a_plugin_file_is_run(regkit, files, tmp_path):
    file = tmp_path / "beads.py"
    file.write_text(SHAPE)
    add_method(files.experiment, "beads", "{kind: beads, factor: 0.7}")
    refused = regkit("run", files.experiment, "--out", files.out)
    assert refused.code == 1
    assert "no plug-in 'beads' in regkit.shapes (installed: gsog, sog)" in refused.err
    ended = regkit(
        "run", files.experiment, "--out", files.out, "--plugin", file, "--only", "beads", *QUICK
    )
    assert ended.code == 0
    assert files.metrics()["beads"]["mean"]["joint_error_raw_cm"] > 0.0
    assert "factor: 0.7" in (files.out / "config.yaml").read_text()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (None, "FILE: there is no such Python file"),
        ("x = 1\n", "FILE: the file registers no plug-in; decorate the class with @register"),
        ("import no_such_module\n", "FILE: ModuleNotFoundError: No module named 'no_such_module'"),
        ("def broken(:\n", "FILE: SyntaxError: invalid syntax"),
        ("raise RuntimeError('by design')\n", "FILE: RuntimeError: by design"),
    ],
)
def test_plugin_file_that_is_broken_is_told(regkit, files, tmp_path, text, expected):
    file = tmp_path / "mine.py"
    if text is not None:
        file.write_text(text)
    ended = regkit("run", files.experiment, "--out", files.out, "--plugin", file)
    assert ended.code == 1
    assert ended.err.replace(str(file), "FILE").startswith(f"error: {expected}")
    assert not files.out.exists()


@pytest.mark.slow
@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.yaml")), ids=lambda path: path.stem)
def test_example_runs_on_two_frames(regkit, tmp_path, request, path):
    """Every one whose data are shipped, or are among the reference data."""
    settings = ["--set", f"dataset.frames={FRAMES}"]
    if path.stem == "utd":
        data = request.getfixturevalue("reference_data") / "utd_mhad"
        settings += ["--set", f"dataset.root={data}", "--set", "dataset.sequences=[a1_s1_t1]"]
    ended = regkit("run", path, "--out", tmp_path / "out", *settings)
    assert ended.code == 0
    assert ended.err == ""
    methods = json.loads((tmp_path / "out" / "metrics.json").read_text())["methods"]
    for figures in methods.values():
        assert figures["mean"]["frames"] == FRAMES
        assert 0.0 < figures["mean"]["joint_error_raw_cm"] < 25.0


def test_only_keeps_what_other_methods_have_finished(regkit, files):
    add_method(files.experiment, "sog", "sog")
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    before = files.metrics()
    (files.out / "sog" / "first" / "measure.json").unlink()
    assert regkit("run", files.experiment, "--out", files.out, "--only", "sog", *QUICK).code == 0
    assert files.metrics()["gsog"] == before["gsog"]
    assert set(files.metrics()["sog"]["sequences"]) == {"first"}


def test_missing_camera_stops_only_its_own_sequence(regkit, files):
    (files.data / "first" / "camera.json").unlink()
    ended = regkit("run", files.experiment, "--out", files.out)
    assert ended.code == 1
    assert "camera.json: the file is missing" in ended.err
    sequences = files.metrics()["gsog"]["sequences"]
    assert "camera.json" in sequences["first"]["error"]
    assert sequences["second"]["frames"] is not None


def test_run_that_cannot_begin_leaves_no_folder(regkit, files):
    assert regkit("run", files.experiment, "--out", files.out, "--only", "nothing").code == 1
    assert not files.out.exists()


def test_resolved_configuration_can_be_run_again(regkit, files, tmp_path):
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    again = tmp_path / "again"
    assert regkit("run", files.out / "config.yaml", "--out", again).code == 0
    assert (again / "config.yaml").read_text() == (files.out / "config.yaml").read_text()


def test_fault_of_a_plugin_stops_only_its_own_method(regkit, files, tmp_path):
    path = tmp_path / "faulty.py"
    path.write_text(FAULTY.replace("pass  # Here it fails.", "raise KeyError('left_wing')"))
    add_method(files.experiment, "faulty", "faulty")
    ended = regkit("run", files.experiment, "--out", files.out, "--plugin", path, *QUICK)
    assert ended.code == 1
    assert "KeyError: 'left_wing'; this is a fault of the program or of a plug-in" in ended.err
    assert "left_wing" in (files.out / "faulty" / "first" / "error.txt").read_text()
    assert files.metrics()["gsog"]["sequences"]["first"]["frames"] == 1


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('    kind: Literal["faulty"] = "faulty"\n', "", "must declare its name"),
        ("    makes: ClassVar[type[Primitives]] = Gaussians\n", "", "class variable 'makes'"),
    ],
)
def test_plugin_that_declares_too_little_is_refused(regkit, files, tmp_path, old, new, expected):
    path = tmp_path / "faulty.py"
    path.write_text(FAULTY.replace(old, new))
    ended = regkit("run", files.experiment, "--out", files.out, "--plugin", path)
    assert ended.code == 1
    assert ended.err.startswith(f"error: {path}: ")
    assert expected in ended.err


FAULTY = """\
from typing import ClassVar, Literal

from regkit.interfaces import ShapeModel
from regkit.plugin import register
from regkit.primitives import Gaussians, Primitives


@register
class Faulty(ShapeModel):
    kind: Literal["faulty"] = "faulty"
    makes: ClassVar[type[Primitives]] = Gaussians

    def attach(self, body):
        pass  # Here it fails.
"""


def test_folder_that_cannot_be_written_is_told(regkit, files):
    ended = regkit("run", files.experiment, "--out", "/proc/nowhere")
    assert ended.code == 1
    assert ended.err.startswith("error: /proc/nowhere")
    assert "cannot be written" in ended.err


def test_table_names_the_units(regkit, files):
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
    for unit in ("raw [cm]", "near [%]", "surf. [mm]"):
        assert unit in ended.out


def test_start_that_does_not_fit_the_template_is_told_before_the_run(regkit, files):
    text = files.experiment.read_text().replace(
        "rotation_deg: [180, 0, 0]}", "rotation_deg: [180, 0, 0]}, joints: {left_shinn: 3}"
    )
    files.experiment.write_text(text)
    ended = regkit("run", files.experiment, "--out", files.out)
    assert ended.err.startswith(f"error: {files.experiment}:5: start: a pose turns 'left_shinn'")
    assert "did you mean 'left_shin'?" in ended.err
    assert not files.out.exists()


def test_damaged_sequence_that_is_not_used_is_not_read(regkit, files):
    (files.data / "second" / "sequence.yaml").write_text("fsp: 3\n")
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0


def test_sequences_without_reference_are_not_compared(regkit, files):
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK, "--set",
                   "dataset.compared=false")  # fmt: skip
    assert ended.code == 0
    assert files.metrics()["gsog"]["mean"]["joint_error_raw_cm"] is None


def test_start_far_from_the_data_is_an_error_and_no_result(regkit, files):
    text = files.experiment.read_text().replace("[-0.05, -0.05, 3.25]", "[0, 0, 900]")
    files.experiment.write_text(text)
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
    assert ended.code == 1
    assert "m away from the data; the start or the template's size is wrong" in ended.err
    assert files.metrics()["gsog"]["sequences"]["first"]["joint_error_raw_cm"] is None
