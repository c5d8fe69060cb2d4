"""A Google Cloud Storage emulator process behind an HTTP proxy that injects faults and counts."""

import http.client
import os
import socket
import subprocess
import sys
import threading
import time
import urllib.parse
import urllib.request
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

# must be set before gcsfs is imported: it would ask Google's control plane for a minute
os.environ.setdefault("GCSFS_EXPERIMENTAL_ZB_HNS_SUPPORT", "false")

BUCKET = "music"


def free_port() -> int:
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        return int(sock.getsockname()[1])


@contextmanager
def emulator(log: Path) -> Iterator[str]:
    """Address of a real emulator process with an empty bucket, its objects in memory."""
    port = free_port()
    command = [sys.executable, "-m", "gcp_storage_emulator", "start", "--port", str(port)]
    command += ["--host", "127.0.0.1", "--in-memory", "--quiet", "--default-bucket", BUCKET]
    with log.open("w") as stream:
        process = subprocess.Popen(command, stdout=stream, stderr=stream)
    try:
        address = f"http://127.0.0.1:{port}"
        for _ in range(300):
            try:
                urllib.request.urlopen(f"{address}/storage/v1/b/{BUCKET}", timeout=5).read()
                break
            except OSError:
                assert process.poll() is None, log.read_text()
                time.sleep(0.1)
        yield address
    finally:
        process.kill()
        process.wait()


class FaultProxy:
    """Passes requests on; for downloads of an object applies its faults and counts.

    Attributes:
        busy: downloads to answer with 503 before the object is let through, by object name.
        cut: downloads whose connection ends half way, by object name.
        damage: changes to an object's bytes at every download, by object name.
        asked: downloads asked for; `delivered`: answered with status 200.
        delay: seconds each download takes at least.
    """

    def __init__(self, upstream: str) -> None:
        self.busy: Counter[str] = Counter()
        self.cut: Counter[str] = Counter()
        self.damage: dict[str, Callable[[bytes], bytes]] = {}
        self.asked: Counter[str] = Counter()
        self.delivered: Counter[str] = Counter()
        self.delay = 0.0
        self._host = urllib.parse.urlsplit(upstream).netloc
        self._one_at_a_time = threading.Lock()  # the emulator has one thread
        self._counting = threading.Lock()
        proxy = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def handle_any(self) -> None:
                body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
                with suppress(ConnectionError):  # the client was killed
                    proxy.answer(self, body)

            do_GET = do_POST = do_PUT = do_DELETE = do_PATCH = handle_any

            def log_message(self, format: str, *args: Any) -> None:
                pass

        self._server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self._server.daemon_threads = True
        self.address = f"http://127.0.0.1:{self._server.server_address[1]}"

    def __enter__(self) -> "FaultProxy":
        threading.Thread(target=self._server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *args: object) -> None:
        self._server.shutdown()
        self._server.server_close()

    def answer(self, handler: BaseHTTPRequestHandler, body: bytes) -> None:
        url = urllib.parse.urlsplit(handler.path)
        download = handler.command == "GET" and "alt=media" in url.query
        name = urllib.parse.unquote(url.path.rsplit("/o/", 1)[-1]) if download else ""
        if download:
            time.sleep(self.delay)
            with self._counting:
                self.asked[name] += 1
                busy = self.busy[name] > 0
                self.busy[name] -= busy
            if busy:
                return self._send(handler, 503, b"try again", {})
        status, content, headers = self._pass_on(handler, body)
        if download and status == 200:
            content = self.damage.get(name, bytes)(content)
            if self.cut[name] > 0:
                self.cut[name] -= 1
                headers["Content-Length"] = str(2 * len(content))
                handler.close_connection = True
                return self._send(handler, status, content, headers)
        self._send(handler, status, content, headers)
        if download and status == 200:
            with self._counting:
                self.delivered[name] += 1
        return None

    def _pass_on(
        self, handler: BaseHTTPRequestHandler, body: bytes
    ) -> tuple[int, bytes, dict[str, str]]:
        headers = {k: v for k, v in handler.headers.items() if k.lower() != "host"}
        with self._one_at_a_time:
            connection = http.client.HTTPConnection(self._host, timeout=60)
            connection.request(handler.command, handler.path, body, headers)
            response = connection.getresponse()
            content = response.read()
            connection.close()
        own = {"content-length", "transfer-encoding", "connection", "date", "server"}
        kept = {k: v for k, v in response.headers.items() if k.lower() not in own}
        return response.status, content, kept

    def _send(
        self, handler: BaseHTTPRequestHandler, status: int, content: bytes, headers: dict[str, str]
    ) -> None:
        handler.send_response(status)
        for name, value in ({"Content-Length": str(len(content))} | headers).items():
            handler.send_header(name, value)
        handler.end_headers()
        handler.wfile.write(content)


def options(address: str) -> dict[str, Any]:
    """fsspec's settings for a bucket at this address."""
    return {"endpoint_url": address, "token": "anon", "project": "test"}
