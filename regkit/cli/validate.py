"""``regkit validate``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from regkit.body import BodyDescription
from regkit.cli.console import errors, output, print_error
from regkit.cli.options import PluginFiles, run_plugin_files
from regkit.config.document import Document
from regkit.experiment import Study
from regkit.skeleton import SkeletonDescription
from regkit.system.errors import ConfigError, RegkitError


def validate(
    files: Annotated[
        list[Path],
        typer.Argument(metavar="FILE", help="YAML files of experiments, templates or skeletons."),
    ],
    plugin: PluginFiles = None,
) -> None:
    """Check YAML files and report each mistake with its line."""
    run_plugin_files(plugin)
    failed = False
    for file in files:
        try:
            output.print(f"{file}: a valid {_checked(file)}")
        except RegkitError as error:
            failed = True
            print_error(error)
    if failed:
        raise typer.Exit(1)


def _checked(file: Path) -> str:
    """Validates a file and returns its type."""
    document = Document.read(file)
    if "methods" in document.data:
        study = Study.of(document)
        if study.lists:
            return f"sweep of {len(study.experiments)} experiments"
        return "experiment"
    if "segments" not in document.data:
        raise ConfigError(
            "unknown type of file: an experiment has 'methods', a template or a skeleton has "
            "'segments'",
            place=str(file),
        )
    if {"title", "size", "shapes", "stances"} & document.data.keys():
        description = document.validated(BodyDescription)
        description.body(file.stem, 1.0)
        for key, reason in description.unchecked().items():
            place = document.place(("shapes", key))
            errors.print(
                f"warning: {place} is not checked: {reason}",
                style="yellow",
            )
        return "template"
    document.validated(SkeletonDescription)
    return "skeleton"
