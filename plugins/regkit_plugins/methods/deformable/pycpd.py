"""Deformable coherent point drift by pycpd."""

from __future__ import annotations

from typing import ClassVar, Literal

from regkit_plugins.methods.deformable.coherent import DeformableRegistration


class PyCPD(DeformableRegistration):
    """Deformable coherent point drift by pycpd."""

    kind: Literal["pycpd"] = "pycpd"

    module: ClassVar[str] = "pycpd"
