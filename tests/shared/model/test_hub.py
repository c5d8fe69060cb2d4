"""Models to and from a hub, which is a small one on this machine: no test asks the internet."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from huggingface_hub import ModelCard
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.errors import UsageError, UserError
from src.shared.model.checkpoint import PRETRAINED, resolve_model
from src.shared.model.hub import TASKS, hub_name, model_files, parsed, render_card
from tests.shared.model.hub_server import Hub, Repository, running_hub

ROOT = Path(__file__).parents[3]
Done = subprocess.CompletedProcess[str]
REPO = "lab/walks"


@pytest.fixture
def hub() -> Iterator[Hub]:
    with running_hub() as running:
        yield running


@pytest.fixture
def run(hub: Hub, tmp_path: Path) -> Callable[..., Done]:
    """Python in a process of its own, since the hub's client reads its variables when imported."""
    set_up = {
        "PYTHONPATH": str(ROOT),
        "HF_ENDPOINT": hub.address,
        "HF_HOME": str(tmp_path / "home"),
        "HF_TOKEN": hub.token,
        "HF_HUB_OFFLINE": "0",
        "HF_HUB_DISABLE_XET": "1",
    }

    def started(*arguments: object, **changed: str) -> Done:
        return subprocess.run(
            [sys.executable, *map(str, arguments)], capture_output=True, text=True, cwd=tmp_path,
            env=os.environ | set_up | changed,
        )  # fmt: skip

    return started


@pytest.fixture
def tools(run: Callable[..., Done]) -> Callable[..., Done]:
    return lambda *words, **changed: run("-m", "src.cli.tools", *words, **changed)


@pytest.fixture
def model(generator, tmp_path: Path) -> Path:
    """A trained folder, with what training leaves beside the model."""
    folder = tmp_path / "runs" / "mine"
    generator.save_pretrained(folder)
    (folder / "checkpoints/step-1").mkdir(parents=True)
    for name in ("checkpoints/step-1/model.safetensors", "log.jsonl", "notes.py", ".hidden.json"):
        (folder / name).write_text("{}")
    return folder


@pytest.fixture
def stored(hub: Hub, model: Path) -> Repository:
    """The model on the hub, as a push leaves it."""
    files = {name: (model / name).read_bytes() for name in model_files(model)}
    hub.repositories[REPO] = made = Repository()
    made.commit(files | {"README.md": render_card(model, REPO, licence="cc-by-4.0").encode()})
    return made


def failed(done: Done, code: int, *words: str) -> None:
    assert done.returncode == code, done.stderr
    assert "Traceback" not in done.stderr
    [line] = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
    assert all(word in line for word in words), line


# ---------------------------------------------------------------- there and back


def test_what_is_pushed_is_pulled_byte_for_byte(hub: Hub, tools, model: Path, tmp_path: Path):
    done = tools("models", "push", model, REPO, "--licence", "cc-by-4.0", "--dataset", "my-mocap")
    assert done.returncode == 0, done.stderr
    stored = hub.repositories[REPO]
    assert done.stdout.strip() == f"{hub.address}/{REPO}/commit/{stored.refs['main']}"
    names = set(stored.files())
    assert names == {*model_files(model), "README.md", ".gitattributes"}
    assert not {"log.jsonl", "notes.py", ".hidden.json"} & names

    pulled = tools("models", "pull", REPO, "--out", tmp_path / "own", "--json")
    assert pulled.returncode == 0, pulled.stderr
    told = json.loads(pulled.stdout)
    assert told["revision"] == stored.refs["main"]
    for name in model_files(model):
        assert (tmp_path / "own" / name).read_bytes() == (model / name).read_bytes()
    assert resolve_model(tmp_path / "own") == tmp_path / "own"
    metadata = ModelCard.load(tmp_path / "own" / "README.md").data
    assert metadata.license == "cc-by-4.0"
    assert metadata.datasets == ["my-mocap"]


def test_a_push_replaces_the_model_and_leaves_what_is_not_its_own(hub: Hub, tools, model: Path):
    done = tools("models", "push", model, REPO, "--licence", "cc-by-4.0", "--private")
    assert done.returncode == 0, done.stderr
    stored = hub.repositories[REPO]
    assert stored.private
    first = stored.refs["main"]
    stored.commit(stored.files() | {"video.mp4": b"mp4", "decoder.onnx": b"of older weights"})
    done = tools("models", "push", model, f"{REPO}@trial", "--licence", "mit", "--message", "Try")
    assert done.returncode == 0, done.stderr
    assert "decoder.onnx" in stored.files("main")
    assert "video.mp4" in stored.files("trial") and "decoder.onnx" not in stored.files("trial")
    assert b"license: mit" in stored.files("trial")["README.md"]
    assert b"license: cc-by-4.0" in stored.files(first)["README.md"]


@pytest.mark.parametrize("there", [False, True])
def test_a_server_without_xet_is_named(hub: Hub, tools, model: Path, there):
    words = ("models", "push", model, REPO, "--licence", "cc-by-4.0")
    if there:
        hub.repositories[REPO] = made = Repository()
        made.commit({".gitattributes": b""})
    done = tools(*words, HF_HUB_DISABLE_XET="0")
    failed(done, 1, "xet-write-token", "set HF_HUB_DISABLE_XET=1")
    assert "cache" not in done.stderr and "free space" not in done.stderr
    assert set(hub.repositories) == {REPO}  # made, or as it was: nothing is deleted on a server
    assert tools(*words).returncode == 0


def test_a_repository_without_a_card_is_told_of_once(hub: Hub, tools):
    hub.repositories[REPO] = made = Repository()
    made.commit({".gitattributes": b""})
    done = tools("models", "pull", REPO)
    failed(done, 1, "is no model of motionsuite")
    assert len(done.stderr.splitlines()) == 1


PYTHON = """
import sys, motionsuite as ms
name, folder, endpoint, cache = sys.argv[1:]
asked = dict(seconds=1.0, sampling=ms.Sampling(seed=3))
[near] = ms.load(folder).generate("a person walks forward", **asked)
[far] = ms.load(name).generate("a person walks forward", **asked)
assert (near.quaternions == far.quaternions).all()
elsewhere = ms.load(name, revision="main", endpoint=endpoint, cache_dir=cache)
[other] = elsewhere.generate("a person walks forward", **asked)
assert (other.quaternions == near.quaternions).all()
again = ms.load(name, cache_dir=cache, local_files_only=True)
assert again.text.card == elsewhere.text.card
"""


def test_a_name_on_the_hub_is_a_model_in_python(
    hub: Hub, run, stored: Repository, model: Path, tmp_path: Path
):
    cache = tmp_path / "elsewhere"
    done = run("-c", PYTHON, REPO, model, hub.address, cache)
    assert done.returncode == 0, done.stderr
    assert list(cache.glob("models--*"))
    assert sum("/revision/main" in each for each in hub.asked) == 2, "once a cache, not once a file"


def test_a_judge_goes_through_the_hub_as_well(hub: Hub, run, tools):
    done = tools("models", "push", PRETRAINED / "evaluator", "lab/judge")
    assert done.returncode == 0, done.stderr
    code = "from src.shared.model.evaluator import Evaluator as E;"
    code += "print(*(E.from_pretrained(n).content_hash for n in ('lab/judge', 'evaluator')))"
    done = run("-c", code)
    assert len(set(done.stdout.split())) == 1, done.stderr
    assert done.returncode == 0, done.stderr


# ---------------------------------------------------------------- which one


def test_a_commit_a_tag_and_a_branch_name_a_revision(hub: Hub, tools, stored: Repository):
    first = stored.refs["v1"] = stored.refs["main"]
    stored.commit(stored.files() | {"LICENSE": b"another"})
    for name in ("v1", first):
        assert tools("models", "pull", f"{REPO}@{name}").stdout.strip().endswith(first)
    assert tools("models", "pull", f"hf://{REPO}").stdout.strip().endswith(stored.refs["main"])
    failed(tools("models", "pull", f"{REPO}@v2"), 1, "no revision 'v2'", hub.address)
    failed(tools("models", "pull", f"{REPO}@{'0' * 40}"), 1, "no revision")


def test_what_is_not_there_or_not_ours_to_see_is_told(
    hub: Hub, tools, stored: Repository, model: Path
):
    failed(tools("models", "pull", "lab/none"), 1, "no model 'lab/none'", hub.address, "HF_TOKEN")
    failed(tools("generate", "--prompt", "walk", "--model", "lab/none"), 1, "no model 'lab/none'")
    stored.private = True
    failed(
        tools("models", "pull", REPO, HF_TOKEN="wrong"), 1, f"no model '{REPO}'", "hf auth login"
    )
    failed(tools("models", "push", model, REPO, "--licence", "mit", HF_TOKEN="x"), 1, "refused")
    failed(tools("models", "push", model, REPO, "--licence", "no-such"), 1, "license", "refused")


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("push", "MODEL", REPO), ("--licence",)),
        (("push", "MODEL", "walks", "--licence", "mit"), ("'walks'", "user/model")),
        (("pull", "lab/a--b"), ("'lab/a--b'",)),
    ],
)
def test_wrong_usage(model: Path, words: tuple[str, ...], named: tuple[str, ...]):
    given = [str(model) if word == "MODEL" else word for word in words]
    result = CliRunner().invoke(app, ["models", *given])
    failed(Done(given, result.exit_code, result.stdout, result.stderr), 2, *named)


def test_names_that_are_paths_stay_paths(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "outputs").mkdir()
    assert hub_name("lab/walks") and hub_name("hf://outputs/walks@refs/pr/1")
    for name in ("runs/walks", "outputs/walks", "./lab/walks", "/lab/walks", "lab/a/b", "lab/",
                 "lab", "../walks", "C:/walks", Path("lab/walks")):  # fmt: skip
        assert not hub_name(name), name
    assert parsed("lab/walks@v1.0") == ("lab/walks", "v1.0")
    with pytest.raises(UsageError, match="user/model"):
        parsed("walks")
    with pytest.raises(UserError, match="no such folder"):
        resolve_model("outputs/walks")


# ---------------------------------------------------------------- offline


def test_offline_the_cache_serves_and_nothing_is_asked(
    hub: Hub, tools, stored: Repository, model: Path, tmp_path
):
    assert tools("models", "pull", REPO).returncode == 0
    hub.asked.clear()
    generate = ("generate", "--prompt", "walk", "--model", REPO, "--format", "npz")
    done = tools(*generate, "--out", tmp_path / "out", HF_HUB_OFFLINE="1")
    assert done.returncode == 0, done.stderr
    failed(tools("models", "pull", f"{REPO}@v1", HF_HUB_OFFLINE="1"), 1, "offline", f"{REPO}@v1")
    failed(
        tools("models", "push", model, REPO, "--licence", "mit", HF_HUB_OFFLINE="1"), 1, "offline"
    )
    assert not hub.asked
    nowhere = {"HF_ENDPOINT": "http://127.0.0.1:9"}
    assert tools("models", "pull", REPO, **nowhere).returncode == 0, "what is cached does"
    failed(tools("models", "pull", "lab/none", **nowhere), 1, nowhere["HF_ENDPOINT"], "connection")
    failed(tools("models", "push", model, REPO, "--licence", "mit", **nowhere), 1, "be reached")


def test_a_half_fetched_model_is_no_model(tools, stored: Repository):
    folder = Path(tools("models", "pull", REPO).stdout.strip())
    (folder / "model.safetensors").unlink()
    failed(tools("models", "pull", REPO, HF_HUB_OFFLINE="1"), 1, "not whole")
    assert tools("models", "pull", REPO).returncode == 0


def test_a_cache_that_cannot_be_written_is_named(tools, stored: Repository, tmp_path: Path):
    (tmp_path / "file").touch()
    cache = str(tmp_path / "file" / "hub")
    failed(tools("models", "pull", REPO, HF_HUB_CACHE=cache), 1, cache, "HF_HUB_CACHE")


# ---------------------------------------------------------------- whom to believe


def flipped(data: bytes) -> bytes:
    return data[:-1] + bytes([data[-1] ^ 1])


def test_bytes_that_the_hub_did_not_list_are_refused(hub: Hub, tools, stored: Repository):
    files = stored.files()
    for name in ("model.safetensors", "scope.json"):
        hub.served = {name: flipped(files[name])}
        failed(tools("models", "pull", REPO, "--force"), 1, name, "not the file", "--force")
    hub.served = {}
    failed(tools("generate", "--prompt", "walk", "--model", REPO), 1, "scope.json", "--force")
    assert tools("models", "pull", REPO, "--force").returncode == 0


def test_weights_that_their_card_does_not_vouch_for_are_refused(
    tools, stored: Repository, model: Path
):
    good = stored.refs["main"]
    tampered = flipped(stored.files()["model.safetensors"])
    stored.commit(stored.files() | {"model.safetensors": tampered})
    failed(tools("models", "pull", REPO), 1, "model.safetensors", "vouches", "SHA-256")
    assert tools("models", "pull", f"{REPO}@{good}").returncode == 0
    (model / "model.safetensors").write_bytes(tampered)
    failed(tools("models", "push", model, REPO, "--licence", "mit"), 1, "SHA-256")


def test_code_and_pickles_are_never_fetched(hub: Hub, tools, stored: Repository, tmp_path: Path):
    harm = (
        "modeling.py",
        "setup.py",
        "pytorch_model.bin",
        "tokenizer/code.py",
        "a/b.json",
        "x.pkl",
    )
    stored.commit(stored.files() | dict.fromkeys(harm, b"import os"))
    hub.asked.clear()
    done = tools("models", "pull", REPO, "--out", tmp_path / "own")
    assert done.returncode == 0, done.stderr
    assert not [asked for asked in hub.asked if asked.endswith(harm)]
    names = [
        path.name for path in (*(tmp_path / "home").rglob("*"), *(tmp_path / "own").rglob("*"))
    ]
    assert not {Path(name).name for name in harm} & set(names)


@pytest.mark.parametrize("config", [b"", b"[]", b'{"model_type": "gpt2"}', b'{"kind": []}'])
def test_another_programs_model_is_refused_before_its_weights(hub: Hub, tools, config: bytes):
    hub.repositories[REPO] = Repository()
    files = {"config.json": config} if config else {}
    hub.repositories[REPO].commit(files | {"model.safetensors": b"much"})
    failed(tools("models", "pull", REPO), 1, REPO, "no model of motionsuite")
    assert not [asked for asked in hub.asked if asked.endswith("model.safetensors")]


# ---------------------------------------------------------------- cards


def test_a_card_is_rendered_from_what_the_folder_says(tools, model: Path):
    done = tools("models", "push", model, REPO, "--licence", "cc0-1.0", "--dry-run", "--json")
    told = json.loads(done.stdout)
    assert told["files"] == model_files(model)
    card = ModelCard(told["card"])
    assert (card.data.library_name, card.data.license) == ("motionsuite", "cc0-1.0")
    assert card.data.pipeline_tag == "text-to-3d" and "text-to-motion" in card.data.tags
    assert f'ms.load("{REPO}")' in card.text and "walk, jump" in card.text


def test_figures_of_training_and_a_licence_in_words_become_metadata(model: Path):
    content = json.loads((model / "config.json").read_text())
    content |= {"licence": "CC BY-NC 4.0 (of the data)", "training": {"validation": {"loss": 0.25}}}
    (model / "config.json").write_text(json.dumps(content))
    data = ModelCard(render_card(model, REPO)).data
    assert data.license == "cc-by-nc-4.0"
    [result] = data.eval_results
    assert (result.task_type, result.metric_type) == ("text-to-motion", "loss")
    assert result.metric_value == 0.25
    content["licence"] = "ask the lab"
    (model / "config.json").write_text(json.dumps(content))
    data = ModelCard(render_card(model, REPO)).data
    assert (data.license, data.license_name) == ("other", "ask the lab")


def test_a_card_of_ones_own_is_kept(model: Path):
    own = "---\nlicense: mit\ntags: [mine]\nco2: 3\n---\n# Walks\n"
    (model / "README.md").write_text(own)
    card = ModelCard(render_card(model, REPO, datasets=["mocap"]))
    assert (card.data.license, card.data.tags, card.data.co2) == ("mit", ["mine"], 3)
    assert card.data.datasets == ["mocap"] and card.data.library_name == "motionsuite"
    assert card.text.strip() == "# Walks"
    (model / "README.md").write_text("---\nlicense: [\n---\n# Walks\n")
    with pytest.raises(UserError, match="metadata cannot be read"):
        render_card(model, REPO)


@pytest.mark.parametrize("folder", sorted(PRETRAINED.iterdir()), ids=lambda path: path.name)
def test_shipped_cards_have_their_metadata(folder: Path):
    data = ModelCard.load(folder / "README.md").data
    kind = json.loads((folder / "config.json").read_text())["kind"]
    free = folder.name == "starter-free"
    assert data.license == ("apache-2.0" if free else "cc-by-nc-4.0")
    assert data.library_name == "motionsuite" and data.pipeline_tag == TASKS[kind][0]
    assert TASKS[kind][1] in data.tags and data.datasets and data.eval_results
    card, own = render_card(folder, REPO), (folder / "README.md").read_text("utf-8")
    told = own.split("---", 2)[2]
    for result in data.eval_results:
        value = f"{result.metric_value:g}"
        assert re.search(
            rf"(?<![\d.]){re.escape(value.removeprefix('0'))}(?!\d)|{value}(?!\d)", told
        ), value
    assert card.count("\n") == own.count("\n") and card[:200] == own[:200], "nothing to add"
    assert not re.search(r"\]\((?!https?://)", card), "a link that is dead there"


def test_links_to_what_is_not_pushed_are_words_alone(model: Path):
    own = (
        "---\nlicense: mit\n---\n[a](../b.md#c) [`d`](../e/README.md) ![f](f.png) `g[0](h.i)`\n"
        "[j](https://k.org/l) [m](#n) [the card](config.json)\n```\no[0](p.q)\n```\n"
    )
    (model / "README.md").write_text(own)
    assert ModelCard(render_card(model, REPO)).text.strip() == (
        "a `d` f `g[0](h.i)`\n"
        "[j](https://k.org/l) [m](#n) [the card](config.json)\n```\no[0](p.q)\n```"
    )
