"""What a results folder states of its run, for the report: its configuration and its machine."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import BaseModel

from regkit.config.document import Document
from regkit.system.guard import reading
from regkit.system.json_files import read_json


class _Config(BaseModel):
    """The parts of a configuration that the report reads; plug-ins need not be installed."""

    name: str
    methods: dict[str, dict[str, Any]]


class _Environment(BaseModel):
    """The parts of ``environment.json`` that the report reads."""

    libraries: dict[str, str] = {}


def read_config(folder: Path) -> dict[str, Any]:
    """Returns ``config.yaml`` of a results folder, with the parts that the report reads.

    Raises:
        RegkitError: If it is missing or damaged.
    """
    document = Document.read(folder / "config.yaml")
    document.validated(_Config)
    return document.data


def read_environment(folder: Path) -> dict[str, Any]:
    """Returns ``environment.json`` of a results folder.

    Raises:
        DataError: If it is missing or damaged.
    """
    file = folder / "environment.json"
    with reading(file, "an environment of regkit run"):
        data = read_json(file)
        _Environment.model_validate(data)
        return data
