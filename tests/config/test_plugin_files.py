"""Plug-ins of a user's own, in a file."""

import runpy

import numpy as np
import pytest
from places import EXAMPLES
from small_experiment import QUICK, add_method

from regkit.config.registry import run_plugin_file
from regkit.interfaces import Prior, Scene, ShapeModel, Term

SHAPE = '''
from typing import ClassVar, Literal

import numpy as np

from regkit.interfaces import ShapeModel
from regkit.config.plugin import register
from regkit.primitives import Gaussians, Primitives


@register
class Beads(ShapeModel):
    """One Gaussian in the middle of each capsule."""

    kind: Literal["beads"] = "beads"
    makes: ClassVar[type[Primitives]] = Gaussians

    factor: float = 0.5
    """Standard deviation over the capsule's radius."""

    def bind(self, body):
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
FAULTY = """\
from typing import ClassVar, Literal

from regkit.interfaces import ShapeModel
from regkit.config.plugin import register
from regkit.primitives import Gaussians, Primitives


@register
class Faulty(ShapeModel):
    kind: Literal["faulty"] = "faulty"
    makes: ClassVar[type[Primitives]] = Gaussians

    def bind(self, body):
        pass  # Here it fails.
"""


def test_shape_of_a_plugin_file_is_run(regkit, files, tmp_path):
    file = tmp_path / "beads.py"
    file.write_text(SHAPE)
    add_method(files.experiment, "beads", "{kind: beads, factor: 0.7}")
    refused = regkit("run", files.experiment, "--out", files.out, "--no-figures")
    assert refused.code == 1
    installed = ", ".join(ShapeModel.available())
    assert f"no plug-in 'beads' in regkit.shapes (installed: {installed})" in refused.err
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
        (
            "import no_such_module\n",
            "FILE:1: ModuleNotFoundError: No module named 'no_such_module'",
        ),
        ("def broken(:\n", "FILE:1: SyntaxError: invalid syntax"),
        ("raise RuntimeError('by design')\n", "FILE:1: RuntimeError: by design"),
    ],
)
def test_plugin_file_that_is_broken_is_told(regkit, files, tmp_path, text, expected):
    file = tmp_path / "mine.py"
    if text is not None:
        file.write_text(text)
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures", "--plugin", file)
    assert ended.code == 1
    assert ended.err.replace(str(file), "FILE").startswith(f"error: {expected}")
    assert not files.out.exists()


def test_fault_of_a_plugin_stops_only_its_own_method(regkit, files, tmp_path):
    path = tmp_path / "faulty.py"
    path.write_text(FAULTY.replace("pass  # Here it fails.", "raise KeyError('left_wing')"))
    add_method(files.experiment, "faulty", "faulty")
    ended = regkit("run", files.experiment, "--out", files.out, "--plugin", path, *QUICK)
    assert ended.code == 1
    assert "KeyError: 'left_wing'; this is a bug" in ended.err
    assert "left_wing" in (files.out / "faulty" / "first" / "error.txt").read_text()
    assert files.metrics()["gsog"]["recordings"]["first"]["frames"] == 1


def test_plugin_that_ends_the_program_stops_only_its_own_method(regkit, files, tmp_path):
    path = tmp_path / "faulty.py"
    path.write_text(FAULTY.replace("pass  # Here it fails.", "raise SystemExit(0)"))
    add_method(files.experiment, "faulty", "faulty")
    ended = regkit("run", files.experiment, "--out", files.out, "--plugin", path, *QUICK)
    assert ended.code == 1
    assert "sys.exit(0)" in ended.err
    assert f"{path}:" in ended.err
    assert "sys.exit(0)" in files.metrics()["faulty"]["recordings"]["first"]["error"]
    assert files.metrics()["gsog"]["recordings"]["first"]["frames"] == 1


@pytest.mark.parametrize(
    ("text", "line", "expected"),
    [
        ("import sys\n\nsys.exit(0)\n", 3, "sys.exit(0)"),
        ("class Odd(BaseException): pass\nraise Odd('x')\n", 2, "Odd: x"),
        (
            "class Odd(BaseException):\n    def __str__(self): raise ValueError\nraise Odd\n",
            3,
            "Odd",
        ),
        ("import nothing_of_this_name\n", 1, "ModuleNotFoundError"),
        ("def f(:\n", 1, "SyntaxError"),
        ("x = 1\n", None, "@register"),
        ("\0", None, "null bytes"),
    ],
)
def test_plugin_file_that_fails_is_told_with_its_line(regkit, tmp_path, text, line, expected):
    path = tmp_path / "own.py"
    path.write_text(text)
    ended = regkit("plugins", "--plugin", path)
    assert ended.code == 1
    assert ended.err.startswith(f"error: {path}:{line}: " if line else f"error: {path}: ")
    assert expected in ended.err


def test_odd_exception_of_a_validator_names_the_plug_in_and_its_line(regkit, files, tmp_path):
    path = tmp_path / "odd.py"
    path.write_text(
        "from pydantic import field_validator\n"
        + FAULTY
        + "\n    @field_validator('kind')\n    @classmethod\n    def _odd(cls, kind):\n"
        "        return {}[kind]\n"
    )
    add_method(files.experiment, "faulty", "faulty")
    ended = regkit("run", files.experiment, "--out", files.out, "--plugin", path)
    assert ended.code == 1
    assert ended.err.startswith(f"error: {files.experiment}:")
    assert "KeyError" in ended.err
    assert f"'faulty' fails at {path}:" in ended.err


@pytest.mark.parametrize("name", ["own.txt", "nothing.py", "."])
def test_plugin_file_that_is_none_is_refused(regkit, tmp_path, name):
    (tmp_path / "own.txt").write_text("x = 1\n")
    ended = regkit("plugins", "--plugin", tmp_path / name)
    assert ended.code == 1
    assert "Python file" in ended.err


def test_end_of_the_program_in_a_command_is_an_error(regkit, tmp_path):
    path = tmp_path / "own.py"
    path.write_text(FAULTY.replace("pass  # Here it fails.", "raise SystemExit(0)"))
    ended = regkit(
        "register", EXAMPLES / "data" / "human_walk", "--plugin", path,
        "--template", "{kind: human, height: 1.7}", "--method",
        "{kind: direct, shape: faulty, kernel: correlation, solver: lbfgs}",
    )  # fmt: skip
    assert ended.code == 1
    assert ended.err.startswith(f"error: {path}:")


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
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures", "--plugin", path)
    assert ended.code == 1
    assert ended.err.startswith(f"error: {path}:")
    assert expected in ended.err


@pytest.mark.parametrize(
    ("file", "method"),
    [
        ("dumbbells.py", "{kind: direct, shape: dumbbells, kernel: correlation, solver: lbfgs}"),
        ("upright.py", "{preset: best, terms: [visibility, free_space, upright]}"),
    ],
)
def test_plug_in_of_the_how_to_pages_runs(regkit, files, file, method):
    ended = regkit(
        "run", files.experiment, "--out", files.out, "--no-figures", "--plugin", EXAMPLES / file,
        "--set", f"methods.mine={method}", "--only", "mine", *QUICK,
    )  # fmt: skip
    assert ended.code == 0, ended.err
    assert files.metrics()["mine"]["mean"]["frames"] == 1


def test_term_of_the_how_to_page_has_the_derivative_that_it_claims(linkage, random):
    run_plugin_file(EXAMPLES / "upright.py")
    bones = linkage.skeleton
    pose = bones.retract(bones.rest(), random.normal(size=bones.dofs))
    energy = Term.load("upright")().bind(Scene(linkage, None, Prior(pose), None))
    numerical = [
        energy(bones.retract(pose, 1e-6 * e)).energy - energy(bones.retract(pose, -1e-6 * e)).energy
        for e in np.eye(bones.dofs)
    ]
    np.testing.assert_allclose(energy(pose).force, np.array(numerical) / 2e-6, atol=1e-8)


def test_hand_of_the_how_to_page_touches_the_table(capsys):
    distances = runpy.run_path(str(EXAMPLES / "touching_hand.py"))["main"]()
    assert abs(distances["touching"]) < 1e-6
    # Without the constraint the data, which show no index finger, do not bring it there.
    assert abs(distances["free"]) > 0.005
    assert capsys.readouterr().out.count("Solve_Succeeded") == 2


def test_field_that_no_yaml_can_hold_is_named_before_anything_is_run(regkit, files, tmp_path):
    file = tmp_path / "beads.py"
    file.write_text(SHAPE.replace("factor: float = 0.5", "factor: __import__('typing').Any = abs"))
    files.experiment.write_text(files.experiment.read_text().replace("gsog,", "beads,"))
    ended = regkit("run", files.experiment, "--out", files.out, "--plugin", file, *QUICK)
    assert ended.code == 1
    assert ended.err.startswith("error: methods.gsog.shape.factor: it cannot be written to config")
    assert not (files.out / "config.yaml").exists()
