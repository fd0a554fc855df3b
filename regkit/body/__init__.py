"""Bodies: skeletons with surface, markers and shapes, and their YAML descriptions."""

from regkit.body.body import Body, Markers, Stance
from regkit.body.capsules import CapsuleParameters
from regkit.body.deformation import Deformation, Mirror, Scaling, Stretch
from regkit.body.description import BodyDescription
from regkit.body.ellipsoids import BallParameters, EllipsoidParameters
from regkit.body.fit import BodyFit
from regkit.body.free_body import FreeBody
from regkit.body.freedoms import Freedom
from regkit.body.gaussians import GaussianParameters, IsotropicGaussianParameters
from regkit.body.listed import ListedShape, capsules, ellipsoids, gaussians, of_capsules
from regkit.body.parts import Part
from regkit.body.shape_parameters import ShapeParameters
from regkit.body.shapes import ParametricShape

__all__ = [
    "BallParameters",
    "Body",
    "BodyDescription",
    "BodyFit",
    "CapsuleParameters",
    "Deformation",
    "EllipsoidParameters",
    "FreeBody",
    "Freedom",
    "GaussianParameters",
    "IsotropicGaussianParameters",
    "ListedShape",
    "Markers",
    "Mirror",
    "ParametricShape",
    "Part",
    "Scaling",
    "ShapeParameters",
    "Stance",
    "Stretch",
    "capsules",
    "ellipsoids",
    "gaussians",
    "of_capsules",
]
