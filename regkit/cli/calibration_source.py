"""What ``regkit calibrate`` is given: a folder or an experiment, and a template."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from regkit.calibration import Calibration
from regkit.config.document import Document
from regkit.config.model import Model
from regkit.experiment import Experiment
from regkit.interfaces import Dataset, Preprocessor, Recording, Template
from regkit.skeleton import PoseDescription
from regkit.system.errors import ConfigError

SHOWN = 5
"""So many recordings are named to a user who has to choose one."""


class _Named(Model):
    """A template, as the command line names it."""

    template: Template


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
            template: A name, a file or a YAML mapping; the experiment's or ``human`` without it.
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
        data = {"dataset": {"kind": "depth", "root": str(path)}, "template": "human"}
        source = Document(data, {(): str(path)}).validated(cls)
        if template is None:
            return source
        return source.model_copy(update={"template": template_named(template)})

    def recording(self, name: str | None) -> Recording:
        """The recording called ``name``, or the only one that there is.

        Raises:
            RegkitError: If there is no such recording, or there are several.
        """
        if name is not None:
            try:
                return self.dataset.model_copy(update={"recordings": (name,)}).chosen()[0]
            except ConfigError as error:
                raise ConfigError(error.message, place="--recording") from None
        found = self.dataset.chosen()
        if len(found) > 1:
            names = ", ".join(recording.name for recording in found[:SHOWN])
            more = ", ..." if len(found) > SHOWN else ""
            raise ConfigError(
                f"there are {len(found)} recordings ({names}{more}); name one", place="--recording"
            )
        return found[0]

    def calibration(self, frames: int) -> Calibration:
        """How the subject is calibrated, in so many frames."""
        return Calibration(
            template=self.template, preprocessor=self.preprocessor, start=self.start, frames=frames
        )


def template_named(text: str) -> Template:
    """The template that ``--template`` names.

    Raises:
        ConfigError: If there is none, or its file is wrong.
    """
    place = f"--template {text}"
    if Path(text).suffix in (".yaml", ".yml"):
        document = Document({"template": {"kind": "file", "path": text}}, {})
    else:
        try:
            document = Document({}, {}).overridden([f"template={text}"])
        except ConfigError as error:
            raise ConfigError(error.message, place=place) from None
    return Document(document.data, {(): place}).validated(_Named).template
