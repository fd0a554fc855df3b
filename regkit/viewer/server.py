"""A small server of a page and its data, for browsers on this machine."""

from __future__ import annotations

import gzip
import ipaddress
import socket
import sys
from collections.abc import Callable, Iterator
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any, ClassVar
from urllib.parse import urlsplit

from regkit.system.errors import ConfigError, RegkitError
from regkit.system.notes import note

HOST = "127.0.0.1"
"""The address to which a server is bound unless another is given: only this machine reaches it."""

Answer = tuple[str, bytes] | Iterator[bytes]
"""A media type and the content; or server-sent events that follow one another."""

JSON, HTML, BYTES = "application/json", "text/html; charset=utf-8", "application/octet-stream"

PATIENCE = 30.0
"""Time [s] for which a browser may neither ask nor read before its connection is closed."""

WORTH = 1000
"""Number of bytes from which an answer is compressed."""


class Server(ThreadingHTTPServer):
    """A server that answers each path by a function; it opens no file.

    Args:
        answer: Returns the answer to a path without its leading slash, or None for a path that
            does not exist.
        host: Address to bind to. Anyone who reaches another address than ``HOST`` can look.
        port: Port; 0 for any that is free.

    Raises:
        ConfigError: If it cannot be bound to the address.
    """

    daemon_threads = True

    def __init__(
        self, answer: Callable[[str], Answer | None], host: str = HOST, port: int = 0
    ) -> None:
        self.answer = answer
        self.given = host
        self.address_family = socket.AF_INET6 if ":" in host else socket.AF_INET
        try:
            super().__init__((host, port), _Handler)
        except (OSError, OverflowError) as error:
            reason = getattr(error, "strerror", None) or error
            raise ConfigError(
                f"port {port} of {host} cannot be used: {reason}; choose another, or 0 for any "
                "that is free",
                place="port",
            ) from None
        if not is_loopback(host):
            note(
                f"the viewer listens on {host}: whoever reaches this machine can see the recording",
                place="host",
            )

    @property
    def url(self) -> str:
        """The address of the page."""
        name = self.given if self.given not in ("0.0.0.0", "::") else socket.gethostname()
        return f"http://{f'[{name}]' if ':' in name else name}:{self.server_address[1]}/"

    def knows(self, host: str) -> bool:
        """Whether a request's ``Host`` names this server.

        A page of others may have a name that leads here (DNS rebinding), and would read what is
        served. It has a name, so addresses are safe, and of names only this machine's are.
        """
        name = urlsplit(f"//{host}").hostname or ""
        if name in ("localhost", self.given.lower(), socket.gethostname().lower()):
            return True
        return _is_address(name)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Tells a fault; a browser that goes away is none."""
        if not isinstance(sys.exception(), (ConnectionError, TimeoutError)):
            super().handle_error(request, client_address)


class _Handler(BaseHTTPRequestHandler):
    server: Server
    protocol_version = "HTTP/1.1"
    timeout = PATIENCE
    server_version = "regkit"
    sys_version = ""
    fixed: ClassVar[dict[str, str]] = {
        "Cache-Control": "no-store",
        "X-Content-Type-Options": "nosniff",
        "Referrer-Policy": "no-referrer",
        "Cross-Origin-Resource-Policy": "same-origin",
    }

    def do_GET(self) -> None:
        """Answers a request."""
        try:
            known = self.server.knows(self.headers.get("Host", ""))
        except ValueError:
            known = False
        if not known:
            self._say(HTTPStatus.FORBIDDEN, "this server has another name")
            return
        path = urlsplit(self.path).path.removeprefix("/")
        try:
            answer = self.server.answer(path)
        except RegkitError as error:
            self._say(HTTPStatus.INTERNAL_SERVER_ERROR, str(error))
            return
        if answer is None:
            self._say(HTTPStatus.NOT_FOUND, "there is nothing here")
        elif isinstance(answer, tuple):
            self._send(HTTPStatus.OK, *answer)
        else:
            self._stream(answer)

    def _say(self, status: HTTPStatus, message: str) -> None:
        self._send(status, "text/plain; charset=utf-8", f"{message}\n".encode())

    def _send(self, status: HTTPStatus, kind: str, content: bytes) -> None:
        coding = {}
        if len(content) >= WORTH and "gzip" in self.headers.get("Accept-Encoding", ""):
            content, coding = gzip.compress(content, 5, mtime=0), {"Content-Encoding": "gzip"}
        self.send_response(status)
        length = {"Content-Type": kind, "Content-Length": str(len(content))}
        for name, value in (length | coding | self.fixed).items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(content)

    def _stream(self, events: Iterator[bytes]) -> None:
        """Sends events until they end or the browser goes away."""
        self.close_connection = True
        self.send_response(HTTPStatus.OK)
        for name, value in ({"Content-Type": "text/event-stream"} | self.fixed).items():
            self.send_header(name, value)
        self.end_headers()
        for event in events:
            self.wfile.write(event)
            self.wfile.flush()

    def log_message(self, *_: object) -> None:
        """Writes no log."""


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches an address."""
    return host == "localhost" or (_is_address(host) and ipaddress.ip_address(host).is_loopback)


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
