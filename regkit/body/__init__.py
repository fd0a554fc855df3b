"""Bodies: skeletons with flesh and markers, and the YAML that describes them."""

from regkit.body.body import Body, Markers, Stance
from regkit.body.description import BodyDescription

__all__ = ["Body", "BodyDescription", "Markers", "Stance"]
