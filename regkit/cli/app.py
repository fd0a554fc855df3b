"""The commands, each in a file of its own, and how an error reaches the user."""

from __future__ import annotations

import sys

import typer

from regkit.cli.calibrate import calibrate
from regkit.cli.console import print_error
from regkit.cli.doctor import doctor
from regkit.cli.fit import fit
from regkit.cli.new import new
from regkit.cli.plugins import plugins
from regkit.cli.register import register
from regkit.cli.run import run
from regkit.cli.schema import schema
from regkit.cli.validate import validate
from regkit.errors import RegkitError

app = typer.Typer(
    help="Register articulated and rigid shape models to point clouds and depth frames.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
for command in (run, register, calibrate, fit, validate, plugins, new, schema, doctor):
    app.command()(command)


def main() -> None:
    """Run the command line; what a user can mend ends with a message and the exit code 1."""
    try:
        app()
    except RegkitError as error:
        print_error(error)
        sys.exit(1)
