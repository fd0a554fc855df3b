"""Damage to the structure of YAML and JSON files."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import lru_cache
from io import StringIO
from random import Random
from typing import Any

from ruamel import yaml as ruamel
from ruamel.yaml.error import YAMLError

from tests.fuzz.mutations.trees import CHANGES, json_copy, places
from tests.fuzz.mutations.unsuitable import UnsuitableError


@lru_cache(maxsize=200)
def _tree(content: bytes) -> Any:
    """The tree of a YAML file; most are the sound ones, again and again."""
    try:
        return ruamel.YAML(typ="safe", pure=True).load(content.decode())
    except Exception:  # Whatever a parser raises on what is damaged already.
        raise UnsuitableError from None


def _yaml(random: Random, change: Callable[[Random, Any], None], content: bytes) -> bytes:
    tree = _tree(content)
    places(tree)
    tree = json_copy(tree)
    change(random, tree)
    # JSON is YAML too, and much faster to write.
    style = random.choice(("json", "json", "lines", "flow"))
    try:
        text = _as_json(tree) if style == "json" else _as_yaml(tree, flow=style == "flow")
    except (RecursionError, YAMLError, ValueError, TypeError):
        raise UnsuitableError from None
    return text.encode("utf-8", "surrogatepass")


def _as_json(tree: Any) -> str:
    text = json.dumps(tree, default=str)
    return text.replace("NaN", ".nan").replace("Infinity", ".inf")


def _as_yaml(tree: Any, *, flow: bool) -> str:
    stream = StringIO()
    yaml = ruamel.YAML(typ="safe", pure=True)
    yaml.default_flow_style = flow or None
    yaml.sort_base_mapping_type_on_output = False
    # What is the same object twice would be written as an alias; those are mutations of the text.
    yaml.representer.ignore_aliases = lambda *_: True
    yaml.dump(tree, stream)
    return stream.getvalue()


def _json(random: Random, change: Callable[[Random, Any], None], content: bytes) -> bytes:
    try:
        tree = json.loads(content)
    except (ValueError, RecursionError):
        raise UnsuitableError from None
    change(random, tree)
    try:
        return json.dumps(tree, default=str).encode("utf-8", "surrogatepass")
    except (ValueError, RecursionError, TypeError):
        raise UnsuitableError from None


def _named(form: Callable[..., bytes]) -> dict[str, Callable[[Random, bytes], bytes]]:
    def bound(change: Callable[[Random, Any], None]) -> Callable[[Random, bytes], bytes]:
        return lambda random, content: form(random, change, content)

    return {f"tree.{change.__name__}": bound(change) for change in CHANGES}


YAML = _named(_yaml)
JSON = _named(_json)
