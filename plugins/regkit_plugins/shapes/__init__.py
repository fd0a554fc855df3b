"""Shape models, which turn a body into primitives.

- ``sog``, ``gsog``: isotropic and anisotropic Gaussians of the template.
- ``cloud_sog``, ``cloud_gsog``: Gaussians at the points of a surface.
- ``mesh``: the vertices of a skinned mesh as surfels.
- ``sphere``: the capsules of the template, or spheres along them.
- ``surface``: not a plug-in; the option to use visible surfaces, shared by ``sog`` and ``gsog``.
"""
