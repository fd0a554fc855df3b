"""The contents of a results folder, from which a report is made."""

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
"""Maximum number of methods in one figure; more curves or bars are indistinguishable."""


@dataclass(frozen=True)
class Run:
    """The results of an experiment.

    Attributes:
        config: The experiment's configuration with all defaults.
        text: The same as YAML.
        environment: Machine and library versions.
        measures: Metrics by method and recording.
        failures: Reasons of failure by method and recording.
        records: Records of finished recordings by method and recording.
        chosen: Pairs of methods that the user selected for comparison.
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
        """The name of the experiment."""
        return str(self.config.get("name", "results"))

    @cached_property
    def recordings(self) -> list[str]:
        """The names of all recordings, in order of first occurrence."""
        found = [name for by in (*self.measures.values(), *self.failures.values()) for name in by]
        return list(dict.fromkeys(found))

    @cached_property
    def finished(self) -> dict[str, Mapping[str, Measure]]:
        """The metrics of the methods that finished at least one recording."""
        return {name: by_recording for name, by_recording in self.measures.items() if by_recording}

    @cached_property
    def shared(self) -> list[str]:
        """The recordings that all methods in ``finished`` have finished."""
        return [s for s in self.recordings if all(s in by for by in self.finished.values())]

    @cached_property
    def drawn(self) -> list[str]:
        """The methods that are drawn: those in ``finished``, or the best of them if too many."""
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
        """The sentence of a caption about methods that are not drawn."""
        if len(self.drawn) == len(self.finished):
            return ""
        return f" Of {len(self.finished)} methods the {len(self.drawn)} best are drawn."

    @cached_property
    def compared(self) -> bool:
        """Whether any method has joint errors."""
        known = (m.joint_error_raw_cm for by in self.measures.values() for m in by.values())
        return any(one is not None for one in known)

    @property
    def metric(self) -> str:
        """The metric that ranks methods: the joint error if any method has one."""
        return "joint_error_raw_cm" if self.compared else "surface_distance_mm"

    def value(self, method: str, recording: str, metric: str | None = None) -> float | None:
        """Returns a metric, by default the ranking one, of a method on a recording, or None."""
        measure = self.measures.get(method, {}).get(recording)
        value: float | None = None if measure is None else getattr(measure, metric or self.metric)
        return value

    @cached_property
    def styles(self) -> dict[str, Style]:
        """The style of each method."""
        return method_styles(self.config, self.measures)

    def style(self, method: str) -> Style:
        """Returns the style of a method."""
        return self.styles[method]

    @cached_property
    def shape_pairs(self) -> list[tuple[str, str]]:
        """Pairs of methods that differ in their shape model only."""
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
        """Returns the configuration of a method."""
        return _configured(self.config, name)

    def pairs(self) -> list[Pair]:
        """Returns the comparisons of the best method with others, of shape models, and chosen."""
        metrics = [self.metric]
        if self.compared:
            metrics.append("joint_error_adjusted_cm")
        chosen = (*self.shape_pairs, *self.chosen)
        return [pair for metric in metrics for pair in compared(self.finished, metric, chosen)]

    def worst(self, method: str) -> list[str]:
        """Returns the recordings that a method finished, worst first, without a metric last."""
        values = {name: self.value(method, name) for name in self.measures.get(method, {})}
        return sorted(values, key=lambda name: -_or(values[name], -np.inf))


def method_styles(config: Mapping[str, Any], others: Iterable[str] = ()) -> dict[str, Style]:
    """Returns the style of each method of an experiment, and of others that it does not list.

    A method that a sweep runs as ``SETTING/METHOD`` is not drawn itself and gets no style.
    """
    names = list(others)
    swept = {name.rpartition("/")[2] for name in names if "/" in name}
    methods: dict[str, Mapping[str, Any]] = {
        name: method for name, method in config.get("methods", {}).items() if name not in swept
    }
    methods.update({name: _configured(config, name) for name in names if name not in methods})
    return styles({name: shape_of(method) or name for name, method in methods.items()})


def _configured(config: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    """Returns the configuration of a method, also by its name in a sweep, ``SETTING/METHOD``."""
    methods: Mapping[str, Mapping[str, Any]] = config.get("methods", {})
    return methods.get(name, methods.get(name.rpartition("/")[2], {}))


def shape_of(method: Mapping[str, Any]) -> str | None:
    """Returns the kind of a method's shape model, or of the method if it has none."""
    return kind_of(method.get("shape")) or kind_of(method)


def kind_of(plugin: Any) -> str | None:
    """Returns the kind of a plug-in's configuration, a mapping or just the kind."""
    if isinstance(plugin, Mapping):
        return str(plugin["kind"]) if "kind" in plugin else None
    return None if plugin is None else str(plugin)


def _or(value: float | None, other: float) -> float:
    return other if value is None else value
