"""Templates, the bodies to register, and their YAML files.

- ``human``, ``hand``: the shipped people and hands.
- ``file``: a template in a YAML file.
- ``cloud``: a rigid point cloud or mesh.
- ``reading``: not a plug-in; cached reading of template files.
"""

from pathlib import Path

FOLDER = Path(__file__).resolve().parent
"""Folder of the shipped templates."""
