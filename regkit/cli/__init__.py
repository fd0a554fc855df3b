"""The command line."""

from __future__ import annotations

import sys

__all__ = ["main"]


def main() -> None:
    """Runs the command line; Ctrl-C while it is imported ends it too."""
    try:
        from regkit.cli.app import main as run
    except KeyboardInterrupt:
        sys.exit(130)
    run()
