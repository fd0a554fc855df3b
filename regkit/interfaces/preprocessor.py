"""Preprocessors: from frames to the data of kernels."""

from __future__ import annotations

from abc import ABC, abstractmethod

from regkit.config.plugin import Plugin
from regkit.observation import Frame, Observation, View
from regkit.system.errors import NoDataError


class Preprocessor(Plugin, ABC):
    """A conversion of a frame's points to a sum of Gaussians."""

    group = "regkit.preprocessors"
    former_group = "regkit.observers"

    @abstractmethod
    def preprocess(self, frame: Frame) -> Observation:
        """Returns the data of a frame.

        Raises:
            DataError: If the frame has too few points, or points that are not finite.
        """

    def observation(self, frame: Frame) -> Observation:
        """Returns the data of a frame of any number of cameras, each preprocessed by itself.

        A camera that shows too few points is left out.

        Raises:
            DataError: If all cameras show too few points, or one has points that are not finite.
        """
        if not frame.views:
            return self.preprocess(frame)
        views: list[View[Observation]] = []
        lacking: NoDataError | None = None
        for view in frame.views:
            try:
                data = self.preprocess(view.data)
            except NoDataError as error:
                lacking = lacking or error
            else:
                views.append(View(view.name, view.T_world_camera, data))
        if lacking is not None and not views:
            raise lacking
        return Observation.of_views(views, frame.landmarks)
