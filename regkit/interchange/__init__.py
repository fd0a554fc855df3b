"""Import and export of skeletons, skinned meshes and motion in the formats of other programs.

- ``skeletons``: ``read_skeleton`` imports BVH and URDF skeletons as templates.
- ``meshes``: ``read_mesh`` imports skinned meshes from glTF and NPZ.
- ``motions``: ``write_motion`` exports tracked motion as BVH, CSV or glTF.
- ``bvh``, ``gltf``, ``urdf``: the formats.
- ``imported``: the common part of imported skeletons.

The package does not import its modules, because the formats load slowly.
"""
