"""Models on a Hugging Face hub: `user/model` becomes a folder, a folder becomes a repository.

Of a repository only what a model folder consists of is fetched: never code, never a pickle. Every
file must have the hash that the hub lists for its commit, and the weights that of their own card.
Cache, token, endpoint and offline mode are those of `huggingface_hub`: HF_HUB_CACHE, HF_TOKEN,
HF_ENDPOINT, HF_HUB_OFFLINE.
"""

import logging
import re
import shutil
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import lru_cache
from hashlib import sha1
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from ..errors import UsageError, UserError
from ..io.files import atomic_write, load_json, read_text, sha256_file, why_not_written
from .checkpoint import (
    CARD_FILE,
    RUNS,
    WEIGHTS_FILE,
    WeightsInfo,
    check_weights,
    of_another_version,
    read_card,
    resolve_model,
)

PROGRAM, README = "motionsuite", "README.md"
NAME = re.compile(
    r"(?P<scheme>hf://)?(?P<repo>(?P<owner>\w[\w.-]*)/\w[\w.-]*)(?:@(?P<revision>[\w./-]+))?",
    re.ASCII,
)
# What a model folder consists of; anything else of a repository or a folder stays where it is.
OURS = re.compile(
    r"(tokenizer/)?\w[\w.-]*\.(json|safetensors|model|onnx)|README\.md|LICENSE(\.md|\.txt)?",
    re.ASCII,
)
# of Markdown; code is passed over
LINK = re.compile(
    r"```(?s:.*?)```|`[^`\n]+`|!?\[(?P<words>[^\[\]]*)\]\((?P<to>[^()\s]+)\)", re.ASCII
)
EVALUATOR = "evaluator"  # has a card of its own
# kind: pipeline_tag, one of the hub's own, and what the field calls it
TASKS = {
    "motion-generator": ("text-to-3d", "text-to-motion"),
    "audio-motion": ("other", "music-to-motion"),
    "motion-clip": ("feature-extraction", "text-motion-retrieval"),
    "shared-space": ("feature-extraction", "audio-motion-retrieval"),
    EVALUATOR: ("feature-extraction", "text-motion-evaluation"),
}
LICENCES = (
    *("cc-by-nc-4.0", "cc-by-nc-sa-4.0", "cc-by-sa-4.0", "cc-by-4.0", "cc0-1.0"),
    *("apache-2.0", "mit"),
)


def hub_name(name: str | Path) -> bool:
    """Whether a name is a repository's: `user/model`, `user/model@revision`, with hf:// or not.

    Without hf:// a name whose first part is a folder here, or `runs`, is a path.
    """
    found = NAME.fullmatch(name) if isinstance(name, str) else None
    if found is None:
        return False
    owner = found["owner"]
    return bool(found["scheme"]) or not (owner == str(RUNS) or Path(owner).is_dir())


def parsed(name: str) -> tuple[str, str | None]:
    """Repository and revision of a name.

    Raises:
        UsageError: not of that form.
    """
    found = NAME.fullmatch(name)
    if found is None:
        raise UsageError(
            f"{name!r} is no name of a model on a hub; write user/model or user/model@revision"
        )
    return found["repo"], found["revision"]


# ---------------------------------------------------------------- from the hub


def pull(
    name: str,
    *,
    revision: str | None = None,
    cache_dir: str | Path | None = None,
    local_files_only: bool = False,
    endpoint: str | None = None,
    force: bool = False,
) -> Path:
    """The folder of a model from the hub, in the cache; asked for again, the process's own answer.

    Args:
        name: `user/model` or `user/model@revision`.
        revision: branch, tag or commit; None = what the name says, or main.
        cache_dir: None = HF_HUB_CACHE.
        local_files_only: ask the cache alone.
        endpoint: address of the hub; None = HF_ENDPOINT.
        force: fetch again what is in the cache.

    Raises:
        UsageError: no such form of a name.
        UserError: no such model or revision, not to be reached and not in the cache, not a model
            of this program, or a file that is not what the hub or its card vouches for.
    """
    repo, named = parsed(name)
    if force:
        _fetched.cache_clear()
    return _fetched(
        repo,
        revision or named,
        cache_dir=str(cache_dir) if cache_dir is not None else None,
        local_files_only=local_files_only,
        endpoint=endpoint,
        force_download=force,
    )


@lru_cache
def _fetched(repo: str, revision: str | None, **how: Any) -> Path:
    """`pull`; `how` is of `snapshot_download`."""
    from huggingface_hub import get_cached_repo_tree, snapshot_download
    from huggingface_hub.errors import CachedRepoTreeNotFoundError

    def fetch(revision: str | None, files: Sequence[str]) -> Path:
        with _told(repo, revision, how["endpoint"], how["local_files_only"]):
            own = {"revision": revision, "allow_patterns": files, "library_name": PROGRAM}
            return Path(snapshot_download(repo, **own, **how))

    commit = (folder := fetch(revision, [CARD_FILE])).name  # small, and tells whether to go on
    shown = f"{repo}@{commit[:12]}"
    content = _content(folder, shown)
    try:
        listed = get_cached_repo_tree(repo, revision=commit, cache_dir=how["cache_dir"])
    except CachedRepoTreeNotFoundError:  # another program filled the cache, and now it is offline
        listed = []
    files = {file.path: file for file in listed if OURS.fullmatch(file.path)}
    fetch(commit, sorted(files))
    again = f"`motion-tools models pull {repo}@{commit} --force`"
    for path, file in files.items():
        digest, wanted = (sha256_file, file.lfs.sha256) if file.lfs else (_git_hash, file.blob_id)
        if digest(folder / path) != wanted:
            raise UserError(
                f"{folder / path} is not the file that the hub lists for {shown}: it is damaged;"
                f" fetch it again with {again}, and if that does not help, tell its owner"
            )
    try:
        check_weights(folder, _weights(folder, content))
    except UserError as error:
        raise UserError(
            f"{shown}: its {WEIGHTS_FILE} is not the one that its {CARD_FILE} vouches for"
            f" ({error}); fetch it again with {again}, name another revision, or tell its owner"
        ) from error
    return folder


def _git_hash(path: Path) -> str:
    data = path.read_bytes()
    return sha1(b"blob %d\0" % len(data) + data, usedforsecurity=False).hexdigest()


def _content(folder: Path, shown: str) -> dict[str, Any]:
    """What config.json of a model folder says, of any kind that there is."""
    content: dict[str, Any] = {}
    with suppress(OSError, ValueError, TypeError):
        content = dict(load_json(folder / CARD_FILE))
    if (kind := str(content.get("kind"))) not in TASKS:
        raise UserError(
            f"{shown} is no model of {PROGRAM}: no {CARD_FILE} there tells of one; name a folder of"
            " training, or a repository that `models push` made"
        )
    if kind != EVALUATOR:  # whose own reader checks the rest
        read_card(folder)
    return content


def _weights(folder: Path, content: Mapping[str, Any]) -> WeightsInfo | None:
    given = content.get("weights")
    try:
        return WeightsInfo.model_validate(given) if given else None
    except ValidationError as error:
        raise of_another_version(folder / CARD_FILE, error) from error


@contextmanager
def _told(repo: str, revision: str | None, endpoint: str | None, local: bool) -> Iterator[None]:
    """Turn what the client raises into what a user can mend."""
    from huggingface_hub import constants, errors, utils

    hub = endpoint or constants.ENDPOINT
    name = f"{repo}@{revision}" if revision else repo
    offline = local or constants.is_offline_mode()
    log_in = "log in with `hf auth login`, or set HF_TOKEN"
    logging.getLogger("huggingface_hub").propagate = False  # it writes to stderr by itself
    # "No files matched" of a repository without a card, which is told below
    logging.getLogger("huggingface_hub._snapshot_download").setLevel(logging.ERROR)
    if not sys.stderr.isatty():
        utils.disable_progress_bars()
    try:
        yield
    except errors.GatedRepoError as error:
        raise UserError(f"{hub}/{repo} is gated; ask there for access, then {log_in}") from error
    except errors.RepositoryNotFoundError as error:
        raise UserError(
            f"no model {repo!r} on {hub}, and no such folder here; check the name, or, if it is"
            f" private, {log_in}"
        ) from error
    except errors.RevisionNotFoundError as error:
        raise UserError(
            f"{repo} has no revision {revision!r} on {hub}; name a branch, a tag or a commit of it"
        ) from error
    except (errors.LocalEntryNotFoundError, errors.OfflineModeIsEnabled) as error:
        if not offline:
            raise UserError(
                f"{hub} cannot be asked for {name}, which is not whole in the cache"
                f" ({_reason(error.__cause__ or error)}); check the connection and HF_ENDPOINT"
            ) from error
        raise UserError(
            f"{name} is not in the cache, or not whole, and nothing else is asked offline"
            " (HF_HUB_OFFLINE or local_files_only); pull it once with a connection, or name a"
            " folder that is here"
        ) from error
    except errors.HFValidationError as error:
        raise UsageError(
            f"{name!r} cannot be a name on a hub: {_reason(error)}; check it"
        ) from error
    except errors.HfHubHTTPError as error:
        raise UserError(
            f"{hub} refused {name} ({_reason(error)}); set HF_TOKEN to one that may"
            " do this, or try later"
        ) from error
    except errors.HTTPError as error:  # of the client beneath, whichever version it is
        raise UserError(
            f"{hub} cannot be reached ({_reason(error)}); check the connection and HF_ENDPOINT"
        ) from error
    except ValueError as error:  # the hub's own check of a card, among others
        raise UserError(
            f"{hub} refused {name} ({_reason(error)}); correct it and push again"
        ) from error
    except OSError as error:
        if error.errno is None or isinstance(error, ConnectionError | TimeoutError):
            # not of this machine's files: xet, which carries large files, raises Python's own
            raise UserError(
                f"{hub} failed to take or send the files of {name} ({_reason(error)}); set"
                " HF_HUB_DISABLE_XET=1 where a server does not speak xet, else check the connection"
            ) from error
        reason = why_not_written(error)
        raise UserError(
            f"cannot keep {name} in the cache, {constants.HF_HUB_CACHE}: {reason}; free space, or"
            " set HF_HUB_CACHE to another folder"
        ) from error


def _reason(error: BaseException) -> str:
    return " ".join(str(error).split())[:300] or type(error).__name__


# ---------------------------------------------------------------- to the hub


def push_to_hub(
    model: str | Path,
    repo: str,
    *,
    licence: str | None = None,
    datasets: Sequence[str] = (),
    private: bool = False,
    message: str | None = None,
    endpoint: str | None = None,
) -> str:
    """Publish a model in one commit, with its card; returns the commit's address.

    A repository that is not there is made, and so is a branch. Files of a model that an earlier
    commit brought and this model does not have are deleted; others are left.

    Args:
        model: a name that `models` lists, or a folder from training.
        repo: `user/model`, or `user/model@branch`.
        licence, datasets: as of `render_card`.
        private: of a repository that is made.
        message: of the commit.
        endpoint: address of the hub; None = HF_ENDPOINT.

    Raises:
        UsageError: `repo` has not that form, or no licence is known.
        UserError: no such model or a damaged one; the hub refuses, or cannot be reached.
    """
    name, branch = parsed(repo)
    folder = resolve_model(model)
    card, files = render_card(folder, name, licence=licence, datasets=datasets), model_files(folder)

    from huggingface_hub import CommitOperationAdd, CommitOperationDelete, HfApi

    with _told(name, branch, endpoint, local=False):
        api = HfApi(endpoint=endpoint, library_name=PROGRAM)
        api.create_repo(name, private=private, exist_ok=True)
        if branch is not None:
            api.create_branch(name, branch=branch, exist_ok=True)
        there = [
            file for file in api.list_repo_files(name, revision=branch) if OURS.fullmatch(file)
        ]
        left = [file for file in there if file not in (*files, README)]
        commit = api.create_commit(
            name,
            [
                *(CommitOperationAdd(file, folder / file) for file in files if file != README),
                CommitOperationAdd(README, card.encode()),
                *map(CommitOperationDelete, left),
            ],
            commit_message=message or f"Upload {folder.name} by {PROGRAM}",
            revision=branch,
        )
    return str(commit.commit_url)


def model_files(folder: Path) -> list[str]:
    """The files of a model folder that are published, by name; checkpoints and logs are not.

    Raises:
        UserError: no model, or its weights are damaged.
    """
    check_weights(folder, _weights(folder, _content(folder, str(folder))))
    inside = [*folder.glob("*"), *folder.glob("tokenizer/*")]
    names = (path.relative_to(folder).as_posix() for path in inside if path.is_file())
    return sorted(name for name in names if OURS.fullmatch(name))


def copy_files(folder: Path, out: Path) -> None:
    """Copy a model folder of the cache, where files are links, to a folder of one's own."""
    for name in sorted(model_files(folder), key=CARD_FILE.__eq__):  # the card last: it vouches
        with atomic_write(out / name) as temporary:
            shutil.copyfile(folder / name, temporary)


# ---------------------------------------------------------------- the card


def render_card(
    folder: Path, repo: str, *, licence: str | None = None, datasets: Sequence[str] = ()
) -> str:
    """The README.md of a model on a hub: metadata, then the folder's own text or one made of facts.

    What the folder's README.md has as metadata stays, the rest comes from config.json.

    Args:
        folder: of the model.
        repo: where it will lie.
        licence: the hub's identifier, cc-by-4.0 say; None = what the folder says.
        datasets: names of what it learned from.

    Raises:
        UsageError: no licence is known.
        UserError: no model, or metadata that cannot be read.
    """
    from huggingface_hub import ModelCard, ModelCardData

    content, path = _content(folder, str(folder)), folder / README
    whole = read_text(path, "a model card") if path.is_file() else _facts(content, repo)
    text = whole = _without_dead_links(whole)
    given: dict[str, Any] = {}
    try:
        if text.startswith("---"):
            own = ModelCard(whole)
            given, text = own.data.to_dict(), own.text
        asked = {"license": licence, "datasets": list(datasets)}
        said = given | {key: value for key, value in asked.items() if value}
        merged = _metadata(content, repo) | said
        if "license" in said and not given.get("license_name"):
            merged.pop("license_name", None)
        head = ModelCardData(**merged).to_yaml()
    except Exception as error:  # of the YAML reader, too
        raise UserError(
            f"{path}: its metadata cannot be read ({_reason(error)}); correct what stands between"
            " the lines ---"
        ) from error
    if not merged.get("license"):
        raise UsageError(
            f"{folder} says nothing of its licence; give --licence, one of {', '.join(LICENCES)},"
            " or another that the hub knows"
        )
    return whole if merged == given else f"---\n{head.strip()}\n---\n\n{text.lstrip()}"


def _without_dead_links(text: str) -> str:
    """Markdown whose links to files that are not pushed are their words alone."""

    def kept(link: re.Match[str]) -> str:
        to = link["to"] or "#"
        lives = re.match(r"[a-z][a-z+.-]*:|#", to) or OURS.fullmatch(to)
        return link[0] if lives else link["words"]

    return LINK.sub(kept, text)


def _metadata(content: Mapping[str, Any], repo: str) -> dict[str, Any]:
    """Front matter from config.json."""
    task, tag = TASKS[content["kind"]]
    found: dict[str, Any] = {
        "library_name": PROGRAM,
        "pipeline_tag": task,
        "tags": [tag, "human-motion", PROGRAM],
        "language": list(content.get("languages") or ()),
    }
    if words := str(content.get("licence") or ""):
        slug = words.lower().replace(" ", "-")
        known = next((each for each in LICENCES if slug.startswith(each)), None)
        found |= {"license": known} if known else {"license": "other", "license_name": words}
    if figures := _figures(content):
        result = {
            "task": {"type": tag},
            "dataset": {"type": "validation", "name": "validation split of its training"},
            "metrics": [{"type": key, "value": value} for key, value in figures.items()],
        }
        found["model-index"] = [{"name": repo.split("/")[1], "results": [result]}]
    return {key: value for key, value in found.items() if value}


def _figures(content: Mapping[str, Any]) -> dict[str, float]:
    """What the last validation of training measured."""
    measured = dict(content.get("training") or content).get("validation")
    values = measured if isinstance(measured, dict) else {}
    return {str(key): round(v, 6) for key, v in values.items() if isinstance(v, int | float)}


def _facts(content: Mapping[str, Any], repo: str) -> str:
    """The text of a card for a model whose folder has none."""
    weights, training = content.get("weights") or {}, content.get("training") or {}
    rows = {
        "kind": content["kind"],
        "knows": ", ".join(content.get("tags") or ()),
        "languages": ", ".join(content.get("languages") or ()),
        "longest clip in training": f"{content['max-seconds']:g} s"
        if content.get("max-seconds")
        else "",
        "steps": training.get("steps"),
        "data": f"manifest {content['data']}" if content.get("data") else "",
        "weights": f"{weights.get('bytes', 0) / 1e6:.1f} MB, SHA-256 {weights.get('sha256')}",
    }
    table = "\n".join(f"| {name} | {value} |" for name, value in rows.items() if value)
    figures = "\n".join(f"| {name} | {value:.4g} |" for name, value in _figures(content).items())
    measured = f"\n## Figures of validation\n\n| | |\n|---|---|\n{figures}\n" if figures else ""
    return f"""# {content.get("name") or repo}

{content.get("description") or "A model of human motion."}

| | |
|---|---|
{table}
{measured}
## Use

```python
import motionsuite as ms

model = ms.load("{repo}")
```

Weights are safetensors, checked by their SHA-256; nothing of this repository is run as code.
"""
