"""The plug-ins of this distribution keep the laws of regkit."""

from regkit.testing import conformance

TestConformance = conformance("regkit-superquadric")
