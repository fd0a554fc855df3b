"""Landmarks as an energy of the joints, which a term and the search for poses share.

- ``table``: the landmarks of a frame as rows of numbers.
- ``energy``, ``compiled``: the energy in its readable and its compiled form.
"""

from regkit.registration.landmarks.compiled import respond_joints
from regkit.registration.landmarks.energy import LandmarkEnergy
from regkit.registration.landmarks.table import COLUMNS, WEIGHT, landmark_table

__all__ = ["COLUMNS", "WEIGHT", "LandmarkEnergy", "landmark_table", "respond_joints"]
