"""What would end the program in code of others is an error with its line."""

from __future__ import annotations

import sys

import pytest

from regkit.system.errors import DataError, PluginError
from regkit.system.plugin_code import plugin_code


class Odd(BaseException):
    def __str__(self) -> str:
        raise ValueError


@pytest.mark.parametrize("error", [SystemExit(), SystemExit(0), SystemExit("bye"), Odd()])
def test_end_of_the_program_is_an_error_with_its_line(error):
    with pytest.raises(PluginError) as caught, plugin_code("a method"):
        raise error
    assert "a method" in caught.value.message
    assert caught.value.place.startswith(f"{__file__}:")


def test_code_of_an_exit_is_told():
    with pytest.raises(PluginError, match=r"sys\.exit\(3\)"), plugin_code("a method"):
        sys.exit(3)


@pytest.mark.parametrize("error", [KeyboardInterrupt(), GeneratorExit(), DataError("x"), OSError()])
def test_ordinary_errors_and_interrupts_pass(error):
    with pytest.raises(type(error)), plugin_code("a method"):
        raise error
