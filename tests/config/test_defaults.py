"""Defaults that distributions declare, and the one way from data to a plug-in."""

import subprocess
import sys

import pytest

from regkit.config.document import Document
from regkit.experiment import Experiment
from regkit.interfaces import Method, Preprocessor, Solver, Template, Tracker
from regkit.system.errors import ConfigError, PluginError
from regkit_plugins.templates.hand import Hand


@pytest.mark.parametrize("slot", [Method, Preprocessor, Solver, Template, Tracker])
def test_default_is_a_plugin_of_the_slot(slot):
    assert isinstance(slot.parse(slot.default(), place="here", field="it"), slot)


def test_default_takes_fields_and_purposes():
    data = Preprocessor.default(voxel=0.5)
    assert Preprocessor.parse(data, place="here", field="it").voxel == 0.5
    assert Method.default("rigid") != Method.default()


def test_defaults_are_looked_up_without_importing_a_plugin():
    code = (
        "import sys; from regkit.interfaces import Method, Tracker; Method.default(); "
        "Tracker.default(); assert 'regkit_plugins' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_default_that_nobody_declares_is_told():
    with pytest.raises(PluginError, match=r"trackers\.live"):
        Tracker.default("live")


@pytest.mark.parametrize("value", ["kernels_of_none:No", "regkit_plugins.solvers.lbfgs:LBFGS"])
def test_default_must_be_a_plugin_of_its_group(distribution, value):
    distribution(f"[regkit.defaults]\ntrackers.live = {value}\n")
    with pytest.raises(PluginError, match=r"trackers\.live"):
        Tracker.default("live")


def test_default_of_two_distributions_is_told(distribution):
    value = "regkit_plugins.trackers.constant_velocity:ConstantVelocity"
    distribution(f"[regkit.defaults]\ntrackers = {value}\n", "rival")
    with pytest.raises(PluginError, match="rival"):
        Tracker.default()


def test_experiment_takes_the_defaults():
    data = {
        "name": "defaults",
        "dataset": {"kind": "depth", "root": "nowhere"},
        "template": "human",
        "methods": {"one": Method.default()},
    }
    experiment = Document(data, {(): "here"}).validated(Experiment)
    assert experiment.tracker.kind == Tracker.default()["kind"]
    assert experiment.preprocessor.kind == Preprocessor.default()["kind"]


def test_choices_of_every_form_are_the_same_plugin():
    hand = Hand(side="left")
    forms = ({"kind": "hand", "side": "left"}, hand)
    assert [Template.parse(form, place="here", field="template") for form in forms] == [hand, hand]
    assert Template.parse("hand", place="here", field="template") == Hand()


def test_mistake_is_told_with_its_place_and_field():
    with pytest.raises(ConfigError, match=r"here: template\.sid: .*did you mean 'side'"):
        Template.parse({"kind": "hand", "sid": "left"}, place="here", field="template")
    with pytest.raises(ConfigError, match=r"here: method: .*did you mean 'best'"):
        Method.parse("bst", place="here", field="method")
    with pytest.raises(ConfigError, match="here: tracker"):
        Tracker.parse(3, place="here", field="tracker")
