"""The format of results folders, which has a number of its own beside the package's version."""

from __future__ import annotations

import json
from pathlib import Path

from regkit import __version__
from regkit.system.errors import DataError

FORMAT = 2
"""Raised when a file in a results folder, a field or a metric gets another name or meaning.

Format 1 is that of regkit 0.1, which did not write the number down.
"""


def check_format(folder: Path) -> None:
    """Refuse a results folder that was written in another format.

    A folder without ``environment.json`` says nothing of its format, and is left to who reads it.

    Raises:
        DataError: If the format is another one; it says which version of regkit wrote it.
    """
    file = folder / "environment.json"
    if not file.is_file():
        return
    try:
        environment = json.loads(file.read_text(encoding="utf-8"))
        written, author = int(environment.get("format", 1)), str(environment["regkit"])
    except (OSError, ValueError, TypeError, KeyError, AttributeError) as error:
        raise DataError(
            f"damaged ({error}); it says in which format the results are. Run the experiment again "
            "in another folder",
            place=str(file),
        ) from None
    if written != FORMAT:
        raise DataError(
            f"regkit {author} wrote these results in format {written}; regkit {__version__} reads "
            f"and completes format {FORMAT}. Run the experiment again in another folder, or "
            f"install regkit {author} to read these",
            place=str(folder),
        )
