"""The studio: one page with a text model inside that makes motions in a browser, without a server.

The shell (scripts, onnxruntime's WebAssembly) is built from `studio/` and ships; the model and its
graph go in here as they are stored. Each part is a `<script>` that no browser runs, of characters
of seven bits: a sixth more than its bytes, where base64 has a third. The page refuses the network
by its own Content-Security-Policy.
"""

import gzip
import re
from functools import reduce
from importlib.resources import files
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ..config_schema import PAIRS, DiffusionConfig
from ..data.retarget.mapping import load_mappings
from ..environment import TEXT_MODEL
from ..errors import UserError
from ..formats.preview.html import body_data, script_safe_json
from ..formats.rig import END_SITES
from ..formats.writers.glb import rest_files
from ..io.files import atomic_write, load_json
from ..model.checkpoint import WEIGHTS_FILE, ModelCard, read_card, resolve_model, wrong_kind
from ..model.clip.out_of_domain import META_FILE as SCOPE_FILE
from ..model.clip.out_of_domain import TABLE_FILE, OutOfDomainDetector
from ..model.clip.tokenizer import META_FILE, MODEL_FILE, TOKENIZER_FOLDER
from ..model.generation.motion_generator import KIND
from ..model.noise import NoiseSchedule, few_from_noise, sampling_timesteps
from ..model.onnx_card import READY, TextOnnxCard, read_onnx_card
from ..model.onnx_graphs import ADAPTED_GRAPH, DENOISER_GRAPH, require_packages
from ..motion.postprocess.whole import smoothing_weights
from ..motion.skeleton import JOINT_NAMES, LIMBS
from ..pipelines.edit import GROUPS
from ..pipelines.words import MAX_COUNT, MOST, UNITS, all_words, unlearned_words

WASM, GRAPHICS_WASM = "onnxruntime.wasm.gz", "onnxruntime-webgpu.wasm.gz"
SCRIPTS = {"@SCRIPT@": "studio.js", "@HELPER@": "helper.js", "@GRAPHICS@": "graphics.js"}
REFUSED = tuple(map(ord, "\0\n\r<"))  # of seven bits, which HTML, or who copies it, may change
TEMPLATE = "studio.html"
LICENCES = "licences.txt.gz"
SAMPLERS = ("ddim", "dpm-solver++")  # that the page's scripts know


def write_studio(out: Path, model: str = TEXT_MODEL, steps: int | None = None) -> Path:
    """Write the page; returns its path.

    Args:
        out: an HTML file, or a folder that then holds index.html.
        model: a name that `models` lists, or a folder of training.
        steps: of sampling; None = the model's own.

    Raises:
        UserError: no such model, or one that the studio cannot run; the file cannot be written.
        UsageError: more steps than the model was trained in, or none.
    """
    shell = files(__package__).joinpath("shell")
    folder = resolve_model(model)
    card = read_card(folder)
    _check(card, folder)
    process = card.network.generation.diffusion()
    if steps is not None:
        process = process.model_copy(update={"sampling_steps": steps})
    own = settings(folder, card, process)
    graphs, shifted = graphs_of(folder)
    parts = {
        "wasm": shell.joinpath(WASM).read_bytes(),
        **{kind: graph for kind, (graph, _) in graphs.items()},
        "weights": (folder / WEIGHTS_FILE).read_bytes(),
        "tokenizer": (folder / TOKENIZER_FOLDER / MODEL_FILE).read_bytes(),
        "scope": (folder / TABLE_FILE).read_bytes(),
        **rest_files(),
        "graphics": shell.joinpath(GRAPHICS_WASM).read_bytes(),
        "licences": shell.joinpath(LICENCES).read_bytes(),
    }
    blobs = "\n".join(
        f'<script type="text/plain" id="part-{name}">{seven_bit(part)}</script>'
        for name, part in parts.items()
    )
    filled = {
        "@SETTINGS@": script_safe_json(
            own
            | {
                "weights": {kind: names for kind, (_, names) in graphs.items()},
                "shifted": shifted if few_from_noise(process) else (),
            }
        ),
        "@PARTS@": blobs,
        **{mark: shell.joinpath(name).read_text("utf-8") for mark, name in SCRIPTS.items()},
    }
    page = shell.joinpath(TEMPLATE).read_text("utf-8")
    page = re.sub("|".join(filled), lambda mark: filled[mark[0]], page)
    path = page_file(out)
    with atomic_write(path) as temporary:
        temporary.write_text(page, "utf-8", newline="\n")
    return path


def page_file(out: Path) -> Path:
    """Where the page goes: an HTML file as it is, index.html in a folder."""
    return out if out.suffix.lower() in (".html", ".htm") else out / "index.html"


def seven_bit(part: bytes) -> str:
    """A part, compressed, as characters of seven bits; those that are REFUSED have the eighth."""
    packed = _packed(part)
    padded = np.frombuffer(packed + bytes(-len(packed) % 7), np.uint8).reshape(-1, 7)
    groups = np.pad(padded, ((0, 0), (1, 0))).view(">u8")
    codes = (groups >> np.arange(49, -1, -7, dtype=np.uint64) & 127).astype(np.uint8).ravel()
    codes[np.isin(codes, REFUSED)] |= 128
    return codes[: -(-len(packed) * 8 // 7)].tobytes().decode("latin-1")


def _packed(part: bytes) -> bytes:
    """Compressed, unless it is already."""
    return part if part[:2] == b"\x1f\x8b" else gzip.compress(part, 9, mtime=0)


def _check(card: ModelCard, folder: Path) -> None:
    """Raises UserError where the page's scripts cannot run a model."""
    if card.kind != KIND:
        raise wrong_kind(folder, card.kind, KIND)
    generation, clip = card.network.generation, card.network.clip
    if (
        clip.text_model != PAIRS
        or generation.text_conditioning != "pooled"
        or generation.sampler not in SAMPLERS
    ):
        raise UserError(
            f"{folder}: the studio runs models with clip.text-model pairs, text-conditioning pooled"
            f" and sampler {' or '.join(SAMPLERS)}, as the shipped starter is; use `generate` for"
            " this one"
        )


def graphs_of(folder: Path) -> tuple[dict[str, tuple[bytes, tuple[str, ...]]], tuple[str, ...]]:
    """The denoiser's graphs, ready to open, "graph" and, of a model with adapters, "adapted", each
    with the names of its weights: the folder's own, else exported here. And the names of the
    vectors that change for the first of few steps, if that was learned."""
    kinds = {"graph": READY + DENOISER_GRAPH, "adapted": READY + ADAPTED_GRAPH}
    if (folder / kinds["graph"]).is_file():
        own = read_onnx_card(folder, TextOnnxCard)
        found = {
            kind: ((folder / name).read_bytes(), own.graphs[name].weights)
            for kind, name in kinds.items()
            if name in own.graphs
        }
        return found, own.shifted
    from ..model.generation.onnx import export_text

    require_packages("onnx", "onnxscript", "onnxruntime")
    with TemporaryDirectory() as scratch:
        export_text(folder, scratch)
        return graphs_of(Path(scratch))


def settings(folder: Path, card: ModelCard, process: DiffusionConfig) -> dict[str, Any]:
    """All that the page needs to know besides arrays."""
    generation = card.network.generation
    alpha_bar = NoiseSchedule.from_config(process).alphas_cumprod
    steps = sampling_timesteps(process.timesteps, process.sampling_steps, process.timestep_spacing)
    post = generation.post_processing
    body = body_data()
    tokenizer = load_json(folder / TOKENIZER_FOLDER / META_FILE)
    scope = OutOfDomainDetector.from_pretrained(folder)
    return {
        "name": card.name,
        "licence": card.licence,
        "languages": list(card.languages),
        "maxSeconds": card.max_seconds,
        "maxTokens": tokenizer["max-tokens"],
        "tags": len(card.tags),
        "adapters": len(generation.adapter_ranks),
        "schedule": [[step, float(alpha_bar[step])] for step in steps],
        "sampler": generation.sampler,
        "guidance": generation.guidance_scale,
        "clip": generation.clip_sigma,
        "prediction": generation.prediction_type,
        "post": {
            "smoothing": smoothing_weights(post),
            "maxVelocity": post.max_velocity,
            "footLock": post.foot_lock,
        },
        "scope": load_json(folder / SCOPE_FILE),
        "measures": javascript_patterns(),
        "unlearned": unlearned_words(),
        "ownWords": bool(scope and scope.captions),
        "skeleton": {
            "names": list(JOINT_NAMES),
            "parents": body["skeleton"]["parents"],
            "offsets": body["skeleton"]["offsets"],
            "tips": list(END_SITES.items()),
            "limbs": LIMBS,
            "groups": GROUPS,
        },
        "profiles": [
            {
                "name": profile.name,
                "joints": profile.joints,
                "axes": {joint: profile.axes_of(joint).ravel().tolist() for joint in profile.axes},
            }
            for profile in load_mappings()
        ],
        "body": body,
    }


# ---------------------------------------------------------------- words as JavaScript reads them

_WORD = r"\p{L}\p{N}_"  # what \w is here
_JAVASCRIPT = (
    ("(?-i:", "(?:"),
    ("(?P<", "(?<"),
    (r"[\w", f"[{_WORD}"),
    (r"\w", f"[{_WORD}]"),
    (r"\W", f"[^{_WORD}]"),
    (r"\d", r"\p{Nd}"),
    (r"\-", "-"),
)


def javascript_patterns() -> dict[str, Any]:
    """The patterns as JavaScript reads them, with the flags i and u, and what their words say."""
    ours = all_words()
    tables = (
        "numbers",
        "adverbs",
        "angles",
        "tempos",
        "postures",
        "returned",
        "others",
        "plainly",
        "steps",
    )
    said = {name: vars(ours)[name] for name in tables}
    apart = {*said, "units", "pauses"}
    alone = {name: each for name, each in vars(ours).items() if name not in apart}
    found = {
        name: reduce(lambda text, pair: text.replace(*pair), _JAVASCRIPT, each.pattern)
        for name, each in (alone | ours.units | ours.pauses).items()
    }
    return {"patterns": found, "units": UNITS, "most": MOST, "maxCount": MAX_COUNT} | said
