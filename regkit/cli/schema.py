"""``regkit schema``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from pydantic.errors import PydanticInvalidForJsonSchema

from regkit.cli.console import errors, output
from regkit.cli.options import PluginFiles, run_plugin_files
from regkit.config.installed import OWN, Installed, only_from
from regkit.config.schema_line import FOLDER, MARK
from regkit.experiment.schemas import schema_of, schemas
from regkit.interfaces import SLOTS
from regkit.system.errors import PluginError
from regkit.system.files import write_text


def schema(
    folder: Annotated[
        Path,
        typer.Argument(metavar="FOLDER", help="Folder to write the schemas to, or to check."),
    ] = Path(FOLDER),
    check: Annotated[
        bool,
        typer.Option(
            "--check",
            help="Write nothing; fail if a schema is out of date. Schemas of the built-in plug-ins "
            "alone also count as up to date.",
        ),
    ] = False,
    built_in: Annotated[
        bool, typer.Option("--built-in", help="Leave out plug-ins of other distributions.")
    ] = False,
    plugin: PluginFiles = None,
) -> None:
    """Write the JSON Schemas of experiments and their parts, for editors."""
    run_plugin_files(plugin)
    if built_in:
        with only_from(OWN):
            texts = _texts()
    else:
        _report_left_out()
        texts = _texts()
    if check:
        _check(folder, texts)
        return
    for name, text in texts.items():
        file = folder / f"{name}.json"
        write_text(file, text)
        output.print(f"written: {file}")
    line = f"{MARK}{(folder / 'experiment.json').as_posix()}"
    output.print(
        f"for editors, begin an experiment with this line (path relative to its folder): {line}",
    )


def _check(folder: Path, texts: dict[str, str]) -> None:
    """Exits with code 1 if a file matches neither ``texts`` nor the built-in schemas."""
    files = {name: folder / f"{name}.json" for name in texts}
    found = {
        name: file.read_text(encoding="utf-8") if file.exists() else ""
        for name, file in files.items()
    }
    if found == texts:
        return
    with only_from(OWN):
        own = _texts()
    stale = [files[name] for name, text in found.items() if text not in (texts[name], own[name])]
    for file in stale:
        state = "out of date" if file.exists() else "missing"
        errors.print(f"{file} is {state}; run: regkit schema {folder}")
    if stale:
        raise typer.Exit(1)


def _report_left_out() -> None:
    """Reports the plug-ins left out of the schemas because they are broken or not describable."""
    for slot in SLOTS:
        for kind, origin in slot.available().items():
            try:
                plugin = slot.load(kind)
                if not (isinstance(origin, Installed) and OWN in origin.distributions):
                    schema_of(plugin)
            except PluginError as error:
                reason = str(error)
            except PydanticInvalidForJsonSchema as error:
                by = origin.versions if isinstance(origin, Installed) else origin.__module__
                reason = (
                    f"plug-in '{kind}' of {by} has a field without a YAML form: {error.message}"
                )
            else:
                continue
            errors.print(f"left out: {reason}", style="red")


def _texts() -> dict[str, str]:
    return {name: json.dumps(found, indent=2) + "\n" for name, found in schemas().items()}
