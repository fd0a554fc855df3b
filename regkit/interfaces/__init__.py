"""The interfaces of plug-ins, as abstract base classes, and the types that pass between them."""

from regkit.interfaces.alignment_start import AlignmentCandidate, AlignmentStart
from regkit.interfaces.compiled import (
    CompiledEnergy,
    CompiledJoints,
    CompiledPart,
    CompiledWeights,
)
from regkit.interfaces.curvature import Curvature
from regkit.interfaces.dataset import Dataset, Recording
from regkit.interfaces.deformation import Deformation
from regkit.interfaces.expected import Expected
from regkit.interfaces.kernel import Kernel, Response, RigidComparison, RigidSimilarity, Similarity
from regkit.interfaces.keypoints import KeypointRecording, KeypointStream
from regkit.interfaces.method import Method, check_field
from regkit.interfaces.preprocessor import Preprocessor
from regkit.interfaces.prior import Prior
from regkit.interfaces.registrar import Registrar
from regkit.interfaces.result import Evaluation, RegistrationResult
from regkit.interfaces.segmenter import (
    BoundSegmenter,
    Chain,
    SegmentedRecording,
    Segmenter,
    each_body,
)
from regkit.interfaces.shape import ListedShapeModel, ShapeModel
from regkit.interfaces.solver import (
    Constraints,
    LimitKeeping,
    Multipliers,
    Problem,
    Solution,
    Solver,
)
from regkit.interfaces.source import Source
from regkit.interfaces.start import Start, StartSearch
from regkit.interfaces.stream import Stream
from regkit.interfaces.template import Template
from regkit.interfaces.term import JointEnergy, JointResponse, Scene, Term, VisibilityWeights
from regkit.interfaces.tracker import BodySearch, BoundTracker, Past, Tracker
from regkit.interfaces.window import Window
from regkit.observation import TimedFrame

SLOTS = (
    Dataset,
    Source,
    Template,
    Segmenter,
    Preprocessor,
    StartSearch,
    ShapeModel,
    Kernel,
    Term,
    Solver,
    Tracker,
    AlignmentStart,
    Method,
)
"""All groups of plug-ins, in the order of the data flow."""

__all__ = [
    "SLOTS",
    "AlignmentCandidate",
    "AlignmentStart",
    "BodySearch",
    "BoundSegmenter",
    "BoundTracker",
    "Chain",
    "CompiledEnergy",
    "CompiledJoints",
    "CompiledPart",
    "CompiledWeights",
    "Constraints",
    "Curvature",
    "Dataset",
    "Deformation",
    "Evaluation",
    "Expected",
    "JointEnergy",
    "JointResponse",
    "Kernel",
    "KeypointRecording",
    "KeypointStream",
    "LimitKeeping",
    "ListedShapeModel",
    "Method",
    "Multipliers",
    "Past",
    "Preprocessor",
    "Prior",
    "Problem",
    "Recording",
    "Registrar",
    "RegistrationResult",
    "Response",
    "RigidComparison",
    "RigidSimilarity",
    "Scene",
    "SegmentedRecording",
    "Segmenter",
    "ShapeModel",
    "Similarity",
    "Solution",
    "Solver",
    "Source",
    "Start",
    "StartSearch",
    "Stream",
    "Template",
    "Term",
    "TimedFrame",
    "Tracker",
    "VisibilityWeights",
    "Window",
    "check_field",
    "each_body",
]
