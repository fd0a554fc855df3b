"""The command line."""

from regkit.cli.app import main

__all__ = ["main"]
