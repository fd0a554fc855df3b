"""Version number of the format of results folders, independent of the package's version."""

from __future__ import annotations

from pathlib import Path

from regkit import __version__
from regkit.system.errors import DataError, RegkitError
from regkit.system.guard import foreign
from regkit.system.json_files import read_json

FORMAT = 5
"""Incremented when a file, field or metric in results folders is renamed or redefined.

Format 1 is that of regkit 0.1, which did not record the number. Format 3 binds results to their
inputs by digests and checksums, which those of format 2 lack. Format 4 has misfits, and the
verdict of each start.
Format 5 has the covariances of poses, and how well they cover the errors.
"""


def check_format(folder: Path) -> None:
    """Refuses a results folder of another format.

    A folder without ``environment.json`` does not state its format and is accepted.

    Raises:
        DataError: If the format differs; the message names the version of regkit that wrote it.
    """
    file = folder / "environment.json"
    if not file.is_file():
        return
    try:
        environment = read_json(file)
        written, author = int(environment.get("format", 1)), str(environment["regkit"])
    except (RegkitError, ValueError, TypeError, KeyError, AttributeError) as error:
        reason = error.message if isinstance(error, RegkitError) else foreign(error)
        raise DataError(
            f"damaged ({reason}); the file records the format of the results. Run the experiment "
            "again in another folder",
            place=str(file),
        ) from None
    if written != FORMAT:
        raise DataError(
            f"regkit {author} wrote these results in format {written}; regkit {__version__} reads "
            f"and continues format {FORMAT}. Run the experiment again in another folder, or "
            f"install regkit {author} to read these",
            place=str(folder),
        )
