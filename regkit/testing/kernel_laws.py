"""Laws of kernels, for every shape that they accept."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from regkit.body import Body
from regkit.geometry.rigid import rigid
from regkit.observation import Observation
from regkit.system.arrays import Array
from regkit.testing.block_laws import BlockLaws
from regkit.testing.bound import Bound
from regkit.testing.cases import Pair
from regkit.testing.compiled_kernel_laws import CompiledKernelLaws
from regkit.testing.differences import Slopes
from regkit.testing.laws import checked_on_every
from regkit.testing.rigid_laws import RigidLaws
from regkit.testing.samples import moved_pose, posed, surface_data
from regkit.testing.shape_laws import attached
from regkit.testing.verdict import copied, require, same

THIRD_OF_A_TURN = rigid(np.eye(3)[[1, 2, 0]], np.array([0.3, -1.0, 0.7]))
"""Rotation about the diagonal, which maps boxes along the axes to such boxes."""
HALF_A_TURN = rigid(np.diag([-1.0, -1.0, 1.0]), np.zeros(3))
"""Rotation about the camera's axis, which leaves the view unchanged."""
FAR_AWAY = np.array([0.0, 0.0, 5.0])


class KernelLaws(BlockLaws, CompiledKernelLaws, RigidLaws):
    """Laws of kernels, including those of their blocks, compiled functions and rigid bodies."""

    @checked_on_every("option")
    @pytest.mark.parametrize("smoothing", [0.0, 0.02])
    def test_kernel_gradient_is_the_derivative_of_its_energy(
        self, bound: Bound, random: np.random.Generator, smoothing: float
    ) -> None:
        """Forces and torques agree with central differences on the joints of a body."""
        slopes = Slopes.of(bound.problem(smoothing), bound.near_start(random))
        require(
            slopes.largest > 0.0, bound.kernel,
            "has an energy that does not change with any motion of the body, for the shape "
            f"'{bound.pair.shape.kind}'",
            look_at=bound.answer,
        )  # fmt: skip
        require(slopes.agree(), bound.kernel, slopes.message(bound.body), look_at=bound.answer)

    def test_kernel_response_has_its_shapes_and_does_not_depend_on_the_curvature(
        self, bound: Bound
    ) -> None:
        """Wrenches are (K, 6), blocks on request (K, 6, 6), with the same energy."""
        placed, similarity = bound.placed(), bound.similarity()
        plain, curved = similarity(placed), similarity(placed, curvature=True)
        count, at = len(placed), bound.answer
        require(
            plain.wrenches.shape == (count, 6) and np.isfinite(plain.wrenches).all()
            and np.isfinite(plain.energy), bound.kernel,
            f"returns wrenches of shape {plain.wrenches.shape}, or not finite; they must "
            f"be {(count, 6)}: a force and a torque for each primitive", look_at=at,
        )  # fmt: skip
        require(
            plain.stiffness is None, bound.kernel,
            "returns blocks without a request; omit them if curvature is False",
            look_at=at,
        )  # fmt: skip
        require(
            curved.energy == plain.energy and np.array_equal(curved.wrenches, plain.wrenches),
            bound.kernel, "returns another energy or other wrenches if curvature is requested",
            look_at=at,
        )  # fmt: skip

    def test_segments_feel_the_sum_of_what_their_primitives_feel(self, bound: Bound) -> None:
        """``on_segments`` is the response, accumulated; it may only be faster."""
        placed, similarity = bound.placed(), bound.similarity()
        segments = len(bound.body.skeleton.names)
        own = similarity(placed, curvature=True)
        summed = similarity.on_segments(placed, segments, curvature=True)
        wrenches = placed.accumulate(own.wrenches, segments)
        agree = np.isclose(summed.energy, own.energy, rtol=1e-9)
        agree &= _alike(summed.wrenches, wrenches)
        if own.stiffness is not None:
            blocks = placed.accumulate_stiffness(own.stiffness, segments)
            agree &= summed.stiffness is not None and _alike(summed.stiffness, blocks)
        require(
            bool(agree), bound.kernel,
            "has other energy, wrenches or blocks in on_segments than in its response",
            look_at=type(similarity).on_segments,
        )  # fmt: skip

    def test_kernel_answers_for_the_point_after_a_step_in_place(
        self, bound: Bound, random: np.random.Generator
    ) -> None:
        """Solvers may write their next point into the array of the last one."""
        problem, x = bound.problem(), bound.near_start(random)
        problem.value_and_gradient(x)
        x += bound.near_start(random)
        stepped = problem.value_and_gradient(x)
        fresh = bound.problem().value_and_gradient(x.copy())
        require(
            same(stepped, fresh), bound.kernel, "evaluates the old point after a step in place: "
            f"the energy is {stepped[0]:.6g} for {fresh[0]:.6g}; do not cache by the identity of "
            "an array", look_at=bound.answer,
        )  # fmt: skip

    def test_kernel_takes_a_point_of_twice_the_weight_for_two(self, bound: Bound) -> None:
        """A weight is an amount of data, whether the energy is a sum or a mean."""
        # All variances are equal, since a kernel may use their mean.
        data = replace(bound.data, variances=np.full_like(bound.data.variances, 4e-4))
        half = np.arange(len(data.points)) % 2 == 0
        heavy = replace(data, weights=np.where(half, 2.0, 1.0) * data.weights)
        twice = np.concatenate([np.arange(len(half)), np.flatnonzero(half)])
        double = replace(
            data, points=data.points[twice], weights=data.weights[twice],
            variances=data.variances[twice],
            normals=None if data.normals is None else data.normals[twice],
        )  # fmt: skip
        placed = bound.placed()
        plain, weighted, counted = (
            bound.kernel.bind(each, placed)(placed).wrenches for each in (data, heavy, double)
        )
        # A loss may estimate its scale from the points alone, so a part of the effect may remain.
        left = np.abs(weighted - counted).max() / max(np.abs(plain - counted).max(), 1e-300)
        require(
            left < 0.8, bound.kernel, "ignores the weights of the data: twice a point's weight "
            f"should equal a second point, but {100 * left:.0f} % of the change in forces remains; "
            "use the observation's weights", look_at=bound.answer,
        )  # fmt: skip

    @checked_on_every("pair")
    @pytest.mark.parametrize("camera", [False, True], ids=["blind", "seen"])
    def test_kernel_is_left_alone_by_a_common_motion(self, bound: Bound, camera: bool) -> None:
        """Body and data move together: the energy stays, and the forces rotate with them.

        With a camera they rotate about its axis only.
        """
        motion = HALF_A_TURN if camera else THIRD_OF_A_TURN
        data = replace(bound.data, depth=None, camera=bound.data.camera if camera else None)
        bound = replace(bound, data=data)
        there = bound.moved(motion)
        first, second = bound.similarity()(bound.placed()), there.similarity()(there.placed())
        by = abs(second.energy - first.energy) / max(abs(first.energy), 1e-9)
        require(
            by < 1e-6, bound.kernel, f"has an energy that changes by {by:.2g} of itself if body "
            "and data move together; it may depend on their relative pose alone",
            look_at=bound.answer,
        )  # fmt: skip
        turn = motion[:3, :3]
        turned = np.concatenate(
            [first.wrenches[:, :3] @ turn.T, first.wrenches[:, 3:] @ turn.T], axis=1
        )
        by = np.abs(second.wrenches - turned).max() / max(np.abs(turned).max(), 1e-300)
        require(
            by < 1e-5, bound.kernel, f"has wrenches that do not rotate with body and data: "
            f"{by:.2g} relative to the largest; they must be given in the world's axes, about the "
            "primitives' centres", look_at=bound.answer,
        )  # fmt: skip

    @checked_on_every("pair")
    def test_kernel_prefers_the_body_where_the_data_are(
        self, pair: Pair, body: Body, random: np.random.Generator
    ) -> None:
        """The energy at the data's pose is lower than 0.1 m away in any direction."""
        start = posed(body, random)
        bound = Bound(pair, body, start, attached(pair.shape, body), surface_data(body, start))
        similarity = bound.similarity(0.01)
        here = similarity(bound.placed()).energy
        aside = [
            similarity(bound.placed(moved_pose(start, rigid(np.eye(3), 0.1 * way)))).energy
            for way in (*np.eye(3), *-np.eye(3))
        ]
        require(
            here < min(aside), bound.kernel, "prefers a body 0.1 m away from its data: the energy "
            f"is {min(aside):.6g} there and {here:.6g} at the data; registration minimizes it",
            look_at=bound.answer,
        )  # fmt: skip

    def test_kernel_explains_what_is_near_and_nothing_far_away(
        self, pair: Pair, body: Body, random: np.random.Generator
    ) -> None:
        """Inlier probabilities are 0 to 1, and higher on the surface than 5 m behind it."""
        start = posed(body, random)
        near = surface_data(body, start)
        points = np.concatenate([near.points, near.points[:5] + FAR_AWAY])
        data = Observation(
            points,
            np.ones(len(points)),
            np.full(len(points), 1e-4),
            normals=None if near.normals is None else np.resize(near.normals, points.shape),
        )
        bound = Bound(pair, body, start, attached(pair.shape, body), data)
        similarity = bound.similarity()
        probability = similarity.inlier_probability(bound.placed())
        if probability is None:
            pytest.skip("it has no inlier probabilities")
        at = type(similarity).inlier_probability
        require(
            probability.shape == (len(points),)
            and (probability >= 0.0).all()
            and (probability <= 1.0 + 1e-9).all(),
            bound.kernel,
            f"returns inlier probabilities from {np.min(probability):.2g} to "
            f"{np.max(probability):.2g}, in the shape {probability.shape}; they "
            f"must be 0 to 1, {(len(points),)}",
            look_at=at,
        )
        far, share = probability[-5:].max(), probability[:-5].mean()
        require(
            far < 0.1 and far < share, bound.kernel, f"returns inlier probability {far:.2g} for "
            f"points 5 m away, and {share:.2g} for those on the body's surface", look_at=at,
        )  # fmt: skip

    def test_kernel_energy_alone_is_that_of_its_response(self, bound: Bound) -> None:
        """Candidates are compared by the energy alone, which a kernel may compute faster."""
        similarity, placed = bound.similarity(), bound.placed()
        alone, whole = similarity.energy(placed), similarity(placed).energy
        require(
            bool(np.isclose(alone, whole, rtol=1e-9, atol=1e-12)), bound.kernel,
            f"has the energy {alone:.6g} alone but {whole:.6g} in its response",
            look_at=type(similarity).energy,
        )  # fmt: skip

    def test_kernel_is_deterministic_and_changes_nothing(self, bound: Bound) -> None:
        """Bound twice, it returns the same to the last bit, and modifies no argument."""
        placed = bound.placed()
        before = copied((bound.data.points, bound.data.weights, bound.data.variances, placed))
        answers = [bound.kernel.bind(bound.data, placed)(placed, curvature=True) for _ in range(2)]
        require(
            same(*answers), bound.kernel, "returns another result when called again",
            look_at=bound.answer,
        )  # fmt: skip
        after = (bound.data.points, bound.data.weights, bound.data.variances, placed)
        require(
            same(before, after), bound.kernel, "modifies the data or the primitives; copy arrays "
            "before writing to them", look_at=bound.answer,
        )  # fmt: skip


def _alike(one: Array, other: Array) -> bool:
    """Returns whether two arrays are equal up to rounding."""
    return bool(np.allclose(one, other, rtol=1e-7, atol=1e-9 * np.abs(other).max(initial=0.0)))
