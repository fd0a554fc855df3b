"""Cases of the laws: installed plug-ins with their options."""

from __future__ import annotations

import typing
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from pydantic import ValidationError

from regkit.config.installed import Installed, same_distribution
from regkit.config.plugin import Plugin
from regkit.interfaces import SLOTS, Kernel, ShapeModel, Term
from regkit.system.errors import PluginError

Options = Mapping[str, Any]
"""A plug-in's fields as in YAML, without its kind."""
Examples = Mapping[str, Options | Sequence[Options]]
"""Options by kind, or by ``group.kind`` if two groups have the same kind."""


Scope = Literal["class", "pair", "option"]
"""Scope of a law: each class once; each pair of a kernel's or term's class with a shape's class; or
each named option in addition."""


@dataclass(frozen=True)
class Case:
    """A plug-in with options, or the reason for its absence.

    Attributes:
        slot: Its group.
        kind: Its name.
        name: Unique name in the identifier of a test.
        own: Whether it is tested itself, and not only used by tests of others.
        plugin: The plug-in, if it could be created.
        missing: Required fields without an example.
        broken: Why it cannot be loaded.
        scope: Smallest scope of the laws that are tested on it.
    """

    slot: type[Plugin]
    kind: str
    name: str
    own: bool
    plugin: Plugin | None = None
    missing: tuple[str, ...] = ()
    broken: str = ""
    scope: Scope = "class"


@dataclass(frozen=True)
class Pair:
    """A kernel or a term with a shape whose primitives it accepts.

    Attributes:
        plugin: The kernel or the term.
        shape: The shape.
        name: Identifier of a test.
        scope: Smallest scope of the laws that are tested on it.
        suspect: The shape, if only it is under test and not its partner.
    """

    plugin: Plugin
    shape: ShapeModel
    name: str
    scope: Scope = "class"
    suspect: ShapeModel | None = None


def cases(subjects: Sequence[str | type[Plugin]], examples: Examples) -> list[Case]:
    """Returns all installed plug-ins as cases.

    Args:
        subjects: Names of distributions and classes of plug-ins to test; all if empty.
        examples: Options of plug-ins with required fields, or further options to test.

    Raises:
        PluginError: If a distribution provides no plug-in, or an example is invalid.
    """
    found = []
    for slot in SLOTS:
        for kind, origin in slot.available().items():
            own = not subjects or any(_is_of(origin, subject) for subject in subjects)
            found += list(_cases_of(slot, kind, own, examples))
    brought = {
        name for slot in SLOTS for origin in slot.available().values() for name in _names(origin)
    }
    for subject in subjects:
        if isinstance(subject, str) and not any(same_distribution(subject, n) for n in brought):
            raise PluginError(
                f"no installed distribution '{subject}' provides a plug-in (there are: "
                f"{', '.join(sorted(brought))}); install it: pip install -e ."
            )
        if not isinstance(subject, str) and not any(
            subject is origin for slot in SLOTS for origin in slot.available().values()
        ):
            raise PluginError(f"{subject.__qualname__} is not registered: decorate it by @register")
    return found


def pairs(found: Sequence[Case], slot: type[Kernel] | type[Term]) -> list[Pair]:
    """Returns kernels or terms with the shapes that they accept, one of which is under test.

    A kernel is paired with every shape. A term depends on the primitives alone: it is paired with
    one shape for each type of them. Further options of both are paired with one shape.
    """
    made = []
    for one in found:
        if not isinstance(one.plugin, slot):
            continue
        partners = {
            (two.plugin.makes if slot is Term else two.name): (two.plugin, two)
            for two in reversed(found)  # The first shape of a type comes last, and stays.
            if isinstance(two.plugin, ShapeModel)
            and (one.own or two.own)
            and accepts(one.plugin, two.plugin)
        }
        for index, (shape, two) in enumerate(reversed(partners.values())):
            other = one.scope == "option" or (index > 0 and two.scope == "option")
            scope: Scope = "option" if other else "pair" if index else "class"
            suspect = None if one.own else shape
            name = f"{one.name}-{two.name}" if one.own else f"{two.name}-{one.name}"
            made.append(Pair(one.plugin, shape, name, scope, suspect))
            if one.scope == "option":
                break
    return made


def accepts(plugin: Kernel | Term, shape: ShapeModel) -> bool:
    """Whether a kernel or a term accepts a shape's primitives."""
    if isinstance(plugin, Term):
        return issubclass(shape.makes, plugin.accepts)
    try:
        plugin.check_shape(shape)
    except ValueError:
        return False
    return True


def _is_of(origin: Installed | type[Plugin], subject: str | type[Plugin]) -> bool:
    if isinstance(subject, str):
        return any(same_distribution(subject, name) for name in _names(origin))
    return origin is subject


def _names(origin: Installed | type[Plugin]) -> tuple[str, ...]:
    return origin.distributions if isinstance(origin, Installed) else ()


def _cases_of(slot: type[Plugin], kind: str, own: bool, examples: Examples) -> Iterator[Case]:
    try:
        plugin = slot.load(kind)
    except PluginError as error:
        yield Case(slot, kind, kind, own, broken=str(error))
        return
    group = slot.group.removeprefix("regkit.")
    given = examples.get(f"{group}.{kind}", examples.get(kind))
    tried: list[Options] = [given] if isinstance(given, Mapping) else list(given or [{}])
    for index, options in enumerate(tried):
        name = kind if len(tried) == 1 else "-".join([kind, *_leaves(options)])
        scope: Scope = "option" if index else "class"
        try:
            yield Case(slot, kind, name, own, plugin.model_validate(options), scope=scope)
        except ValidationError as error:
            missing = [str(each["loc"][0]) for each in error.errors() if each["type"] == "missing"]
            if given is not None:
                raise PluginError(f"the example of {group}.{kind} is invalid: {error}") from None
            # A broken plug-in of another distribution must not end the tests of this one.
            broken = "" if missing else f"{group}.{kind} has defaults that {_misfit(error)}"
            yield Case(slot, kind, name, own, missing=tuple(missing), broken=broken)
            return
        for change in _other_choices(plugin, options) if index == 0 else ():
            field, value = next(iter(change.items()))
            try:
                changed = plugin.model_validate({**options, **change})
            except ValidationError:
                continue  # This choice requires other fields, which an example can provide.
            yield Case(slot, kind, f"{name}-{field}={value}", own, changed, scope="option")


def _misfit(error: ValidationError) -> str:
    """Returns the invalid fields in one line."""
    wrong = [f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors()]
    return f"are invalid ({'; '.join(wrong)})"


def _other_choices(plugin: type[Plugin], options: Options) -> Iterator[dict[str, Any]]:
    """Yields, for each field with a few named values, those other than the current one."""
    for name, field in plugin.model_fields.items():
        if name == "kind" or typing.get_origin(field.annotation) is not Literal:
            continue
        for value in typing.get_args(field.annotation):
            if value != options.get(name, field.default):
                yield {name: value}


def _leaves(options: Any) -> list[str]:
    """Returns the values in options, as parts of a test's identifier."""
    if isinstance(options, Mapping):
        return [leaf for value in options.values() for leaf in _leaves(value)]
    if isinstance(options, list | tuple):
        return [leaf for value in options for leaf in _leaves(value)]
    return [Path(str(options)).name]
