"""What ``regkit calibrate`` is given: a folder or an experiment, and a template."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from regkit.calibration import Calibration
from regkit.cli.choices import template_named
from regkit.cli.options import options
from regkit.config.model import Model
from regkit.experiment import Experiment
from regkit.interfaces import Dataset, Preprocessor, Recording, Template
from regkit.skeleton import PoseDescription
from regkit.system.errors import ConfigError


class Source(Model):
    """Where a subject is seen, and what it is."""

    dataset: Dataset
    """Where the frames come from."""
    template: Template
    """What is seen in them."""
    preprocessor: Preprocessor | None = None
    """How frames become data."""
    start: PoseDescription | None = None
    """Pose in the first frame."""

    @classmethod
    def read(cls, path: Path, template: str | None, settings: Iterable[str]) -> Source:
        """The source that a folder of depth images is, or that an experiment's YAML describes.

        Args:
            path: The folder or the file.
            template: A name, a file or a YAML mapping; the experiment's or a person without it.
            settings: ``a.b.c=value``, for an experiment.

        Raises:
            RegkitError: If something of this cannot be.
        """
        if not path.is_dir():
            experiment = Experiment.read(path, settings, called="--set")
            return cls(
                dataset=experiment.dataset,
                template=experiment.template if template is None else template_named(template),
                preprocessor=experiment.preprocessor,
                start=experiment.start if template is None else None,
            )
        for setting in settings:
            raise ConfigError(
                f"only an experiment's values can be changed; {path} is a folder",
                place=f"--set {setting}",
            )
        place = str(path)
        return cls(
            dataset=Dataset.parse(Dataset.in_folder(path), place=place, field="dataset"),
            template=template_named(template),
        )

    def recording(self, name: str | None) -> Recording:
        """The recording called ``name``, or the only one that there is.

        Raises:
            RegkitError: If there is no such recording, or there are several.
        """
        with options(**{"dataset.recordings": "--recording"}):
            return self.dataset.only(name)

    def calibration(self, frames: int) -> Calibration:
        """How the subject is calibrated, in so many frames."""
        return Calibration(
            template=self.template, preprocessor=self.preprocessor, start=self.start, frames=frames
        )
