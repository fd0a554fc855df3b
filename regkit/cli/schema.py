"""``regkit schema``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from pydantic import BaseModel

from regkit.cli.console import PluginFiles, errors, output, run_plugin_files
from regkit.files import write_text


def schema(
    folder: Annotated[Path, typer.Argument(help="Where the schemas are.")] = Path("schemas"),
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; fail if a file is not up to date.")
    ] = False,
    plugin: PluginFiles = None,
) -> None:
    """Write the JSON Schemas of experiments, templates and skeletons, for editors."""
    run_plugin_files(plugin)
    stale = False
    for name, text in _schemas().items():
        file = folder / f"{name}.json"
        if check:
            current = file.exists() and file.read_text(encoding="utf-8") == text
            if not current:
                stale = True
                errors.print(
                    f"{file} is not up to date; run: regkit schema {folder}", soft_wrap=True
                )
        else:
            write_text(file, text)
            output.print(f"written: {file}", highlight=False, soft_wrap=True)
    if stale:
        raise typer.Exit(1)


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
