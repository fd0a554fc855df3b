"""The page of a scene: one HTML text that works without a server and without a network."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Environment

FOLDER = Path(__file__).parent / "page"
"""The template, its style and its modules."""

NEIGHBOUR = re.compile(r'(?<=from)(\s*)"\./([\w.]+)"')
"""What a module imports from a file beside it."""

START = 'import "./main.js";'
"""The script that starts the page."""


def page(title: str, scene: bytes | None = None) -> str:
    """Returns the page that shows a scene, complete with its style and its scripts.

    Args:
        title: Title of the page, which a browser shows until the scene is there.
        scene: The scene as UTF-8 JSON, which becomes a part of the page. Without it, the page
            fetches ``scene.json`` from beside its own address.
    """
    style = (FOLDER / "scene.css").read_text("utf-8")
    imports = _imports()
    start = START.replace("./", "page/")
    template = _environment().get_template("scene.html")
    return template.render(
        title=title,
        policy=_policy(style, imports, start),
        style=style,
        imports=imports,
        start=start,
        scene=None if scene is None else _base64(gzip.compress(scene, mtime=0)),
    )


@cache
def _imports() -> str:
    """Returns an import map whose addresses are the modules themselves.

    A module at a ``data:`` address has no neighbours, so that each import of one becomes a name
    of the map.
    """
    own = {f"page/{file.name}": file for file in sorted(FOLDER.glob("*.js"))}
    files = own | {
        "three": FOLDER / "three" / "three.module.min.js",
        "page/three.core.min.js": FOLDER / "three" / "three.core.min.js",
        "three/OrbitControls.js": FOLDER / "three" / "OrbitControls.js",
    }
    return json.dumps({"imports": {name: _address(file) for name, file in files.items()}})


def _address(module: Path) -> str:
    text = NEIGHBOUR.sub(r'\1"page/\2"', module.read_text("utf-8"))
    return "data:text/javascript;base64," + _base64(text.encode("utf-8"))


def _policy(style: str, *scripts: str) -> str:
    """Returns a policy by which the page loads nothing, and asks only its own server for frames."""
    allowed = " ".join(_digest(script) for script in scripts)
    return (
        f"default-src 'none'; script-src {allowed} data:; style-src {_digest(style)}; "
        "img-src data:; connect-src 'self'; base-uri 'none'; form-action 'none'"
    )


def _digest(text: str) -> str:
    return f"'sha256-{_base64(hashlib.sha256(text.encode('utf-8')).digest())}'"


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode("ascii")


@cache
def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape

    return Environment(
        loader=PackageLoader("regkit.viewer", "page"),
        autoescape=select_autoescape(["html"]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
