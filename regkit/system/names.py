"""Names of files' contents, such as recordings, as names of files on every system."""

from __future__ import annotations

import hashlib
import re

from regkit.system.printable import plain_name

LONGEST = 100
"""Maximum length of a name [bytes]; several of them make a path."""

_NOT_IN_NAMES = re.compile(r'[<>:"/\\|?*\n]')
"""What separates folders, or what some system does not allow in a name."""

_BEGINS_WRONG = re.compile(r"[ .=+\-@~\u3000\uff1d\uff0b\uff0d\uff20]")
"""What hides a file, makes it an option, a formula or a home folder."""

_DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9¹²³]|lpt[0-9¹²³])\s*(\..*)?", re.IGNORECASE)
"""Names that are devices on Windows, with any suffix."""


def file_name(name: str) -> str:
    """Returns a name that is valid for a file or folder on every system; a valid one unchanged."""
    safe = _NOT_IN_NAMES.sub("_", plain_name(name))
    if not safe or _BEGINS_WRONG.match(safe) or _DEVICE.fullmatch(safe):
        safe = f"_{safe}"
    if safe[-1] in " .":
        safe = f"{safe}_"
    if len(safe.encode()) > LONGEST:
        digest = hashlib.sha256(name.encode(errors="surrogateescape")).hexdigest()[:8]
        head = safe.encode()[: LONGEST - len(digest) - 1].decode(errors="ignore")
        safe = f"{head}_{digest}"
    return safe
