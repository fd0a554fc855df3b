"""The laws catch what they are for: each fault breaks its own, with a sentence that names it."""

import inspect
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from regkit import plugin
from regkit.errors import PluginError
from regkit.interfaces import ShapeModel
from regkit.plugin import run_plugin_file
from regkit.testing import conformance
from regkit.testing.bound import Bound
from regkit.testing.cases import Case, Pair
from regkit.testing.kernel_laws import KernelLaws
from regkit.testing.laws import Laws
from regkit.testing.plugin_laws import PluginLaws
from regkit.testing.samples import linkage
from regkit.testing.shape_laws import ShapeLaws

SUPERQUADRIC = (
    Path(__file__).parents[1]
    / "third_party" / "regkit-superquadric" / "src" / "regkit_superquadric.py"
)  # fmt: skip

SHAPE = '''
from collections.abc import Callable
from typing import ClassVar, Literal

import numpy as np

from regkit.interfaces import ShapeModel
from regkit.plugin import register
from regkit.primitives import Gaussians, Primitives
from regkit.rotation import between


@register
class Faulty(ShapeModel):
    """A ball about each capsule."""

    kind: Literal["faulty"] = "faulty"
    makes: ClassVar[type[Primitives]] = Gaussians

    width: float = 0.5
    """A part of the radius."""

    def attach(self, body):
        capsules = body.capsules
        radii = capsules.radii.mean(axis=1)
        return Gaussians(
            segments=capsules.segments,
            centres=capsules.ends.mean(axis=1),
            axes=np.tile(np.eye(3), (len(radii), 1, 1)),
            scales=np.tile(self.width * radii[:, None], (1, 3)),
            weights=np.ones(len(radii)),
        )
'''

SHAPE_FAULTS = {
    "covers": (
        "capsules = body.capsules\n",
        "capsules = body.capsules.some(body.capsules.segments != 1)\n",
        "test_shape_covers_every_segment",
        "shape 'faulty' leaves segments without a primitive: arm; look at",
    ),
    "place": (
        "centres=capsules.ends.mean(axis=1)",
        "centres=capsules.ends.mean(axis=1)[::-1]",
        "test_shape_lies_where_its_segments_are",
        "m outside of its segment 'base'; centres are given in the frame of the segment",
    ),
    "random": (
        "centres=capsules.ends.mean(axis=1)",
        "centres=capsules.ends.mean(axis=1) + 0.01 * np.random.default_rng().normal(size=(1, 3))",
        "test_shape_is_deterministic_and_leaves_the_body_alone",
        "shape 'faulty' makes something else when it is attached again",
    ),
    "writes": (
        "radii = capsules.radii.mean(axis=1)",
        "capsules.radii[:] *= 1.01; radii = capsules.radii.mean(axis=1)",
        "test_shape_is_deterministic_and_leaves_the_body_alone",
        "shape 'faulty' ",
    ),
    "axes": (
        "np.tile(np.eye(3),",
        "np.tile(np.diag([1.0, 1.0, -1.0]),",
        "test_shape_makes_what_it_says",
        "shape 'faulty' makes axes that are no rotations",
    ),
    "transposed": (
        "axes=np.tile(np.eye(3), (len(radii), 1, 1)),\n"
        "            scales=np.tile(self.width * radii[:, None], (1, 3)),",
        "axes=np.array([between(np.eye(3)[1], b - a).T for a, b in capsules.ends]),\n"
        "            scales=[0.5, 1.5, 0.5] * radii[:, None],",
        "test_shape_has_its_axes_as_columns",
        "with the axes transposed; the columns are a primitive's own axes",
    ),
    "scaled": (
        "@register\nclass Faulty",
        '''class Gaussians(Gaussians):
    """Gaussians that do not grow."""

    def scaled(self, factor):
        from dataclasses import replace

        return replace(self, centres=factor * self.centres)


@register
class Faulty''',
        "test_shape_stays_in_its_place_when_scaled",
        "shape 'faulty' has primitives whose scaled() leaves scales behind, by",
    ),
    "not written": (
        "width: float = 0.5",
        "width: float = 0.5\n    how: Callable[[int], int] = abs",
        "test_plugin_round_trips_through_yaml",
        "shape 'faulty' has a field that cannot be written as YAML (Unable to serialize",
    ),
    "other type": (
        "return Gaussians(",
        "return dict(",
        "test_shape_covers_every_segment",
        "shape 'faulty' declares makes = Gaussians, but makes dict; look at",
    ),
    "class docstring": (
        '    """A ball about each capsule."""\n',
        "",
        "test_plugin_is_documented",
        "shape 'faulty' has no docstring",
    ),
    "field docstring": (
        '    """A part of the radius."""\n',
        "",
        "test_plugin_is_documented",
        "shape 'faulty' has fields without a docstring below them: width",
    ),
    "world": (
        "@register\nclass Faulty",
        '''class Gaussians(Gaussians):
    """Gaussians that forget to turn."""

    def place(self, transforms):
        from dataclasses import replace

        return replace(super().place(transforms), axes=self.axes)


@register
class Faulty''',
        "test_shape_moves_with_the_body",
        "shape 'faulty' does not turn with the body: place(G T) differs from G place(T) by",
    ),
}  # fmt: skip

KERNEL = (
    SUPERQUADRIC.read_text()
    .replace('"superquadric"', '"faulty"')
    .replace('"radial_distance"', '"radial_faulty"')
    .replace("class RadialDistance(", "@register\nclass RadialDistance(")
    .replace("from regkit.primitives", "from regkit.plugin import register\nfrom regkit.primitives")
)

KERNEL_FAULTS = {
    "torque": (
        "-np.concatenate([normals, turns]",
        "-np.concatenate([normals, -turns]",
        "test_kernel_gradient_is_the_derivative_of_its_energy",
        "(the forces are right, so it is the torques)",
    ),
    "sign": (
        "-np.concatenate([normals, turns]",
        "np.concatenate([normals, turns]",
        "test_kernel_gradient_is_the_derivative_of_its_energy",
        "(all signs are wrong: it must point uphill)",
    ),
    "blocks": (
        "pulls[:, None, None] * rows",
        "1e-3 * pulls[:, None, None] * rows",
        "test_kernel_blocks_fit_its_forces",
        "has blocks that are too soft",
    ),
    "stiff": (
        "pulls[:, None, None] * rows",
        "1e3 * pulls[:, None, None] * rows",
        "test_kernel_blocks_fit_its_forces",
        "has blocks that are too stiff",
    ),
    "negative": (
        "pulls[:, None, None] * rows",
        "-pulls[:, None, None] * rows",
        "test_kernel_blocks_are_symmetric_and_semidefinite",
        "clip the weights of residuals at zero",
    ),
    "where": (
        "energy = 0.5 * float(",
        "energy = placed.centres[0, 0] + 0.5 * float(",
        "test_kernel_is_left_alone_by_a_common_motion",
        "when body and data are moved together",
    ),
    "unweighted": (
        "observation.weights / observation.weights.sum()",
        "np.full(len(self._points), 1.0 / len(self._points))",
        "test_kernel_takes_a_point_of_twice_the_weight_for_two",
        "does not weigh the data: of what a second point in the same place does to its forces, "
        "twice the weight leaves 100 % undone",
    ),
    "maximum": (
        "return Response(energy, wrenches,",
        "return Response(-energy, -wrenches,",
        "test_kernel_prefers_the_body_where_the_data_are",
        "prefers a body 0.1 m beside its data",
    ),
}


@pytest.fixture(autouse=True)
def registry(monkeypatch):
    """What a test registers is gone after it."""
    monkeypatch.setattr(plugin, "_REGISTERED", {})


def loaded(folder: Path, text: str, old: str = "", new: str = "") -> ModuleType:
    """A plug-in file with one place changed, as a module."""
    assert old in text
    file = folder / "faulty.py"
    file.write_text(text.replace(old, new))
    plugin._REGISTERED.clear()
    run_plugin_file(file)
    (registered,) = (one for plugins in plugin._REGISTERED.values() for one in plugins.values())
    return sys.modules[registered.__module__]


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
        (KernelLaws,), pair=pair, bound=bound, blur=0.0, camera=False, body=linkage(), random=random
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
    assert f"RadialDistances.__call__ ({tmp_path / 'faulty.py'}:" in str(caught.value)


def test_broken_plugin_fails_the_law_of_loading():
    case = Case(ShapeModel, "odd", "odd", True, broken="plug-in 'odd' of odd-things is broken")
    with pytest.raises(pytest.fail.Exception, match="'odd' of odd-things is broken"):
        PluginLaws().test_plugin_can_be_loaded(case)


def test_plugin_with_required_fields_is_skipped_with_the_reason():
    suite = conformance("regkit")
    (case,) = (case for case in suite.parameters["dataset"] if case.kind == "depth")
    assert case.missing == ("root",)


def test_unknown_distribution_is_told_with_those_that_there_are():
    with pytest.raises(PluginError, match=r"'regkit-supper' brings a plug-in \(there are: regkit"):
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
    (case,) = conformance(plugin._REGISTERED["regkit.shapes"]["faulty"]).parameters["plugin"]
    with pytest.raises(pytest.fail.Exception, match=r"do not fit \(width: Input should"):
        PluginLaws().test_plugin_can_be_loaded(case)


def test_example_that_does_not_fit_is_told():
    with pytest.raises(PluginError, match=r"the example of solvers.lbfgs does not fit"):
        conformance("regkit", examples={"lbfgs": {"max_iterations": -1}})


@pytest.mark.slow
def test_wrong_gradient_of_an_installed_package_is_named(tmp_path):
    """In a process of its own, as its author would run it."""
    text = SUPERQUADRIC.read_text().replace("superquadric", "oddquadric")
    text = text.replace("radial_distance", "odd_distance").replace(
        "-np.concatenate", "np.concatenate"
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
        "from regkit.errors import DependencyError\n"
        "try:\n    import regkit.testing\nexcept DependencyError as error:\n    print(error)\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False
    )
    assert "pytest" in ended.stdout
    assert ended.stdout.endswith("run: pip install 'regkit[testing]'\n")
