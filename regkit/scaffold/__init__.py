"""Scaffolding: new packages with a working plug-in, and copies of examples."""

from regkit.scaffold.examples import Example, examples
from regkit.scaffold.scaffold import KINDS, Scaffold

__all__ = ["KINDS", "Example", "Scaffold", "examples"]
