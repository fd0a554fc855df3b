"""Types of fields with bounds, beyond which a number is a mistake rather than a choice.

The bounds are wide: a field of its own meaning has narrower ones. They keep out what overflows,
never ends, or asks for more memory than there is.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

Length = Annotated[float, Field(ge=1e-6, le=1e4)]
"""A positive length, such as a radius [m]."""

Coordinate = Annotated[float, Field(ge=-1e4, le=1e4)]
"""A coordinate in a body or a scene [m]."""

WorldCoordinate = Annotated[float, Field(ge=-1e8, le=1e8)]
"""A coordinate in the world, as of a map [m]."""

Margin = Annotated[float, Field(ge=0.0, le=1e4)]
"""A length that may be zero [m]."""

Voxel = Annotated[float, Field(ge=1e-4, le=1e3)]
"""Side of a voxel [m]; its index on each axis must fit into an integer."""

LARGEST_ANGLE = 36000.0
"""A hundred turns [deg]."""

Angle = Annotated[float, Field(ge=-LARGEST_ANGLE, le=LARGEST_ANGLE)]
"""An angle or a limit of a hinge, up to a hundred turns [deg]."""

Turn = Annotated[float, Field(ge=-720.0, le=720.0)]
"""A component of a rotation vector [deg]."""

Spread = Annotated[float, Field(ge=1e-3, le=3600.0)]
"""A standard deviation of angles [deg]."""

Weight = Annotated[float, Field(ge=1e-12, le=1e12)]
"""A positive factor of an energy."""

Factor = Annotated[float, Field(ge=1e-6, le=1e6)]
"""A positive factor without a unit, such as a multiple of a voxel."""

Share = Annotated[float, Field(ge=0.0, le=1.0)]
"""A part of a whole."""

Tolerance = Annotated[float, Field(ge=0.0, le=10.0)]
"""A change that ends an iteration; 0 never ends it."""

Rate = Annotated[float, Field(ge=1e-3, le=1e5)]
"""Frames per second [1/s]."""

Duration = Annotated[float, Field(ge=0.0, le=1e5)]
"""A time in a motion [s]."""

Iterations = Annotated[int, Field(ge=1, le=100_000)]
"""A maximum number of iterations."""

Count = Annotated[int, Field(ge=1, le=10_000)]
"""A number of things that are held or searched together, such as neighbours."""

FrameCount = Annotated[int, Field(ge=1, le=10_000_000)]
"""A number of frames."""

Seed = Annotated[int, Field(ge=0, le=2**63 - 1)]
"""A seed of random numbers."""
