"""Plug-ins: frozen pydantic models that are found by name through entry points.

A plug-in's fields are its configuration and its methods are its behaviour. An abstract plug-in
(``ShapeModel``, ``Kernel``, ...) used as the type of a field is a *slot*: pydantic reads ``kind``
from the input, imports only that plug-in and validates the rest against it. Nothing is imported
until it is named, so a broken third-party plug-in can only harm those who name it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, ClassVar, Self, TypeVar, cast

from pydantic import Field, GetCoreSchemaHandler, GetJsonSchemaHandler, TypeAdapter
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from regkit.config.complete import check_complete
from regkit.config.defaults import default_name
from regkit.config.document import Document
from regkit.config.former import check_former
from regkit.config.input_files import input_paths
from regkit.config.installed import Installed, installed
from regkit.config.model import Model, did_you_mean
from regkit.config.parts import placed_parts
from regkit.config.preset import YAML, presets_of
from regkit.config.registry import add, registered
from regkit.config.slot import plugin_of
from regkit.config.slot_schema import slot_schema
from regkit.system.errors import PluginError
from regkit.system.plugin_code import described, raised_at


class Plugin(Model):
    """Base of every plug-in; a direct, abstract subclass that sets ``group`` is a slot."""

    group: ClassVar[str]
    """Entry-point group, set once by each slot."""

    former_group: ClassVar[str | None] = None
    """Old name of the group."""

    declared: ClassVar[tuple[str, ...]] = ()
    """Class variables that each plug-in of a slot must declare; their values are classes."""

    formerly: ClassVar[tuple[str, ...]] = ()
    """Old names of the plug-in."""

    kind: str
    """Name of the plug-in, equal to its entry-point name."""

    def input_files(self) -> Iterable[Path]:
        """Returns the files and folders that the plug-in reads, without those of its own package.

        Results are bound to the content of these files: a run is not continued after a change. The
        default are the paths in fields of the type ``InputPath``; plug-ins within this one answer
        for themselves. Override it for files that no such field names.
        """
        return input_paths(self, Plugin)

    @classmethod
    def available(cls) -> dict[str, Installed | type[Self]]:
        """Returns all plug-ins of this group by name, without importing them."""
        found: dict[str, Installed | type[Self]] = {**installed(cls.group)}
        return dict(sorted((found | registered(cls.group)).items()))

    @classmethod
    def load(cls, kind: str) -> type[Self]:
        """Imports the plug-in called ``kind``.

        Raises:
            PluginError: If it does not exist, cannot be imported, is not a complete plug-in of this
                group, or two distributions provide the name.
        """
        available = cls.available()
        found = available.get(kind)
        if found is None:
            check_former(cls, kind)
            presets = list(presets_of(cls.group))
            if kind in presets:
                raise PluginError(
                    f"'{kind}' is a preset of {cls.group} and no plug-in; write {{preset: {kind}}}"
                )
            hint = f"; presets: {', '.join(presets)}" if presets else ""
            raise PluginError(
                f"no plug-in '{kind}' in {cls.group} (installed: {', '.join(available)}{hint})"
                + did_you_mean(kind, [*presets, *available])
            )
        if not isinstance(found, Installed):
            return found
        plugin = found.load("plug-in")
        try:
            check_complete(plugin, cls, kind)
        except PluginError as error:
            raise PluginError(
                f"plug-in '{kind}' of {found.distributions[0]} {error.message}"
            ) from None
        except Exception as error:
            raise PluginError(
                f"plug-in '{kind}' of {found.distributions[0]} is broken: {described(error)}",
                place=raised_at(error),
            ) from error
        return cast(type[Self], plugin)

    @classmethod
    def parse(cls, choice: Any, *, place: str, field: str) -> Self:
        """Returns the plug-in of an argument.

        Args:
            choice: The name of a preset or kind, a file, a mapping with a ``kind`` or a ``preset``,
                or the plug-in itself.
            place: Function or command-line option of the argument, for messages.
            field: Name of the argument.

        Raises:
            ConfigError: One line for each mistake.
        """
        data = cls.named(str(choice)) if isinstance(choice, (str, Path)) else choice
        return cls.of(Document({field: data}, {(): place}), field)

    @classmethod
    def of(cls, document: Document, field: str) -> Self:
        """Returns the plug-in of a document's field, without validating the other fields.

        Raises:
            ConfigError: One line for each mistake.
        """
        return document.field(field, TypeAdapter[Self](cls).validate_python)

    @classmethod
    def named(cls, name: str) -> dict[str, Any]:
        """Returns the data of a name: a preset, its YAML file, or else a kind."""
        of_preset = name in presets_of(cls.group) or Path(name).suffix.lower() in YAML
        return {"preset" if of_preset else "kind": name}

    @classmethod
    def default(cls, purpose: str = "", **fields: Any) -> dict[str, Any]:
        """Returns the data of this group's default plug-in.

        Installed distributions declare the defaults, so that regkit names no plug-in.

        Args:
            purpose: Purpose of the default, in groups with several.
            fields: Values of the plug-in's fields.

        Raises:
            PluginError: If no distribution declares the default, or two do.
        """
        return {**cls.named(default_name(cls.group, purpose)), **fields}

    @classmethod
    def __get_pydantic_core_schema__(
        cls, source: type[Any], handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Validates a concrete plug-in as a model, and a slot by the plug-in that it names."""
        if "group" not in vars(cls):
            return super().__get_pydantic_core_schema__(source, handler)
        return core_schema.no_info_plain_validator_function(
            cls._resolved,
            ref=f"{cls.group}:0",
            metadata={"pydantic_js_functions": [cls._slot_json_schema]},
        )

    @classmethod
    def _resolved(cls, value: Any) -> Self:
        return value if isinstance(value, cls) else cast(Self, plugin_of(cls, value))

    @classmethod
    def _slot_json_schema(cls, _: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return slot_schema(cls, handler)


def plugins_in(value: Any, place: str = "") -> Iterator[tuple[str, Plugin]]:
    """Yields the plug-ins in a configuration with the paths of their fields, also nested ones."""
    if isinstance(value, Plugin):
        yield place, value
    for inner, part in placed_parts(value, place):
        yield from plugins_in(part, inner)


def slot_default(slot: type[Plugin], purpose: str = "", **fields: Any) -> Any:
    """Returns the default of a model's field: ``slot.default``, evaluated on use."""
    return _evaluated_on_use(lambda: _shortest(slot.default(purpose, **fields)))


def slot_defaults(slot: type[Plugin]) -> Any:
    """Returns the default of a field that lists plug-ins: the default of their slot alone."""
    return _evaluated_on_use(lambda: [_shortest(slot.default())])


def _shortest(data: dict[str, Any]) -> Any:
    """Returns the data of a plug-in, as its name if that is all."""
    return data["kind"] if list(data) == ["kind"] else data


def _evaluated_on_use(data: Callable[[], Any]) -> Any:
    return Field(
        default_factory=data,
        validate_default=True,
        json_schema_extra=lambda schema: schema.update(default=data()),
    )


P = TypeVar("P", bound=Plugin)


def register(plugin: type[P]) -> type[P]:
    """Class decorator: registers a plug-in in this process, from a notebook, test or plug-in file.

    Raises:
        PluginError: If the class lacks a required declaration.
    """
    kind = plugin.model_fields["kind"].default
    try:
        check_complete(plugin, Plugin, kind)
    except PluginError as error:
        raise PluginError(f"{plugin.__qualname__} {error.message}") from None
    add(plugin.group, kind, plugin)
    return plugin
