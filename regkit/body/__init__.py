"""Bodies: skeletons with surface, markers and shapes, and their YAML descriptions."""

from regkit.body.body import Body, Markers, Stance
from regkit.body.deformation import Deformation, Mirror, Scaling, Stretch
from regkit.body.description import BodyDescription
from regkit.body.ellipsoids import BallParameters, EllipsoidParameters
from regkit.body.fit import BodyFit
from regkit.body.listed import ListedShape, ellipsoids
from regkit.body.shape_parameters import ShapeParameters
from regkit.body.shapes import ParametricShape

__all__ = [
    "BallParameters",
    "Body",
    "BodyDescription",
    "BodyFit",
    "Deformation",
    "EllipsoidParameters",
    "ListedShape",
    "Markers",
    "Mirror",
    "ParametricShape",
    "Scaling",
    "ShapeParameters",
    "Stance",
    "Stretch",
    "ellipsoids",
]
