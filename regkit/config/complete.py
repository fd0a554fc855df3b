"""Checks that a class declares everything that a plug-in needs."""

from __future__ import annotations

import inspect
from typing import Any

from pydantic.errors import PydanticUndefinedAnnotation

from regkit.system.errors import PluginError


def check_complete(found: object, slot: type[Any], kind: str) -> None:
    """Refuses an object that is not a complete plug-in of a slot.

    Args:
        found: The object of an entry point, or a registered class.
        slot: The abstract plug-in that it must derive from.
        kind: Its name in the group.

    Raises:
        PluginError: If anything is missing; the message is worded to follow the plug-in's name.
    """
    if not (inspect.isclass(found) and issubclass(found, slot)):
        raise PluginError(f"is not a concrete {slot.__name__}: {found!r}")
    plugin: type[Any] = found
    missing = ", ".join(sorted(getattr(plugin, "__abstractmethods__", ())))
    if missing:
        raise PluginError(
            f"is not a concrete {slot.__name__}: {plugin.__qualname__} does not define {missing}"
        )
    for name in plugin.declared:
        if not any(name in vars(base) for base in plugin.__mro__):
            raise PluginError(f"must declare the class variable '{name}' in {plugin.__qualname__}")
        value = getattr(plugin, name)
        if not inspect.isclass(value):
            raise PluginError(f"must set '{name}' to a class in {plugin.__qualname__}: {value!r}")
    own = plugin.model_fields["kind"].default
    if not isinstance(own, str):
        raise PluginError(
            f'must declare its name in {plugin.__qualname__}: kind: Literal["name"] = "name"'
        )
    if own != kind:
        raise PluginError(
            f"calls itself '{own}': {plugin.__qualname__}.kind must default to its entry-point name"
        )
    try:
        plugin.model_rebuild()
    except PydanticUndefinedAnnotation as error:
        raise PluginError(
            f"has a field of an unknown type in {plugin.__qualname__}: name '{error.name}' is not "
            "defined"
        ) from None
