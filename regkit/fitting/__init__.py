"""Fitting of templates to skinned meshes.

- ``template``: the fitted template, where the parts come together.
- ``bones``: the segment of each bone of a mesh.
- ``layout``, ``posture``: the division of a mesh into segments, and its rest pose.
- ``flesh``, ``clusters``: samples of the volume and surface of each segment.
- ``mesh_shape``: proportions, offsets and shapes of a mesh.
- ``skin``: the decimated mesh with segments as bones.
"""
