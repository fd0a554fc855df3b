"""Plug-ins named by options, parsed into arguments of the library."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar

from regkit.api.choices import name_of, segmenters_of
from regkit.config.changes import Location
from regkit.config.document import Document
from regkit.config.model import Model
from regkit.config.plugin import slot_default, slot_defaults
from regkit.config.yaml import yaml_value
from regkit.interfaces import (
    AlignmentStart,
    Method,
    Preprocessor,
    Segmenter,
    Source,
    StartSearch,
    Template,
    Tracker,
)
from regkit.system.errors import ConfigError


class Choices(Model):
    """Choices of ``regkit register`` and ``regkit track``."""

    renamed: ClassVar[dict[str, str]] = {"observer": "preprocessor"}

    template: Template = slot_default(Template)
    """The template to register."""
    method: Method = slot_default(Method)
    """The registration method."""
    segmentation: tuple[Segmenter, ...] = slot_defaults(Segmenter)
    """Segmenters that take the body out of the scene, applied in order before the preprocessor."""
    preprocessor: Preprocessor | None = None
    """Preprocessing of frames; by default they are downsampled to about 900 points."""
    tracker: Tracker = slot_default(Tracker)
    """Tracker from frame to frame, if the method has none of its own."""
    source: Source | None = None
    """Camera or recording of ``regkit track``."""
    start: StartSearch = slot_default(StartSearch)
    """Search for pose and size in the first frame, or the pose itself (``kind: given``)."""

    @classmethod
    def of(
        cls,
        options: Mapping[str, str | None],
        settings: Iterable[str],
        source: Mapping[str, Any] | None = None,
    ) -> tuple[Choices, str]:
        """Returns the choices of the options after ``a.b.c=value`` settings, and the method's name.

        Args:
            options: Values of ``--template``, ``--method``, ...; None for an option that is absent.
            settings: Further changes.
            source: Data of the source of ``regkit track``.

        Raises:
            ConfigError: One line for each mistake.
        """
        given = {name: text for name, text in options.items() if text is not None}
        data = {name: parsed(text, f"--{name}") for name, text in given.items()}
        if "segmentation" in given:
            data["segmentation"] = listed(given["segmentation"], "--segmentation")
        for name, slot in (("template", Template), ("method", Method), ("tracker", Tracker)):
            if isinstance(data.get(name), str):
                data[name] = slot.named(data[name])
            elif name not in data:
                data[name] = slot.default()
        if source is not None:
            data["source"] = dict(source)
        places: dict[Location, str] = {(name,): f"--{name} {text}" for name, text in given.items()}
        document = Document(data, {(): "regkit", **places}).overridden(settings, called="--set")
        return document.validated(cls), name_of(document.data["method"])


def parsed(text: str, option: str) -> Any:
    """Returns an option's value: a name or file unchanged, or a YAML mapping.

    Raises:
        ConfigError: If it begins like a mapping but is not one.
    """
    if not text.lstrip().startswith("{"):
        return text
    try:
        return yaml_value(text)
    except ConfigError as error:
        raise error.at(f"{option} {text}") from None


def listed(text: str, option: str) -> list[Any]:
    """Returns an option's plug-ins: names between commas, a YAML mapping, or a YAML list.

    Raises:
        ConfigError: If it begins like YAML but is not.
    """
    if not text.lstrip().startswith(("[", "{")):
        return [name.strip() for name in text.split(",")]
    try:
        value = yaml_value(text)
    except ConfigError as error:
        raise error.at(f"{option} {text}") from None
    return value if isinstance(value, list) else [value]


def segmentation_named(text: str) -> tuple[Segmenter, ...]:
    """Returns the segmenters of ``--segmentation``.

    Raises:
        ConfigError: If there is no such segmenter, or one of its fields is invalid.
    """
    return segmenters_of(listed(text, "--segmentation"), place=f"--segmentation {text}")


def template_named(text: str | None) -> Template:
    """Returns the template of ``--template``, or the default one for None.

    Raises:
        ConfigError: If there is no such template, or its file is invalid.
    """
    if text is None:
        return Template.parse(Template.default(), place="--template", field="template")
    return Template.parse(parsed(text, "--template"), place=f"--template {text}", field="template")


def start_named(text: str) -> str | AlignmentStart:
    """Returns the start of ``regkit align --start``: a mapping is a plug-in, anything else a name.

    Raises:
        ConfigError: If the mapping is no plug-in, or one of its fields is invalid.
    """
    if not text.lstrip().startswith("{"):
        return text
    return AlignmentStart.parse(parsed(text, "--start"), place=f"--start {text}", field="start")


def method_named(text: str) -> Method:
    """Returns the method of ``--method``.

    Raises:
        ConfigError: If there is no such method, or one of its fields is invalid.
    """
    return Method.parse(parsed(text, "--method"), place=f"--method {text}", field="method")
