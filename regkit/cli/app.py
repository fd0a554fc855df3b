"""The commands, each in a file of its own, and how an error reaches the user."""

from __future__ import annotations

import sys

import typer

from regkit.cli.calibrate import calibrate
from regkit.cli.console import print_error
from regkit.cli.doctor import doctor
from regkit.cli.export import export
from regkit.cli.fit import fit
from regkit.cli.import_ import import_
from regkit.cli.new import new
from regkit.cli.plugins import plugins
from regkit.cli.register import register
from regkit.cli.report import report
from regkit.cli.run import run
from regkit.cli.schema import schema
from regkit.cli.validate import validate
from regkit.system.errors import RegkitError

app = typer.Typer(
    help="Register articulated and rigid shape models to point clouds and depth frames.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
COMMANDS = (
    run, report, export, register, calibrate, fit, import_, validate, plugins, new, schema, doctor
)  # fmt: skip
for command in COMMANDS:
    # A word of Python's own has an underscore behind it.
    app.command(command.__name__.rstrip("_"))(command)


def main() -> None:
    """Run the command line; what a user can mend ends with a message and the exit code 1."""
    try:
        app()
    except RegkitError as error:
        print_error(error)
        sys.exit(1)
