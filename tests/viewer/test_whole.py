"""Scenes of tracks in a browser, as the server and the live viewer give them to the page."""

import threading

import numpy as np
from browser import opened
from made_tracks import MadeRegistrar, made_scene, made_track

from regkit.viewer.live import LiveViewer
from regkit.viewer.run_scene import run_scene
from regkit.viewer.server import Server
from regkit.viewer.sites import SceneSite
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.shapes.sphere import SphereMesh
from regkit_plugins.templates.human import Human

BODY = Human(height=1.7).body(1.7)


def test_served_results_are_shown_at_the_frame_of_the_address(browser):
    one = made_scene(BODY, GeneralizedSumOfGaussians().bind(BODY), 9, lost=2)
    other = made_scene(BODY, SphereMesh().bind(BODY), 9)
    stored = {"walk": {"best": lambda: one, "spheres": lambda: other}}
    colours = {"best": "#0072b2", "spheres": "#d55e00"}
    with Server(SceneSite(run_scene("results", stored, colours))) as server:
        threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True).start()
        with opened(browser, server.url, hash="#frame=8") as shown:
            shown.wait_frame(8)
            text = shown.page.inner_text("body")
            assert "lost" in text.lower()
            for name in ("best", "spheres", "joint error"):
                assert name in text
            assert shown.messages == []
        server.shutdown()


def test_live_track_is_followed_to_its_end(browser):
    registrar = MadeRegistrar(BODY, GeneralizedSumOfGaussians().bind(BODY))
    track = made_track(BODY, 4)
    viewer = LiveViewer("live", 30.0, registrar)

    def add(number: int) -> None:
        transforms = BODY.place(track.pose(number)).transforms
        viewer.add(
            number, number / 30.0, np.zeros((0, 3)), transforms, track.markers[number], "doubtful",
            supports=track.supports[number], curves={"inlier share": 70.0}, status="30 frames/s",
        )  # fmt: skip

    for number in range(3):
        add(number)
    with opened(browser, viewer.url) as shown:
        shown.wait_frame(2)
        add(3)
        shown.wait_frame(3)
        assert "doubtful" in shown.page.inner_text("body").lower()
        viewer.close("the camera was unplugged")
        shown.page.wait_for_selector("text=the camera was unplugged")
        assert shown.messages == []
