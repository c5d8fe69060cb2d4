"""A WebSocket on the loopback address: handshake, both ways, and who is refused."""

import socket
import time
from collections.abc import Iterator

import pytest

from src.shared.errors import UserError
from src.shared.io.websocket import SLOW, WebSocketServer

KEY = "dGhlIHNhbXBsZSBub25jZQ=="  # RFC 6455, section 1.2, with the answer that it prints
ANSWER = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo="


@pytest.fixture
def heard() -> list[str]:
    return []


@pytest.fixture
def server(heard: list[str]) -> Iterator[WebSocketServer]:
    with WebSocketServer(0, heard.append) as running:
        yield running


def request(server: WebSocketServer, *lines: str) -> tuple[socket.socket, str]:
    client = socket.create_connection(("127.0.0.1", server.port), timeout=5)
    head = ("GET / HTTP/1.1", "Host: localhost", "Upgrade: websocket", *lines, "", "")
    client.sendall("\r\n".join(head).encode())
    answer = b""
    while b"\r\n\r\n" not in answer and (more := client.recv(1024)):
        answer += more
    return client, answer.decode()


def joined(server: WebSocketServer) -> socket.socket:
    client, answer = request(server, f"Sec-WebSocket-Key: {KEY}")
    assert answer.startswith("HTTP/1.1 101") and ANSWER in answer
    until(lambda: bool(server._clients))
    return client


def until(true) -> None:
    for _ in range(100):
        if true():
            return
        time.sleep(0.02)
    raise AssertionError("waited in vain")


def masked(kind: int, data: bytes) -> bytes:
    mask = b"\x01\x02\x03\x04"
    size = bytes([0x80 | len(data)]) if len(data) < 126 else b"\xfe" + len(data).to_bytes(2, "big")
    return bytes([0x80 | kind]) + size + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(data))


def test_both_ways(server: WebSocketServer, heard: list[str]) -> None:
    client = joined(server)
    server.send("a" * 300)
    got = b""
    while len(got) < 304:
        got += client.recv(1024)
    assert got == b"\x81\x7e\x01\x2c" + b"a" * 300
    client.sendall(masked(1, "一个人挥手".encode()))
    until(lambda: heard == ["一个人挥手"])
    client.sendall(masked(9, b"hi"))
    assert client.recv(64) == b"\x8a\x02hi"
    client.sendall(masked(8, b"\x03\xe8bye"))
    assert client.recv(64) == b"\x88\x02\x03\xe8"  # the same code
    until(lambda: not server._clients)


def test_a_text_may_come_in_parts(server: WebSocketServer, heard: list[str]) -> None:
    client, words = joined(server), "一个人挥手".encode()
    first, more, last = masked(1, words[:4]), masked(0, words[4:9]), masked(0, words[9:])
    client.sendall(bytes([first[0] & 0x7F]) + first[1:] + bytes([more[0] & 0x7F]) + more[1:])
    client.sendall(masked(9, b"hi") + last)
    until(lambda: heard == ["一个人挥手"])
    assert heard == ["一个人挥手"]
    client.sendall(2 * (bytes([1]) + masked(1, b"x" * 4000)[1:]) + masked(0, b"x" * 200))
    until(lambda: not server._clients)


@pytest.mark.parametrize("data", [b"\x81\x02ab", masked(1, b"x" * 5000), b"\xff\xff\xff\xff\xff"])
def test_what_is_no_frame_of_ours_ends_it(server: WebSocketServer, data: bytes) -> None:
    client = joined(server)
    client.sendall(data)
    until(lambda: not server._clients)
    other = joined(server)
    server.send("still here")
    assert other.recv(64).endswith(b"still here")


@pytest.mark.parametrize(
    "parts",
    [masked(1, b"walks") + masked(0, b" on"), bytes([1]) + masked(1, b"a")[1:] + masked(1, b"b"),
     bytes([9]) + masked(9, b"hi")[1:], bytes([2]) + masked(2, b"a")[1:]],
)  # fmt: skip
def test_parts_of_nothing_end_it(server: WebSocketServer, heard: list[str], parts: bytes) -> None:
    client = joined(server)
    client.sendall(parts)
    until(lambda: not server._clients)
    assert heard in ([], ["walks"])


def test_foreign_pages_are_refused(server: WebSocketServer) -> None:
    key = f"Sec-WebSocket-Key: {KEY}"
    for origin in ("https://example.com", "http://localhost.example.com"):
        assert request(server, key, f"Origin: {origin}")[1].startswith("HTTP/1.1 403")
    for origin in ("http://localhost:8000", "http://127.0.0.1", "null"):
        assert request(server, key, f"Origin: {origin}")[1].startswith("HTTP/1.1 101")
    assert request(server)[1].startswith("HTTP/1.1 400")


def test_a_taken_port_is_one_line(server: WebSocketServer) -> None:
    with pytest.raises(UserError, match=f"--websocket {server.port}: .*choose another"):
        WebSocketServer(server.port, print)


def test_who_does_not_read_is_let_go_and_others_go_on(server: WebSocketServer) -> None:
    """A stopped page held the frames of all, and the end of the program."""
    stuck, other = joined(server), joined(server)
    until(lambda: len(server._clients) == 2)
    text, sent, got = "a" * 60_000, 0, 0
    while len(server._clients) == 2:
        begun = time.monotonic()
        server.send(text)
        assert time.monotonic() - begun < 3.0
        sent += 1
        assert sent < 2_000
        while got < sent * (4 + len(text)):
            got += len(other.recv(1 << 16))
    server.send("b")
    assert other.recv(3) == b"\x81\x01b"
    begun = time.monotonic()
    server.__exit__()
    assert time.monotonic() - begun < 3.0
    stuck.close()


def test_who_says_nothing_for_a_while_is_heard_later(
    server: WebSocketServer, heard: list[str]
) -> None:
    client = joined(server)
    time.sleep(2 * SLOW)
    client.sendall(masked(1, b"walks")[:4])
    time.sleep(2 * SLOW)
    assert not heard and len(server._clients) == 1
    client.sendall(masked(1, b"walks")[4:])
    until(lambda: bool(heard))
    assert heard == ["walks"]
