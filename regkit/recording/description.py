"""The description of a recording, ``sequence.yaml``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from pydantic import Field

from regkit.config.document import Document
from regkit.config.model import Model
from regkit.config.quantities import Rate

Positive = Annotated[float, Field(ge=1e-3, le=1e6)]

FILE = "sequence.yaml"
"""Name of the description's file."""


class RecordingDescription(Model):
    """The content of ``sequence.yaml``."""

    name: Annotated[str, Field(pattern=r"^\w[\w. -]*$")] | None = None
    """Name of the recording; by default that of its folder."""
    fps: Rate = 30.0
    """Frames per second."""
    depth_scale: Positive = 1000.0
    """Depth image units per metre: 1000 for millimetres."""
    source: str = ""
    """Origin of the data."""
    licence: str = ""
    """Licence of the data."""

    @classmethod
    def read(cls, folder: Path) -> RecordingDescription:
        """Returns the description of a recording's folder.

        Raises:
            RegkitError: If it is missing or invalid.
        """
        return Document.read(folder / FILE).validated(cls)
