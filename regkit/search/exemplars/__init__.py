"""Exemplars: a template's own poses from all sides, looked up by their small depth images.

- ``poses``: the poses and views of an atlas, sampled within the joint limits.
- ``images``, ``descriptors``: small orthographic depth images, in compiled loops.
- ``atlas``, ``storage``: the exemplars of a template, and their cache.
- ``blocks``, ``pictures``: the data as small images, of a camera or of virtual cameras.
- ``lookup``: the exemplars that resemble the data.
- ``rendering``, ``pulls``, ``refinement``: comparison with the data, and a few steps towards them.
- ``finder``: all of it, from a frame to poses that may explain it.
"""

from regkit.search.exemplars.atlas import Atlas, AtlasSettings
from regkit.search.exemplars.exemplar import Exemplar
from regkit.search.exemplars.finder import Finder
from regkit.search.exemplars.lookup import even_rolls
from regkit.search.exemplars.pictures import Pictures
from regkit.search.exemplars.storage import atlas_of
from regkit.search.exemplars.variation import BRIEF, THOROUGH, Variation

__all__ = [
    "BRIEF",
    "THOROUGH",
    "Atlas",
    "AtlasSettings",
    "Exemplar",
    "Finder",
    "Pictures",
    "Variation",
    "atlas_of",
    "even_rolls",
]
