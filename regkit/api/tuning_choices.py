"""What a template is tuned to, and what a camera sees meanwhile: arguments and options."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from regkit.api.choices import name_of
from regkit.api.pipeline import preprocessor_for
from regkit.body.shape_keys import ListName
from regkit.config.changes import Location
from regkit.config.document import Document
from regkit.config.model import Model
from regkit.config.plugin import Plugin, slot_default
from regkit.config.quantities import Seed
from regkit.geometry.camera import Camera
from regkit.interfaces import Method, Preprocessor, Template, Tracker
from regkit.sensors import CAMERAS, CameraChoice
from regkit.sensors.cameras import CameraFile, CameraNumbers
from regkit.sensors.noise import NoiseChoice
from regkit.system.errors import ConfigError
from regkit.tuning.sets import SampleSets


class TuningChoices(Model):
    """Choices of ``regkit tune`` and ``regkit.tune``."""

    template: Template = slot_default(Template)
    """The template, of the size for which its lengths hold."""
    method: Method = slot_default(Method)
    """The method to whose energy its primitives are fitted."""
    name: ListName | None = None
    """Name of the tuned list; by default the list that the method takes is replaced."""
    bodies: tuple[Template, ...] = ()
    """Other templates that the camera sees in training, with the same joints."""
    proportions: Annotated[float, Field(ge=0.0, le=0.3)] = 0.0
    """Spread of the lengths and girths of further bodies that it sees, as a fraction."""
    camera: CameraChoice = "sr4000"
    """The depth camera."""
    noise: NoiseChoice | None = None
    """Its noise; by default that of a known camera, and none of any other."""
    preprocessor: Preprocessor | None = None
    """Preprocessing of frames; by default they are downsampled to about 900 points."""
    primitives: Annotated[int, Field(ge=1, le=10_000)] | None = None
    """Number of primitives to begin with; by default those that the template lists."""
    samples: Annotated[int, Field(ge=1, le=1_000_000)] = 240
    """Number of training samples."""
    seed: Seed = 0
    """Seed of all samples."""

    @classmethod
    def of(cls, given: Mapping[str, Any], places: Mapping[Location, str]) -> TuningChoices:
        """Returns the choices of some arguments.

        Args:
            given: Values of the fields, each a name, a file, a mapping or an object; None for the
                default.
            places: Where they are written, for messages.

        Raises:
            ConfigError: One line for each mistake.
        """
        data = {name: value for name, value in given.items() if value is not None}
        data.setdefault("template", Template.default())
        data.setdefault("method", Method.default())
        slots: list[tuple[str, type[Plugin]]] = [
            ("template", Template),
            ("method", Method),
            ("preprocessor", Preprocessor),
        ]
        for name, slot in slots:
            if name in data:
                data[name] = _named(slot, data[name])
        data["bodies"] = tuple(_named(Template, one) for one in data.get("bodies", ()))
        if "camera" in data:
            data["camera"] = _camera(data["camera"])
        return Document(data, places).validated(cls)

    def tracker(self) -> Tracker:
        """Returns what leads the method from frame to frame: its own tracker, or the default."""
        if self.method.tracker is not None:
            return self.method.tracker
        return Tracker.parse(Tracker.default(), place="tuning", field="tracker")

    def sets(self) -> SampleSets:
        """Returns the sets of samples; bodies of the same name are numbered."""
        others: dict[str, Template] = {}
        for body in self.bodies:
            same = sum(one.name() == body.name() for one in self.bodies)
            others[f"{body.name()} {len(others) + 1}" if same > 1 else body.name()] = body
        return SampleSets(
            self.template,
            self.preprocessor or preprocessor_for,
            others,
            self.proportions,
            self.camera,
            self.noise,
            seed=self.seed,
        )

    @property
    def seen_by(self) -> str:
        """The camera and its noise in a few words."""
        noise = "" if self.noise is None else f" with noise {_shown(self.noise)}"
        return f"{_shown(self.camera)}{noise}"


def method_name(choice: Any) -> str:
    """Returns the name of a method, with the fields that differ from it."""
    if isinstance(choice, Method):
        return _shown(choice)
    if isinstance(choice, Mapping):
        changed = {key: value for key, value in choice.items() if key not in ("kind", "preset")}
        return f"{name_of(choice)} with {json.dumps(changed)}" if changed else name_of(choice)
    return Path(choice).name


def _named(slot: type[Plugin], choice: Any) -> Any:
    return slot.named(str(choice)) if isinstance(choice, (str, Path)) else choice


def _camera(choice: Any) -> Any:
    """Returns the data of a camera: a name, a file, a mapping, or intrinsics."""
    if isinstance(choice, Camera):
        fields = ("width", "height", "fx", "fy", "cx", "cy")
        return CameraNumbers(**{name: getattr(choice, name) for name in fields})
    if not isinstance(choice, (str, Path)) or choice in CAMERAS:
        return choice
    if Path(choice).suffix.lower() == ".json":
        return {"file": str(choice)}
    raise ConfigError(
        f"no camera '{choice}'; the known ones are {', '.join(CAMERAS)}; or give a camera.json, or "
        "a mapping such as {width: 320, height: 240, fx: 290}",
        place="camera",
    )


def _shown(choice: Any) -> str:
    """Returns a choice in a line: a name or number as it is, a file by its name, or its fields."""
    if isinstance(choice, CameraFile):
        return choice.file.name
    if isinstance(choice, Model):
        fields = choice.model_dump(mode="json", exclude_defaults=True)
        return json.dumps({"kind": choice.kind, **fields} if isinstance(choice, Plugin) else fields)
    return str(choice)
