"""The coarse-to-fine method for surfaces of many points, with ever narrower Gaussians."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from regkit.body import Body
from regkit.config.quantities import Tolerance
from regkit.gaussians.cloud_shape import CloudShape
from regkit.interfaces import Kernel, Method, ShapeModel, Solver
from regkit.system.threads import using_threads
from regkit_plugins.methods.coarse_to_fine.bound import BoundCoarseToFine
from regkit_plugins.methods.coarse_to_fine.resolutions import resolutions

Part = Annotated[float, Field(ge=1e-3, le=1e3)]


class CoarseToFine(Method):
    """Registers a body's surface points to a cloud, from few wide Gaussians to many narrow ones.

    At each resolution both are downsampled to one point per voxel, and each point is a Gaussian
    some voxels wide. The solver minimises the energy, and neighbours are updated after each
    solution. The result is the start of the next resolution; the last one uses all points.
    """

    kind: Literal["coarse_to_fine"] = "coarse_to_fine"

    shape: ShapeModel
    """Shape model of the body's surface, cloud_gsog or cloud_sog; the method sets its width."""
    kernel: Kernel
    """Kernel that compares the shape model with the data."""
    solver: Solver
    """Solver that minimises the energy between two updates of the neighbours."""
    coarsest: Part = 0.1
    """Size of the first voxels, as a fraction of the body's size."""
    finest: Part = 1.0
    """Size of the last voxels, as a fraction of the spacing of neighbouring points."""
    resolutions: Annotated[int, Field(ge=1, le=50)] = 6
    """Number of resolutions, with voxel sizes in geometric progression; of a cloud whose points are
    sparse there are fewer."""
    width: Part = 2.0
    """Standard deviation of a pair of Gaussians along the surface, in voxels."""
    searches: Annotated[int, Field(ge=1, le=1000)] = 10
    """Maximum number of neighbour updates at each resolution."""
    motion_tolerance: Tolerance = 0.1
    """The next resolution begins when the root mean square motion of the body's points, in voxels,
    is at most this."""
    threads: Annotated[int, Field(ge=1, le=256)] | None = None
    """Number of threads, one by default or as many as ``regkit align --threads`` says. An
    experiment already computes one recording on each core, where more threads would only disturb
    one another; they shorten a single registration of many points. The result is the same to the
    last bit."""

    @model_validator(mode="after")
    def _parts_fit(self) -> CoarseToFine:
        if not isinstance(self.shape, CloudShape):
            raise ValueError(
                f"shape '{self.shape.kind}' has no width that could be changed; take cloud_gsog "
                "or cloud_sog"
            )
        self.kernel.check_shape(self.shape)
        return self

    def bind(self, body: Body) -> BoundCoarseToFine:
        """Binds the method to a body, with Gaussians of its surface at every resolution.

        Raises:
            ConfigError: If the body has no surface.
        """
        assert isinstance(self.shape, CloudShape)
        with using_threads(self.threads):
            levels = resolutions(
                body,
                self.shape,
                coarsest=self.coarsest,
                finest=self.finest,
                count=self.resolutions,
                width=self.width,
            )
        return BoundCoarseToFine(self, body, levels[-1].primitives, levels)
