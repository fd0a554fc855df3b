"""The laws of solvers, datasets, sources and templates catch faults in packages made wrong."""

import importlib
import re
from collections.abc import Callable
from typing import Any
from zlib import crc32

import numpy as np
import pytest

from regkit.scaffold import Scaffold
from regkit.testing.dataset_laws import FRAMES, DatasetLaws
from regkit.testing.problems import bowl
from regkit.testing.solver_laws import SolverLaws
from regkit.testing.source_laws import SourceLaws, frames_at_start
from regkit.testing.template_laws import TemplateLaws


@pytest.fixture
def faulty(tmp_path, monkeypatch) -> Callable[..., Any]:
    """Makes the plug-in of a new package in which one place of a file is changed."""

    def make(what: str, file: str, old: str, new: str, **options: object) -> Any:
        # A module of each name is imported once.
        name = f"faulty_{crc32((old + new).encode())}"
        scaffold = Scaffold(what, name)
        source = scaffold.write(tmp_path) / "src"
        path = source / scaffold.module / file.replace("NAME", name)
        assert old in path.read_text()
        path.write_text(path.read_text().replace(old, new))
        monkeypatch.syspath_prepend(str(source))
        module = importlib.import_module(f"{scaffold.module}.{what}")
        return getattr(module, f"{name.title().replace('_', '')}{what.title()}")(**options)

    return make


def refusal(law: Callable[[], None], expected: str) -> None:
    with pytest.raises(pytest.fail.Exception, match=re.escape(expected)) as caught:
        law()
    assert "; look at regkit_faulty_" in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "law", "expected"),
    [
        ("np.clip(x - length / size * gradient, problem.lower, problem.upper)",
         "x - length / size * gradient",
         lambda laws, made:
            laws.test_solver_stays_in_the_box_and_is_never_worse_than_the_start(made, bowl, 0.01),
         "leaves the box of bowl by"),
        ("if trial_value < value and", "if trial_value == trial_value or",
         lambda laws, made: laws.test_solver_returns_the_best_point_that_it_saw(made),
         "saw the value"),
        ("            evaluations += 1\n", "",
         lambda laws, made: laws.test_solver_returns_the_best_point_that_it_saw(made),
         "reports 1 evaluations of"),
        ("if not (np.isfinite(value) and np.isfinite(gradient).all())", "if False",
         lambda laws, made: laws.test_solver_refuses_a_start_that_is_not_finite(made, np.nan, 1.0),
         "it must raise a DataError"),
        ("x - length / size * gradient", "x + length / size * gradient",
         lambda laws, made: laws.test_solver_makes_a_quadratic_small(made),
         "reduces a quadratic only from"),
    ],
    ids=["box", "best", "count", "finite", "uphill"],
)  # fmt: skip
def test_faulty_solver_breaks_its_law(faulty, old, new, law, expected):
    made = faulty("solver", "solver.py", old, new)
    refusal(lambda: law(SolverLaws(), made), expected)


@pytest.mark.parametrize(
    ("old", "new", "law", "expected"),
    [
        ("[: self.frames]", "",
         lambda laws, made, found: laws.test_dataset_names_its_recordings(made, found),
         f"does not keep to `frames`: 'lump' has 3 of {FRAMES}"),
        ("len(files), files)", "7, files)",
         lambda laws, made, found:
            laws.test_dataset_frames_are_finite_and_as_many_as_it_says(made, found),
         f"states that 'lump' has 7 frames but yields {FRAMES}"),
        ("np.loadtxt(file, ndmin=2)", "1000.0 * np.loadtxt(file, ndmin=2)",
         lambda laws, made, found:
            laws.test_dataset_frames_are_finite_and_as_many_as_it_says(made, found),
         "points must be in metres"),
        ("        return None\n", '        return Truth(("a", "a"), np.zeros((2, 2, 3)))\n',
         lambda laws, made, found:
            laws.test_dataset_truth_has_a_row_for_each_frame(made, found),
         "has two reference joints with the same name in 'lump'"),
        ("return self.files", "return self.files[:1]",
         lambda laws, made, found:
            laws.test_dataset_lists_the_files_that_it_reads(made, found),
         "does not list a file that 'lump' reads"),
    ],
    ids=["frames", "length", "millimetres", "joints", "files"],
)  # fmt: skip
def test_faulty_dataset_breaks_its_law(faulty, tmp_path, old, new, law, expected):
    made = faulty("dataset", "dataset.py", old, new, root=tmp_path)
    (package,) = tmp_path.iterdir()
    made = made.model_copy(update={"root": package / "data"})
    found = made.model_copy(update={"frames": FRAMES}).chosen()
    refusal(lambda: law(DatasetLaws(), made, found), expected)


@pytest.mark.parametrize(
    ("old", "new", "law", "expected"),
    [
        ("DEPTH_SCALE = 1000.0", "DEPTH_SCALE = 0.5",
         lambda laws, made, found:
            laws.test_source_frames_are_in_metres_and_fit_their_camera(made, found),
         "points must be in metres"),
        ("index / self.fps)", "-index / self.fps)",
         lambda laws, made, found:
            laws.test_source_times_are_finite_and_do_not_decrease(made, found),
         "yields frames at the times"),
        ("np.array(content[", "np.random.default_rng().uniform() * np.array(content[",
         lambda laws, made, found:
            laws.test_source_reads_the_same_when_it_is_opened_twice(made, found),
         "yields other frames when it is opened again"),
        ("            return None\n", "            self._next = 0\n            return None\n",
         lambda laws, made, found: laws.test_source_has_ended_once_it_ends(made),
         "yields frames after its end"),
        ("self.length = len(images)", "self.length = 7",
         lambda laws, made, found: laws.test_source_has_ended_once_it_ends(made),
         "states 7 frames but yields 3"),
        ("        self.fps = fps", "        self.fps = 1e400",
         lambda laws, made, found: laws.test_source_can_be_closed_twice(made),
         "opens a stream of inf frames per second"),
    ],
    ids=["metres", "times", "twice", "end", "length", "rate"],
)  # fmt: skip
def test_faulty_source_breaks_its_law(faulty, tmp_path, old, new, law, expected):
    made = faulty("source", "source.py", old, new, path=tmp_path)
    (package,) = tmp_path.iterdir()
    made = made.model_copy(update={"path": package / "data" / "ball.json"})
    found = frames_at_start(made)
    refusal(lambda: law(SourceLaws(), made, found), expected)


def test_faulty_template_breaks_its_law(faulty):
    new = '''    def body(self, size):
        """A little more every time."""
        return self.description().body(self.kind, 1.01 * size)

    def given_size'''
    made = faulty("template", "template.py", "    def given_size", new)
    law = TemplateLaws().test_template_gives_a_body_of_each_size
    refusal(lambda: law(made), "returns a body of size 0.505 for 0.5")


def test_template_without_optional_parts_that_is_extended_breaks_its_law(faulty):
    new = '''    def extended(self):
        """The same once more."""
        return self

    def given_size'''
    made = faulty("template", "template.py", "    def given_size", new)
    law = TemplateLaws().test_extended_template_has_optional_parts_and_the_same_sizes
    refusal(lambda: law(made), "extended has no optional segment")
