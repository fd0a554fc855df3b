"""Whoever writes a name of regkit 0.1 is answered with the name that it has now."""

import inspect
from collections.abc import Iterator

import numpy as np
import pytest
from small_experiment import QUICK

import regkit as package
from regkit.config.model import Model
from regkit.experiment import Experiment, Study
from regkit.interfaces import SLOTS, Preprocessor
from regkit.system.errors import ConfigError, PluginError

EXPERIMENT = """\
name: old
dataset: {kind: depth, root: nowhere}
template: human
methods:
  best: {preset: best}
  icp: {preset: icp}
"""


def models(base: type[Model] = Model) -> Iterator[type[Model]]:
    for model in base.__subclasses__():
        yield model
        yield from models(model)


def test_former_names_are_gone_and_new_ones_exist():
    for slot in SLOTS:
        for kind in slot.available():
            assert not {*slot.load(kind).formerly} & {*slot.available()}
    for model in models():
        assert not model.renamed.keys() & model.model_fields.keys(), model
        if not inspect.isabstract(model):
            assert {*model.renamed.values()} <= model.model_fields.keys(), model


def test_misspelt_former_name_is_answered_with_the_new_one(file):
    file.write_text(EXPERIMENT + "obsrver: points\n")
    told = refused(lambda: Experiment.read(file))
    assert "did you mean 'preprocessor'?" in told
    assert "observer" not in told


FIELDS = [
    ("observer", "preprocessor", "voxel", "0.03"),
    ("dataset.sequences", "recordings", None, "[a]"),
    ("methods.best.blur", "annealing", None, "[0.1, 0]"),
    ("methods.icp.kernel.reach", "max_correspondence_distance", None, "0.2"),
    ("methods.icp.kernel.way_back", "reverse_weight", None, "0.5"),
]
"""The path to an old field, its new name, a field within, and a value."""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "experiment.yaml"
    path.write_text(EXPERIMENT)
    return path


def refused(read) -> str:
    with pytest.raises(ConfigError) as caught:
        read()
    return str(caught.value)


def test_old_fields_of_a_file_are_answered_at_their_lines(file):
    lines = EXPERIMENT.replace("nowhere}", "nowhere, sequences: [a]}").splitlines()
    lines[4] = "  best: {preset: best, blur: [0.1, 0]}"
    lines[5] = "  icp: {preset: icp, kernel: {reach: 0.2}}"
    file.write_text("\n".join(lines))
    expected = (
        (2, "'sequences' is now called 'recordings'"),
        (5, "'blur' is now called 'annealing'"),
        (6, "'reach' is now called 'max_correspondence_distance'"),
    )
    told = refused(lambda: Experiment.read(file)).splitlines()
    for line, (number, answer) in zip(told, expected, strict=True):
        assert line.startswith(f"{file}:{number}: ")
        assert answer in line
    file.write_text(EXPERIMENT + "observer: points\n")
    told = refused(lambda: Experiment.read(file))
    assert told == f"{file}:7: observer: 'observer' is now called 'preprocessor'"


@pytest.mark.parametrize(("path", "new", "within", "value"), FIELDS)
def test_old_field_of_a_setting_or_a_sweep_is_answered_at_its_place(file, path, new, within, value):
    old, whole = path.rpartition(".")[2], f"{path}.{within}" if within else path
    setting = f"{whole}={value}"
    told = refused(lambda: Experiment.read(file, [setting]))
    assert told.startswith(f"setting {setting}: {path}: ")
    assert f"'{old}' is now called '{new}'" in told
    file.write_text(f"{EXPERIMENT}sweep: {{{whole}: [{value}]}}\n")
    told = refused(lambda: Study.read(file))
    assert told.startswith(f"{file}:7: ")
    assert f"'{old}' is now called '{new}'" in told


@pytest.mark.parametrize("setting", ["tracker=hold", "methods.best.tracker={kind: hold}"])
def test_old_kind_is_answered(file, setting):
    told = refused(lambda: Experiment.read(file, [setting]))
    assert "'hold' is now called 'constant_pose'" in told


def test_plug_in_of_an_old_group_is_told_by_who_names_it_and_by_the_doctor(
    regkit, distribution, files
):
    distribution("[regkit.observers]\nfoggy = foggy:Foggy\n", "foggy-things")
    with pytest.raises(PluginError) as caught:
        Preprocessor.load("foggy")
    told = str(caught.value)
    for word in ("'foggy'", "foggy-things 1.0", "'regkit.observers'", "'regkit.preprocessors'"):
        assert word in told
    ended = regkit(
        "run", files.experiment, "--out", files.out, *QUICK, "--set", "preprocessor=foggy"
    )
    assert ended.code == 1
    assert "'regkit.observers', which is now called 'regkit.preprocessors'" in ended.err
    ended = regkit("doctor")
    assert ended.code == 1
    assert "foggy-things" in ended.out
    assert "regkit.preprocessors" in ended.out


@pytest.mark.parametrize(
    ("arguments", "answer"),
    [
        (("calibrate", "a", "--sequence", "b"), "'--sequence' is now called '--recording'"),
        (("calibrate", "a", "--sequence=b"), "'--sequence' is now called '--recording'"),
        (("register", "a.ply", "b.ply", "--voxel", "1"), "'--voxel' is now called 'align --voxel'"),
    ],
)
def test_old_option_is_answered(regkit, arguments, answer):
    ended = regkit(*arguments)
    assert ended.code == 2
    assert answer in ended.err


def test_old_command_is_answered(regkit):
    ended = regkit("register", "a.ply", "b.ply")
    assert ended.code == 1
    assert "is now called 'align" in ended.err


def test_old_names_of_the_api_are_answered():
    with pytest.raises(AttributeError, match=r"'regkit\.load_sequence'.*'regkit\.load_recording'"):
        package.load_sequence  # noqa: B018
    points = np.zeros((10, 3))
    for function in (package.register, package.track):
        with pytest.raises(TypeError, match=r"'observer'.*'preprocessor'"):
            function(points, "human", observer="points")
