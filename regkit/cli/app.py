"""The commands: each is a function in a module of its own, imported when the command is used."""

from __future__ import annotations

import importlib
import sys
from keyword import iskeyword
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from regkit.cli.console import print_error, tell_compiling
from regkit.system.compiled import when_compiling
from regkit.system.errors import RegkitError

COMMANDS = {
    "run": "Run an experiment: register the template to every recording with every method.",
    "report": "Write the report of a results folder anew, also of a run that was interrupted.",
    "export": "Write a tracked motion for other programs: BVH, CSV or glTF.",
    "register": "Register a template to one frame: the body's size and pose, and how well it fits.",
    "track": "Track a template through a recording, from a start that is found in its first frame.",
    "align": "Lay a rigid cloud or mesh on another: T_target_source, and how well they agree.",
    "calibrate": "Make a template with the proportions of the person or hand that a recording "
    "shows.",
    "fit": "Make a template in the shape of a skinned mesh.",
    "import": "Make a template of another program's skeleton: BVH, or URDF with its limits.",
    "validate": "Check YAML files and say what is wrong with them, and where.",
    "plugins": "List what is installed, by group, with the distribution that brings it; or one's "
    "fields.",
    "new": "Begin a package with a plug-in of your own, which passes conformance as it is written.",
    "schema": "Write the JSON Schemas of experiments and their parts, for editors.",
    "doctor": "Check the installation, and name the command that repairs each fault.",
}
"""What the list of commands says of each: the first paragraph of the command's docstring."""

RENAMED_OPTIONS = {
    "calibrate": {"--sequence": "--recording"},
    "register": {name: f"align {name}" for name in ("--min-fitness", "--start", "--voxel")},
}
"""Options that a command had before, and what they are called now."""


class Commands(TyperGroup):
    """The commands by name; the list of them imports none."""

    def list_commands(self, ctx: Any) -> list[str]:
        """The names, in the order of the list."""
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """A command with its line in the list, and nothing else yet."""
        summary = COMMANDS.get(cmd_name)
        return None if summary is None else TyperCommand(cmd_name, help=summary)

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[Any, Any, list[str]]:
        """The command that is used, whole.

        Raises:
            BadParameter: If an option is given by the name that it had before.
        """
        name, _, rest = super().resolve_command(ctx, args)
        former = RENAMED_OPTIONS.get(str(name), {})
        for option in (argument.partition("=")[0] for argument in rest):
            if option in former:
                raise typer.BadParameter(f"'{option}' is now called '{former[option]}'", ctx=ctx)
        return name, loaded(str(name)), rest


def loaded(name: str) -> Any:
    """A command with its parameters."""
    # A word of Python's own has an underscore behind it.
    own = f"{name}_" if iskeyword(name) else name
    alone = typer.Typer(add_completion=False)
    alone.command(name)(getattr(importlib.import_module(f"regkit.cli.{own}"), own))
    return typer.main.get_command(alone)


app = typer.Typer(cls=Commands, add_completion=False, pretty_exceptions_enable=False)


@app.callback(no_args_is_help=True)
def regkit() -> None:
    """Register articulated and rigid shape models to point clouds and depth frames."""


def main() -> None:
    """Run the command line; an error that a user can correct is printed, with the exit code 1."""
    when_compiling(tell_compiling)
    try:
        app()
    except RegkitError as error:
        print_error(error)
        sys.exit(1)
