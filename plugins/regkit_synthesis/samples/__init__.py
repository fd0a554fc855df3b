"""Generation of the shipped samples: ``depth`` recordings, ``mannequin`` clouds, ``keypoints``."""

from regkit_synthesis.samples.depth import hand_gestures, human_walk

__all__ = ["hand_gestures", "human_walk"]
