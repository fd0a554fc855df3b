"""Shell completion, which needs the options of a command but nothing of what it does."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable, Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from regkit.system.shipped import examples_folder

VARIABLE = "_REGKIT_COMPLETE"
"""Environment variable by which a shell asks for completions."""

NEEDED = ("regkit.cli", "regkit.config.schema_line")
"""Modules whose values a signature uses."""

GROUPS = {
    "method": ("regkit.methods", "regkit.methods.presets"),
    "preprocessor": ("regkit.preprocessors",),
    "segmentation": ("regkit.segmenters",),
    "template": ("regkit.templates",),
    "tracker": ("regkit.trackers",),
}
"""Groups of entry points whose names complete an option."""


def completing() -> bool:
    """Whether a shell asks this process for completions."""
    return VARIABLE in os.environ


def plugin_names(*options: str) -> Callable[[str], list[str]]:
    """Returns the completion of plug-ins and presets of some options, or of all groups."""

    def names(incomplete: str) -> list[str]:
        # Entry points take long to import, and only a completion lists them.
        from regkit.config.installed import installed

        groups = [group for option in options or GROUPS for group in GROUPS[option]]
        found = {name for group in groups for name in installed(group)}
        return sorted(name for name in found if name.startswith(incomplete))

    return names


def example_names(incomplete: str) -> list[str]:
    """Returns the completions of an example's name."""
    files = [path for path in examples_folder().iterdir() if path.suffix in (".yaml", ".py")]
    return sorted(path.stem for path in files if path.stem.startswith(incomplete))


def stand_in() -> None:
    """Puts placeholders for everything that a command's module imports and completion needs not.

    The signature of a command is in its module, with what the command uses: for ``run`` a second
    of imports. With placeholders a completion takes a fifth of it.
    """
    importlib.import_module("regkit.config.installed")  # A completion needs it as it is.
    sys.meta_path.insert(0, _Placeholders())


class _Anything(type):
    """The class of placeholders, which have every attribute."""

    def __getattr__(cls, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return Placeholder

    def __getitem__(cls, _: object) -> Any:
        return Placeholder


class Placeholder(metaclass=_Anything):
    """Stands for a class, a function or a constant that is not needed."""

    def __init__(self, *_: object, **__: object) -> None: ...


class _Placeholders(MetaPathFinder, Loader):
    """Finds an empty module in place of each that is not needed."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Returns the spec of a placeholder for numpy, and for regkit below its command line."""
        if fullname.startswith(NEEDED) or not fullname.startswith(("regkit.", "numpy")):
            return None
        return ModuleSpec(fullname, self, is_package=True)

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """Returns None: the module is as usual."""
        return None

    def exec_module(self, module: ModuleType) -> None:
        """Gives the module every attribute."""
        module.__getattr__ = lambda name: getattr(Placeholder, name)  # type: ignore[method-assign]
