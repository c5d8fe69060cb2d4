"""A small hub on this machine: what `huggingface_hub` asks for, with repositories in memory."""

import base64
import json
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from hashlib import sha1, sha256
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from typing import Any
from urllib.parse import unquote, urlsplit

Files = dict[str, bytes]
LARGE = (".safetensors", ".onnx", ".model", ".bin", ".pkl")  # kept apart, as git-lfs does


def blob_id(data: bytes) -> str:
    return sha1(b"blob %d\0" % len(data) + data).hexdigest()


@dataclass
class Repository:
    """Commits by name, and the branches and tags that point at them."""

    commits: dict[str, Files] = field(default_factory=dict)
    refs: dict[str, str] = field(default_factory=dict)
    private: bool = False

    def commit(self, files: Files, ref: str = "main") -> str:
        """Put these files at a branch or tag; returns the commit."""
        told = json.dumps([len(self.commits), sorted((k, blob_id(v)) for k, v in files.items())])
        oid = sha1(told.encode()).hexdigest()
        self.commits[oid], self.refs[ref] = dict(files), oid
        return oid

    def files(self, ref: str = "main") -> Files:
        return self.commits[self.refs.get(ref, ref)]


@dataclass
class Hub:
    """What the server holds.

    Attributes:
        served: bytes to send in place of a file's own, by its path: a bad disk, or a bad hub.
        asked: method and path of every request.
        token: who may write.
    """

    repositories: dict[str, Repository] = field(default_factory=dict)
    uploads: dict[str, bytes] = field(default_factory=dict)
    served: Files = field(default_factory=dict)
    asked: list[str] = field(default_factory=list)
    token: str = "secret"
    address: str = ""


class Refused(Exception):
    """An answer other than 200."""

    def __init__(self, status: int, code: str = "") -> None:
        self.status, self.code = status, code


class Handler(BaseHTTPRequestHandler):
    """One request."""

    protocol_version = "HTTP/1.1"
    hub: Hub

    def log_message(self, *_: Any) -> None: ...

    def answer(self, status: int, body: Any = b"", **headers: str) -> None:
        data = body if isinstance(body, bytes) else json.dumps(body).encode()
        self.send_response(status)
        for name, value in ({"Content-Length": str(len(data))} | headers).items():
            self.send_header(name.replace("_", "-"), value)
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(data)

    def body(self) -> bytes:
        return self.rfile.read(int(self.headers.get("Content-Length") or 0))

    def handle_request(self) -> None:
        path, data = unquote(urlsplit(self.path).path), self.body()
        self.hub.asked.append(f"{self.command} {path}")
        try:
            for pattern, answer in ROUTES.items():
                if found := re.fullmatch(pattern, f"{self.command} {path}"):
                    if self.command in ("POST", "PUT", "DELETE"):
                        self.require_token()
                    answer(self, data, **found.groupdict())
                    return
            raise Refused(404)
        except Refused as refusal:
            code = {"X_Error_Code": refusal.code} if refusal.code else {}
            self.answer(refusal.status, {"error": refusal.code or "refused"}, **code)

    do_GET = do_HEAD = do_POST = do_PUT = do_DELETE = handle_request

    def require_token(self) -> None:
        if not self.logged_in() and self.command != "PUT":  # what is put has an address of its own
            raise Refused(401)

    def logged_in(self) -> bool:
        return self.headers.get("Authorization") == f"Bearer {self.hub.token}"

    def repository(self, name: str) -> Repository:
        found = self.hub.repositories.get(name)
        if found is None or (found.private and not self.logged_in()):
            raise Refused(401, "RepoNotFound")  # as the hub does to whoever is not logged in
        return found

    def commit_of(self, repo: str, ref: str) -> str:
        found = self.repository(repo)
        oid = found.refs.get(ref, ref)
        if oid not in found.commits:
            raise Refused(404, "RevisionNotFound")
        return oid

    # ------------------------------------------------------------ reading

    def info(self, _: bytes, repo: str, ref: str) -> None:
        oid = self.commit_of(repo, ref)
        names = [{"rfilename": name} for name in self.repository(repo).commits[oid]]
        found = {"_id": repo, "id": repo, "modelId": repo, "sha": oid, "siblings": names}
        self.answer(200, found | {"private": False, "tags": [], "downloads": 0, "likes": 0})

    def info_of_main(self, data: bytes, repo: str) -> None:
        self.info(data, repo, "main")

    def tree(self, _: bytes, repo: str, ref: str) -> None:
        files = self.repository(repo).commits[self.commit_of(repo, ref)]
        rows = []
        for name, data in files.items():
            row = {"type": "file", "path": name, "size": len(data), "oid": blob_id(data)}
            if name.endswith(LARGE):
                digest = sha256(data).hexdigest()
                row["lfs"] = {"oid": digest, "size": len(data), "pointerSize": 130}
            rows.append(row)
        self.answer(200, rows)

    def resolve(self, _: bytes, repo: str, ref: str, file: str) -> None:
        oid = self.commit_of(repo, ref)
        files = self.repository(repo).commits[oid]
        if file not in files:
            raise Refused(404, "EntryNotFound")
        own = files[file]
        etag = sha256(own).hexdigest() if file.endswith(LARGE) else blob_id(own)
        sent = self.hub.served.get(file, own)
        self.answer(200, sent, ETag=f'"{etag}"', X_Repo_Commit=oid)

    # ------------------------------------------------------------ writing

    def create(self, data: bytes) -> None:
        asked = json.loads(data)
        name = f"{asked['organization']}/{asked['name']}"
        url = f"{self.hub.address}/{name}"
        if name in self.hub.repositories:
            self.answer(409, {"error": "it is there already", "url": url})
            return
        made = Repository(private=asked.get("visibility") == "private")
        made.commit({".gitattributes": b"*.safetensors filter=lfs\n"})
        self.hub.repositories[name] = made
        self.answer(200, {"url": url})

    def delete(self, data: bytes) -> None:
        asked = json.loads(data)
        del self.hub.repositories[f"{asked['organization']}/{asked['name']}"]
        self.answer(200, {})

    def branch(self, _: bytes, repo: str, ref: str) -> None:
        found = self.repository(repo)
        if ref in found.refs:
            raise Refused(409)
        found.refs[ref] = found.refs["main"]
        self.answer(200, {})

    def valid(self, data: bytes) -> None:
        wrong = "license: no-such" in json.loads(data)["content"]
        errors = [{"message": '"license" must be one of the known'}] if wrong else []
        self.answer(400 if wrong else 200, {"errors": errors, "warnings": []})

    def preupload(self, data: bytes, repo: str, ref: str) -> None:
        files = self.repository(repo).commits[self.commit_of(repo, ref)]
        answers = []
        for each in json.loads(data)["files"]:
            path = each["path"]
            mode = "lfs" if path.endswith(LARGE) else "regular"
            oid = blob_id(files[path]) if path in files and mode == "regular" else None
            answers.append({"path": path, "uploadMode": mode, "shouldIgnore": False, "oid": oid})
        self.answer(200, {"files": answers})

    def batch(self, data: bytes, repo: str) -> None:
        self.repository(repo)
        found = [
            {**each, "actions": {"upload": {"href": f"{self.hub.address}/upload/{each['oid']}"}}}
            for each in json.loads(data)["objects"]
        ]
        self.answer(200, {"transfer": "basic", "objects": found})

    def upload(self, data: bytes, oid: str) -> None:
        if sha256(data).hexdigest() != oid:
            raise Refused(422)
        self.hub.uploads[oid] = data
        self.answer(200)

    def commit(self, data: bytes, repo: str, ref: str) -> None:
        found = self.repository(repo)
        files = dict(found.commits[self.commit_of(repo, ref)])
        for line in data.splitlines():
            item = json.loads(line)
            value = item["value"]
            match item["key"]:
                case "file":
                    files[value["path"]] = base64.b64decode(value["content"])
                case "lfsFile":
                    files[value["path"]] = self.hub.uploads[value["oid"]]
                case "deletedFile":
                    del files[value["path"]]
        oid = found.commit(files, ref)
        url = f"{self.hub.address}/{repo}/commit/{oid}"
        self.answer(200, {"commitUrl": url, "commitOid": oid})


REPO = r"(?P<repo>[\w.-]+/[\w.-]+)"
ROUTES: dict[str, Callable[..., None]] = {
    rf"GET /api/models/{REPO}/revision/(?P<ref>.+)": Handler.info,
    rf"GET /api/models/{REPO}": Handler.info_of_main,
    rf"GET /api/models/{REPO}/tree/(?P<ref>[^/]+)": Handler.tree,
    rf"(GET|HEAD) /{REPO}/resolve/(?P<ref>[^/]+)/(?P<file>.+)": Handler.resolve,
    r"POST /api/repos/create": Handler.create,
    r"DELETE /api/repos/delete": Handler.delete,
    r"POST /api/validate-yaml": Handler.valid,
    rf"POST /api/models/{REPO}/branch/(?P<ref>.+)": Handler.branch,
    rf"POST /api/models/{REPO}/preupload/(?P<ref>.+)": Handler.preupload,
    rf"POST /{REPO}\.git/info/lfs/objects/batch": Handler.batch,
    r"PUT /upload/(?P<oid>\w+)": Handler.upload,
    rf"POST /api/models/{REPO}/commit/(?P<ref>.+)": Handler.commit,
}


@contextmanager
def running_hub() -> Iterator[Hub]:
    """A hub with nothing in it, on a free port of this machine."""
    hub = Hub()
    server = ThreadingHTTPServer(("127.0.0.1", 0), type("Bound", (Handler,), {"hub": hub}))
    hub.address = f"http://127.0.0.1:{server.server_port}"
    thread = Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield hub
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
