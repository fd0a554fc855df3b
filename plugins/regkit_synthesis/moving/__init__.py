"""Bodies that move: one alone, or several in one scene, each along its course."""

from regkit_synthesis.moving.course import Waypoint
from regkit_synthesis.moving.moved import Moved
from regkit_synthesis.moving.moving import Moving
from regkit_synthesis.moving.several import MovingPart, joined_bodies

__all__ = ["Moved", "Moving", "MovingPart", "Waypoint", "joined_bodies"]
