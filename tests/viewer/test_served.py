import json
from typing import Any

import numpy as np
from browser import Watched, opened
from viewer_scenes import method, recording, scene, transforms, walk

from regkit.viewer.page import page

SERVER = "http://viewer.test/"

STREAM = """
    window.EventSource = class extends EventTarget {
        static CLOSED = 2;
        constructor(address) {
            super();
            window.stream = this;
            this.address = address;
            this.readyState = 1;
        }
        close() { this.readyState = 2; }
    };
"""


def lazy_points(route: Any) -> None:
    """Answers with points at the origin."""
    head = np.array([0.0, 0.0, 2.5, 0.001], "<f4").tobytes()
    route.fulfill(body=head + np.zeros((50, 3), "<i2").tobytes())


def test_points_are_fetched_frame_by_frame(browser):
    document = json.loads(walk())
    document["recordings"][0]["points"] = {"href": "points/0/{index}"}

    def served(watched: Watched) -> None:
        watched.page.route(
            SERVER, lambda route: route.fulfill(body=page("walk"), content_type="text/html")
        )
        watched.page.route(SERVER + "scene.json", lambda route: route.fulfill(json=document))
        watched.page.route(SERVER + "points/**", lazy_points)

    with opened(browser, SERVER, hash="#frame=30", before=served) as shown:
        shown.wait_frame(30)
        points = [one.removeprefix(SERVER) for one in shown.requests if "/points/" in one]
        assert points == ["points/0/3", "points/0/4"]
        shown.page.route(SERVER + "points/**", lambda route: route.fulfill(status=410))
        shown.page.keyboard.press("Home")
        shown.page.wait_for_selector("#banner:has-text('points of frame 0')")


def live_frame(number: int) -> dict[str, Any]:
    """A frame as a server sends it."""
    placed = transforms(1)[0]
    return {
        "frame": number,
        "time": number / 30.0,
        "points": {
            "origin": [0.0, 0.0, 2.5],
            "step": 0.001,
            "positions": [[number % 50, 0, 0]] * 40,
        },
        "status": f"28 frames/s, frame {number}",
        "methods": [
            {
                "name": "best",
                "transforms": placed.tolist(),
                "markers": placed[1:, 4:].tolist(),
                "verdict": "lost" if number == 700 else "found",
                "curves": {"inlier share": 97.0},
            }
        ],
    }


def test_live_frames_are_followed_until_the_reader_goes_back(browser, tmp_path):
    made, numbers, length = recording(frames=0, joints=None)
    made["methods"] = [method("best", "#0072b2", numbers, length, verdicts=[])]
    file = tmp_path / "live.html"
    file.write_text(page("live", scene(made, live=True)), "utf-8")
    send = """frames => {
        for (const frame of JSON.parse(frames)) {
            stream.dispatchEvent(new MessageEvent("message", { data: JSON.stringify(frame) }));
        }
    }"""
    with opened(browser, file, script=STREAM) as shown:
        shown.page.wait_for_selector("#banner:has-text('Waiting')")
        assert shown.page.evaluate("stream.address") == "frames"
        shown.page.evaluate(send, json.dumps([live_frame(number) for number in range(3)]))
        shown.wait_frame(2)
        shown.page.keyboard.press("Home")
        shown.wait_frame(0)
        shown.page.evaluate(send, json.dumps([live_frame(number) for number in range(3, 701)]))
        # Frames before the last 600 are gone, and so is the one that was shown.
        shown.wait_frame(101)
        assert shown.page.get_attribute("#follow", "aria-pressed") == "false"
        shown.page.click("#follow")
        shown.wait_frame(700)
        assert shown.page.inner_text("#banner") == "Body lost"
        assert "28 frames/s" in shown.page.inner_text("#status")
        shown.page.evaluate("stream.dispatchEvent(new Event('error'))")
        assert "broke" in shown.page.inner_text("#status")
        shown.page.evaluate("stream.dispatchEvent(new MessageEvent('end', { data: '' }))")
        assert "ended" in shown.page.inner_text("#status")
        # A server that was started anew counts from the beginning.
        shown.page.evaluate(send, json.dumps([live_frame(5)]))
        shown.wait_frame(5)
        assert shown.page.get_attribute("#timeline", "aria-valuemax") == "5"
        assert shown.messages == []
