"""The commands beside ``run``: what they print, and how they end."""

import inspect
import json
import shutil
import subprocess
import sys

import pytest
from places import ROOT

from regkit.cli.app import COMMANDS, loaded
from regkit.interfaces import SLOTS, Solver

EXAMPLES = sorted((ROOT / "docs" / "examples").glob("*.yaml"))
TEMPLATES = sorted((ROOT / "plugins" / "regkit_plugins" / "templates").glob("*.yaml"))


def python(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, check=False, cwd=ROOT
    )


def test_help_names_every_command(regkit):
    ended = regkit("--help")
    assert ended.code == 0
    for command in ("run", "validate", "plugins", "schema", "doctor"):
        assert command in ended.out
        assert regkit(command, "--help").code == 0


def test_list_of_commands_says_what_each_command_says_of_itself():
    for name, summary in COMMANDS.items():
        told = inspect.cleandoc(loaded(name).help).partition("\n\n")[0]
        assert summary == " ".join(told.split()), name


def test_list_of_commands_imports_none_of_them():
    program = (
        "import sys; sys.argv = ['regkit', '--help']\n"
        "from regkit.cli import app\n"
        "try: app.main()\n"
        "except SystemExit: pass\n"
        "names = {'regkit.cli.' + name for name in app.COMMANDS} | {'pydantic', 'numpy'}\n"
        "print('imported:', sorted(names & set(sys.modules)))"
    )
    ended = python("-c", program)
    assert ended.stdout.endswith("imported: []\n"), ended.stdout + ended.stderr


def test_unknown_command_and_option_are_refused(regkit):
    assert regkit("rnu").code == 2
    assert regkit("doctor", "--quick").code == 2


def test_module_is_the_command_and_tells_errors_without_a_traceback(tmp_path):
    missing = tmp_path / "nothing.yaml"
    ended = python("-m", "regkit", "run", str(missing))
    assert ended.returncode == 1
    assert ended.stdout == ""
    assert ended.stderr == f"error: {missing}: there is no such file\n"


def test_cli_imports_nothing_heavy():
    """So that ``--help`` and a misspelt option are told at once."""
    heavy = {"open3d", "casadi", "scipy", "matplotlib"}
    program = f"import sys, regkit.cli.app; print(sorted({heavy!r} & set(sys.modules)))"
    ended = python("-c", program)
    assert ended.stdout.strip() == "[]", ended.stderr


def test_plugins_lists_every_kind_of_every_group(regkit):
    ended = regkit("plugins")
    assert ended.code == 0
    for slot in SLOTS:
        assert slot.group.removeprefix("regkit.") in ended.out
        for kind in slot.available():
            assert f" {kind} " in ended.out
    assert "broken" not in ended.out
    assert "L-BFGS-B" in ended.out


def test_plugins_says_what_each_solver_does_with_limits(regkit):
    table = regkit("plugins").out.rsplit("joint limits", 1)[1]
    for kind in Solver.available():
        (line,) = [line for line in table.splitlines() if f" {kind} " in line]
        assert ("refused" in line) is not Solver.load(kind).limits.hard


def test_plugins_lists_those_of_a_file(regkit, tmp_path):
    file = tmp_path / "mine.py"
    file.write_text(MINE)
    ended = regkit("plugins", "--plugin", file)
    assert ended.code == 0
    assert "stay" in ended.out
    assert "Never moves." in ended.out


MINE = '''
from typing import Literal

from regkit.interfaces import BoundTracker, RegistrationResult, Tracker
from regkit.config.plugin import register


class Staying(BoundTracker):
    """Gives back the start."""

    def step(self, observation, past):
        return RegistrationResult.given(past.last.pose)


@register
class Stay(Tracker):
    """Never moves."""

    kind: Literal["stay"] = "stay"

    def bind(self, registrar):
        return Staying()
'''


def test_doctor_finds_nothing_to_mend_here(regkit):
    ended = regkit("doctor")
    assert ended.code == 0
    for name in ("Python", "numpy", "open3d", "casadi", "plug-ins"):
        assert name in ended.out
    needed, _, optional = ended.out.partition("optional library")
    assert "pip install" not in needed
    for name in ("h5py", "small_gicp", "biocpd", "probreg"):
        assert f" {name} " in optional
    for line in optional.splitlines():
        if " not installed " in line:
            assert f"to install {line.split()[1]}: pip install " in optional


def test_lists_are_readable_on_80_columns(regkit, monkeypatch):
    monkeypatch.setattr("regkit.cli.console.output._width", 80)
    for command in ("plugins", "example", "doctor"):
        lines = regkit(command).out.splitlines()
        assert max(len(line) for line in lines if not line.startswith("to install")) <= 80
        # A description in a narrow column would take many lines.
        assert len(lines) < 240


@pytest.mark.long
def test_schema_check_passes_on_the_committed_files(regkit):
    ended = regkit("schema", ROOT / "schemas", "--check")
    assert ended.err == ""
    assert ended.code == 0


@pytest.mark.long
def test_schema_check_tells_missing_files_and_what_writes_them(regkit, tmp_path):
    ended = regkit("schema", tmp_path, "--check")
    assert ended.code == 1
    lines = ended.err.splitlines()
    assert len(lines) == len(list((ROOT / "schemas").glob("*.json")))
    assert f"{tmp_path / 'experiment.json'} is missing; run: regkit schema {tmp_path}" in lines
    assert list(tmp_path.iterdir()) == []


def test_schema_check_names_the_changed_copies(regkit, tmp_path):
    folder = tmp_path / "schemas"
    assert regkit("schema", folder).code == 0
    changed = [folder / name for name in ("experiment.json", "skeleton.json")]
    for file in changed:
        file.write_text(file.read_text() + "\n")
    before = [file.read_bytes() for file in changed]
    ended = regkit("schema", folder, "--check")
    assert ended.code == 1
    lines = ended.err.splitlines()
    assert [line.split()[0] for line in lines] == [str(file) for file in changed]
    assert all("out of date" in line and f"regkit schema {folder}" in line for line in lines)
    assert [file.read_bytes() for file in changed] == before


def test_schema_describes_the_fields_of_every_plugin(regkit, tmp_path):
    """An editor shows the docstrings; a plug-in of a file is in it as any other."""
    file = tmp_path / "mine.py"
    file.write_text(MINE)
    regkit("schema", tmp_path / "schemas", "--plugin", file)
    text = (tmp_path / "schemas" / "experiment.json").read_text()
    schema = json.loads(text)
    assert {"name", "dataset", "template", "methods"} <= set(schema["required"])
    # An experiment has datasets, and no sources or starts of alignments.
    for name in ("source", "alignment_start"):
        text += (tmp_path / "schemas" / f"{name}.json").read_text()
    for slot in SLOTS:
        for kind in slot.available():
            assert f'"{kind}"' in text
    assert '"stay"' in text
    described = Solver.load("lbfgs").model_fields["max_iterations"].description
    assert json.dumps(described) in text


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_is_valid(regkit, path):
    ended = regkit("validate", path)
    assert ended.err == ""
    assert ended.out == f"{path}: a valid experiment\n"
    assert ended.code == 0


@pytest.mark.parametrize("path", TEMPLATES, ids=lambda path: path.stem)
def test_template_is_valid(regkit, path):
    assert regkit("validate", path) == (0, f"{path}: a valid template\n", "")


def test_there_are_examples_and_templates():
    assert len(EXAMPLES) >= 4
    assert len(TEMPLATES) >= 3


def test_validate_tells_every_file_and_fails_if_one_is_wrong(regkit, tmp_path, linkage_text):
    skeleton = tmp_path / "skeleton.yaml"
    skeleton.write_text("segments: {root: {joint: {type: free}}}\n")
    template = tmp_path / "template.yaml"
    template.write_text(linkage_text)
    wrong = tmp_path / "wrong.yaml"
    texts = (example.read_text() for example in EXAMPLES)
    text = next(text for text in texts if "solver: lbfgs" in text or "kind: lbfgs" in text)
    wrong.write_text(text.replace("kind: lbfgs", "kind: lbfg", 1).replace(
        "solver: lbfgs", "solver: lbfg", 1
    ))  # fmt: skip
    ended = regkit("validate", skeleton, wrong, template)
    assert ended.code == 1
    assert ended.out == f"{skeleton}: a valid skeleton\n{template}: a valid template\n"
    assert ended.err.startswith(f"error: {wrong}:")
    assert "no plug-in 'lbfg' in regkit.solvers" in ended.err
    assert "did you mean 'lbfgs'?" in ended.err


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("name: x\n", "FILE: unknown type of file: an experiment has 'methods'"),
        ("methods: {}\n", "FILE:1: methods: dictionary should have at least 1 item"),
        ("segments: {}\n", "FILE:1: segments: dictionary should have at least 1 item"),
        ("", "FILE:1: the file is empty"),
        ("name: [\n", "FILE:2: not valid YAML"),
        ('name: "\x01"\n', "FILE:1: YAML does not allow the character U+0001"),
        (b"\xff\xfe\xfd", "FILE:1: the text is UTF-16"),
        ("segments: {a: {joint: {type: free}}}\nstances: {odd: {joints: {b: 1}}}\ntitle: x\n"
         "size: {name: y, value: 1, range: [1, 2]}\n",
         "FILE:2: stances.odd.joints.b: "),
    ],
)  # fmt: skip
def test_file_that_is_wrong_is_told(regkit, tmp_path, text, expected):
    file = tmp_path / "wrong.yaml"
    file.write_bytes(text.encode() if isinstance(text, str) else text)
    ended = regkit("validate", file)
    assert ended.code == 1
    assert expected in ended.err.replace(str(file), "FILE")
    assert ended.out == ""


def test_validate_knows_the_plugins_of_a_file(regkit, tmp_path):
    plugins = tmp_path / "mine.py"
    plugins.write_text(MINE)
    experiment = tmp_path / "experiment.yaml"
    experiment.write_text(EXPERIMENT.replace("tracker: constant_pose", "tracker: stay"))
    assert regkit("validate", experiment).code == 1
    assert regkit("validate", experiment, "--plugin", plugins).code == 0


EXPERIMENT = """\
name: test
dataset: {kind: depth, root: data}
template: human
tracker: constant_pose
methods:
  only: {kind: direct, shape: gsog, kernel: correlation, solver: lbfgs}
"""


def test_plugin_of_another_distribution_is_found(regkit, distribution, tmp_path):
    module = tmp_path / "good"
    distribution("[regkit.trackers]\nstay = tracker_of_another:Stay\n", "good")
    (module / "tracker_of_another.py").write_text(MINE.replace("@register\n", ""))
    file = tmp_path / "experiment.yaml"
    file.write_text(EXPERIMENT.replace("tracker: constant_pose", "tracker: stay"))
    assert regkit("validate", file).code == 0
    (row,) = (line for line in regkit("plugins").out.splitlines() if " stay " in line)
    assert "Never moves." in row
    assert "good 1.0" in row


def test_examples_folder_can_be_copied_away(regkit, tmp_path):
    """Paths are meant from the file, not from where the user stands."""
    folder = shutil.copytree(ROOT / "docs" / "examples", tmp_path / "examples")
    for path in EXAMPLES:
        assert regkit("validate", folder / path.name).code == 0
