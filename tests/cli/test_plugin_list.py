"""``regkit plugins`` keeps its list only while nothing that it tells of changes."""

import os
import subprocess
import sys

import pytest

PLUGIN = '''
from typing import Any, ClassVar, Literal

from regkit.interfaces import ShapeModel
from regkit.primitives import Gaussians, Primitives


class Odd(ShapeModel):
    """Gaussians of an odd kind."""

    kind: Literal["odd"] = "odd"
    makes: ClassVar[type[Primitives]] = Gaussians

    def bind(self, body: Any) -> Any:
        return None
'''

LISTED = """
import sys
from regkit.cli import main
sys.argv = ["regkit", "plugins"]
try:
    main()
finally:
    names = "odd", "regkit_plugins", "numpy"
    print("imported:", *(name for name in names if name in sys.modules))
"""


@pytest.fixture
def listed(tmp_path, distribution):
    """The list that a process of its own prints, and what it imported, with an own plug-in."""
    distribution("[regkit.shapes]\nodd = odd:Odd\n", "odd-things")

    def run() -> tuple[list[str], str]:
        # What Python compiled is looked up by seconds, within which a test changes a file.
        names = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", "COLUMNS": "300"}
        names |= {
            "PYTHONPATH": str(tmp_path / "odd-things"),
            "REGKIT_CACHE": str(tmp_path / "cache"),
        }
        command = [sys.executable, "-c", LISTED]
        ended = subprocess.run(command, env=names, capture_output=True, text=True, check=True)
        *lines, imported = ended.stdout.splitlines()
        return lines, imported

    return run


def test_list_is_kept_until_a_plug_in_changes(listed, tmp_path):
    """In one test, since each list that is made anew imports every plug-in."""
    module = tmp_path / "odd-things" / "odd.py"
    module.write_text(PLUGIN)
    first, imported = listed()
    assert imported == "imported: odd regkit_plugins numpy"
    assert any(" odd " in line and "Gaussians of an odd kind." in line for line in first)
    assert listed() == (first, "imported:")
    module.write_text(PLUGIN.replace("an odd kind", "another kind"))
    assert any("Gaussians of another kind." in line for line in listed()[0])


@pytest.mark.long
def test_list_that_is_damaged_or_has_a_broken_plug_in_is_made_again(listed, tmp_path):
    module = tmp_path / "odd-things" / "odd.py"
    module.write_text(PLUGIN)
    first = listed()[0]
    (kept,) = (tmp_path / "cache").iterdir()
    kept.write_text(kept.read_text()[:-50])
    assert listed()[0] == first
    module.write_text("import no_such_library\n")
    told = "broken: plug-in 'odd' of odd-things cannot be imported"
    for _ in range(2):
        assert any(told in line for line in listed()[0]), "a broken plug-in is told each time"
