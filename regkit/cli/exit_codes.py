"""Exit codes of all commands. Of several that apply, the first of 130, 2, 1, 3 is the answer."""

from __future__ import annotations

DONE = 0
"""The command did what it was asked to; a doubtful result says so on standard error."""

ERROR = 1
"""An error that the user can correct: a damaged file, an invalid value, a full disk."""

USAGE = 2
"""The command line itself is wrong: an unknown option, a missing argument."""

NOT_FOUND = 3
"""The command ran, but the body or the alignment was not found; also a doubtful result with
``--strict``."""

INTERRUPTED = 130
"""Ended by Ctrl-C; finished work is kept.

Ctrl-C is the usual end of a camera's track, whose code is that of its verdict.
"""
