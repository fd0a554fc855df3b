"""Tuning in a few seconds: few steps, held-out samples and trials."""

import pytest


def make_few(patch: pytest.MonkeyPatch) -> None:
    """Makes tuning short until the patch is undone."""
    patch.setattr("regkit.tuning.tuning.HELD", 4)
    patch.setattr("regkit.tuning.sets.TRIED", 8)
    patch.setattr("regkit.tuning.sets.LONG", 4)
    patch.setattr("regkit.tuning.sets.PROPORTIONS", 2)
    patch.setattr("regkit.tuning.descent.PATIENCE", 1)
    patch.setattr("regkit.tuning.descent.SLIGHT", 0.1)
