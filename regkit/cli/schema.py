"""``regkit schema``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from pydantic import BaseModel

from regkit.cli.console import PluginFiles, errors, output, run_plugin_files
from regkit.errors import PluginError
from regkit.files import write_text
from regkit.installed import OWN, only_from
from regkit.interfaces import SLOTS


def schema(
    folder: Annotated[Path, typer.Argument(help="Where the schemas are.")] = Path("schemas"),
    check: Annotated[
        bool,
        typer.Option(
            "--check",
            help="Write nothing; fail if a file is up to date neither with what is installed nor "
            "with regkit's own plug-ins alone.",
        ),
    ] = False,
    built_in: Annotated[
        bool, typer.Option("--built-in", help="Leave out what other distributions bring.")
    ] = False,
    plugin: PluginFiles = None,
) -> None:
    """Write the JSON Schemas of experiments, templates and skeletons, for editors."""
    run_plugin_files(plugin)
    with only_from(OWN):
        own = _schemas()
    whole = own if built_in else _schemas()
    if not built_in:
        _tell_broken()
    stale = False
    for name, text in whole.items():
        file = folder / f"{name}.json"
        if check:
            known = file.read_text(encoding="utf-8") if file.exists() else ""
            if known not in (text, own[name]):
                stale = True
                errors.print(
                    f"{file} is not up to date; run: regkit schema {folder}", soft_wrap=True
                )
        else:
            write_text(file, text)
            output.print(f"written: {file}", highlight=False, soft_wrap=True)
    if stale:
        raise typer.Exit(1)


def _tell_broken() -> None:
    """Say which plug-ins the schemas leave out, since they cannot be had."""
    for slot in SLOTS:
        for kind in slot.available():
            try:
                slot.load(kind)
            except PluginError as error:
                errors.print(
                    f"left out: {error}", style="red", markup=False, highlight=False, soft_wrap=True
                )


def _schemas() -> dict[str, str]:
    from regkit.body import BodyDescription
    from regkit.experiment.sweep import SweptExperiment
    from regkit.skeleton import SkeletonDescription

    models: dict[str, type[BaseModel]] = {
        "experiment": SweptExperiment,
        "template": BodyDescription,
        "skeleton": SkeletonDescription,
    }
    return {
        name: json.dumps(model.model_json_schema(), indent=2) + "\n"
        for name, model in models.items()
    }
