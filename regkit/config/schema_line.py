"""The comment line that links a YAML file to its JSON Schema for editors."""

from __future__ import annotations

import os
from pathlib import Path

MARK = "# yaml-language-server: $schema="
"""Prefix of the line, as YAML language servers expect it."""

FOLDER = "schemas"
"""Folder of the schemas that ``regkit schema`` writes."""


def schema_line(file: Path, kind: str) -> str | None:
    """Returns the schema line of a file with a ``schemas`` folder in its folder or above.

    Args:
        file: A YAML file, which need not exist yet.
        kind: Type of the document: experiment, template, skeleton or method.

    Returns:
        The line with the schema's path relative to the file; None if there is no such schema.
    """
    folder = file.absolute().parent
    for above in (folder, *folder.parents):
        schema = above / FOLDER / f"{kind}.json"
        if schema.is_file():
            return MARK + Path(os.path.relpath(schema, folder)).as_posix()
    return None
