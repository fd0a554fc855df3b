"""Where regkit keeps what it can make again at any time."""

from __future__ import annotations

import os
from pathlib import Path

from platformdirs import user_cache_path

VARIABLE = "REGKIT_CACHE"
"""Environment variable that names another folder."""


def cache_folder() -> Path:
    """The user's cache folder of regkit, which may be deleted as a whole whenever nothing runs."""
    named = os.environ.get(VARIABLE)
    return Path(named).expanduser().absolute() if named else user_cache_path("regkit")
