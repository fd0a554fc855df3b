"""The start of a template of several bodies that move freely beside each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.body.verdict import Verdict
from regkit.interfaces import Method, Start, Template
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.start.divisions import Division
from regkit.start.scene import Scene
from regkit.start.scene_verdict import judged_scene
from regkit.start.several import FEWEST, Find, SeveralSearch


def with_free_bodies(
    find: Find, template: Template, observations: Sequence[Observation], method: Method
) -> Start | None:
    """Returns the start of several bodies that move freely; None if the template is one body.

    The points of the first frame are divided among the bodies, each is sought on its own points,
    and all are registered together. Bodies without a given size share one scale.

    Args:
        find: Search for the start of one body.
        template: The template.
        observations: The frames, the first one first.
        method: Method that registers.

    Raises:
        RegkitError: If a body does not support this search.
    """
    if not template.free_bodies():
        return None
    seen, sizes = observations[0], template.candidate_sizes()
    search = SeveralSearch.of(find, template, sizes[len(sizes) // 2], method, seen)
    scenes = search.scenes()
    if not scenes:
        return _nowhere(search)
    if len(sizes) > 1:
        sized = SeveralSearch.of(find, template, _size(search, template, scenes[0]), method, seen)
        parts = Division(scenes[0].owned(seen), cut=False)
        again = sized.contest(sized.of_division(parts))
        scenes, search = (again, sized) if again else (scenes, search)
    return judged_scene(scenes, search)


def _size(search: SeveralSearch, template: Template, scene: Scene) -> float:
    """Returns the size of the whole [m] that fits best, of those that its bodies tell alone.

    Args:
        search: The search at the usual size.
        template: The template of the whole.
        scene: The scene that it found.
    """
    each, seen = template.free_bodies().values(), search.observation
    ratios = []
    for one, free, own in zip(each, scene.body.free_bodies, scene.owned(seen), strict=True):
        if len(one.candidate_sizes()) > 1 and own.sum() >= FEWEST:
            found = search.find(one, [seen.only(own)])
            ratios.append(found.body.size / free.body.size)
    if not ratios:
        return scene.body.size
    usual = scene.body.size
    tried = [usual * ratio for ratio in (*ratios, float(np.exp(np.log(ratios).mean())))]

    def cost(size: float) -> float:
        """Returns the cost of the scene at a size [m]."""
        registrar = search.method.bind(template.body(size))
        pose = registrar.register(seen, [scene.pose]).pose
        unusual = float(np.log(size / usual) ** 2)
        return Scene.at(registrar, seen, pose, scene.starts).cost + unusual

    return min(tried, key=cost)


def _nowhere(search: SeveralSearch) -> Start:
    """Returns the start of bodies with too few points, all in the middle of these."""
    body, points = search.registrar.body, search.observation.points
    pose: Pose = body.skeleton.rest()
    for one in body.free_bodies:
        own = one.body.skeleton.rest()
        root = own.root.copy()
        root[:3, 3] = points.mean(axis=0)
        pose = one.placed(Pose(root, own.balls, own.hinges), pose)
    reason = f"{len(points)} points are too few for {len(body.free_bodies)} bodies"
    return Start(body, pose, Verdict.LOST, reason)
