"""Terms, which add energies or weights to a kernel.

- ``clamp``: limits the overlap that each point contributes.
- ``continuity``: keeps the pose close to its prediction.
- ``free_space``: keeps the body out of free space.
- ``intersection``: keeps the parts of a body apart.
- ``limits``: penalises violations of joint limits.
- ``visibility``: weights of occluded primitives.
"""
