"""What a report is made of: everything that a results folder holds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from regkit.metrics import Measure
from regkit.metrics.pairs import Pair, compared
from regkit.report.record import Record
from regkit.report.style import Style, styles

MOST_DRAWN = 12
"""Curves or bars of more methods than this in one figure cannot be told apart."""


@dataclass(frozen=True)
class Run:
    """The results of an experiment.

    Attributes:
        config: The experiment with every default filled in.
        text: The same as YAML.
        environment: Versions and machine.
        measures: Figures by method and recording.
        failures: Why a recording failed, by method and recording.
        records: What is kept of each finished recording, by method and recording.
        chosen: Pairs of methods that the user wants compared.
    """

    config: Mapping[str, Any]
    text: str
    environment: Mapping[str, Any]
    measures: Mapping[str, Mapping[str, Measure]]
    failures: Mapping[str, Mapping[str, str]]
    records: Mapping[str, Mapping[str, Record]]
    chosen: tuple[tuple[str, str], ...] = ()

    @property
    def name(self) -> str:
        """What the experiment is called."""
        return str(self.config.get("name", "results"))

    @cached_property
    def recordings(self) -> list[str]:
        """The names of all recordings, in the order in which they were met."""
        found = [name for by in (*self.measures.values(), *self.failures.values()) for name in by]
        return list(dict.fromkeys(found))

    @cached_property
    def finished(self) -> dict[str, Mapping[str, Measure]]:
        """The figures of the methods that finished a recording."""
        return {name: by_recording for name, by_recording in self.measures.items() if by_recording}

    @cached_property
    def shared(self) -> list[str]:
        """The recordings that every method finished, of those that finished any."""
        return [s for s in self.recordings if all(s in by for by in self.finished.values())]

    @cached_property
    def drawn(self) -> list[str]:
        """The methods that share a figure: all that finished a recording, or the best of many."""
        names = list(self.finished)
        if len(names) <= MOST_DRAWN:
            return names

        def mean(name: str) -> float:
            values = [self.value(name, recording) for recording in self.finished[name]]
            known = [value for value in values if value is not None]
            return float(np.mean(known)) if known else np.inf

        chosen = sorted(names, key=mean)[:MOST_DRAWN]
        return [name for name in names if name in chosen]

    @property
    def not_drawn(self) -> str:
        """What a figure's caption says of the methods that are left out of it."""
        if len(self.drawn) == len(self.finished):
            return ""
        return f" Of {len(self.finished)} methods the {len(self.drawn)} best are drawn."

    @cached_property
    def compared(self) -> bool:
        """Whether anyone has a joint error."""
        known = (m.joint_error_raw_cm for by in self.measures.values() for m in by.values())
        return any(one is not None for one in known)

    @property
    def figure(self) -> str:
        """The figure that methods are judged by: the joint error where anyone has it."""
        return "joint_error_raw_cm" if self.compared else "surface_distance_mm"

    def value(self, method: str, recording: str, figure: str | None = None) -> float | None:
        """A figure of a method on a recording, or None."""
        measure = self.measures.get(method, {}).get(recording)
        value: float | None = None if measure is None else getattr(measure, figure or self.figure)
        return value

    @cached_property
    def styles(self) -> dict[str, Style]:
        """How each method is drawn."""
        return method_styles(self.config, self.measures)

    def style(self, method: str) -> Style:
        """How a method is drawn."""
        return self.styles[method]

    @cached_property
    def shape_pairs(self) -> list[tuple[str, str]]:
        """Methods that differ in their shape model alone."""
        methods = {name: dict(self.method(name)) for name in self.finished}
        shapes = {name: config.pop("shape", None) for name, config in methods.items()}
        names = [name for name in methods if shapes[name] is not None]
        return [
            (one, other)
            for index, one in enumerate(names)
            for other in names[index + 1 :]
            if methods[one] == methods[other]
            and kind_of(shapes[one]) != kind_of(shapes[other])
            and one.rpartition("/")[0] == other.rpartition("/")[0]
        ]

    def method(self, name: str) -> Mapping[str, Any]:
        """The configuration of a method."""
        return _configured(self.config, name)

    def pairs(self) -> list[Pair]:
        """The tests between pairs of methods: the best one, of shape models, and chosen ones."""
        figures = [self.figure]
        if self.compared:
            figures.append("joint_error_adjusted_cm")
        chosen = (*self.shape_pairs, *self.chosen)
        return [pair for figure in figures for pair in compared(self.finished, figure, chosen)]

    def worst(self, method: str) -> list[str]:
        """The recordings that a method finished, the worst first; those without a figure last."""
        values = {name: self.value(method, name) for name in self.measures.get(method, {})}
        return sorted(values, key=lambda name: -_or(values[name], -np.inf))


def method_styles(config: Mapping[str, Any], others: Iterable[str] = ()) -> dict[str, Style]:
    """How each method of an experiment is drawn, and others that it does not name.

    A method that a sweep runs as ``SETTING/METHOD`` is not drawn itself, and takes no colour.
    """
    names = list(others)
    swept = {name.rpartition("/")[2] for name in names if "/" in name}
    methods: dict[str, Mapping[str, Any]] = {
        name: method for name, method in config.get("methods", {}).items() if name not in swept
    }
    methods.update({name: _configured(config, name) for name in names if name not in methods})
    return styles({name: shape_of(method) or name for name, method in methods.items()})


def _configured(config: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    """The configuration of a method, which a sweep calls ``SETTING/METHOD``."""
    methods: Mapping[str, Mapping[str, Any]] = config.get("methods", {})
    return methods.get(name, methods.get(name.rpartition("/")[2], {}))


def shape_of(method: Mapping[str, Any]) -> str | None:
    """The kind of a method's shape model, or its own if it has none."""
    return kind_of(method.get("shape")) or kind_of(method)


def kind_of(plugin: Any) -> str | None:
    """The kind of a plug-in's configuration, which may be its name alone."""
    if isinstance(plugin, Mapping):
        return str(plugin["kind"]) if "kind" in plugin else None
    return None if plugin is None else str(plugin)


def _or(value: float | None, other: float) -> float:
    return other if value is None else value
