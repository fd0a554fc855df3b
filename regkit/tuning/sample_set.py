"""Sets of samples, and the share of a set that one worker renders."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from regkit.system.errors import ConfigError, DataError
from regkit.tuning.samples import Sample, Sampler

REPLACEMENTS = 2
"""Number of samples that are tried in the place of one that cannot be rendered."""


@dataclass(frozen=True)
class SampleSet:
    """A set of samples.

    Attributes:
        name: Its name.
        samplers: Sources of the samples, in turn.
        count: Number of samples.
    """

    name: str
    samplers: tuple[Sampler, ...]
    count: int

    def sample(self, number: int, failures: list[str]) -> Sample:
        """Renders a sample, or another one in its place if it cannot be rendered.

        Args:
            number: Its number, from 0 on.
            failures: Receives the reason for each that cannot be rendered.

        Raises:
            RegkitError: If those in its place cannot be rendered either.
        """
        own = self.samplers[number % len(self.samplers)]
        index = number // len(self.samplers)
        for at in range(REPLACEMENTS):
            try:
                return own.sample(index + at * self.count)
            except (ConfigError, DataError) as error:
                failures.append(str(error))
        return own.sample(index + REPLACEMENTS * self.count)


@dataclass(frozen=True)
class Share:
    """The samples of a set that one worker has.

    Attributes:
        whole: The set.
        first: Number of its first sample.
        every: Number of workers.
    """

    whole: SampleSet
    first: int
    every: int

    def samples(self, failures: list[str]) -> Iterator[Sample]:
        """Renders the samples, as ``SampleSet.sample`` does."""
        for number in range(self.first, self.whole.count, self.every):
            yield self.whole.sample(number, failures)
