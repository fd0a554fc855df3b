"""Search over rotations and over the configurations of limbs, for starts and trackers.

- ``limbs``: the limbs of a skeleton, chains of segments from the trunk.
- ``limb_search``: the configuration of a limb that best matches unexplained data.
- ``rotations``: rigid alignment from many initial rotations.
- ``compiled``: distances of limb configurations to points in compiled loops.
"""
