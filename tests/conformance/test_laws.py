"""The laws catch what they are for: each fault breaks its own, with a sentence that names it."""

import inspect
import os
import re
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from faults import KERNEL, KERNEL_FAULTS, SHAPE, SHAPE_FAULTS, SUPERQUADRIC

from regkit.config import registry as registered
from regkit.config.registry import run_plugin_file
from regkit.interfaces import ShapeModel
from regkit.registration.pose_problem import PoseProblem
from regkit.system.errors import PluginError
from regkit.testing import conformance
from regkit.testing.bound import Bound
from regkit.testing.cases import Case, Pair
from regkit.testing.kernel_laws import KernelLaws
from regkit.testing.laws import Laws
from regkit.testing.plugin_laws import PluginLaws
from regkit.testing.samples import linkage, lump
from regkit.testing.shape_laws import ShapeLaws
from regkit.testing.verdict import require, suspecting
from regkit_plugins.kernels.correlation import Correlation
from regkit_plugins.kernels.local_likelihood.local_likelihood import LocalLikelihood
from regkit_plugins.kernels.local_likelihood.rigid import LocalRigidSimilarity
from regkit_plugins.shapes.cloud_gsog import CloudGeneralizedSumOfGaussians
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians


@pytest.fixture(autouse=True)
def nothing_registered(monkeypatch):
    """What a test registers is gone after it."""
    monkeypatch.setattr(registered, "_REGISTERED", {})


def loaded(folder: Path, text: str, old: str = "", new: str = "") -> ModuleType:
    """A plug-in file with one place changed, as a module."""
    assert old in text
    file = folder / "faulty.py"
    file.write_text(text.replace(old, new))
    registered._REGISTERED.clear()
    run_plugin_file(file)
    (plugin,) = (one for plugins in registered._REGISTERED.values() for one in plugins.values())
    return sys.modules[plugin.__module__]


def random() -> np.random.Generator:
    return np.random.default_rng(7)


def tried(law: Callable[..., None], **arguments: object) -> None:
    """A law with those of the arguments that it takes."""
    law(**{name: arguments[name] for name in inspect.signature(law).parameters})


def shape_laws(faulty: ModuleType) -> dict[str, Callable[[], None]]:
    """The laws of plug-ins and of shapes for a module's shape, by name."""
    shape = faulty.Faulty()
    case = Case(ShapeModel, "faulty", "faulty", True, shape)
    return laws((PluginLaws, ShapeLaws), plugin=case, shape=shape, body=linkage(), random=random)


def kernel_laws(faulty: ModuleType) -> dict[str, Callable[[], None]]:
    """The laws of kernels for a module's kernel and shape, by name."""
    pair = Pair(faulty.RadialDistance(), faulty.Superquadric(), "faulty")

    def bound() -> Bound:
        return Bound.near(pair, linkage(), random())

    return laws(
        (KernelLaws,),
        pair=pair,
        bound=bound,
        smoothing=0.0,
        camera=False,
        body=linkage(),
        rigid_body=lump(),
        random=random,
    )


def laws(groups: tuple[type[Laws], ...], **arguments: Any) -> dict[str, Callable[[], None]]:
    """All laws of some groups; of the arguments, functions are called anew for each."""

    def law_of(test: Callable[..., None]) -> Callable[[], None]:
        def law() -> None:
            tried(test, **{n: v() if inspect.isfunction(v) else v for n, v in arguments.items()})

        return law

    return {
        name: law_of(getattr(group(), name))
        for group in groups
        for name in dir(group)
        if name.startswith("test_")
    }


def test_what_is_right_keeps_all_laws(tmp_path):
    for law in shape_laws(loaded(tmp_path, SHAPE)).values():
        law()
    for law in kernel_laws(loaded(tmp_path, KERNEL)).values():
        # A law of what a kernel need not have is skipped.
        with suppress(pytest.skip.Exception):
            law()


@pytest.mark.parametrize("fault", SHAPE_FAULTS)
def test_faulty_shape_breaks_its_law(tmp_path, fault):
    old, new, law, expected = SHAPE_FAULTS[fault]
    with pytest.raises(pytest.fail.Exception, match=re.escape(expected)) as caught:
        shape_laws(loaded(tmp_path, SHAPE, old, new))[law]()
    assert f"{tmp_path / 'faulty.py'}:" in str(caught.value)


@pytest.mark.parametrize("fault", KERNEL_FAULTS)
def test_faulty_kernel_breaks_its_law(tmp_path, fault):
    old, new, law, expected = KERNEL_FAULTS[fault]
    with pytest.raises(pytest.fail.Exception, match=re.escape(expected)) as caught:
        kernel_laws(loaded(tmp_path, KERNEL, old, new))[law]()
    assert str(caught.value).startswith("kernel 'radial_faulty' ")
    assert f" ({tmp_path / 'faulty.py'}:" in str(caught.value)


def test_law_names_the_one_under_test_first(tmp_path):
    """A built-in kernel is seldom at fault when it fails with the shape of another's package."""
    faulty = loaded(tmp_path, SHAPE).Faulty
    made = conformance(faulty).parameters["pair"]
    assert made
    for pair in made:
        assert pair.suspect is pair.shape
        assert pair.name.startswith("faulty-")
    with pytest.raises(pytest.fail.Exception) as caught, suspecting(made[0].suspect):
        require(False, Correlation(), "is odd", look_at=Correlation)
    first, _, second = str(caught.value).partition("kernel 'correlation' is odd")
    assert first.startswith("shape 'faulty' ")
    assert f"({tmp_path / 'faulty.py'}:" in first
    assert "correlation.py:" in second


def test_problem_that_takes_an_array_for_its_point_breaks_the_law_of_steps(monkeypatch):
    pose, last = PoseProblem._pose, []

    def remembered(self, x):
        if not (last and last[0] is x):
            last[:] = x, pose(self, x)
        return last[1]

    monkeypatch.setattr(PoseProblem, "_pose", remembered)
    pair = Pair(Correlation(), GeneralizedSumOfGaussians(), "correlation-gsog")
    with pytest.raises(pytest.fail.Exception, match="after a step in place"):
        KernelLaws().test_kernel_answers_for_the_point_after_a_step_in_place(
            Bound.near(pair, linkage(), random()), random()
        )


@pytest.mark.parametrize(
    ("fault", "expected"),
    [
        (lambda one: replace(one, energy=1.01 * one.energy), "for a rigid body but"),
        (lambda one: replace(one, wrenches=-one.wrenches), "has a wrench of a rigid body that"),
        (lambda one: replace(one, stiffness=2.0 * one.stiffness), "has a block of a rigid body"),
        (lambda one: replace(one, stiffness=None), "or for its primitives alone"),
    ],
)
def test_rigid_form_that_differs_breaks_its_law(monkeypatch, fault, expected):
    answer = LocalRigidSimilarity.__call__
    monkeypatch.setattr(LocalRigidSimilarity, "__call__", lambda *given: fault(answer(*given)))
    pair = Pair(LocalLikelihood(), CloudGeneralizedSumOfGaussians(), "local_likelihood-cloud_gsog")
    with pytest.raises(pytest.fail.Exception, match=expected):
        KernelLaws().test_kernel_of_a_rigid_body_sums_over_its_primitives(pair, lump(), random())


def test_law_is_checked_once_for_each_class_unless_it_says_otherwise():
    suite = conformance("regkit", examples={"likelihood": [{}, {"outliers": 0.2}]})
    for argument, cases in suite.parameters.items():
        first = [case.plugin for case in cases if case.scope == "class" and case.plugin]
        assert len({type(plugin) for plugin in first}) == len(first), argument
    classes = {(type(pair.plugin), type(pair.shape)) for pair in suite.parameters["pair"]}
    pairs = [pair for pair in suite.parameters["pair"] if pair.scope != "option"]
    assert {(type(pair.plugin), type(pair.shape)) for pair in pairs} == classes
    assert len(pairs) == len(classes)


def test_broken_plugin_fails_the_law_of_loading():
    case = Case(ShapeModel, "odd", "odd", True, broken="plug-in 'odd' of odd-things is broken")
    with pytest.raises(pytest.fail.Exception, match="'odd' of odd-things is broken"):
        PluginLaws().test_plugin_can_be_loaded(case)


def test_plugin_with_required_fields_is_skipped_with_the_reason():
    suite = conformance("regkit")
    (case,) = (case for case in suite.parameters["dataset"] if case.kind == "depth")
    assert case.missing == ("root",)


def test_unknown_distribution_is_told_with_those_that_there_are():
    with pytest.raises(PluginError, match=r"'regkit-supper' provides a plug-in \(there are"):
        conformance("regkit-supper")


def test_class_that_is_not_registered_is_refused():
    with pytest.raises(PluginError, match="Thing is not registered"):
        conformance(type("Thing", (ShapeModel,), {"__module__": __name__}))


def test_registered_class_has_a_suite_of_its_own(tmp_path):
    suite = conformance(loaded(tmp_path, SHAPE).Faulty)
    assert [case.name for case in suite.parameters["plugin"]] == ["faulty"]
    assert [case.name for case in suite.parameters["shape"]] == ["faulty"]
    assert all(pair.shape.kind == "faulty" for pair in suite.parameters["pair"])
    assert "solver" not in suite.parameters
    assert not any(name.startswith("test_solver") for name in dir(suite))


def test_partner_whose_defaults_do_not_fit_does_not_end_the_tests_of_others(tmp_path):
    loaded(tmp_path, SHAPE, "width: float = 0.5", 'width: float = "wide"')
    suite = conformance("regkit-superquadric")
    assert [case.name for case in suite.parameters["shape"]] == ["superquadric"]
    (case,) = conformance(registered._REGISTERED["regkit.shapes"]["faulty"]).parameters["plugin"]
    with pytest.raises(pytest.fail.Exception, match=r"are invalid \(width: Input should"):
        PluginLaws().test_plugin_can_be_loaded(case)


def test_example_that_does_not_fit_is_told():
    with pytest.raises(PluginError, match=r"the example of solvers.lbfgs is invalid"):
        conformance("regkit", examples={"lbfgs": {"max_iterations": -1}})


@pytest.mark.long
def test_wrong_gradient_of_an_installed_package_is_named(tmp_path):
    """In a process of its own, as its author would run it."""
    text = SUPERQUADRIC.read_text().replace("superquadric", "oddquadric")
    text = text.replace("radial_distance", "odd_distance").replace(
        "part, gradients)", "part, -gradients)"
    )
    (tmp_path / "oddquadric.py").write_text(text)
    info = tmp_path / "regkit_oddquadric-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: regkit-oddquadric\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(
        "[regkit.shapes]\noddquadric = oddquadric:Superquadric\n"
        "[regkit.kernels]\nodd_distance = oddquadric:RadialDistance\n"
        "[regkit.terms]\nodd = no_such_terms:Odd\n"
    )
    suite = 'from regkit.testing import conformance\n\nTest = conformance("regkit_oddquadric")\n'
    (tmp_path / "test_odd.py").write_text(suite)
    ended = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "no:dash",
         "-k", "loaded or gradient", str(tmp_path / "test_odd.py")],
        env={**os.environ, "PYTHONPATH": str(tmp_path)}, cwd=tmp_path,
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ended.returncode == 1
    assert "kernel 'odd_distance' has a gradient that is not the derivative" in ended.stdout
    assert "plug-in 'odd' of regkit-oddquadric cannot be imported" in ended.stdout
    assert "test_plugin_can_be_loaded[terms.odd]" in ended.stdout
    assert "Error" not in ended.stdout.replace("ModuleNotFoundError", "")


def test_shape_that_no_kernel_takes_is_told(tmp_path):
    lonely = loaded(tmp_path, SHAPE, "] = Gaussians\n", "] = Primitives\n").Faulty
    suite = conformance(lonely)
    (case,) = suite.parameters["shape"]
    with pytest.raises(pytest.fail.Exception, match="makes Primitives, which no installed kernel"):
        suite().test_shape_has_a_kernel_that_compares_it(case.plugin)


def test_suite_without_pytest_says_what_to_install():
    program = (
        "import sys; sys.modules['pytest'] = None\n"
        "from regkit.system.errors import DependencyError\n"
        "try:\n    import regkit.testing\nexcept DependencyError as error:\n    print(error)\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False
    )
    assert "pytest is not installed" in ended.stdout
    assert "pip install" in ended.stdout
    assert "regkit[testing]" in ended.stdout
