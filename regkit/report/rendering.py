"""The templates of the report's page, and what they show pictures and texts with."""

from __future__ import annotations

import base64
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jinja2 import Environment


def rendered(template: str, **values: Any) -> str:
    """Returns a template of the report with the given values, each of which must be there."""
    return _environment().get_template(template).render(values)


@cache
def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape

    environment = Environment(
        loader=PackageLoader("regkit.report"),
        autoescape=select_autoescape(["html"]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    filters: dict[str, Any] = {
        "png": _embedded,
        "picture": lambda file: _embedded(file.read_bytes()),
        "md": _markdown,
    }
    environment.filters.update(filters)
    return environment


def _embedded(png: bytes) -> str:
    return "data:image/png;base64," + base64.b64encode(png).decode("ascii")


def _markdown(text: object) -> str:
    """Returns text with Markdown's special characters escaped, also for use in a table."""
    flat = " ".join(str(text).split())
    for special in "\\|*`[]<":
        flat = flat.replace(special, "\\" + special)
    return flat
