"""Scaffolding: new packages with a working plug-in that passes the conformance tests."""

from regkit.scaffold.scaffold import KINDS, PLACEHOLDER, Scaffold

__all__ = ["KINDS", "PLACEHOLDER", "Scaffold"]
