"""Whatever a reader of foreign bytes raises becomes an error with place and reason."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
from pydantic import TypeAdapter

from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit.system.guard import LONGEST, reading
from regkit.system.notes import RegkitWarning, note

PLACE = Path("some/file.bin")


@pytest.mark.parametrize(
    "error",
    [
        struct.error("unpack requires 4 bytes"),
        RecursionError(),
        MemoryError(),
        OverflowError("int too large"),
        AssertionError(),
        IndexError("list index out of range"),
        UnicodeDecodeError("utf-8", b"\xff", 0, 1, "invalid start byte"),
        OSError(5, "Input/output error"),
        ValueError("x" * 100_000),
    ],
    ids=lambda error: type(error).__name__,
)
def test_guard_turns_every_foreign_exception_into_a_short_error_with_its_place(
    error: Exception,
) -> None:
    with pytest.raises(DataError) as caught, reading(PLACE, "a file of numbers"):
        raise error
    assert caught.value.place == str(PLACE)
    assert 10 < len(caught.value.message) < LONGEST + 100


def test_guard_keeps_own_errors_and_their_places() -> None:
    with pytest.raises(ConfigError) as caught, reading(PLACE, "a file of numbers"):
        raise ConfigError("wrong", place="elsewhere:3")
    assert caught.value.place == "elsewhere:3"


def test_guard_names_a_missing_file_and_a_folder(tmp_path: Path) -> None:
    for path, words in ((tmp_path / "no.txt", "no such file"), (tmp_path, "folder")):
        with pytest.raises(DataError, match=words), reading(path, "a text"):
            path.read_bytes()


@pytest.mark.parametrize("error", [KeyboardInterrupt(), SystemExit(1)])
def test_guard_lets_the_end_of_the_process_through(error: BaseException) -> None:
    with pytest.raises(type(error)), reading(PLACE, "a file of numbers"):
        raise error


def test_note_is_a_warning_with_its_place() -> None:
    with pytest.warns(RegkitWarning, match=r"a\.bvh:3: frame time is 0"):
        note("frame time is 0", place="a.bvh:3")
    assert not issubclass(RegkitWarning, RegkitError)


def test_guard_says_which_field_is_wrong_or_missing() -> None:
    with pytest.raises(DataError, match=r"a\.1: .*integer"), reading("x", "a list"):
        TypeAdapter(dict[str, list[int]]).validate_json('{"a": [1, "b"]}')
    with pytest.raises(DataError, match="'size' is missing"), reading("x", "a list"):
        dict[str, int]()["size"]
