"""Laws of all plug-ins: they load, are documented, frozen, and survive YAML."""

from __future__ import annotations

import inspect
from typing import Any

import pytest
from pydantic import ValidationError
from pydantic_core import PydanticSerializationError

from regkit.config.plugin import Plugin
from regkit.config.yaml import yaml_data, yaml_text
from regkit.testing.cases import Case
from regkit.testing.laws import Laws
from regkit.testing.verdict import require, same


class PluginLaws(Laws):
    """Laws of all plug-ins."""

    def test_plugin_can_be_loaded(self, plugin: Case) -> None:
        """Its entry point names a complete plug-in of its group."""
        if plugin.broken:
            pytest.fail(plugin.broken, pytrace=False)

    def test_plugin_is_documented(self, plugin: Case) -> None:
        """The class and its fields have docstrings, which become help and schema."""
        found = _loaded(plugin)
        require(
            bool(inspect.cleandoc(found.__doc__ or "")), found.model_construct(),
            "has no docstring, which `regkit plugins` and editors show", look_at=found,
        )  # fmt: skip
        silent = [
            name
            for name, field in found.model_fields.items()
            if name != "kind" and not (field.description or "").strip()
        ]
        require(
            not silent, found.model_construct(),
            f"has fields without a docstring below them: {', '.join(silent)}", look_at=found,
        )  # fmt: skip

    def test_plugin_is_frozen(self, plugin: Case) -> None:
        """No field can be set: data are arguments, never a state."""
        made = _made(plugin)
        frozen = True
        try:
            for name, value in made:
                setattr(made, name, value)
                frozen = False
        except ValidationError:
            pass
        require(
            frozen, made, "can be modified after its creation; keep model_config frozen",
            look_at=type(made),
        )  # fmt: skip

    def test_plugin_round_trips_through_yaml(self, plugin: Case) -> None:
        """The output of ``model_dump`` is read back as the same plug-in."""
        made = _made(plugin)
        try:
            written: dict[str, Any] = made.model_dump(mode="json")
        except PydanticSerializationError as error:
            require(
                False, made, f"has a field without a YAML form ({error})",
                look_at=type(made),
            )  # fmt: skip
            raise
        text = yaml_text(written)
        again = type(made).model_validate(yaml_data(text, type(made).__name__))
        require(
            same(again.model_dump(), made.model_dump()), made,
            f"is not read back as it is written; YAML: {text!r}", look_at=type(made),
        )  # fmt: skip


def _loaded(case: Case) -> Any:
    if case.broken:
        pytest.skip("it cannot be loaded")
    return case.slot.load(case.kind)


def _made(case: Case) -> Plugin:
    if case.plugin is None:
        pytest.skip(f"needs {', '.join(case.missing)}" if case.missing else "it cannot be loaded")
    return case.plugin
