"""Conformance tests of plug-ins: two lines test a third party's distribution completely.

    from regkit.testing import conformance

    TestConformance = conformance("my-distribution")

pytest then collects one test for each law and plug-in, such as
``TestConformance::test_shape_covers_every_segment[superquadric]``. See
:func:`regkit.testing.conformance.conformance` for plug-ins that need examples of their options.
"""

from regkit.system.optional import load_library

load_library("pytest")

from regkit.testing.conformance import Conformance, conformance  # noqa: E402

__all__ = ["Conformance", "conformance"]
