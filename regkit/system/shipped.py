"""Files that come with regkit beside its code."""

from __future__ import annotations

from pathlib import Path

from regkit.system.errors import DataError

PACKAGE = Path(__file__).parents[1]


def examples_folder() -> Path:
    """Returns the folder of the examples: in the package of a wheel, or in a source checkout.

    Raises:
        DataError: If this installation has none.
    """
    for folder in (PACKAGE / "examples", PACKAGE.parent / "docs" / "examples"):
        if folder.is_dir():
            return folder
    raise DataError("this installation of regkit has no examples", place=str(PACKAGE))
