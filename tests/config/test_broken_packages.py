"""Packages that are broken on purpose: each harms only those who name it, and is named itself."""

import json

import pytest
from places import ROOT
from small_experiment import QUICK

from regkit.interfaces import SLOTS, ShapeModel, Solver

HEAD = '''
from typing import Any, ClassVar, Literal

from regkit.body import ellipsoids
from regkit.interfaces import ShapeModel
from regkit.primitives import Gaussians, Primitives


class Odd(ShapeModel):
    """A shape that is broken in one way."""

    kind: Literal["odd"] = "odd"
    makes: ClassVar[type[Primitives]] = Gaussians

    def bind(self, body):
        return Gaussians(*ellipsoids(body.shapes["gsog"]))
'''

MODULES = {
    "import_error": "import no_such_library\n",
    "exit": "import sys\nsys.exit(3)\n",
    "function": "def odd():\n    return None\n",
    "class_creation": HEAD.replace('"odd"\n    makes', '"odd"\n    loud: "odd" + 1 = 2\n    makes'),
    "unknown_type": HEAD.replace('"odd"\n    makes', '"odd"\n    loud: "Loudness" = 2\n    makes'),
    "no_kind": HEAD.replace('    kind: Literal["odd"] = "odd"\n', ""),
    "other_kind": HEAD.replace('"odd"', '"ev" "en"'),
    "no_makes": HEAD.replace("    makes: ClassVar[type[Primitives]] = Gaussians\n", ""),
    "makes_text": HEAD.replace("] = Gaussians\n", "] = 'Gaussians'\n"),
    "advised": "raise TypeError('nothing\\n\\nHow to mend it: not here')\n",
    "abstract": HEAD.replace("def bind", "def bound"),
    "syntax": "class Odd(\n",
}

EXPECTED = {
    "import_error": "cannot be imported: ModuleNotFoundError: No module named 'no_such_library'",
    "exit": "cannot be imported: it calls sys.exit(3)",
    "function": "is not a concrete ShapeModel: <function odd",
    "class_creation": "cannot be imported: TypeError",
    "unknown_type": "has a field of an unknown type in Odd: name 'Loudness' is not defined",
    "no_kind": 'must declare its name in Odd: kind: Literal["name"] = "name"',
    "other_kind": "calls itself 'even': Odd.kind must default to its entry-point name",
    "no_makes": "must declare the class variable 'makes' in Odd",
    "makes_text": "must set 'makes' to a class in Odd: 'Gaussians'",
    "advised": "cannot be imported: TypeError: nothing",
    "abstract": "is not a concrete ShapeModel: Odd does not define bind",
    "syntax": "cannot be imported: SyntaxError",
    "other_slot": "is not a concrete ShapeModel: <class 'regkit_plugins.solvers.lbfgs.LBFGS'>",
    "absent": "cannot be imported: AttributeError",
}


@pytest.fixture
def broken(distribution, tmp_path) -> dict[str, str]:
    """Install the distribution ``odd-things``, all of whose plug-ins are broken; what is told."""
    targets = {name: f"odd_{name}:{'odd' if name == 'function' else 'Odd'}" for name in EXPECTED}
    targets["other_slot"] = "regkit_plugins.solvers.lbfgs:LBFGS"
    targets["absent"] = "regkit.system.errors:Thing"
    lines = [f"{name} = {target}" for name, target in targets.items()]
    distribution("\n".join(["[regkit.shapes]", *lines]), "odd-things")
    for name, text in MODULES.items():
        text = text.replace('"odd"', f'"{name}"')
        (tmp_path / "odd-things" / f"odd_{name}.py").write_text(text)
    return {name: f"plug-in '{name}' of odd-things {told}" for name, told in EXPECTED.items()}


def test_broken_plugins_fail_only_when_they_are_named(regkit, files, broken):
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
    assert ended.code == 0, ended.err
    assert files.metrics()["gsog"]["mean"]["frames"] == 1
    text = files.experiment.read_text()
    for name, told in broken.items():
        files.experiment.write_text(text.replace("shape: gsog", f"shape: {name}"))
        ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
        assert ended.code == 1
        assert ended.err.startswith(f"error: {files.experiment}:8: methods.gsog.shape: {told}")
        assert "Traceback" not in ended.err


def test_broken_plugins_are_told_by_every_command(regkit, broken, monkeypatch, tmp_path):
    monkeypatch.setenv("COLUMNS", "400")
    listed, health = regkit("plugins"), regkit("doctor")
    written = regkit("schema", tmp_path / "schemas")
    assert (listed.code, health.code, written.code) == (0, 1, 0)
    files = ("experiment.json", "source.json", "alignment_start.json")
    schema = "".join((tmp_path / "schemas" / name).read_text() for name in files)
    for name, told in broken.items():
        (row,) = (line for line in listed.out.splitlines() if f" {name} " in line)
        assert f"broken: {told}" in row
        assert "odd-things 1.0" in row
        assert told in health.out
        assert f"left out: {told}" in written.err
        assert f'"{name}"' not in schema
    assert "reinstall or uninstall" in health.out
    for slot in SLOTS:
        for kind in slot.available():
            assert kind in broken or (f" {kind} " in listed.out and f'"{kind}"' in schema)
    assert regkit("schema", ROOT / "schemas", "--check").code == 0


def test_class_without_a_docstring_is_listed(regkit, distribution, tmp_path):
    distribution("[regkit.shapes]\nodd = odd_silent:Odd\n", "odd-things")
    silent = HEAD.replace('    """A shape that is broken in one way."""\n\n', "")
    (tmp_path / "odd-things" / "odd_silent.py").write_text(silent)
    ended = regkit("plugins")
    assert ended.code == 0
    (row,) = (line for line in ended.out.splitlines() if " odd " in line)
    assert "(its class has no docstring)" in row


def test_field_without_a_schema_leaves_out_its_plugin_alone(regkit, distribution, tmp_path):
    """A type that no YAML can hold: the plug-in works in Python, and its schema cannot be had."""
    distribution("[regkit.shapes]\nodd = odd_callable:Odd\n", "odd-things")
    field = '"odd"\n    how: __import__("collections").abc.Callable[[int], int] = abs\n    makes'
    (tmp_path / "odd-things" / "odd_callable.py").write_text(
        HEAD.replace('"odd"\n    makes', field)
    )
    assert ShapeModel.load("odd")().how is abs
    written = regkit("schema", tmp_path / "schemas")
    assert written.code == 0
    assert "left out: plug-in 'odd' of odd-things 1.0 has a field without" in written.err
    schema = json.loads((tmp_path / "schemas" / "experiment.json").read_text())
    assert '"gsog"' in json.dumps(schema)
    assert '"odd"' not in json.dumps(schema)


def test_name_that_two_distributions_claim_harms_only_those_who_use_it(
    regkit, distribution, files, tmp_path
):
    """Neither silently replaces the other, and the rest of the group is there."""
    distribution("[regkit.shapes]\nsog = elsewhere:Thing\n", "rival")
    told = (
        "plug-in 'sog' of regkit.shapes is provided by regkit "
        "(regkit_plugins.shapes.sog:SumOfGaussians) and rival (elsewhere:Thing); uninstall one of "
        "these distributions"
    )
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    ended = regkit("run", files.experiment, "--set", "methods.gsog.shape=sog", *QUICK)
    assert ended.code == 1
    assert told in ended.err
    table = regkit("plugins")
    assert table.code == 0
    listed = " ".join(table.out.split())
    assert "rival 1.0" in listed
    assert "regkit 0" in listed
    assert regkit("doctor").code == 1
    assert f"left out: {told.split(' is ')[0]}" in regkit("schema", tmp_path / "schemas").err


def test_distribution_that_is_seen_twice_is_no_rival_of_itself(distribution):
    entry = "[regkit.shapes]\ngsog = regkit_plugins.shapes.gsog:GeneralizedSumOfGaussians\n"
    distribution(entry, "regkit")
    assert ShapeModel.load("gsog")().kind == "gsog"


def test_broken_preset_is_told(regkit, distribution, files):
    distribution("[regkit.methods.presets]\nodd = no_such_presets:PATH\n", "odd-things")
    table = regkit("plugins")
    assert table.code == 0
    assert "broken: preset 'odd' of odd-things" in " ".join(table.out.split())
    assert "preset 'odd' of odd-things cannot be imported" in regkit("doctor").out
    ended = regkit("run", files.experiment, "--set", "methods.gsog={preset: odd}", *QUICK)
    assert ended.code == 1
    assert "preset 'odd' of odd-things cannot be imported: ModuleNotFoundError" in ended.err


def test_broken_solver_is_none_of_those_that_keep_limits(distribution):
    distribution("[regkit.solvers]\nodd = no_such_solvers:Odd\n", "odd-things")
    assert "ipopt" in Solver.keeping_limits()
    assert "odd" not in Solver.keeping_limits()


@pytest.mark.long
def test_committed_schemas_are_of_the_built_ins_alone(regkit, distribution, tmp_path):
    """Whatever else is installed where they are checked."""
    distribution("[regkit.trackers]\nstay = tracker_that_stays:Stay\n", "good")
    (tmp_path / "good" / "tracker_that_stays.py").write_text(STAYING)
    assert regkit("schema", tmp_path / "all").code == 0
    assert '"stay"' in (tmp_path / "all" / "experiment.json").read_text()
    assert regkit("schema", tmp_path / "all", "--check").code == 0
    assert regkit("schema", tmp_path / "all", "--check", "--built-in").code == 1
    assert regkit("schema", tmp_path / "own", "--built-in").code == 0
    for file in sorted((ROOT / "schemas").glob("*.json")):
        assert (tmp_path / "own" / file.name).read_text() == file.read_text()
    assert regkit("schema", ROOT / "schemas", "--check").code == 0
    assert regkit("schema", ROOT / "schemas", "--check", "--built-in").code == 0


STAYING = '''
from typing import Literal

from regkit.interfaces import BoundTracker, RegistrationResult, Tracker


class Staying(BoundTracker):
    """Gives back the start."""

    def step(self, observation, past):
        return RegistrationResult.given(past.last.pose)


class Stay(Tracker):
    """Never moves."""

    kind: Literal["stay"] = "stay"

    def bind(self, registrar):
        return Staying()
'''
