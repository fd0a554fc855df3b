"""The cache folder, for data that regkit can compute again."""

from __future__ import annotations

import os
from pathlib import Path

from platformdirs import user_cache_path

VARIABLE = "REGKIT_CACHE"
"""Environment variable that overrides the cache folder."""


def cache_folder() -> Path:
    """Returns the user's cache folder of regkit; it may be deleted while regkit is not running."""
    named = os.environ.get(VARIABLE)
    return Path(named).expanduser().absolute() if named else user_cache_path("regkit")
