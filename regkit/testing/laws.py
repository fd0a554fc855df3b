"""Laws: tests with the plug-ins of a conformance suite as parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import ClassVar, TypeVar, get_args

import numpy as np
import pytest

from regkit.body import Body
from regkit.testing.cases import Case, Pair, Scope
from regkit.testing.samples import linkage, lump
from regkit.testing.verdict import suspecting

Law = TypeVar("Law", bound=Callable[..., None])


def checked_on_every(scope: Scope) -> Callable[[Law], Law]:
    """Decorator of a law to test on each pair of classes, or on each option."""

    def marked(law: Law) -> Law:
        law.scope = scope  # type: ignore[attr-defined]
        return law

    return marked


class Laws:
    """Tests with a plug-in, or a pair of plug-ins, as their argument.

    A law is tested once for each class of plug-ins, unless ``checked_on_every`` sets another scope.
    """

    parameters: ClassVar[Mapping[str, Sequence[Case | Pair]]] = {}
    """Cases by the name of the argument."""

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        """Gives each test the cases of its argument."""
        scopes = get_args(Scope)
        checked = scopes[: 1 + scopes.index(getattr(metafunc.function, "scope", "class"))]
        for argument, cases in self.parameters.items():
            if argument in metafunc.fixturenames:
                chosen = [_parameter(argument, each) for each in cases if each.scope in checked]
                metafunc.parametrize(argument, chosen)

    @pytest.fixture(autouse=True)
    def suspect(self, request: pytest.FixtureRequest) -> Iterator[None]:
        """Names the one under test of a pair first, if a law is violated."""
        called = getattr(request.node, "callspec", None)
        pairs = [one for one in called.params.values() if isinstance(one, Pair)] if called else []
        with suspecting(pairs[0].suspect if pairs else None):
            yield

    @pytest.fixture
    def body(self) -> Body:
        """The body to register: a linkage with every type of joint, capsules and a skin."""
        return linkage()

    @pytest.fixture
    def rigid_body(self) -> Body:
        """The body for methods without joints: a closed surface without symmetry."""
        return lump()

    @pytest.fixture
    def random(self) -> np.random.Generator:
        """Random numbers, the same in every test."""
        return np.random.default_rng(7)


def _parameter(argument: str, case: Case | Pair) -> object:
    if isinstance(case, Pair):
        return pytest.param(case, id=case.name)
    if argument == "plugin":
        return pytest.param(case, id=f"{case.slot.group.removeprefix('regkit.')}.{case.name}")
    if case.missing:
        group = case.slot.group.removeprefix("regkit.")
        reason = (
            f"needs {', '.join(case.missing)}: give conformance() an example, "
            f'examples={{"{group}.{case.kind}": {{...}}}}'
        )
        return pytest.param(None, id=case.name, marks=pytest.mark.skip(reason=reason))
    return pytest.param(case.plugin, id=case.name)
