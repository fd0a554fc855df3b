"""``regkit schema``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any

import typer
from pydantic import BaseModel, TypeAdapter
from pydantic.errors import PydanticInvalidForJsonSchema
from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue
from pydantic_core import core_schema

from regkit.body import BodyDescription
from regkit.cli.console import errors, output
from regkit.cli.options import PluginFiles, run_plugin_files
from regkit.config.installed import OWN, Installed, only_from
from regkit.config.schema_line import FOLDER, MARK
from regkit.experiment.sweeps.sweep import SweptExperiment
from regkit.interfaces import SLOTS, Dataset, Method
from regkit.skeleton import SkeletonDescription
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
                    _schema_of(plugin)
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


def schemas() -> dict[str, dict[str, Any]]:
    """Each schema by the name of its file."""
    return {
        "experiment": _schema_of(SweptExperiment),
        "template": _schema_of(BodyDescription),
        "skeleton": _schema_of(SkeletonDescription),
        "method": _whole(_schema_of(Method), "A method as a file: a preset."),
        "dataset": _whole(_schema_of(Dataset), "A dataset as a file: a preset."),
    }


def _texts() -> dict[str, str]:
    return {name: json.dumps(found, indent=2) + "\n" for name, found in schemas().items()}


def _schema_of(model: type[BaseModel]) -> dict[str, Any]:
    schema = TypeAdapter(model).json_schema(schema_generator=_ForEditors)
    return {"$schema": _ForEditors.schema_dialect, **schema}


def _whole(schema: dict[str, Any], description: str) -> dict[str, Any]:
    """The schema of a file that must name its kind, made of that of a slot."""
    definitions = schema["$defs"]
    # pydantic sets a slot among the definitions only if it is used more than once.
    slot = definitions[schema["$ref"].rpartition("/")[2]] if "$ref" in schema else schema
    (named,) = (form for form in slot["anyOf"] if "oneOf" in form)
    return {
        "$schema": schema["$schema"],
        "description": description,
        **named,
        "$defs": definitions,
    }


class _ForEditors(GenerateJsonSchema):
    """Schemas whose fields have descriptions, but no titles, which only repeat the names."""

    def field_title_should_be_set(self, schema: Any) -> bool:
        """Never."""
        return False

    def tagged_union_schema(self, schema: core_schema.TaggedUnionSchema) -> JsonSchemaValue:
        """The alternatives, which must say what they are even if that is also their default."""
        union = super().tagged_union_schema(schema)
        tag = schema["discriminator"]
        return {**union, "type": "object", "required": [tag]} if isinstance(tag, str) else union

    def dict_schema(self, schema: core_schema.DictSchema) -> JsonSchemaValue:
        """A mapping, which has no other keys than those that are right."""
        mapping = super().dict_schema(schema)
        return (
            {**mapping, "additionalProperties": False}
            if "patternProperties" in mapping
            else mapping
        )
