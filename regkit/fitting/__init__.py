"""Fitting of templates to skinned meshes.

- ``template``: the fitted template, where the parts come together.
- ``bones``: the segment of each bone of a mesh.
- ``layout``, ``posture``: the division of a mesh into segments, and its rest pose.
- ``flesh``, ``clusters``: samples of the volume and surface of each segment.
- ``body_model``: the template of a parametric body model, in the model's own pose.
- ``parts``, ``segment_capsules``: samples of a model's segments, and capsules in their place.
- ``carried_modes``: shape modes of a mesh, on the segments of a template.
- ``mesh_shape``: proportions, offsets and shapes of a mesh.
- ``skin``: the decimated mesh with segments as bones.
"""
