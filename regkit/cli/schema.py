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
        Path, typer.Argument(help="Where the schemas are written, or checked.")
    ] = Path(FOLDER),
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
    """Write the JSON Schemas of experiments and their parts, for editors."""
    run_plugin_files(plugin)
    if built_in:
        with only_from(OWN):
            texts = _texts()
    else:
        _tell_broken()
        texts = _texts()
    if check:
        _check(folder, texts)
        return
    for name, text in texts.items():
        file = folder / f"{name}.json"
        write_text(file, text)
        output.print(f"written: {file}", highlight=False, soft_wrap=True)
    line = f"{MARK}{(folder / 'experiment.json').as_posix()}"
    output.print(
        f"for an editor, begin an experiment with this line, the path as seen from it: {line}",
        markup=False,
        highlight=False,
        soft_wrap=True,
    )


def _check(folder: Path, texts: dict[str, str]) -> None:
    """End with the exit code 1 if a file is neither as given nor that of the built-ins alone."""
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
        state = "not up to date" if file.exists() else "missing"
        errors.print(f"{file} is {state}; run: regkit schema {folder}", soft_wrap=True)
    if stale:
        raise typer.Exit(1)


def _tell_broken() -> None:
    """Say which plug-ins the schemas leave out, since they cannot be had or described."""
    for slot in SLOTS:
        for kind, origin in slot.available().items():
            try:
                plugin = slot.load(kind)
                if not (isinstance(origin, Installed) and OWN in origin.distributions):
                    schema_of(plugin)
            except PluginError as error:
                told = str(error)
            except PydanticInvalidForJsonSchema as error:
                by = origin.versions if isinstance(origin, Installed) else origin.__module__
                told = (
                    f"plug-in '{kind}' of {by} has a field that no YAML can hold: {error.message}"
                )
            else:
                continue
            errors.print(
                f"left out: {told}", style="red", markup=False, highlight=False, soft_wrap=True
            )


def _texts() -> dict[str, str]:
    return {name: json.dumps(found, indent=2) + "\n" for name, found in schemas().items()}
