"""Generation training: the denoiser behind a frozen text tower (TEXT; rulings 13 to 15, 19, 21).

motion-tools train generation [key=value ...] [--resume]

Captions are encoded batch by batch, without gradients: with a small tower that is a few percent
of a step, it lets words be dropped, and it is the same after a resume.

Letters: B batch, T frames, R rows of a frame, L tokens, S diffusion steps.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

import numpy as np
import torch
from torch import Tensor, nn
from torch.func import functional_call
from torch.nn.functional import pad

from ..shared.config_schema import (
    PROVENANCES,
    ConstraintShares,
    NetworkConfig,
    TrainGenerationConfig,
)
from ..shared.data.captions.book import drop_words
from ..shared.data.text_motion import TextMotionBatch
from ..shared.device import autocast, choose_compute
from ..shared.errors import UsageError
from ..shared.model.clip.features import TextFeatures
from ..shared.model.clip.pretrained import load_text_tower, tower_hash
from ..shared.model.diffusion import GaussianDiffusion
from ..shared.model.generation.denoiser import TAG_WEIGHT, MotionDenoiser
from ..shared.model.generation.losses import GenerationLoss
from ..shared.model.generation.motion_generator import KIND, TextToMotion
from ..shared.motion.features import FORWARD, HEIGHT, LATERAL, LEFT_CONTACT, ROOT_ROW, YAW_RATE
from ..shared.motion.skeleton import JOINT_INDEX, LIMBS
from .launch import STAGES
from .task import Part, Task, generator, means, numpy_generator, to_device
from .text_stages import (
    fit_scope,
    fit_style_map,
    motion_rows,
    open_training_data,
    trained_card,
    training_clips,
    validation_set,
    with_labels,
    write_samples,
)

SAMPLE_SECONDS = 4.0
NOISE_LEVELS = ("low", "middle", "high")  # thirds of the diffusion steps, in validation
LONGEST_END = 45  # frames known at a start or an end
ROOT_WAYS = (0.7, 0.15, 0.15)  # shares of both, heading alone, path alone
MOST_FRAMES = 6  # frames known here and there
FRAMES, TOKENS = 30, 32  # a padded batch has a multiple of these


@dataclass(frozen=True)
class Conditions:
    """What the denoiser is told beside the text.

    Attributes:
        timesteps, tag: [B] long; mask [B,T] bool, real frames.
        drop: [B] bool, rows that see no text.
        known: [B,T,R,6] bool, entries that the network is told; none if it takes no constraints.
        provenance: [B] long, index in PROVENANCES, its length where it is not told.
    """

    timesteps: Tensor
    tag: Tensor
    mask: Tensor
    drop: Tensor
    known: Tensor
    provenance: Tensor


@dataclass(frozen=True)
class NoisedBatch(Conditions):
    """Everything random is drawn already, on the CPU, so that it is the same on every device:
    clean and noise [B,T,R,6], z-scored."""

    clean: Tensor
    noise: Tensor

    def padded(self) -> Self:
        """With frames that are none, up to a multiple of FRAMES."""
        lacking = -self.mask.shape[1] % FRAMES
        long = {name: getattr(self, name) for name in ("known", "clean", "noise")}
        return replace(
            self,
            mask=pad(self.mask, (0, lacking)),
            **{name: pad(value, (0, 0, 0, 0, 0, lacking)) for name, value in long.items()},
        )


@dataclass(frozen=True)
class DenoiserBatch(NoisedBatch):
    """With the captions: input_ids, attention_mask [B,L]."""

    input_ids: Tensor
    attention_mask: Tensor

    def padded(self) -> Self:
        """With tokens that are none, too, up to a multiple of TOKENS."""
        lacking = -self.input_ids.shape[1] % TOKENS
        words = (pad(each, (0, lacking)) for each in (self.input_ids, self.attention_mask))
        ids, mask = words
        return replace(super().padded(), input_ids=ids, attention_mask=mask)


class GuidedDenoiser(nn.Module):
    """The denoiser with condition dropout inside, so that DDP sees the learned null too."""

    def __init__(self, denoiser: MotionDenoiser) -> None:
        super().__init__()
        self.denoiser = denoiser

    def forward(self, noisy: Tensor, text: TextFeatures, told: Conditions) -> Tensor:
        """As MotionDenoiser.forward; rows where `drop` is True see the null text."""
        heard = self.denoiser.drop_text(self.denoiser.with_adapters(text), told.drop)
        return self.predicted(
            noisy,
            told.timesteps,
            heard,
            told.tag,
            told.mask,
            known=told.known if self.denoiser.known_proj is not None else None,
            provenance=told.provenance if self.denoiser.provenance_embed is not None else None,
        )

    def predicted(self, *heard: Any, **told: Any) -> Tensor:
        """As MotionDenoiser.forward, which it is."""
        output: Tensor = self.denoiser(*heard, **told)
        return output


class LearnedStep(GuidedDenoiser):
    """A denoiser that stays as it is, in the one step that it learns."""

    def predicted(self, *heard: Any, **told: Any) -> Tensor:
        """With the weights of that step."""
        step = self.denoiser.one_step
        assert step is not None, "the network has no one-step-rank"
        output: Tensor = functional_call(self.denoiser, step.weights(self.denoiser), heard, told)
        return output


def denoising_losses(
    module: nn.Module, text: TextFeatures, batch: NoisedBatch, loss: GenerationLoss
) -> dict[str, Tensor]:
    """The weighted losses of one noised batch.

    Sampling puts the known entries back, so what is judged is the motion with them in it.
    """
    noisy = loss.diffusion.q_sample(batch.clean, batch.timesteps, batch.noise)
    output = module(torch.where(batch.known, batch.clean, noisy), text, batch)
    target = loss.diffusion.target(batch.clean, batch.noise, batch.timesteps)
    output = torch.where(batch.known, target, output.float())
    losses: dict[str, Tensor] = loss(
        output, batch.clean, noisy, batch.noise, batch.timesteps, batch.mask
    )
    return losses


def spread_timesteps(num: int, steps: int, draws: torch.Generator) -> Tensor:
    """Uniform steps [num] that cover [0, steps) evenly: less variance than independent draws.

    Kingma et al. 2021 (Variational Diffusion Models), appendix I.1.
    """
    places = torch.randperm(num, generator=draws) + torch.rand(1, generator=draws)
    return (places / num * steps).long().clamp(max=steps - 1)


def noise_levels(index: int, num: int, steps: int) -> Iterator[tuple[str, torch.Generator, Tensor]]:
    """Of validation batch `index`: a name, a generator and timesteps [num] for each noise level."""
    thirds = len(NOISE_LEVELS)
    for third, level in enumerate(NOISE_LEVELS):
        draws = generator("validation", index, third)
        spread = spread_timesteps(num, max(1, steps // thirds), draws)
        yield level, draws, (spread + third * steps // thirds).clamp(max=steps - 1)


# ---------------------------------------------------------------- known entries


def draw_known(
    mask: Tensor, rows: int, shares: ConstraintShares | None, rng: np.random.Generator | None
) -> Tensor:
    """Random masks [B, T, R, 6] bool for clips with real frames `mask` [B, T] bool.

    One network learns every use of a constraint at once: a pinned path, feet that land when they
    are to, windows that follow each other, gaps between two clips, joints done again. Without
    shares or a generator nothing is known.
    """
    known = torch.zeros(*mask.shape, rows, 6, dtype=torch.bool)
    if shares is None or rng is None:
        return known
    for row, length in zip(known, mask.sum(1).tolist(), strict=True):
        if rng.random() >= shares.free:
            _draw_clip(row[:length], shares, rng)
    return known


def _draw_clip(known: Tensor, shares: ConstraintShares, rng: np.random.Generator) -> None:
    """Fill the mask [T, R, 6] of one clip."""
    frames = len(known)
    if rng.random() < shares.joints:
        _draw_joints(known, rng)
        return
    if known.shape[1] > ROOT_ROW and rng.random() < shares.root:
        _draw_root(known, rng)
    if known.shape[1] > ROOT_ROW and rng.random() < shares.contacts:
        known[_most(frames, rng), ROOT_ROW, LEFT_CONTACT:] = True
    longest = max(1, min(LONGEST_END, frames // 2))
    if rng.random() < shares.start:
        known[: rng.integers(1, longest + 1)] = True
    if rng.random() < shares.end:
        known[frames - rng.integers(1, longest + 1) :] = True
    if rng.random() < shares.frames:
        known[torch.as_tensor(rng.choice(frames, size=rng.integers(1, MOST_FRAMES + 1)))] = True


def _draw_joints(known: Tensor, rng: np.random.Generator) -> None:
    """All but some limbs, or the whole body, during a span."""
    span = _span(len(known), rng)
    again = [name for name in LIMBS if rng.random() < 0.4]
    known[:] = True
    if not again:
        known[span] = False
    for limb in again:
        known[span, [JOINT_INDEX[joint] for joint in LIMBS[limb]]] = False
        if limb.endswith("leg"):
            known[span, ROOT_ROW:, LEFT_CONTACT:] = False


def _draw_root(known: Tensor, rng: np.random.Generator) -> None:
    """The path and the heading, or one of them; at times the height and the pelvis' tilt."""
    span = _most(len(known), rng)
    ways = ([FORWARD, LATERAL, YAW_RATE], [YAW_RATE], [FORWARD, LATERAL])
    channels = list(ways[rng.choice(len(ways), p=ROOT_WAYS)])
    channels += [HEIGHT] if rng.random() < 0.6 else []
    for channel in channels:
        known[span, ROOT_ROW, channel] = True
    if rng.random() < 0.25:
        known[span, 0] = True  # the pelvis' tilt


def _most(frames: int, rng: np.random.Generator) -> slice:
    """Nearly always the whole clip."""
    return slice(None) if rng.random() < 0.85 else _span(frames, rng)


def _span(frames: int, rng: np.random.Generator) -> slice:
    start, stop = sorted(rng.integers(0, frames + 1, size=2).tolist())
    return slice(start, max(stop, start + 1))


# ---------------------------------------------------------------- the task


class GenerationTask(Task):
    """What the trainer needs to know (src/train/task.py)."""

    can_be_captured = True

    def __init__(self, config: TrainGenerationConfig, network: NetworkConfig) -> None:
        plain = network.generation.model_copy(update={"one_step_rank": 0})  # distilled, not trained
        network = network.model_copy(update={"generation": plain})
        self.config, self.network = config, network
        source = config.clip or config.init or "runs/clip"
        self.tower, self.tokenizer = load_text_tower(source, network.embed_dim)
        self.data = open_training_data(config, network, stream=config.stream)
        only = with_labels(self.data) if self.tower.config.text_places else None
        self.train = training_clips(config, self.data, only)
        self.held_back = validation_set(config, self.data)
        self.mean = motion_rows(self.data.mean, network)
        self.std = motion_rows(self.data.std, network)
        self.num_tags = len(self.data.tags)
        self.shares = config.constraints if network.generation.constraints else None
        self.data_mean, self.data_std = self.mean, self.std
        self.diffusion = GaussianDiffusion(network.generation.diffusion())
        denoiser = MotionDenoiser(network, self.num_tags)
        if config.init:
            self._start_from(config.init, denoiser)
        self.module: nn.Module = GuidedDenoiser(denoiser)
        self.loss = GenerationLoss(config.losses, self.diffusion, self.mean, self.std)
        self.compute = choose_compute(config.device, config.precision)
        self.frozen = (self.tower, self.loss)
        self.identity = {
            "network": network.model_dump(mode="json", by_alias=True),
            "data-hash": self.data.manifest_hash,
            "tower-hash": tower_hash(self.tower),
        }

    def _start_from(self, source: str, denoiser: MotionDenoiser) -> None:
        """Take over a trained denoiser and its z-scores; tags that both know keep their vector."""
        trained = TextToMotion.from_pretrained(source, device="cpu")
        before, after = trained.network.generation, self.network.generation
        loses = before.constraints > after.constraints or before.provenance > after.provenance
        if loses or _trained_shape(trained.network) != _trained_shape(self.network):
            raise UsageError(
                f"init {source} is another network than profile {self.config.profile}; "
                "train with the profile and the network overrides that it was trained with"
            )
        if tower_hash(trained.text) != tower_hash(self.tower) and not self.config.other_tower:
            raise UsageError(
                f"init {source} was trained behind another text tower than that of clip"
                f" {self.config.clip}: its prompts would mean other motions; leave clip out to keep"
                " its own, or give other-tower=true and the steps to get used to the new one"
            )
        state = trained.denoiser.plain_state()  # a learned step is that of what it was
        tags = denoiser.tag_embed.embedding.weight.detach().clone()  # [num_tags + 1, D]
        places = {name: index for index, name in enumerate((*trained.card.tags, None))}
        for index, name in enumerate((*self.data.tags, None)):
            if name in places:
                tags[index] = state[TAG_WEIGHT][places[name]]
        # Constraints and provenance can be learned by a network that had none, starting at zero.
        fresh = {name: torch.zeros_like(value) for name, value in denoiser.state_dict().items()}
        denoiser.load_state_dict({**fresh, **state, TAG_WEIGHT: tags})
        self.mean, self.std = trained.mean, trained.std

    # ------------------------------------------------------------ batches

    def batch(self, part: Part) -> DenoiserBatch:
        """Clips with captions, noise, steps and what is dropped."""
        config, size = self.config, self.config.batch_size
        clips = self.train.batch(part.step, size, rank=part.index, count=part.count)
        rng = numpy_generator("words", config.seed, part.step, part.index)
        captions = [drop_words(text, config.word_dropout, rng) for text in clips.captions]
        draws = generator("noise", config.seed, part.step, part.index)
        timesteps = spread_timesteps(size, self.diffusion.config.timesteps, draws)
        drop = torch.rand(size, generator=draws) < config.condition_dropout
        # rows without text have no tag either: the null of guidance knows neither
        untagged = drop | (torch.rand(size, generator=draws) < config.tag_dropout)
        tag = clips.tag.masked_fill(untagged, self.num_tags)
        unknown = torch.rand(size, generator=draws) < config.provenance_dropout
        provenance = clips.provenance.masked_fill(unknown, len(PROVENANCES))
        masks = numpy_generator("known", config.seed, part.step, part.index)
        return self._noised(clips, captions, timesteps, tag, drop, provenance, draws, masks)

    def _noised(
        self,
        clips: TextMotionBatch,
        captions: list[str],
        timesteps: Tensor,
        tag: Tensor,
        drop: Tensor,
        provenance: Tensor,
        draws: torch.Generator,
        rng: np.random.Generator | None = None,
    ) -> DenoiserBatch:
        clean = motion_rows(clips.motion, self.network)  # z-scored by the data's own statistics
        if self.config.init:
            clean = (clean * self.data_std + self.data_mean - self.mean) / self.std
        noise = torch.randn(clean.shape, generator=draws)
        known = draw_known(clips.mask, clean.shape[2], self.shares, rng)
        words = self.tokenizer(captions)
        return DenoiserBatch(
            timesteps, tag, clips.mask, drop, known, provenance, clean, noise, *words
        )

    # ------------------------------------------------------------ learning

    def training_step(self, module: nn.Module, batch: DenoiserBatch) -> dict[str, Tensor]:
        """The weighted losses of one noised batch."""
        with torch.no_grad(), autocast(self.compute):
            text = self.tower(batch.input_ids, batch.attention_mask)
        return denoising_losses(module, text, batch, self.loss)

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Losses on held-back clips at fixed steps and noise, overall and by noise level."""
        if self.held_back is None:
            return {}
        steps, found = self.diffusion.config.timesteps, []
        batches = self.held_back.fixed_batches(
            self.config.batch_size, self.config.validation_batches
        )
        for index, clips in enumerate(batches):
            for level, draws, timesteps in noise_levels(index, len(clips), steps):
                losses = self._losses(module, clips, timesteps, draws)
                found.append({**losses, f"loss-{level}": losses["loss"]})
            if self.shares is not None:
                draws = generator("validation", index, len(NOISE_LEVELS))
                timesteps = spread_timesteps(len(clips), steps, draws)
                masks = numpy_generator("validation", index)
                losses = self._losses(module, clips, timesteps, draws, masks)
                found.append({"loss-constrained": losses["loss"]})
        return means(found)

    def _losses(
        self,
        module: nn.Module,
        clips: TextMotionBatch,
        timesteps: Tensor,
        draws: torch.Generator,
        rng: np.random.Generator | None = None,
    ) -> dict[str, Tensor]:
        """Of clips with their captions and without a tag."""
        device, told = next(module.parameters()).device, clips.provenance
        none = torch.full_like(clips.tag, self.num_tags)
        drop = torch.zeros(len(clips), dtype=torch.bool)
        batch = self._noised(clips, clips.captions, timesteps, none, drop, told, draws, rng)
        return self.training_step(module, to_device(batch, device))

    # ------------------------------------------------------------ results

    def _generator(self, module: nn.Module) -> TextToMotion:
        assert isinstance(module, GuidedDenoiser)
        card = trained_card(
            KIND,
            self.config,
            self.network,
            self.data,
            max_seconds=self.config.max_frames / 30.0,
            training={"steps": self.config.steps, "validation": self.figures},
        )
        return TextToMotion(
            module.denoiser,
            self.tower,
            self.tokenizer,
            mean=self.mean,
            std=self.std,
            card=card,
            device=next(module.parameters()).device.type,
        )

    def export_samples(self, module: nn.Module, folder: Path) -> None:
        """The validation prompts as BVH, and side by side as HTML."""
        seconds = min(SAMPLE_SECONDS, self.config.max_frames / 30.0)
        prompts = self.config.validation_prompts
        motions = self._generator(module).generate(prompts, seconds=seconds)
        write_samples(motions, (f"{number + 1:02d}" for number in range(len(motions))), folder)

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """A folder that `TextToMotion.from_pretrained` and `generate --model` read."""
        generator = self._generator(module)
        known = (self.data, self.config.languages, self.tower, self.tokenizer)
        generator.scope, generator.style_map = fit_scope(*known), fit_style_map(*known)
        generator.save_pretrained(folder)


def _trained_shape(network: NetworkConfig) -> dict[str, Any]:
    """What weights are bound to: the network without its towers and how it is sampled."""
    free = {"sampler", "sampling_steps", "timestep_spacing", "guidance_scale", "post_processing",
            "one_step_rank"}  # fmt: skip
    learned_later = {"constraints", "provenance"}
    return network.model_dump(exclude={"clip": True, "generation": free | learned_later})


if __name__ == "__main__":
    STAGES["generation"].app()()
