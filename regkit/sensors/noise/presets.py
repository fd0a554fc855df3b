"""Noise models of known depth cameras."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from regkit.sensors.noise.model import DepthNoise, plain
from regkit.sensors.noise.parts import (
    AxialNoise,
    FlyingPixels,
    LateralNoise,
    MissingPixels,
)

NoiseName = Literal["none", "sr4000", "kinect_v1", "kinect_v1_320x240", "realsense_d435", "sr305"]

_NGUYEN = AxialNoise(constant=0.0012, quadratic=0.0019, nearest=0.4, oblique=0.0001)

_KINECT = DepthNoise(
    lateral=LateralNoise(constant_px=0.8, oblique_px=0.035),
    axial=_NGUYEN,
    inverse_depth_step=0.00285,
    missing=MissingPixels(edge_share=0.2, grazing_deg=80.0),
)

NOISES: Mapping[NoiseName, DepthNoise] = {
    "none": DepthNoise(),
    "sr4000": DepthNoise(
        flying=FlyingPixels(share=0.3),
        axial=AxialNoise(quadratic=0.001, shading=1.0),
        missing=MissingPixels(edge_share=0.1, grazing_deg=80.0),
    ),
    "kinect_v1": _KINECT,
    "kinect_v1_320x240": _KINECT.model_copy(
        update={"lateral": LateralNoise(constant_px=0.4, oblique_px=0.0175)}
    ),
    "realsense_d435": DepthNoise(
        lateral=LateralNoise(constant_px=0.5),
        flying=FlyingPixels(share=0.2),
        axial=AxialNoise(quadratic=0.0038),
        inverse_depth_step=0.00147,
        missing=MissingPixels(edge_share=0.1, grazing_deg=80.0),
    ),
    "sr305": DepthNoise(axial=AxialNoise(constant=0.002), missing=MissingPixels(grazing_deg=80.0)),
}
"""The noise model of each camera.

- ``sr4000``: nominally 4 mm for a white target at 2 m, not verified with the data sheet; the rest
  is the general behaviour of time of flight.
- ``kinect_v1``: Nguyen, Izadi and Lovell (2012), with disparity steps of 1/8 px at 585 px and
  7.5 cm, which are the 2.85 mm at 1 m of Khoshelham and Elberink (2012). Nguyen's measurements
  include these steps, so the sum slightly exceeds a Kinect's noise. At half the resolution a pixel
  is twice as large.
- ``realsense_d435``: Grunnet-Jepsen, Sweetser and Woodfill, Tuning Depth Cameras for Best
  Performance (Intel): the standard deviation is z^2 times the disparity error, about 0.08 px,
  divided by 424 px and 5 cm; the disparity has steps of 1/32 px.
- ``sr305``: 2 mm for a hand at close range; our choice.

The fractions of invalid and flying pixels, and the D435's lateral noise, are our choices.
"""


def _form(value: Any) -> str:
    """Returns the tag of a noise's form: name, standard deviation or parts."""
    if isinstance(value, str):
        return "name"
    return "model" if isinstance(value, (dict, DepthNoise)) else "sigma"


NoiseChoice = Annotated[
    Annotated[NoiseName, Tag("name")]
    | Annotated[Annotated[float, Field(ge=0.0, le=100.0)], Tag("sigma")]
    | Annotated[DepthNoise, Tag("model")],
    Discriminator(_form),
]
"""The noise of a known camera, ``none``, a standard deviation [m], or its parts."""


def noise_of(choice: NoiseName | float | DepthNoise) -> DepthNoise:
    """Returns a noise model by its name or standard deviation, or the given one."""
    if isinstance(choice, DepthNoise):
        return choice
    return NOISES[choice] if isinstance(choice, str) else plain(choice)
