"""Names of others are safe as files, in tables and on terminals."""

from __future__ import annotations

import csv
import io
import re
import unicodedata
from pathlib import PureWindowsPath

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regkit.system.csv_table import csv_text, safe_cell
from regkit.system.errors import DataError
from regkit.system.links import check_links
from regkit.system.names import LONGEST, file_name
from regkit.system.printable import one_line, printable, shortened

CHARACTERS = st.characters(codec=None) | st.sampled_from("\n\r\t\x1b\0/\\:=.~-+@ \u202e\udc80<>|")
NAMES = st.text(CHARACTERS, max_size=150) | st.sampled_from(
    ["", ".", "..", "../up", "/etc", "con", "NUL.txt", "Com1", "x.", "x ", "-rf", "~root", "=1+1",
     "C:\\x", "a\nb", "\x1b[2J", "\u202egpj"]
)  # fmt: skip


@given(NAMES)
def test_file_name_is_valid_everywhere_and_stays(name):
    found = file_name(name)
    assert 0 < len(found.encode()) <= LONGEST
    assert not set(found) & set('/\\:*?"<>|\n')
    assert found[0] not in " .=+-@~"
    assert found[-1] not in " ."
    assert not PureWindowsPath(found).is_reserved()
    assert not any(unicodedata.category(one) in ("Cc", "Cs", "Zl", "Zp") for one in found)
    assert file_name(found) == found


@pytest.mark.parametrize("name", ["human_walk", "S01_a1 (2)", "größe", "步行", "v1.2,x=3"])
def test_ordinary_name_is_unchanged(name):
    assert file_name(name) == name


def test_long_names_that_differ_only_at_their_end_remain_different():
    assert file_name("x" * 500 + "a") != file_name("x" * 500 + "b")


@given(st.lists(st.lists(NAMES, min_size=2, max_size=2), max_size=3))
def test_table_has_no_formula_and_no_line_of_others(rows):
    text = csv_text(["a", "b"], rows)
    read = list(csv.reader(io.StringIO(text)))
    assert len(read) == len(rows) + 1
    for cell in (cell for row in read for cell in row):
        assert not re.match(r"\s*[=+@-](?![\d.])", cell)


@pytest.mark.parametrize(
    ("value", "cell"),
    [(-1.5, "-1.5"), ("-0.25", "-0.25"), ("+1e-3", "+1e-3"), ("", ""), (None, "None"),
     ("head", "head"), ("=1+1", "'=1+1"), ("-x", "'-x"), ("@a", "'@a"), (" =1", "' =1"),
     ("\t=1", "\\t=1"), ("-1+cmd|'/c calc'!A0", "'-1+cmd|'/c calc'!A0"), ("\uff1d1", "'\uff1d1")],
)  # fmt: skip
def test_cell_of_a_table_is_a_number_or_a_text(value, cell):
    assert safe_cell(value) == cell


@given(NAMES)
def test_printed_text_moves_no_cursor(text):
    printable(text).encode()
    assert not any(unicodedata.category(one) == "Cc" for one in one_line(text))
    assert "\u202e" not in printable(text)
    assert len(shortened(text * 50).splitlines()) <= 1


def test_error_and_its_place_are_cut_and_escaped():
    error = DataError("'" + "x" * 10_000 + "' is \x1b[2J wrong", place="a\nb\x07")
    shown = str(error)
    assert len(shown) < 300
    assert shown.startswith("a\\nb\\x07: ")
    assert "\x1b" not in shown


def test_link_within_a_folder_is_allowed_and_one_out_of_it_is_named(tmp_path):
    folder = tmp_path / "results"
    (folder / "method" / "walk").mkdir(parents=True)
    (folder / "method" / "again").symlink_to("walk")
    check_links(folder)
    for target in ("..", "../../..", "/etc", str(tmp_path / "nothing")):
        link = folder / "method" / "out"
        link.symlink_to(target)
        if target == "..":
            check_links(folder)
        else:
            with pytest.raises(DataError) as caught:
                check_links(folder)
            assert caught.value.place == str(link)
        link.unlink()
    (folder / "loop").symlink_to("loop")
    with pytest.raises(DataError, match="link"):
        check_links(folder)
