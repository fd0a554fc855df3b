"""Plug-ins registered in this process rather than by an installed distribution."""

from __future__ import annotations

import hashlib
import importlib.util
import sys
from pathlib import Path
from typing import Any

from regkit.system.errors import PluginError, RegkitError
from regkit.system.plugin_code import described, raised_at

_REGISTERED: dict[str, dict[str, type[Any]]] = {}
"""Classes by group and kind."""

_FROM_FILE = "regkit_plugin_file_"
"""Prefix of the names of modules from plug-in files."""


def registered(group: str) -> dict[str, type[Any]]:
    """Returns the registered plug-ins of a group by kind."""
    return dict(_REGISTERED.get(group, {}))


def any_registered() -> bool:
    """Whether any plug-in is registered in this process."""
    return any(_REGISTERED.values())


def add(group: str, kind: str, plugin: type[Any]) -> None:
    """Registers a plug-in that passed ``check_complete``."""
    _REGISTERED.setdefault(group, {})[kind] = plugin


def run_plugin_file(path: Path) -> None:
    """Runs a Python file that registers plug-ins with ``@register``.

    Raises:
        PluginError: If the file is missing, fails, or registers nothing.
    """
    before = {group: dict(plugins) for group, plugins in _REGISTERED.items()}
    where = hashlib.sha256(str(path.absolute()).encode()).hexdigest()[:8]
    name = f"{_FROM_FILE}{path.stem}_{where}"
    spec = importlib.util.spec_from_file_location(name, path.absolute())
    if not path.is_file():
        raise PluginError("there is no such Python file", place=str(path))
    if spec is None or spec.loader is None:
        raise PluginError("not a Python file (.py)", place=str(path))
    module = importlib.util.module_from_spec(spec)
    # pydantic finds a class's module here, to read the docstrings and types of its fields.
    sys.modules[spec.name] = module
    try:
        spec.loader.exec_module(module)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        # A broken class may be registered already, and its module must not be found again.
        _REGISTERED.clear()
        _REGISTERED.update(before)
        del sys.modules[spec.name]
        own = isinstance(error, RegkitError)
        reason = str(error) if own else described(error)
        raise PluginError(reason, place=_failed_at(path, error)) from error
    if before == _REGISTERED:
        raise PluginError(
            "the file registers no plug-in; decorate the class with @register", place=str(path)
        )


def _failed_at(path: Path, error: BaseException) -> str:
    """Returns the place of a plug-in file's error: its own line, if there is one."""
    if isinstance(error, SyntaxError) and error.filename == str(path.absolute()) and error.lineno:
        return f"{path}:{error.lineno}"
    place = raised_at(error, within=str(path.absolute()))
    return str(path) if place is None else f"{path}:{place.rpartition(':')[2]}"


def plugin_files() -> tuple[Path, ...]:
    """Returns the plug-in files that ran, so that worker processes can run them too."""
    plugins = [plugin for by_kind in _REGISTERED.values() for plugin in by_kind.values()]
    modules = sorted({plugin.__module__ for plugin in plugins if from_file(plugin)})
    return tuple(Path(str(sys.modules[module].__file__)) for module in modules)


def from_file(plugin: type[Any]) -> bool:
    """Whether a plug-in was registered by ``run_plugin_file``."""
    return plugin.__module__.startswith(_FROM_FILE)
