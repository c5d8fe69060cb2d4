"""A WebSocket server on the loopback address: text to all who listen, their text back (RFC 6455).

Only what that takes: text of up to `MAX_TEXT` bytes, whole or in parts, close, ping. Pages of other
origins than this machine's are refused: any page may try to open a socket here.
"""

import base64
import hashlib
import re
import socket
import threading
from collections.abc import Callable
from contextlib import suppress
from urllib.parse import urlsplit

from ..errors import UserError

HOST, MAX_TEXT, MAX_HEAD = "127.0.0.1", 4096, 8192
SLOW, GREETING = 0.25, 5.0  # seconds: to take what is sent; for a handshake
_MAGIC = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"  # RFC 6455, section 1.3
_MORE, _TEXT, _CLOSE, _PING, _PONG = 0, 1, 8, 9, 10
_OWN = ("localhost", "127.0.0.1", "[::1]", "::1", None)


class WebSocketServer:
    """Accepts connections until closed; a context manager.

    Args:
        port: 0 = any that is free; see `port`.
        heard: told each text that somebody sends.

    Raises:
        UserError: the port is taken.
    """

    def __init__(self, port: int, heard: Callable[[str], None]) -> None:
        self._heard = heard
        self._clients: set[socket.socket] = set()
        self._lock = threading.Lock()
        try:
            self._server = socket.create_server((HOST, port))
        except OSError as error:
            raise UserError(
                f"--websocket {port}: {error.strerror or error}; choose another port"
            ) from error
        self.port: int = self._server.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def __enter__(self) -> "WebSocketServer":
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(OSError):
            self._server.close()
        for client in list(self._clients):
            self._send(client, _CLOSE, b"")
            self._leave(client)

    def send(self, text: str) -> None:
        """To everybody; who does not take it within `SLOW` seconds is let go."""
        for client in list(self._clients):
            self._send(client, _TEXT, text.encode())

    def _accept(self) -> None:
        while True:
            try:
                client, _ = self._server.accept()
            except OSError:  # closed
                return
            threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def _serve(self, client: socket.socket) -> None:
        client.settimeout(GREETING)
        try:
            answer = _handshake(client)
            client.sendall(answer)
            if not answer.startswith(b"HTTP/1.1 101"):
                return
            client.settimeout(SLOW)
            with self._lock:
                self._clients.add(client)
            begun: bytes | None = None  # of a text in parts
            while (frame := _read_frame(client)) is not None:
                kind, data, last = frame
                if kind == _CLOSE:
                    return self._send(client, _CLOSE, data[:2])
                if kind == _PING:
                    self._send(client, _PONG, data)
                if kind in (_MORE, _TEXT):
                    if (kind == _MORE) == (begun is None):
                        raise ValueError("a part of nothing, or a text within a text")
                    begun = (begun or b"") + data
                    if len(begun) > MAX_TEXT:
                        raise ValueError("too long")
                    if last:
                        self._heard(begun.decode())
                        begun = None
                elif not last:
                    raise ValueError("only texts come in parts")
        except (OSError, ValueError):
            pass  # gone, or no WebSocket
        finally:
            self._leave(client)

    def _send(self, client: socket.socket, kind: int, data: bytes) -> None:
        size = len(data)
        head = bytes([0x80 | kind, size]) if size < 126 else (
            bytes([0x80 | kind, 126]) + size.to_bytes(2, "big")
        )  # fmt: skip
        try:
            with self._lock:
                client.sendall(head + data)
        except OSError:
            self._leave(client)

    def _leave(self, client: socket.socket) -> None:
        with self._lock:
            self._clients.discard(client)
        with suppress(OSError):
            client.close()


def _handshake(client: socket.socket) -> bytes:
    """The answer to a request; a refusal for what is none, or comes from a foreign page."""
    head = b""
    while b"\r\n\r\n" not in head:
        more = client.recv(1024)
        if not more or len(head) > MAX_HEAD:
            return b"HTTP/1.1 400 Bad Request\r\n\r\n"
        head += more
    found = {
        name.lower(): value.strip()
        for name, value in re.findall(r"^([\w-]+):([^\r\n]*)", head.decode("latin-1"), re.M)
    }
    origin = found.get("origin")
    if origin not in (None, "null") and urlsplit(origin).hostname not in _OWN:
        return b"HTTP/1.1 403 Forbidden\r\n\r\n"
    key = found.get("sec-websocket-key")
    if key is None:
        return b"HTTP/1.1 400 Bad Request\r\n\r\n"
    digest = base64.b64encode(hashlib.sha1((key + _MAGIC).encode()).digest()).decode()
    lines = (
        "HTTP/1.1 101 Switching Protocols",
        "Upgrade: websocket",
        "Connection: Upgrade",
        f"Sec-WebSocket-Accept: {digest}",
    )
    return "".join(f"{line}\r\n" for line in (*lines, "")).encode()


def _read_frame(client: socket.socket) -> tuple[int, bytes, bool] | None:
    """Kind and data of the next frame, and whether it is the last of its text; None at the end.
    Raises ValueError for what is none."""
    head = _exactly(client, 2)
    if head is None:
        return None
    size = head[1] & 0x7F
    if size == 126:
        size = int.from_bytes(_exactly(client, 2) or b"\xff\xff", "big")
    if not head[1] & 0x80 or head[1] & 0x7F == 127 or size > MAX_TEXT:
        raise ValueError("not masked, or too long")
    body = _exactly(client, 4 + size)
    if body is None:
        return None
    mask, data = body[:4], body[4:]
    told = bytes(byte ^ mask[at % 4] for at, byte in enumerate(data))
    return head[0] & 0x0F, told, bool(head[0] & 0x80)


def _exactly(client: socket.socket, size: int) -> bytes | None:
    data = b""
    while len(data) < size:
        try:
            more = client.recv(size - len(data))
        except TimeoutError:  # that of sending: nobody has to say anything
            continue
        if not more:
            return None
        data += more
    return data
