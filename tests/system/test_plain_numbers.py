"""Numbers in text files are those that every program reads."""

import pytest

from regkit.system.plain_numbers import real, whole
from regkit.system.printable import is_name, plain_name


@pytest.mark.parametrize(("word", "value"), [("1", 1.0), ("-1.5e-3", -0.0015), ("+.5", 0.5)])
def test_a_plain_number_is_read(word: str, value: float) -> None:
    assert real(word) == value


@pytest.mark.parametrize("word", ["1_000", "\u0663", "", "x", "1\u00e90"])
def test_what_only_python_reads_as_a_number_is_none(word: str) -> None:
    for read in (real, whole):
        with pytest.raises(ValueError, match=r"number|float|literal"):
            read(word)


@pytest.mark.parametrize("name", ["hip\x80s", "a\tb", "a\nb", "\u202ea", "\x1b[2J"])
def test_a_name_that_cannot_be_printed_is_made_one(name: str) -> None:
    assert not is_name(name)
    assert is_name(plain_name(name))
