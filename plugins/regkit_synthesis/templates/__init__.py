"""Generation of the shipped templates: proportions, surfaces and Gaussians of skinned meshes.

``human`` and ``hand`` fit a body description to a mesh: ``*_layout`` divides the mesh into
segments, ``*_limits`` defines joint limits and their comments. ``templates`` adds the skin and
writes the files.
"""

from regkit_synthesis.templates.templates import (
    FittedTemplate,
    human_template,
    left_hand_template,
    right_hand_template,
)

__all__ = [
    "FittedTemplate",
    "human_template",
    "left_hand_template",
    "right_hand_template",
]
