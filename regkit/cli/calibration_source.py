"""Input of ``regkit calibrate``: a folder or an experiment, and a template."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from regkit.calibration import Calibration
from regkit.cli.choices import template_named
from regkit.cli.options import options
from regkit.config.model import Model
from regkit.config.plugin import slot_default, slot_defaults
from regkit.config.preset import YAML
from regkit.experiment import Experiment
from regkit.interfaces import Dataset, Preprocessor, Recording, Segmenter, StartSearch, Template
from regkit.system.errors import ConfigError, DataError


class Source(Model):
    """Frames of a subject, and the template to calibrate."""

    dataset: Dataset
    """The recordings."""
    template: Template
    """The template to calibrate."""
    segmentation: tuple[Segmenter, ...] = slot_defaults(Segmenter)
    """Segmenters that take the body out of the scene."""
    preprocessor: Preprocessor | None = None
    """Preprocessing of the frames."""
    start: StartSearch = slot_default(StartSearch)
    """Search for pose and size in the first frame, or the pose itself."""

    @classmethod
    def read(cls, path: Path, template: str | None, settings: Iterable[str]) -> Source:
        """Reads the source from a recording or an experiment's YAML file.

        Args:
            path: The folder or the file.
            template: A name, a file or a YAML mapping; None for the experiment's template, or the
                default one.
            settings: ``a.b.c=value`` changes of an experiment.

        Raises:
            RegkitError: If an argument is invalid, or a file cannot be read.
        """
        if not path.exists():
            raise DataError(
                "there is no such file or folder; name a recording's folder or file, or an "
                "experiment's YAML file",
                place=str(path),
            )
        if path.suffix.lower() in YAML:
            experiment = Experiment.read(path, settings, called="--set")
            # A given start belongs to the experiment's template.
            kept = template is None or experiment.start.searches
            return cls(
                dataset=experiment.dataset,
                template=experiment.template if template is None else template_named(template),
                segmentation=experiment.segmentation,
                preprocessor=experiment.preprocessor,
                **({"start": experiment.start} if kept else {}),
            )
        for setting in settings:
            raise ConfigError(
                f"--set changes the values of an experiment; {path} is a recording",
                place=f"--set {setting}",
            )
        return cls(
            dataset=Dataset.parse(Dataset.at(path), place=str(path), field="dataset"),
            template=template_named(template),
        )

    def recording(self, name: str | None) -> Recording:
        """Returns the recording called ``name``, or the only one.

        Raises:
            RegkitError: If there is no such recording, or there are several and ``name`` is None.
        """
        with options(**{"dataset.recordings": "--recording"}):
            return self.dataset.only(name)

    def calibration(self, frames: int) -> Calibration:
        """Returns the calibration of the subject in ``frames`` frames."""
        return Calibration(
            template=self.template,
            segmentation=self.segmentation,
            preprocessor=self.preprocessor,
            start=self.start,
            frames=frames,
        )
