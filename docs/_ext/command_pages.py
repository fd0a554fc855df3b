"""Reference of all commands, generated from the command line program."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any

import typer

from regkit.cli.app import app as program
from regkit.cli.app import loaded

_BRACKETS = re.compile(r"\s*\[((?:default|required|x|[\d.]+<)[^\[\]]*)\]\s*")
"""Typer's additions to the help of a parameter: default, bounds, whether it is required."""


def commands_text() -> str:
    """Returns Markdown with a section for each command."""
    group: Any = typer.main.get_command(program)
    context = group.context_class(group, info_name="regkit")
    return "\n\n".join(_commands(group, context))


def _commands(group: Any, context: Any) -> Iterator[str]:
    """Yields the sections of the commands of a group."""
    for name in group.list_commands(context):
        command = loaded(name)
        its = command.context_class(command, info_name=name, parent=context)
        yield f"## {its.command_path}"
        yield inspect.cleandoc(command.help or "")
        records = [one.get_help_record(its) for one in command.get_params(its)]
        rows = [_row(*record) for record in records if record and "--help" not in record[0]]
        if rows:
            yield "\n".join(
                ["| parameter | description | default, bounds |", "|---|---|---|", *rows]
            )


def _row(name: str, text: str) -> str:
    notes = [note for found in _BRACKETS.findall(text) for note in found.split("; ")]
    description = _plain(" ".join(_BRACKETS.sub(" ", text).split()))
    code = name.replace("|", r"\|")  # A vertical bar ends a table cell, even within code.
    return f"| `{code}` | {description} | {_plain(', '.join(notes).replace('default: ', ''))} |"


def _plain(text: str) -> str:
    return re.sub(r"([|<*_{}\[\]])", r"\\\1", text)
