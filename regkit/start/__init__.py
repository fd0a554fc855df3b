"""What the searches for a start share: the pose and size in the first frames of a recording.

- ``scan``: a cloud and its two-sided distance to bodies.
- ``fit``: fits of a posed body to a cloud, annealed from far to near.
- ``sizes``: fits that are comparable between sizes.
- ``finalist``: poses that a method has registered, and their costs; trackers that seek a lost body
  compare them too.
- ``rigid``, ``cloud``: starts of rigid surfaces.
- ``free_root``: starts of bodies whose root is fixed in the world.
- ``further``: whether a template has the further parts that it may have.
- ``inside``: the start of a body with parts, whose base is found first.
- ``beside``, ``several``: the start of bodies beside each other; ``divisions`` divides the points
  among them, a ``scene`` is a pose of all, and ``scene_verdict`` judges it.
- ``of_size``: a template at a size.
- ``unseen``: limbs that no camera shows.
- ``verdict``: whether a start was found.
"""

from regkit.start.beside import with_free_bodies
from regkit.start.candidate import Candidate
from regkit.start.finalist import Finalist
from regkit.start.free_root import FreeRoot, at_root, is_fixed, standing
from regkit.start.further import with_further_parts
from regkit.start.inside import with_parts
from regkit.start.rigid import rigid_start
from regkit.start.scan import Scan
from regkit.start.unseen import rested
from regkit.start.verdict import judged

__all__ = [
    "Candidate",
    "Finalist",
    "FreeRoot",
    "Scan",
    "at_root",
    "is_fixed",
    "judged",
    "rested",
    "rigid_start",
    "standing",
    "with_free_bodies",
    "with_further_parts",
    "with_parts",
]
