"""Start: the pose and size in the first frames of a recording, estimated from the data alone."""

from regkit.start.search import Start, found_start, given_start

__all__ = ["Start", "found_start", "given_start"]
