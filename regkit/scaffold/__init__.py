"""New packages with a plug-in of one's own, which pass conformance as they are written."""

from regkit.scaffold.scaffold import KINDS, Scaffold

__all__ = ["KINDS", "Scaffold"]
