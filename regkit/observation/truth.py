"""Truth: what a recording says of the joints."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.system.arrays import Array


@dataclass(frozen=True)
class Truth:
    """Reference positions of named joints.

    Attributes:
        joints: (J,) names.
        positions: (T, J, 3) [m] in the frame of the points; NaN where a joint was not seen.
    """

    joints: tuple[str, ...]
    positions: Array
