"""The server of scenes: what it answers, whom, and how a live track reaches browsers."""

import gzip
import http.client
import json
import socket
import threading
import time
from contextlib import closing, contextmanager
from typing import NamedTuple

import numpy as np
import pytest
from made_tracks import MadeRegistrar, made_track

from regkit.geometry.camera import Camera
from regkit.interfaces import Recording
from regkit.observation import Frame
from regkit.system.errors import ConfigError
from regkit.system.notes import RegkitWarning
from regkit.viewer.live import BEHIND, KEPT, LiveViewer
from regkit.viewer.packed import unpacked
from regkit.viewer.server import Server
from regkit.viewer.sites import RecordingSite
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.templates.human import Human

BODY = Human(height=1.7).body(1.7)


class Clouds(Recording):
    """Frame n has n points."""

    def frames(self):
        for number in range(self.length):
            yield Frame(np.full((number, 3), 0.5 * number), Camera(64, 48, 60.0, 60.0, 31.5, 23.5))

    def truth(self):
        return None


@contextmanager
def serving(site, **where):
    server = Server(site, **where)
    thread = threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True)
    thread.start()
    try:
        yield server
    finally:
        server.shutdown()
        server.server_close()


class Answered(NamedTuple):
    status: int
    headers: http.client.HTTPMessage
    content: bytes


def sent(server, path, headers) -> http.client.HTTPConnection:
    connection = http.client.HTTPConnection("127.0.0.1", server.server_address[1], timeout=5)
    connection.putrequest("GET", path, skip_host="Host" in headers, skip_accept_encoding=True)
    for name, value in headers.items():
        connection.putheader(name.replace("_", "-"), value)
    connection.endheaders()
    return connection


def asked(server, path="/", **headers) -> Answered:
    with closing(sent(server, path, headers)) as connection, connection.getresponse() as answer:
        return Answered(answer.status, answer.headers, answer.read())


def test_recording_is_served_frame_by_frame():
    with serving(RecordingSite(Clouds("clouds", 10.0, 5))) as server:
        page = asked(server, "/", Accept_Encoding="gzip")
        assert page.status == 200
        assert page.headers["Content-Type"].startswith("text/html")
        assert page.headers["Content-Encoding"] == "gzip"
        assert page.headers["Cache-Control"] == "no-store"
        assert b"<title>clouds" in gzip.decompress(page.content)
        (recording,) = json.loads(asked(server, "/scene.json").content)["recordings"]
        assert recording["frames"] == [0, 1, 2, 3, 4]
        assert recording["points"] == {"href": "points/0/{index}"}
        assert recording["camera"]["width"] == 64
        content = asked(server, "/points/0/3").content
        origin, steps = np.frombuffer(content[:16], "<f4"), np.frombuffer(content[16:], "<i2")
        np.testing.assert_allclose(origin[:3] + origin[3] * steps.reshape(3, 3), 1.5, atol=1e-6)
        for path in ("/points/0/5", "/points/0/-1", "/points/1/0", "/points/0/1/", "/nothing"):
            assert asked(server, path).status == 404


@pytest.mark.parametrize(
    "path", ["/../pyproject.toml", "/..%2f..%2fetc/passwd", "//etc/passwd", "/./."]
)
def test_server_opens_no_file(path):
    with serving(RecordingSite(Clouds("clouds", 10.0, 1))) as server:
        assert asked(server, path).status == 404


@pytest.mark.parametrize(
    ("host", "status"),
    [("127.0.0.1", 200), ("localhost:80", 200), ("[::1]:1", 200), ("192.168.1.5:99", 200),
     ("evil.example", 403), ("127.0.0.1.evil.example", 403), ("", 403), ("[", 403)],
)  # fmt: skip
def test_requests_with_another_name_are_refused(host, status):
    with serving(RecordingSite(Clouds("clouds", 10.0, 1))) as server:
        answer = asked(server, "/", Host=host)
        assert answer.status == status
        assert (b"clouds" in answer.content) == (status == 200)


def test_server_is_bound_to_this_machine_unless_told_otherwise():
    with serving(lambda path: None) as server:
        assert server.server_address[0] == "127.0.0.1"
        with pytest.raises(ConfigError, match=str(server.server_address[1])):
            Server(lambda path: None, port=server.server_address[1])
    with (
        pytest.warns(RegkitWarning, match=r"0\.0\.0\.0"),
        serving(lambda path: None, host="0.0.0.0"),
    ):
        pass
    with pytest.raises(ConfigError, match="cannot be used"):
        Server(lambda path: None, host="256.0.0.1")


@pytest.fixture
def live():
    registrar = MadeRegistrar(BODY, GeneralizedSumOfGaussians().bind(BODY))
    viewer = LiveViewer("live", 30.0, registrar, curves={"inlier share": "%"})
    yield viewer
    viewer.close()


TRACK = made_track(BODY, 2)
PLACED = [BODY.place(TRACK.pose(frame)).transforms for frame in range(2)]


def add(viewer, number):
    points = np.random.default_rng(number).normal(size=(5000, 3))
    viewer.add(
        number, number / 30.0, points, PLACED[number % 2], TRACK.markers[number % 2], "found",
        supports=TRACK.supports[0], curves={"inlier share": 90.0}, status="fast",
    )  # fmt: skip


class Browser:
    """What reads the frames of a live viewer, as an EventSource does."""

    def __init__(self, viewer) -> None:
        self.connection = sent(viewer._server, "/frames", {})
        self.answer = self.connection.getresponse()
        self.kind = self.answer.headers["Content-Type"]
        self.ended = None

    def close(self) -> None:
        self.answer.close()
        self.connection.close()

    def frames(self):
        """The frames, to the end."""
        event = "message"
        for line in self.answer:
            name, _, value = line.decode().strip().partition(": ")
            if name == "event":
                event = value
            elif name == "data" and event == "end":
                self.ended = value
                return
            elif name == "data":
                yield json.loads(value)


@pytest.fixture
def watching(live):
    """Opens browsers that are gone after the test."""
    opened = []

    def watch() -> Browser:
        opened.append(Browser(live))
        return opened[-1]

    yield watch
    for browser in opened:
        browser.close()


def test_browsers_get_the_kept_frames_and_those_that_come(live, watching):
    (recording,) = json.loads(asked(live._server, "/scene.json").content)["recordings"]
    assert recording["frames"] == []
    for number in range(3):
        add(live, number)
    browsers = [watching(), watching()]
    threading.Timer(0.1, lambda: [add(live, 3), live.close("unplugged\nnow")]).start()
    for browser in browsers:
        assert browser.kind == "text/event-stream"
        frames = list(browser.frames())
        assert [one["frame"] for one in frames] == [0, 1, 2, 3]
        assert browser.ended == "unplugged now"
        (method,) = frames[1]["methods"]
        assert method["verdict"] == "found"
        assert method["curves"] == {"inlier share": 90.0}
        origins = unpacked(method["transforms"])[:, 4:]
        np.testing.assert_allclose(origins, PLACED[1][:, :3, 3], atol=1e-5)
        assert unpacked(method["confidence"]).shape == (15,)
        assert len(unpacked(frames[1]["points"]["positions"])) <= 1500


def test_slow_browsers_never_hold_up_a_track_and_old_frames_are_dropped(live, watching):
    with socket.create_connection(live._server.server_address) as slow:
        slow.sendall(b"GET /frames HTTP/1.1\r\nHost: localhost\r\n\r\n")
        time.sleep(0.05)
        begun = time.perf_counter()
        for number in range(KEPT + 200):
            add(live, number)
        assert time.perf_counter() - begun < 4.0
        assert len(live._frames) == KEPT
        assert next(watching().frames())["frame"] == 200


def test_browser_that_lags_skips_to_the_newest_frame(live, watching):
    events = watching().frames()
    add(live, 0)
    assert next(events)["frame"] == 0
    # The frames between are too many to be sent one after another.
    with live._news:
        for number in range(1, BEHIND + 50):
            add(live, number)
    assert next(events)["frame"] == BEHIND + 49
