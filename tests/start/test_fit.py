"""Fits of a posed body to a cloud."""

import numpy as np

from regkit.start import Scan
from regkit.start.sizes import fit
from regkit_plugins.templates.human import Human


def test_fit_in_a_wrong_size_keeps_the_joint_limits():
    """Twists that no distance holds would make the sizes of a body incomparable."""
    small, large = Human().body(1.55), Human().body(1.85)
    for stance in large.stances:
        axes = small.required.place(small.place(stance.pose).transforms).axis_points(0.04)
        found = fit(Scan(axes.points), large, stance.pose, 1.7)
        assert np.degrees(large.skeleton.limits.violation(found.pose).max()) < 5.0
