"""Makes the templates that ship: proportions, surfaces and Gaussians fitted to skinned meshes.

``human`` and ``hand`` describe a body that is fitted to a mesh: ``*_layout`` says which parts of
the mesh are which segments, ``*_limits`` how its joints may move and how the file explains that.
``templates`` adds the skin, and writes both as files.
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
