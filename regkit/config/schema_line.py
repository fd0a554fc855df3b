"""The line by which a YAML file tells editors its JSON Schema."""

from __future__ import annotations

import os
from pathlib import Path

MARK = "# yaml-language-server: $schema="
"""How the line begins that language servers look for."""

FOLDER = "schemas"
"""Where ``regkit schema`` writes, and where its files are looked for."""


def schema_line(file: Path, kind: str) -> str | None:
    """The line for a file whose folder, or one above it, has a folder ``schemas``.

    Args:
        file: A YAML file, which need not be there yet.
        kind: Of the document: experiment, template, skeleton or method.

    Returns:
        The line with the schema's path as seen from the file; None if there is no such schema.
    """
    folder = file.absolute().parent
    for above in (folder, *folder.parents):
        schema = above / FOLDER / f"{kind}.json"
        if schema.is_file():
            return MARK + Path(os.path.relpath(schema, folder)).as_posix()
    return None
