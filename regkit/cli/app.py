"""The commands: one module and function each, imported when the command is used."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable
from functools import wraps
from keyword import iskeyword
from typing import Annotated, Any, ParamSpec

import typer
from typer.core import TyperCommand, TyperGroup

from regkit import __version__
from regkit.cli.completion import completing, stand_in
from regkit.cli.console import print_error, print_warning, tell_compiling
from regkit.cli.exit_codes import ERROR, INTERRUPTED, NOT_FOUND
from regkit.cli.interrupt import Interrupt
from regkit.cli.progress import display
from regkit.cli.streams import flush_output, standard_streams
from regkit.system.compilations import when_compiling
from regkit.system.errors import NotFoundError, RegkitError
from regkit.system.notes import show_notes
from regkit.system.plugin_code import plugin_code
from regkit.system.progress import show_on

P = ParamSpec("P")

COMMANDS = {
    "run": "Run an experiment: register the template to every recording with every method.",
    "report": "Write the report of a results folder again, also after an interrupted run.",
    "view": "Show tracks, clouds or a recording in a browser, until Ctrl-C.",
    "export": "Export a tracked motion: BVH, CSV or glTF, or an animated picture.",
    "register": "Register a template to one frame: size or shape, pose, and quality of the fit.",
    "track": "Track a template through a camera's stream or a recording, from the first frames on.",
    "record": "Record the depth images of a camera, or of a file, as a folder that regkit reads.",
    "preview": "Show what the segmentation removes from a recording, and what it leaves of it.",
    "align": "Align a cloud or mesh to another: T_target_source, and how well they match.",
    "calibrate": "Create a template with the body proportions of the person or hand in a "
    "recording.",
    "fit": "Create a template with the shape of a skinned mesh.",
    "tune": "Fit a template's shape to a method, on rendered frames, so that it tracks with less "
    "error.",
    "import": "Create a template from another program's skeleton or body model: BVH, URDF, SMPL.",
    "validate": "Check YAML files and report each mistake with its line.",
    "plugins": "List the installed plug-ins, or the fields of one of them.",
    "example": "Copy a runnable example with its data, or list the examples.",
    "new": "Create a package for a plug-in of your own, which passes conformance from the start.",
    "schema": "Write the JSON Schemas of experiments and their parts, for editors.",
    "doctor": "Check the installation and name the command that repairs each problem.",
}
"""Summary of each command in the list: the first paragraph of its docstring."""

RENAMED_OPTIONS = {
    "calibrate": {"--sequence": "--recording"},
    "register": {name: f"align {name}" for name in ("--min-fitness", "--start", "--voxel")},
}
"""Old option names of each command, with their new names."""


class Commands(TyperGroup):
    """The group of commands; listing them imports none."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Returns the command names in the order of the list."""
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Returns a command with its summary only; ``resolve_command`` loads the rest."""
        summary = COMMANDS.get(cmd_name)
        return None if summary is None else TyperCommand(cmd_name, help=summary)

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[Any, Any, list[str]]:
        """Returns the complete command to run.

        Raises:
            BadParameter: If an option is given by its old name.
        """
        name, _, rest = super().resolve_command(ctx, args)
        former = {} if ctx.resilient_parsing else RENAMED_OPTIONS.get(str(name), {})
        for option in (argument.partition("=")[0] for argument in rest):
            if option in former:
                raise typer.BadParameter(f"'{option}' is now called '{former[option]}'", ctx=ctx)
        return name, loaded(str(name)), rest


class Command(TyperCommand):
    """A command whose usage leaves out hidden arguments."""

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """Returns the parts of the usage line behind the command's name."""
        shown = [one for one in self.get_params(ctx) if not getattr(one, "hidden", False)]
        pieces = [piece for one in shown for piece in one.get_usage_pieces(ctx)]
        return [*([self.options_metavar] if self.options_metavar else []), *pieces]


def loaded(name: str) -> Any:
    """Returns a command with its parameters."""
    # A command named like a Python keyword has an underscore behind its function's name.
    own = f"{name}_" if iskeyword(name) else name
    alone = typer.Typer(add_completion=False)
    command = getattr(importlib.import_module(f"regkit.cli.{own}"), own)
    alone.command(name, cls=Command)(_ended_by_itself(command, name))
    return typer.main.get_command(alone)


def _ended_by_itself(command: Callable[P, None], name: str) -> Callable[P, None]:
    """Returns a command in which ``sys.exit``, of a plug-in, is an error."""

    @wraps(command)
    def run(*args: P.args, **options: P.kwargs) -> None:
        with plugin_code(f"a plug-in in 'regkit {name}'"):
            command(*args, **options)

    return run


app = typer.Typer(cls=Commands, pretty_exceptions_enable=False)


def print_version(asked: bool) -> None:
    """Prints the version, if it was asked for, and ends."""
    if asked:
        typer.echo(f"regkit {__version__}")
        raise typer.Exit


@app.callback(no_args_is_help=True)
def regkit(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=print_version, is_eager=True, help="Print the version and exit."
        ),
    ] = False,
) -> None:
    """Register articulated and rigid shape models to point clouds and depth frames."""


def main() -> None:
    """Runs the command line; prints an error that a user can correct and exits with code 1."""
    if completing():
        stand_in()
    when_compiling(tell_compiling)
    show_notes(print_warning)
    show_on(display)
    with standard_streams(), Interrupt() as interrupt:
        try:
            try:
                app()
            finally:
                flush_output()
        except BaseException as error:
            # What an interrupted library makes of Ctrl-C is not a fault to tell.
            if interrupt.pressed:
                sys.exit(INTERRUPTED)
            if not isinstance(error, RegkitError):
                raise
            print_error(error)
            sys.exit(NOT_FOUND if isinstance(error, NotFoundError) else ERROR)
