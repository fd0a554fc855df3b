"""Shell completion knows commands, options and plug-ins, and loads nothing of what they do."""

import json
import os
import subprocess
import sys

import pytest

from regkit.cli.app import COMMANDS, loaded
from regkit.interfaces import Method, Template

COMPLETED = """
import json, sys
from regkit.cli import completion
completion.stand_in()
from regkit.cli.app import COMMANDS, loaded
options = {name: [one.opts for one in loaded(name).params] for name in COMMANDS}
heavy = [name for name in ("numpy", "scipy") if hasattr(sys.modules.get(name), "__version__")]
print(json.dumps({"options": options, "heavy": heavy}))
"""


def completions(*words: str, at: int | None = None) -> list[str]:
    """Completions of a line's last word, as bash asks for them."""
    program = "import sys; sys.argv = ['regkit']; from regkit.cli import main; main()"
    ended = subprocess.run(
        [sys.executable, "-c", program],
        env={
            **os.environ,
            "_REGKIT_COMPLETE": "complete_bash",
            "COMP_WORDS": " ".join(["regkit", *words]),
            "COMP_CWORD": str(len(words)),
        },
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ended.stderr == ""
    return ended.stdout.split()


def test_completion_sees_the_options_of_every_command_without_its_libraries():
    ended = subprocess.run(
        [sys.executable, "-c", COMPLETED], capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0, ended.stderr
    found = json.loads(ended.stdout)
    for name in COMMANDS:
        assert found["options"][name] == [one.opts for one in loaded(name).params]
    assert found["heavy"] == []


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("re",), {"record", "register", "report"}),
        (("run", "--j"), {"--jobs"}),
        (("register", "--met"), {"--method"}),
        (("example", "dem"), {"demo"}),
        (("new", "ker"), {"kernel"}),
    ],
)
def test_completion_of_a_word(words, expected):
    assert set(completions(*words)) == expected


def test_completion_names_plugins_and_presets():
    (kind,) = [name for name in Template.available() if name.startswith("han")]
    assert completions("track", "x", "--template", "han") == [kind]
    assert set(completions("track", "x", "--method", "")) >= {*Method.available(), "best"}


def test_version_is_printed(regkit):
    from regkit import __version__

    assert regkit("--version") == (0, f"regkit {__version__}\n", "")
