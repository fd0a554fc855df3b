"""Plug-ins: frozen pydantic models that are found by name through entry points.

A plug-in's fields are its configuration and its methods are its behaviour. An abstract plug-in
(``ShapeModel``, ``Kernel``, ...) used as the type of a field is a *slot*: pydantic reads ``kind``
from the input, imports only that plug-in and validates the rest against it. Nothing is imported
until it is named, so a broken third-party plug-in can only harm those who name it.
"""

from __future__ import annotations

import importlib.util
import inspect
import sys
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Any, ClassVar, Self, TypeVar

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from regkit.errors import PluginError, RegkitError
from regkit.model import Model, did_you_mean
from regkit.preset import changed, preset, presets_of


class Plugin(Model):
    """Base of every plug-in; a direct, abstract subclass that sets ``group`` is a slot."""

    group: ClassVar[str]
    """Entry-point group, set once by each slot."""

    declared: ClassVar[tuple[str, ...]] = ()
    """Class variables that each plug-in of a slot must declare."""

    kind: str
    """Name of the plug-in, equal to its entry-point name."""

    @classmethod
    def available(cls) -> dict[str, EntryPoint | type[Self]]:
        """All plug-ins of this group by name, none of them imported.

        Raises:
            PluginError: If two distributions declare the same name.
        """
        found: dict[str, EntryPoint | type[Self]] = {}
        for point in entry_points(group=cls.group):
            other = found.get(point.name)
            if isinstance(other, EntryPoint) and other.value != point.value:
                raise PluginError(
                    f"two plug-ins in {cls.group} are called {point.name!r}: {other.value} and "
                    f"{point.value}; uninstall one of their distributions"
                )
            found[point.name] = point
        return dict(sorted((found | _REGISTERED.get(cls.group, {})).items()))

    @classmethod
    def load(cls, kind: str) -> type[Self]:
        """Import the plug-in called ``kind``.

        Raises:
            PluginError: If there is none, it cannot be imported, or it is not what it claims to be.
        """
        available = cls.available()
        plugin = available.get(kind)
        if plugin is None:
            raise PluginError(
                f"no plug-in '{kind}' in {cls.group} (installed: {', '.join(available)})"
                + did_you_mean(kind, list(available))
            )
        if isinstance(plugin, EntryPoint):
            origin = plugin.dist.name if plugin.dist else plugin.value
            try:
                plugin = plugin.load()
            except Exception as error:
                raise PluginError(
                    f"plug-in '{kind}' of {origin} cannot be imported: "
                    f"{type(error).__name__}: {error}"
                ) from error
        if not (inspect.isclass(plugin) and issubclass(plugin, cls)) or inspect.isabstract(plugin):
            raise PluginError(
                f"'{kind}' in {cls.group} is not a concrete {cls.__name__}: {plugin!r}"
            )
        if _kind_of(plugin) != kind:
            raise PluginError(
                f"plug-in '{kind}': {plugin.__qualname__}.kind must default to its entry-point name"
            )
        return plugin

    @classmethod
    def __get_pydantic_core_schema__(
        cls, source: type[Any], handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """A concrete plug-in is validated as a model, a slot by the plug-in that is named."""
        if "group" not in vars(cls):
            return super().__get_pydantic_core_schema__(source, handler)
        return core_schema.no_info_plain_validator_function(
            cls._resolved, metadata={"pydantic_js_functions": [cls._slot_json_schema]}
        )

    @classmethod
    def _resolved(cls, value: Any) -> Self:
        if isinstance(value, cls):
            return value
        if isinstance(value, str):
            value = {"kind": value}
        if isinstance(value, dict) and isinstance(value.get("preset"), str):
            try:
                value = changed(cls._preset(value["preset"]), value)
            except RegkitError as error:
                raise PydanticCustomError(
                    "plugin_error", "{error}", {"error": str(error)}
                ) from error
        kind = value.get("kind") if isinstance(value, dict) else None
        if not isinstance(kind, str):
            raise PydanticCustomError(
                "plugin_kind",
                "expected a name or a mapping with a 'kind' (installed: {names})",
                {"names": ", ".join(cls.available())},
            )
        try:
            plugin = cls.load(kind)
        except PluginError as error:
            raise PydanticCustomError("plugin_error", "{error}", {"error": str(error)}) from error
        return plugin.model_validate(value)

    @classmethod
    def _preset(cls, name: str) -> dict[str, Any]:
        """What a preset says, which is a whole configuration: its mistakes are told in its file."""
        document = preset(cls.group, name)
        kind = document.data.get("kind")
        if not isinstance(kind, str):
            raise PluginError("a preset must name its kind", place=document.place(()))
        document.validated(cls.load(kind))
        return document.data

    @classmethod
    def _slot_json_schema(cls, _: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        kinds, options = [], []
        for kind in cls.available():
            try:
                options.append(handler(cls.load(kind).__pydantic_core_schema__))
            except PluginError:
                continue  # A broken plug-in must not harm those who never name it.
            kinds.append(kind)
        forms: list[JsonSchemaValue] = [
            {"type": "string", "enum": kinds},
            {"type": "object", "required": ["kind"], "oneOf": options},
        ]
        if presets_of(cls.group):
            forms.append({
                "type": "object",
                "required": ["preset"],
                "properties": {"preset": {"type": "string", "examples": [*presets_of(cls.group)]}},
            })  # fmt: skip
        return {"anyOf": forms}


P = TypeVar("P", bound=Plugin)
_REGISTERED: dict[str, dict[str, type[Any]]] = {}


def register(plugin: type[P]) -> type[P]:
    """Make a plug-in class available in this process: in notebooks, tests, ``--plugin`` files."""
    _REGISTERED.setdefault(plugin.group, {})[_kind_of(plugin)] = plugin
    return plugin


def _kind_of(plugin: type[Plugin]) -> str:
    """The name of a plug-in, once it is known to declare all that its slot asks for."""
    for name in plugin.declared:
        if not any(name in vars(base) for base in plugin.__mro__):
            raise PluginError(f"{plugin.__qualname__} must declare the class variable '{name}'")
    kind = plugin.model_fields["kind"].default
    if not isinstance(kind, str):
        raise PluginError(
            f'{plugin.__qualname__} must declare its name: kind: Literal["name"] = "name"'
        )
    return kind


def run_plugin_file(path: Path) -> None:
    """Run a Python file that registers plug-ins with ``@register``.

    Raises:
        PluginError: If the file is missing, fails, or registers nothing.
    """
    before = {group: dict(plugins) for group, plugins in _REGISTERED.items()}
    spec = importlib.util.spec_from_file_location(f"regkit_plugin_file_{path.stem}", path)
    if spec is None or spec.loader is None or not path.is_file():
        raise PluginError("there is no such Python file", place=str(path))
    module = importlib.util.module_from_spec(spec)
    # pydantic looks a class's module up here, to read the docstrings and types of its fields.
    sys.modules[spec.name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        raise PluginError(f"{type(error).__name__}: {error}", place=str(path)) from error
    if before == _REGISTERED:
        raise PluginError(
            "the file registers no plug-in; decorate the class with @register", place=str(path)
        )
