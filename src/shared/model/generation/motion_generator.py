"""TextToMotion: prompts in, motions out; everything a trained text branch needs in one object.

Letters: B batch, T frames, K rows (bones, root track), C channels, D embed dim, L text tokens.
"""

import logging
from collections.abc import Callable, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from ...config_schema import PROVENANCES
from ...device import choose_device, idle_threads, sampling_threads
from ...errors import UsageError, UserError
from ...motion.features import without_drift
from ...motion.motion import Motion
from ...motion.postprocess.whole import MotionPostProcessor
from ...tensors import Tensor, torch
from ..checkpoint import (
    ModelCard,
    check_weights,
    load_state,
    read_card,
    read_tensors,
    resolve_model,
    with_prefix,
    write_checkpoint,
    wrong_kind,
)
from ..clip.features import TextFeatures, check_embed_dims
from ..clip.out_of_domain import OutOfDomainDetector, ScopeResult
from ..clip.style_map import StyleMap
from ..clip.tokenizer import TOKENIZER_FOLDER, PromptTokenizer
from ..diffusion import GaussianDiffusion, ModelFn, guided
from ..noise import few_from_noise
from .constraint import Constraint, KnownBatch, SampleRequest, batches, make_requests

if TYPE_CHECKING:
    from ..clip.core import TextTower
    from .denoiser import MotionDenoiser

# ---------------------------------------------------------------- one batch


def sample_batch(
    denoiser: "MotionDenoiser",
    diffusion: GaussianDiffusion,
    requests: Sequence[SampleRequest],
    text: TextFeatures,
    *,
    guidance_scale: float,
    sampler: str,
    steps: int | None,
    known: KnownBatch | None = None,
    first: "MotionDenoiser | None" = None,
) -> Tensor:
    """Z-scored motions [B, T, K, C], T the longest of the batch; frames beyond a request's are
    to be cropped.

    Args:
        denoiser: with the diffusion, on one device.
        diffusion: its process.
        requests: B of them; noise comes from their own streams.
        text: B encoded prompts, row by row.
        guidance_scale: 1 = the text alone, in one forward a step.
        sampler: ddim, ddpm or dpm-solver++; ddpm wants requests of one length.
        steps: None = as configured.
        known: what is given of the motions, padded to T.
        first: makes the first step; None = `denoiser` does.
    """
    device = text.pooled.device
    rows, channels = denoiser.config.motion_rows, denoiser.config.generation.motion_channels
    lengths, tags = [request.frames for request in requests], [request.tag for request in requests]
    streams, longest = [request.noise() for request in requests], max(lengths)
    noise = torch.zeros(len(requests), longest, rows, channels)  # [B, T, K, C]
    for row, frames, stream in zip(noise, lengths, streams, strict=True):
        row[:frames] = stream.normal((frames, rows, channels))
    mask = None  # where all are of one length
    if min(lengths) < longest:
        mask = (torch.arange(longest) < torch.tensor(lengths)[:, None]).to(device)
    tag = torch.tensor(tags, device=device)
    no_tag = torch.full_like(tag, denoiser.num_tags)
    learned = denoiser.shows_known
    shared = {
        "mask": mask,
        "known": known.shown if known is not None and learned else None,
        "provenance": as_captured(denoiser, tag),
    }
    text = denoiser.with_adapters(text)
    null = denoiser.drop_text(text, torch.ones_like(tag, dtype=torch.bool))

    def told(network: "MotionDenoiser") -> ModelFn:
        # keys and values once a sample, not once a step
        own, none = network.text_keys_values(text), network.text_keys_values(null)
        condition = {"text": text, "tag": tag, "keys_values": own, **shared}
        no_condition = {"text": null, "tag": no_tag, "keys_values": none, **shared}
        return guided(network, condition, no_condition, guidance_scale)

    model_fn = told(denoiser)
    if first is not None:
        begin, later, top = told(first), model_fn, diffusion.config.timesteps - 1
        model_fn = lambda x_t, t: (begin if int(t[0]) == top else later)(x_t, t)  # noqa: E731
    noise = noise.to(device)
    if known is not None:
        model_fn = diffusion.held(
            model_fn,
            known.known,
            known.values,
            noise,
            shown=known.shown & learned,
            guide=known.rhythm,
        )
    return diffusion.sample(
        model_fn, noise.shape, sampler=sampler, num_steps=steps, generator=streams, x_T=noise
    )


def as_captured(denoiser: "MotionDenoiser", like: Tensor) -> Tensor | None:
    """Sampled motion is to look captured: procedural clips are there to teach, not to answer."""
    if denoiser.provenance_embed is None:
        return None
    return torch.full_like(like, PROVENANCES.index("captured"))


# ---------------------------------------------------------------- TextToMotion


def _check_lengths(constraints: Sequence[Constraint | None], frames: Sequence[int]) -> None:
    """Raises UsageError where a constraint is not as long as its motion."""
    for constraint, length in zip(constraints, frames, strict=True):
        if constraint is not None and len(constraint.values) != length:
            raise UsageError(
                f"a constraint of {len(constraint.values)} frames for a motion of {length}"
                "; give both the same length"
            )


KIND = "motion-generator"
MAX_BATCH = 64  # motions sampled at once
ON_CPU = 8  # of them on a CPU, whose caches hold no more
ENCODED = 8  # lists of prompts whose encoding is remembered
Progress = Callable[[int, int], None]  # motions done, motions in all

log = logging.getLogger(__name__)


class TextToMotion:
    """Samples motions from prompts.

    Args:
        denoiser: trained with `mean` and `std`.
        text: its frozen text tower.
        tokenizer: the tower's.
        mean: [K, C] of the training data.
        std: [K, C].
        card: tags, licence, whether it is trained, longest clip seen.
        scope: what prompts it knows, if that was learned.
        style_map: from its space to styles, if that was learned.
        device: auto, cuda, mps or cpu.

    Raises:
        UserError: the tower and the denoiser differ in width.
    """

    def __init__(
        self,
        denoiser: "MotionDenoiser",
        text: "TextTower",
        tokenizer: PromptTokenizer,
        *,
        mean: Tensor,
        std: Tensor,
        card: ModelCard,
        scope: OutOfDomainDetector | None = None,
        style_map: StyleMap | None = None,
        device: str | None = None,
    ) -> None:
        check_embed_dims(text.embed_dim, denoiser.config.embed_dim, "the text tower")
        self.device = torch.device(choose_device(device or "auto")[0])
        self.network = denoiser.config.model_copy(update={"clip": text.config})
        self.denoiser = denoiser.to(self.device).eval()
        self.text = text.to(self.device).eval()
        self.tokenizer = tokenizer
        self.mean, self.std = mean.to(self.device), std.to(self.device)
        self.card = card
        self.scope = scope
        self.style_map = style_map
        self.diffusion = GaussianDiffusion(self.network.generation.diffusion()).to(self.device)
        self._encoded: dict[tuple[str, ...], TextFeatures] = {}
        self._read: dict[str, ScopeResult] = {}
        self._told: set[str] = set()  # prompts whose warning the caller has

    @property
    def runtime(self) -> str:
        """What computes: torch or onnx."""
        learned: Any = getattr(self.denoiser, "parameters", tuple)()  # an export's lie in its graph
        return "torch" if any(True for _ in learned) else "onnx"

    def with_denoiser(self, denoiser: "MotionDenoiser", **changed: Any) -> "TextToMotion":
        """The same with another denoiser, and with other arguments of the class."""
        names = ("text", "tokenizer", "mean", "std", "card", "scope", "style_map")
        own = {name: getattr(self, name) for name in names} | {"device": str(self.device)}
        return TextToMotion(denoiser, **own | changed)

    @cached_property
    def _one_step(self) -> "MotionDenoiser | None":
        return self.denoiser.in_one_step()

    def learned_step(self, steps: int | None = None) -> "MotionDenoiser | None":
        """What makes the first of so many steps, None of the model's own, instead of the denoiser,
        if that was learned and there are one or two, from noise alone; neither wants guidance."""
        return self._one_step if few_from_noise(self.diffusion.config, steps) else None

    @property
    def post_processor(self) -> MotionPostProcessor:
        """From raw features to motions, as this model is configured."""
        return MotionPostProcessor(self.network.generation.post_processing, self.card.fps)

    # Generating

    @idle_threads()
    def generate(
        self,
        prompts: Sequence[str],
        *,
        seconds: float | Sequence[float] = 4.0,
        tags: Sequence[str | None] | None = None,
        num_samples: int = 1,
        seed: int = 0,
        steps: int | None = None,
        sampler: str | None = None,
        guidance_scale: float | None = None,
        foot_lock: bool | None = None,
        constraints: Sequence[Constraint | None] | None = None,
        steady: Sequence[Sequence[int]] | None = None,
        progress: Progress | None = None,
    ) -> list[Motion]:
        """Motions for the prompts, prompt-major: all samples of the first one come first.

        Each motion depends on the seed, its prompt and its number among the samples of that
        prompt, not on what else is generated with it.

        Args:
            prompts: in any language the model was trained on.
            seconds: one length for all, or one a prompt.
            tags: action labels beside the prompts, None for none.
            num_samples: motions a prompt.
            seed: 0 or more.
            steps: sampling steps; what is None here and below is the model's own setting. Of one or
                two the first is the one that the model has learned from its many, if it has; and
                neither is guided, for guidance is part of what it learned.
            sampler: ddim, ddpm or dpm-solver++.
            guidance_scale: 1 = no guidance. Who gives another than 0 has every step made as in
                many.
            foot_lock: hold standing feet in place.
            constraints: what is given of each prompt's motions, as long as they are.
            steady: of each prompt's motions the columns of the root row that lose their mean,
                see `without_drift`; None = none.
            progress: called after each batch.

        Raises:
            UserError: the model is untrained, or an argument cannot be worked with.
        """
        features = self.sample_features(
            prompts,
            seconds=seconds,
            tags=tags,
            num_samples=num_samples,
            seed=seed,
            steps=steps,
            sampler=sampler,
            guidance_scale=guidance_scale,
            constraints=constraints,
            progress=progress,
        )
        for warning in self.scope_warnings(prompts, again=False):
            if warning is not None:
                log.warning("%s", warning)
        texts = [prompt for prompt in prompts for _ in range(num_samples)]
        given = [each for each in constraints or [None] * len(prompts) for _ in range(num_samples)]
        columns = [each for each in steady or [()] * len(prompts) for _ in range(num_samples)]
        features = [*map(without_drift, features, columns)]
        return [
            self.post_processor(sample, each and each.known, text=text, foot_lock=foot_lock)
            for sample, text, each in zip(features, texts, given, strict=True)
        ]

    @torch.inference_mode()
    def sample_features(
        self,
        prompts: Sequence[str],
        *,
        seconds: float | Sequence[float] = 4.0,
        tags: Sequence[str | None] | None = None,
        num_samples: int = 1,
        seed: int = 0,
        steps: int | None = None,
        sampler: str | None = None,
        guidance_scale: float | None = None,
        constraints: Sequence[Constraint | None] | None = None,
        progress: Progress | None = None,
    ) -> list[Tensor]:
        """Like `generate`, before post-processing: raw features [T, K, C] on the CPU."""
        if not self.card.trained:
            name = self.card.name or "this model"
            raise UserError(
                f"{name} is untrained and would only give noise; train it with"
                " `motion-tools train generation`, or use a model that `models` lists"
            )
        requests = make_requests(
            prompts,
            seconds=seconds,
            tags=tags,
            known_tags=self.card.tags,
            num_samples=num_samples,
            seed=seed,
            fps=self.card.fps,
        )
        longest = max(request.frames for request in requests)
        warning = self.length_warning(longest / self.card.fps)
        if warning and warning not in self._told:
            self._told.add(warning)
            log.warning("%s", warning)
        given = [each for each in constraints or [None] * len(prompts) for _ in range(num_samples)]
        _check_lengths(given, [request.frames for request in requests])
        row_of = {prompt: row for row, prompt in enumerate(dict.fromkeys(prompts))}
        text = self.encode_prompts(list(row_of))
        settings = self.network.generation
        sampler = sampler or settings.sampler
        scale = settings.guidance_scale if guidance_scale is None else guidance_scale
        first = self.learned_step(steps) if guidance_scale in (None, 0) else None
        if first is not None:
            scale = min(scale, 1.0)  # as without: where no text is heard it is 0
        draws_on_the_way = sampler == "ddpm" or self.diffusion.config.eta > 0
        led = any(each is not None and each.beats is not None for each in given)
        samples: dict[int, Tensor] = {}
        # Neither draws nor rhythm guidance leave padding out, and company must change nothing.
        size = ON_CPU if self.device.type == "cpu" else MAX_BATCH
        kinds = None
        if self.denoiser.one_adapter and text.opened is not None:
            opened = np.asarray(text.opened)
            own = np.where(opened.any(1), opened.argmax(1) + 1, 0)
            kinds = [int(own[row_of[request.prompt]]) for request in requests]
        for batch in batches(requests, size, equal_lengths=draws_on_the_way or led, kinds=kinds):
            chosen = [requests[index] for index in batch]
            rows = torch.tensor([row_of[request.prompt] for request in chosen], device=self.device)
            known = KnownBatch.of(
                [given[index] for index in batch],
                max(request.frames for request in chosen),
                self.mean,
                self.std,
                fps=self.card.fps,
            )
            z_scored = sample_batch(
                self.denoiser,
                self.diffusion,
                chosen,
                text[rows],
                guidance_scale=scale,
                sampler=sampler,
                steps=steps,
                known=known,
                first=first,
            )
            features = (z_scored * self.std + self.mean).cpu()
            for index, sample in zip(batch, features, strict=True):
                cropped, constraint = sample[: requests[index].frames], given[index]
                samples[index] = cropped if constraint is None else constraint.keep(cropped)
            if progress is not None:
                progress(len(samples), len(requests))
        return [samples[index] for index in range(len(requests))]

    # Prompts

    def encode_prompts(self, prompts: Sequence[str]) -> TextFeatures:
        """What the frozen text tower makes of the prompts; the last few lists are remembered.

        Raises:
            UserError: a prompt is empty.
        """
        key = tuple(prompts)
        if key not in self._encoded:
            with idle_threads(), torch.inference_mode():
                ids, mask = self.tokenizer(prompts, warn=True)
                features: TextFeatures = self.text(ids.to(self.device), mask.to(self.device))
            self._encoded = dict([*self._encoded.items(), (key, features)][-ENCODED:])
        return self._encoded[key]

    def scope_warnings(self, prompts: Sequence[str], *, again: bool = True) -> list[str | None]:
        """For each prompt that is far from anything trained, a line naming the nearest actions.

        Args:
            prompts: as for `generate`, which then does not log the same lines.
            again: also for prompts that were warned of before.
        """
        fresh = [prompt for prompt in dict.fromkeys(prompts) if again or prompt not in self._told]
        if self.scope is None or not fresh:
            return [None] * len(prompts)
        found = zip(fresh, self.read(fresh), strict=True)
        odd = ((prompt, read) for prompt, read in found if read and not read.known)
        warnings = {prompt: self.scope.warning(prompt, read) for prompt, read in odd}
        self._told.update(prompts)
        return [warnings.get(prompt) for prompt in prompts]

    def read(self, prompts: Sequence[str]) -> list[ScopeResult | None]:
        """What prompts ask for, as far as the model knows; None where it has not learned that."""
        if self.scope is None or not all(prompts):
            return [None] * len(prompts)
        if fresh := [prompt for prompt in dict.fromkeys(prompts) if prompt not in self._read]:
            rows = zip(fresh, self.encode_prompts(fresh).rows(), strict=True)
            self._read |= {prompt: self.scope.check(prompt, *row) for prompt, row in rows}
        return [*map(self._read.get, prompts)]

    def begins_standing(self, prompt: str) -> bool:
        """Whether what a prompt asks for is done from a standing body to a standing one."""
        [found] = self.read([prompt])
        return bool(found and self.scope and set(found.nearest[:1]) & set(self.scope.gestures))

    def style_of(self, prompt: str) -> np.ndarray | None:
        """The 8-d unit style that a sentence speaks of (ruling 11).

        None where its words are far from anything trained, or the model has no map of styles. A
        style is read off a sentence whose action the model may miss.
        """
        if self.style_map is None or self.scope is None or not self.scope.familiar(prompt):
            return None
        return self.style_map(self.encode_prompts([prompt]).pooled[0].cpu().numpy())

    def length_warning(self, seconds: float) -> str | None:
        """A line that says so if a motion is longer than any trained on; `generate` logs it."""
        longest = self.card.max_seconds
        if longest is None or round(seconds * self.card.fps) <= round(longest * self.card.fps):
            return None
        return (
            f"{seconds:.1f} s is longer than the {longest:.1f} s this model was trained on;"
            " the end may lose the prompt"
        )

    # Folders

    def save_pretrained(
        self, folder: str | Path, *, half: bool = False, int8: bool = False
    ) -> None:
        """Write weights, as float16 or int8 if asked, card, tokenizer, scope and map of styles;
        raises UserError when that fails."""
        folder = Path(folder)
        self.tokenizer.save_pretrained(folder / TOKENIZER_FOLDER)
        if self.scope is not None:
            self.scope.save_pretrained(folder)
        if self.style_map is not None:
            self.style_map.save_pretrained(folder)
        card = self.card.model_copy(
            update={
                "kind": KIND,
                "network": self.network,
                "text_encoder": self.text.encoder_config(),
            }
        )
        tensors = with_prefix("denoiser", self.denoiser.state_dict())
        tensors |= with_prefix("text", self.text.state_dict())
        tensors |= {"statistics.mean": self.mean, "statistics.std": self.std}
        self.card = write_checkpoint(folder, card, tensors, half=half, int8=int8)

    @classmethod
    def from_pretrained(
        cls, name_or_folder: str | Path, *, device: str | None = None, runtime: str = "torch"
    ) -> Self:
        """A generator by the name of a shipped model, or from a folder.

        Args:
            name_or_folder: as of `resolve_model`.
            device: auto, cuda, mps or cpu.
            runtime: torch; or onnx for a folder that holds an export, on the CPU.

        Raises:
            UserError: no such model, another kind, or damaged or unfitting weights.
        """
        folder = resolve_model(name_or_folder)
        card = read_card(folder)
        if card.kind != KIND:
            raise wrong_kind(folder, card.kind, KIND)
        load = _from_export if runtime == "onnx" else _from_weights
        denoiser, text, mean, std = load(folder, card)
        scope = OutOfDomainDetector.from_pretrained(folder)
        if scope is None:
            log.warning("%s has no scope.json: far-off prompts get no warning", folder)
        return cls(
            denoiser,
            text,
            PromptTokenizer.from_pretrained(folder / TOKENIZER_FOLDER),
            mean=mean,
            std=std,
            card=card,
            scope=scope,
            style_map=StyleMap.from_pretrained(folder),
            device="cpu" if runtime == "onnx" else device,
        )


PROJECTED = "output_proj.adapters."
Loaded = tuple[Any, Any, Tensor, Tensor]  # denoiser, text tower, mean and std [K, C]


def _from_weights(folder: Path, card: ModelCard) -> Loaded:
    """PyTorch's networks."""
    from ..clip.core import TextTower
    from .denoiser import MotionDenoiser

    tensors = read_tensors(folder, card)
    tower, projection = (tensors.get(f"{part}.text_proj.weight") for part in ("text", "denoiser"))
    if tower is not None and projection is not None:
        check_embed_dims(len(tower), projection.shape[1], f"the text tower in {folder}")
    denoiser = MotionDenoiser(card.network, len(card.tags))
    own = {f"denoiser.{k}": v for k, v in denoiser.state_dict().items() if k.startswith(PROJECTED)}
    if not own.keys() & tensors.keys():  # adapters of before had none
        tensors |= {name: torch.zeros_like(value) for name, value in own.items()}
    load_state(denoiser, tensors, "denoiser", folder)
    text = TextTower(card.network.clip, card.network.embed_dim, encoder_config=card.text_encoder)
    load_state(text, tensors, "text", folder)
    return denoiser, text.freeze(), tensors["statistics.mean"], tensors["statistics.std"]


def _from_export(folder: Path, card: ModelCard) -> Loaded:
    """The networks of `export-onnx`."""
    from ..onnx_card import TextOnnxCard, read_onnx_card
    from ..onnx_graphs import OnnxDenoiser, OnnxTextTower

    export = read_onnx_card(folder, TextOnnxCard, card)
    check_weights(folder, card.weights)
    threads = sampling_threads()
    return (
        OnnxDenoiser(folder, card.network, export, threads),
        OnnxTextTower(folder, card, threads),
        torch.tensor(export.mean),
        torch.tensor(export.std),
    )
