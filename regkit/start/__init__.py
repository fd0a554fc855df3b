"""The first pose of a recording, found from its cloud alone."""

from regkit.start.search import Start, found_start, given_start

__all__ = ["Start", "found_start", "given_start"]
