"""The folder of ``--out``: no file, no recording, and no part of the results of another run."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from regkit.system.errors import ConfigError

MARKS = (("config.yaml", "environment.json"), ("result.json", "poses.npz"))
"""Files of which all are in a results folder: of ``run``, and of ``register`` and ``track``."""


def check_out(out: Path, *, whole: bool) -> None:
    """Refuses a file, a recording, or a folder inside another results folder, before any work.

    Args:
        out: The folder.
        whole: Whether the folder may be a run's own results folder, to be continued.

    Raises:
        ConfigError: If the path is a file, a recording's folder, or inside another results folder.
    """
    if out.exists() and not out.is_dir():
        raise ConfigError("this is a file; name a folder", place=f"--out {out}")
    if (out / "sequence.yaml").is_file():
        raise ConfigError(
            "this is the folder of a recording; choose another one", place=f"--out {out}"
        )
    place = out.resolve()
    if not whole and _holds(place, MARKS[0]):
        raise ConfigError(
            "this is the results folder of a run; choose another one", place=f"--out {out}"
        )
    for above in place.parents:
        if any(_holds(above, files) for files in MARKS):
            raise ConfigError(
                f"the folder is inside the results folder {above}; choose one outside of it",
                place=f"--out {out}",
            )


def new_folder(name: str) -> Path:
    """Returns a new folder for the results of an experiment, ``results/NAME/DATE-TIME``.

    If ``results/NAME`` is itself a results folder, the new one is beside it.
    """
    date, above = f"{datetime.now():%Y%m%d-%H%M%S}", Path("results") / name
    return Path(f"{above}-{date}") if _holds(above, MARKS[0]) else above / date


def _holds(folder: Path, files: tuple[str, ...]) -> bool:
    return all((folder / name).is_file() for name in files)
