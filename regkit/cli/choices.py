"""What options name: plug-ins, and the arguments of the library that they stand for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from regkit.api.choices import told
from regkit.config.changes import Location
from regkit.config.defaults import default_name
from regkit.config.document import Document
from regkit.config.model import Model
from regkit.config.plugin import slot_default
from regkit.config.yaml import yaml_value
from regkit.interfaces import Method, Preprocessor, Template, Tracker
from regkit.skeleton import PoseDescription
from regkit.system.errors import ConfigError


class Choices(Model):
    """What ``regkit register`` and ``regkit track`` work with."""

    template: Template = slot_default(Template)
    """What is seen."""
    method: Method = slot_default(Method)
    """What registers it."""
    preprocessor: Preprocessor | None = None
    """How frames become data; without it, they are downsampled to some 900 points."""
    tracker: Tracker = slot_default(Tracker)
    """How one frame's pose leads to the next, where the method brings no tracker."""
    start: PoseDescription | None = None
    """Pose in the first frame, which needs the template's size; it is found without it."""

    @classmethod
    def of(cls, options: Mapping[str, str | None], settings: Iterable[str]) -> tuple[Choices, str]:
        """The choices that options name, after ``a.b.c=value`` settings; what the method is called.

        Args:
            options: The texts of ``--template``, ``--method``, ...; None where one is not given.
            settings: Further changes.

        Raises:
            ConfigError: One line for each thing that is wrong.
        """
        given = {name: text for name, text in options.items() if text is not None}
        data = {name: parsed(text, f"--{name}") for name, text in given.items()}
        for name, slot in (("template", Template), ("method", Method), ("tracker", Tracker)):
            if isinstance(data.get(name), str):
                data[name] = slot.named(data[name])
            elif name not in data:
                data[name] = slot.default()
        places: dict[Location, str] = {(name,): f"--{name} {text}" for name, text in given.items()}
        document = Document(data, {(): "regkit", **places}).overridden(settings, called="--set")
        return document.validated(cls), told(document.data["method"])


def parsed(text: str, option: str) -> Any:
    """What an option says: a name or a file as it is, or a YAML mapping.

    Raises:
        ConfigError: If it begins as a mapping and is none.
    """
    if not text.lstrip().startswith("{"):
        return text
    try:
        return yaml_value(text)
    except ConfigError as error:
        raise error.at(f"{option} {text}") from None


def template_named(text: str | None) -> Template:
    """The template that ``--template`` names, or the default.

    Raises:
        ConfigError: If there is none, or its file is wrong.
    """
    name = default_name(Template.group) if text is None else text
    return Template.parse(parsed(name, "--template"), place=f"--template {name}", field="template")


def method_named(text: str) -> Method:
    """The method that ``--method`` names.

    Raises:
        ConfigError: If there is none, or a field of it is wrong.
    """
    return Method.parse(parsed(text, "--method"), place=f"--method {text}", field="method")
