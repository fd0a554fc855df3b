"""Plug-ins by name, as a mapping, or made already: what the functions of the API take."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

from pydantic import Field

from regkit.clouds.reading import READABLE
from regkit.config.document import Document
from regkit.config.model import Model, did_you_mean
from regkit.config.plugin import Plugin
from regkit.config.preset import presets_of
from regkit.interfaces import Method, Preprocessor, Template, Tracker
from regkit.skeleton import PoseDescription
from regkit.system.errors import ConfigError

P = TypeVar("P", bound=Plugin)

Choice: TypeAlias = str | Path | Mapping[str, Any] | P
"""A plug-in's name or preset, a YAML file, a mapping as in an experiment's YAML, or itself."""

YAML = (".yaml", ".yml")


class _OfTemplate(Model):
    template: Template


class _OfStart(Model):
    start: PoseDescription


class _OfMethod(Model):
    method: Method
    preprocessor: Preprocessor | None = None
    tracker: Tracker = Field(default="constant_pose", validate_default=True)


def load_template(source: Choice[Template], **options: object) -> Template:
    """A template by its name or from its file.

    Args:
        source: ``"human"``, ``"hand"`` or another kind of template that is installed; the YAML file
            of a template; a cloud or mesh, which is rigid; or a mapping with a ``kind``.
        options: Fields of that kind of template, such as ``height=1.75`` [m] or ``side="left"``.
            A size that is not given is found from the data.

    Raises:
        ConfigError: If there is no such template or option, or the file is wrong.
    """
    if isinstance(source, Plugin) and not options:
        return source
    data = _mapping(source)
    if isinstance(source, (str, Path)) and Path(source).suffix.lower() in (*YAML, *READABLE):
        kind = "file" if Path(source).suffix.lower() in YAML else "cloud"
        data = {"kind": kind, "path": str(source)}
    document = Document({"template": {**data, **options}}, {(): "load_template"})
    return document.validated(_OfTemplate).template


def chosen_method(
    method: Choice[Method],
    preprocessor: Choice[Preprocessor] | None = None,
    tracker: Choice[Tracker] = "constant_pose",
    *,
    place: str,
) -> tuple[Method, Preprocessor | None, Tracker]:
    """A method, what makes its data, and what leads it from frame to frame.

    Args:
        method: A preset's name or file, a kind, a mapping, or the method.
        preprocessor: Likewise; None if it is left to the data.
        tracker: Likewise; a method that brings its own has that one.
        place: The function that was called, for messages.

    Raises:
        ConfigError: If there is no such plug-in, or a field of it is wrong.
    """
    data = {
        "method": _method(method, place),
        "preprocessor": None if preprocessor is None else _mapping(preprocessor),
        "tracker": _mapping(tracker),
    }
    chosen = Document(data, {(): place}).validated(_OfMethod)
    return chosen.method, chosen.preprocessor, chosen.method.tracker or chosen.tracker


def described_start(start: Mapping[str, Any], *, place: str) -> PoseDescription:
    """A pose that is written as in an experiment's YAML.

    Raises:
        ConfigError: If a field of it is wrong.
    """
    return Document({"start": dict(start)}, {(): place}).validated(_OfStart).start


def told(choice: Choice[Any]) -> str:
    """What a choice is called in a table."""
    if isinstance(choice, Plugin):
        return choice.kind
    if isinstance(choice, Mapping):
        return str(choice.get("preset", choice.get("kind", "")))
    return str(choice)


def _method(method: Choice[Method], place: str) -> Any:
    """A method's mapping, of a preset where the name is one's."""
    if not isinstance(method, (str, Path)):
        return _mapping(method)
    name = str(method)
    presets = presets_of(Method.group)
    if name in presets or Path(name).suffix in YAML:
        return {"preset": name}
    known = [*presets, *Method.available()]
    if name not in known:
        raise ConfigError(
            f"no method '{name}' (there are: {', '.join(known)}; or name a preset's .yaml file)"
            + did_you_mean(name, known),
            place=f"{place}: method",
        )
    return {"kind": name}


def _mapping(choice: Choice[Any]) -> Any:
    """What a document holds for a choice."""
    if isinstance(choice, Plugin):
        return choice
    if isinstance(choice, Mapping):
        return dict(choice)
    return {"kind": str(choice)}
