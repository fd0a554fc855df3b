"""Expansion of lists in an experiment's YAML to several experiments."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import Annotated, Any

from pydantic import ConfigDict, Field

from regkit.config.document import Document
from regkit.config.model import Model, did_you_mean
from regkit.experiment.experiment import Experiment
from regkit.experiment.sweeps.labels import variants
from regkit.system.errors import ConfigError

MOST = 1000
"""Maximum number of combinations; more are assumed to be a mistake."""

Lists = dict[str, Annotated[list[Any], Field(min_length=1)]]


class SweptExperiment(Experiment):
    """An experiment with lists of values; each combination of values is run."""

    model_config = ConfigDict(title="Experiment")

    sweep: Lists = Field(default_factory=dict)
    """Lists of values by the path to a field, such as ``methods.best.kernel.sigma``. Lists below a
    method make variants of it in one table; other lists make experiments in folders of their
    own."""


class _Sweep(Model):
    sweep: Lists = Field(default_factory=dict)


@dataclass(frozen=True)
class Axis:
    """One list of a sweep.

    Attributes:
        keys: Path to the field.
        values: Values of the field.
        places: Where each value was written.
    """

    keys: tuple[str, ...]
    values: list[Any]
    places: list[str]


@dataclass(frozen=True)
class Combination:
    """One of the documents of a sweep.

    Attributes:
        name: Valid as a folder's name; empty if it is the only one.
        fields: Paths to the swept fields outside methods.
        document: The experiment, with swept methods replaced by their variants.
    """

    name: str
    fields: tuple[tuple[str, ...], ...]
    document: Document


def combinations(document: Document) -> list[Combination]:
    """Returns the experiments of a document, in the order of its lists, the last varying fastest.

    Raises:
        ConfigError: If a list is empty or not a list, its field is unknown, or there are too many
            combinations.
    """
    axes = list(_axes(document))
    count = prod(len(axis.values) for axis in axes)
    if count > MOST:
        raise ConfigError(
            f"{' x '.join(str(len(axis.values)) for axis in axes)} = {count} combinations; the "
            f"maximum is {MOST}",
            place=document.place(("sweep",)),
        )
    base = _with_variants(document.without("sweep"), axes)
    others = [axis for axis in axes if axis.keys[0] != "methods"]
    fields = tuple(axis.keys for axis in others)
    names = variants("", {axis.keys: axis.values for axis in others})
    made = [_changed(base, others, chosen) for chosen in _choices(others)]
    return [Combination(name, fields, one) for name, one in zip(names, made, strict=True)]


def _axes(document: Document) -> Iterator[Axis]:
    lists = document.data.get("sweep", {})
    Document({"sweep": lists}, document.places).validated(_Sweep)
    methods = document.data.get("methods")
    for way, values in lists.items():
        keys = tuple(way.split("."))
        place = document.place(("sweep", way))
        if not all(keys):
            raise ConfigError("a field must read a.b.c", place=place)
        if keys[0] in ("name", "sweep") or keys == ("methods",):
            raise ConfigError(f"'{way}' cannot be swept", place=place)
        if keys[0] == "methods" and isinstance(methods, dict) and keys[1] not in methods:
            raise ConfigError(
                f"no method '{keys[1]}' (there are: {', '.join(methods)})"
                + did_you_mean(keys[1], list(methods)),
                place=place,
            )
        for index, value in enumerate(values):
            if value in values[:index]:
                raise ConfigError(f"{value} is listed twice", place=place)
        places = [document.places.get(("sweep", way, index), place) for index in range(len(values))]
        yield Axis(keys, values, places)


def _with_variants(document: Document, axes: list[Axis]) -> Document:
    """Returns the document with swept methods replaced by their variants."""
    if not isinstance(document.data.get("methods"), dict):
        return document
    methods: dict[str, Any] = {}
    places = {at: place for at, place in document.places.items() if at[:1] != ("methods",)}
    for method in document.data["methods"]:
        own = [axis for axis in axes if axis.keys[:2] == ("methods", method)]
        names = variants(method, {axis.keys[2:]: axis.values for axis in own})
        for name, chosen in zip(names, _choices(own), strict=True):
            one = _changed(document, own, chosen)
            methods[name] = one.data["methods"][method]
            for at, place in one.places.items():
                if at[:2] == ("methods", method):
                    places["methods", name, *at[2:]] = place
    places[("methods",)] = document.place(("methods",)).rpartition(": ")[0]
    return Document({**document.data, "methods": methods}, places)


def _choices(axes: list[Axis]) -> Iterable[tuple[int, ...]]:
    return product(*(range(len(axis.values)) for axis in axes))


def _changed(document: Document, axes: list[Axis], chosen: tuple[int, ...]) -> Document:
    for axis, index in zip(axes, chosen, strict=True):
        document = document.changed(axis.keys, axis.values[index], place=axis.places[index])
    return document
