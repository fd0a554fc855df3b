"""Subjects of recordings, from their names."""

from __future__ import annotations

import re
from typing import Annotated

from pydantic import AfterValidator


def _of_one_group(pattern: str) -> str:
    try:
        groups = re.compile(pattern).groups
    except re.error as error:
        raise ValueError(f"not a regular expression: {error}") from None
    if groups != 1:
        raise ValueError(f"it must have one group, for the subject's name; it has {groups}")
    return pattern


SubjectPattern = Annotated[str, AfterValidator(_of_one_group)]
"""Regular expression whose only group is the subject's name within a recording's."""


def subject_of(name: str, pattern: SubjectPattern | None) -> str | None:
    """Returns the subject of the recording ``name``; None if the pattern does not match."""
    found = re.search(pattern, name) if pattern else None
    return found[1] if found else None
