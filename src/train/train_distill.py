"""A text model of few steps, from one of many: guidance folded in, constraints heard.

motion-tools train distill init=starter [key=value ...]

First the teacher samples, as `generate` has it sample, with guidance, and with known entries as in
its own training (`draw_known`). What it starts from and passes through, and where it ends, is kept
in the output folder. Then the student, which begins with the teacher's weights, learns to go from
each of the states that it will visit to the next one in one step, where the teacher took several,
and without the pass of no text: progressive distillation (Salimans and Ho 2022, section 3) with
guidance folded in (Meng et al. 2023), on the teacher's own path from noise.

With `rank` no other network comes of it: the teacher keeps its weights and learns, beside them,
what it becomes for one step (`OneStep` in denoiser.py), which goes from noise to where the
teacher's own sampler ends. The result samples as before, and `--steps 1` takes that step.

Letters: B batch, T frames, R rows of a frame, D shared dimensions, N student steps.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import torch
from safetensors import safe_open
from safetensors.torch import save_file
from torch import Tensor, nn

from ..shared.config_schema import (
    PROVENANCES,
    NetworkConfig,
    TrainDistillConfig,
)
from ..shared.data.text_motion import TextMotionBatch
from ..shared.device import autocast, choose_compute
from ..shared.errors import UsageError
from ..shared.io.files import atomic_write
from ..shared.model.clip.pretrained import encode_captions, tower_hash
from ..shared.model.diffusion import GaussianDiffusion, guided, make_sampler
from ..shared.model.generation.denoiser import MotionDenoiser
from ..shared.model.generation.losses import GenerationLoss
from ..shared.model.generation.motion_generator import TextToMotion, as_captured
from ..shared.model.noise import sampling_timesteps
from .launch import STAGES
from .run_log import announce
from .task import Part, Task, generator, means, mix_seed, numpy_generator, to_device
from .text_stages import (
    as_features,
    network_of_model,
    open_training_data,
    training_set,
    validation_set,
    z_scored_for,
)
from .train_generation import Conditions, GuidedDenoiser, LearnedStep, draw_known

SPACING = "trailing"  # of both: every step of the student is so many of the teacher's
PAIRS_FOLDER = "pairs"  # in the output folder: a resumed run reads it
TOLD_EVERY = 20  # files of pairs


@dataclass(frozen=True)
class Pairs:
    """B motions that the teacher sampled.

    Attributes:
        aims: [B,N,T,R,6], the x_0 that takes a step of the student from each state to the next,
            known entries in it; z-scored; the last is the end.
        mask: [B,T] bool; known: [B,T,R,6] bool, entries that it was told.
        place: [B,D] of the text; tag [B] long; drop [B] bool, rows that heard no text.
        states: [B,N,T,R,6] that it was in at the student's steps; noise first.
    """

    aims: Tensor
    mask: Tensor
    known: Tensor
    place: Tensor
    tag: Tensor
    drop: Tensor
    states: Tensor


@dataclass(frozen=True)
class DistillBatch(Conditions):
    """One of the states of each, seen [B,T,R,6], and what it aims at; known entries in both."""

    seen: Tensor
    aim: Tensor
    place: Tensor


class DistillTask(Task):
    """What the trainer needs to know (task.py)."""

    def __init__(self, config: TrainDistillConfig, network: NetworkConfig) -> None:
        self.config = config
        self.compute = choose_compute(config.device, config.precision)
        self.teacher = TextToMotion.from_pretrained(config.init, device=self.compute.device)
        own: dict[str, Any] = {"one_step_rank": config.rank or 0}
        if config.rank is not None:  # beside the teacher, which samples as it did
            before = self.teacher.network.generation
            own |= {"sampler": before.sampler, "timestep_spacing": before.timestep_spacing}
            _check_teacher(config.init, self.teacher)
        generation = network.generation.model_copy(update=own)
        self.network = network = network.model_copy(update={"generation": generation})
        self.diffusion = GaussianDiffusion(network.generation.diffusion()).to(self.teacher.device)
        self.steps = self._student_timesteps()
        self.data = open_training_data(config, network)
        self.train = training_set(config, self.data)
        self.held_back = validation_set(config, self.data)
        self.folder = Path(config.output) / PAIRS_FOLDER
        self.identity = {
            "teacher": self.teacher.card.content_hash,
            "data-hash": self.data.manifest_hash,
            "tower-hash": tower_hash(self.teacher.text),
        }
        self._make_pairs()
        self.num_held_back = len(list(self.folder.glob("held-*.safetensors")))
        kind = GuidedDenoiser if config.rank is None else LearnedStep
        self.module: nn.Module = kind(self._beginning())
        self.loss = GenerationLoss(
            config.losses, self.diffusion, self.teacher.mean, self.teacher.std
        )
        self.frozen = (self.loss,)

    def _beginning(self) -> MotionDenoiser:
        """A copy of the teacher's denoiser, or of a student's that was taught before; of one that
        learned a step its step alone."""
        before, rank = self.teacher, self.config.rank
        if self.config.student is not None:
            before = TextToMotion.from_pretrained(self.config.student, device="cpu")
            if tower_hash(before.text) != tower_hash(self.teacher.text):
                raise UsageError(
                    f"student {self.config.student} is not of init {self.config.init}: it has"
                    " another text tower; name its own teacher"
                )
            if rank not in (None, before.network.generation.one_step_rank):
                raise UsageError(
                    f"student {self.config.student} has no step of rank {rank}; leave it out, or"
                    f" give rank={before.network.generation.one_step_rank or None}"
                )
        student = MotionDenoiser(self.network, len(self.teacher.card.tags))
        state = before.denoiser.plain_state()
        if rank is not None:
            step = before.denoiser.state_dict().keys() - state.keys()
            same = before.network.generation.one_step_rank == rank
            own = {k: before.denoiser.state_dict()[k] for k in step} if same else {}
            state = student.state_dict() | self.teacher.denoiser.plain_state() | own
        student.load_state_dict(state)
        if rank is not None:
            for name, weight in student.named_parameters():
                weight.requires_grad_(name.startswith("one_step."))
        return student

    def _student_timesteps(self) -> tuple[int, ...]:
        """Steps of the process that the student visits, the noisiest first."""
        config, process = self.config, self.diffusion.config
        if config.rank is not None:
            return sampling_timesteps(process.timesteps, 1, SPACING)
        of_teacher, own = (
            sampling_timesteps(process.timesteps, number, SPACING)
            for number in (config.teacher_steps, config.student_steps)
        )
        if missing := set(own) - set(of_teacher):
            raise UsageError(
                f"teacher-steps {config.teacher_steps} leave out step {min(missing)}, which the"
                f" student visits; choose a multiple of student-steps {config.student_steps}"
            )
        return own

    # ------------------------------------------------------------ what the teacher does

    def _make_pairs(self) -> None:
        """Write the files of pairs that are not there yet."""
        config, size = self.config, self.config.batch_size
        kept = {"seed", "teacher_steps", "student_steps", "batch_size", "condition_dropout",
                "tag_dropout", "constraints", "min_frames", "max_frames", "balance",
                "captured_share", "languages"}  # fmt: skip
        made_of = {
            "kept": f"aims, {SPACING}",
            **self.identity,
            **config.model_dump(mode="json", include=kept),
        }
        if config.rank is not None:  # the teacher's own steps
            made_of = {k: v for k, v in made_of.items() if not k.endswith("_steps")}
            made_of["kept"] = "ends of its own steps"
        made = {"made-of": f"{mix_seed(str(sorted(made_of.items()))):x}"}
        for number in range(config.pair_batches):
            file = self._file("train", number)
            if not _is_made(file, made):
                clips = self.train.batch(number + 1, size)
                _write(file, self._sampled(clips, "pairs", config.seed, number), made)
                if number % TOLD_EVERY == 0:
                    announce(f"the teacher samples: {number} of {config.pair_batches} batches")
        if self.held_back is not None:
            batches = self.held_back.fixed_batches(size, config.validation_batches)
            for number, clips in enumerate(batches):
                file = self._file("held", number)
                if not _is_made(file, made):
                    _write(file, self._sampled(clips, "held", number), made)

    def _file(self, split: str, number: int) -> Path:
        return self.folder / f"{split}-{number:05d}.safetensors"

    @torch.no_grad()
    def _sampled(self, clips: TextMotionBatch, *seed: int | str) -> Pairs:
        """What the teacher makes of these captions and what it is told of these clips."""
        config, teacher = self.config, self.teacher
        draws, size = generator("noise", *seed), len(clips)
        clean = z_scored_for(teacher, clips.motion, self.data)
        noise = torch.randn(clean.shape, generator=draws)
        drop = torch.rand(size, generator=draws) < config.condition_dropout
        untagged = drop | (torch.rand(size, generator=draws) < config.tag_dropout)
        tags = teacher.card.tags
        index = [tags.index(r.tag) if r.tag in tags else len(tags) for r in clips.records]
        tag = torch.tensor(index).masked_fill(untagged, len(tags))
        shares = config.constraints if self.network.generation.constraints else None
        known = draw_known(clips.mask, clean.shape[2], shares, numpy_generator("known", *seed))
        free = ~known.flatten(1).any(1)
        mask = clips.mask | free[:, None]  # no clip limits the length of what is told nothing
        place = encode_captions(teacher.text, teacher.tokenizer, clips.captions)
        device = teacher.device
        clean, noise, mask, known, place, tag, drop = (
            each.to(device) for each in (clean, noise, mask, known, place, tag, drop)
        )
        denoiser = teacher.denoiser
        text = denoiser.with_adapters(as_features(place))
        nothing = denoiser.drop_text(text, torch.ones_like(drop))
        shared = {
            "mask": mask,
            "known": known if denoiser.shows_known else None,
            "provenance": as_captured(denoiser, tag),
        }
        own = {"text": denoiser.drop_text(text, drop), "tag": tag, **shared}
        none = {"text": nothing, "tag": torch.full_like(tag, len(tags)), **shared}
        scale = self.teacher.network.generation.guidance_scale
        model_fn = self.diffusion.held(
            guided(denoiser, own, none, scale), known, clean, noise, shown=known
        )
        path: list[Tensor] = []

        def watched(x_t: Tensor, t: Tensor) -> Tensor:
            if int(t[0]) in self.steps:
                path.append(x_t)
            return model_fn(x_t, t).float()

        own_sampler = ("ddim", config.teacher_steps) if config.rank is None else ()
        sampler = make_sampler(self.diffusion, *own_sampler)
        with autocast(self.compute):
            path.append(sampler.run(watched, noise))
        aims, states = (
            torch.stack([torch.where(known, clean, each) for each in found], dim=1)
            for found in (self._aims(path), path[:-1])
        )
        return Pairs(aims, mask, known, place, tag, drop, states)

    def _aims(self, path: list[Tensor]) -> list[Tensor]:
        """The x_0 [B,T,R,6] of N DDIM steps along N + 1 states (Salimans and Ho 2022, eq. 8)."""
        bars = [self.diffusion.alpha_bar(t) for t in (*self.steps, -1)]
        found = []
        for (x_t, bar), (following, next_bar) in pairwise(zip(path, bars, strict=True)):
            kept = math.sqrt((1 - next_bar) / (1 - bar))  # of the noise
            gained = math.sqrt(next_bar) - kept * math.sqrt(bar)
            found.append((following - kept * x_t) / gained)
        return found

    # ------------------------------------------------------------ batches

    def batch(self, part: Part) -> DistillBatch:
        """A file of pairs, one state of each; every file once before any twice. Or new ones."""
        config = self.config
        number = (part.step - 1) * part.count + part.index
        if config.pair_batches:
            turn, place = divmod(number, config.pair_batches)
            order = numpy_generator("order", config.seed, turn).permutation(config.pair_batches)
            pairs = _read(self._file("train", int(order[place])))
        else:
            clips = self.train.batch(number + 1, config.batch_size)
            pairs = self._sampled(clips, "pairs", config.seed, number)
        draws = generator("states", config.seed, part.step, part.index)
        size = len(pairs.place)
        later = torch.randint(1, max(2, len(self.steps)), (size,), generator=draws)
        first = torch.rand(size, generator=draws) < config.first_share
        return self._at(pairs, later.masked_fill(first | (len(self.steps) == 1), 0))

    def _at(self, pairs: Pairs, chosen: Tensor) -> DistillBatch:
        """The states with these numbers [B]."""
        return DistillBatch(
            timesteps=torch.tensor(self.steps)[chosen],
            tag=pairs.tag,
            mask=pairs.mask,
            drop=pairs.drop,
            known=pairs.known,
            provenance=torch.full_like(pairs.tag, PROVENANCES.index("captured")),
            seen=pairs.states[torch.arange(len(chosen)), chosen],
            aim=pairs.aims[torch.arange(len(chosen)), chosen],
            place=pairs.place,
        )

    # ------------------------------------------------------------ learning

    def training_step(self, module: nn.Module, batch: DistillBatch) -> dict[str, Tensor]:
        """The weighted losses of one batch."""
        output = module(batch.seen, as_features(batch.place), batch).float()
        made = torch.where(batch.known, batch.aim, output)  # sampling puts the known entries back
        rest = batch.seen, batch.seen, batch.timesteps, batch.mask  # noise says nothing of x_0
        losses: dict[str, Tensor] = self.loss(made, batch.aim, *rest)
        return losses

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Losses on held-back clips, one a step of the student."""
        device = next(module.parameters()).device
        found = []
        for number in range(self.num_held_back):
            pairs = _read(self._file("held", number))
            for place, step in enumerate(self.steps):
                batch = self._at(pairs, torch.full((len(pairs.place),), place))
                loss = self.training_step(module, to_device(batch, device))["loss"]
                found.append({f"loss-{step}": loss})
        return means(found)

    # ------------------------------------------------------------ results

    def _student(self, module: nn.Module) -> TextToMotion:
        assert isinstance(module, GuidedDenoiser)
        before, config = self.teacher, self.config
        generation = self.network.generation
        if config.rank is None:
            own = {"guidance_scale": 1.0, "sampling_steps": config.student_steps}
            generation = generation.model_copy(update=own)
        learned = {
            "from": before.card.name,
            "steps": config.steps,
            "rank": config.rank,
            "teacher-steps": config.teacher_steps
            if config.rank is None
            else before.network.generation.sampling_steps,
            "guidance": before.network.generation.guidance_scale,
            "validation": self.figures,
        }
        network = self.network.model_copy(update={"generation": generation})
        update = {
            "name": Path(config.output).name,
            "network": network,
            "training": {**before.card.training, "distilled": learned},
        }
        student = MotionDenoiser(network, len(before.card.tags))
        student.load_state_dict(module.denoiser.state_dict())
        card = before.card.model_copy(update=update)
        device = next(module.parameters()).device.type
        return before.with_denoiser(student, card=card, device=device)

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """A folder that `generate --model` reads."""
        self._student(module).save_pretrained(folder)


def _check_teacher(init: str, teacher: TextToMotion) -> None:
    """Raises UsageError where a model cannot learn one step beside its weights."""
    settings, process = teacher.network.generation, teacher.diffusion.config
    times = sampling_timesteps(process.timesteps, process.sampling_steps, process.timestep_spacing)
    for wrong, why, remedy in (
        (settings.sampler == "ddpm", "draws noise on the way", "give it sampler: ddim"),
        (
            times[0] < process.timesteps - 1,
            "does not begin at noise",
            f"give it timestep-spacing: {SPACING}",
        ),
        (len(times) <= 2, "takes as few steps itself", "name its own teacher"),
    ):
        if wrong:
            raise UsageError(
                f"rank is of a step to where init {init} ends, which {why}; {remedy}, or leave"
                " rank out"
            )


def _is_made(file: Path, made_of: dict[str, str]) -> bool:
    if not file.is_file():
        return False
    with safe_open(file, "pt") as stored:
        return bool(stored.metadata() == made_of)


def _write(file: Path, pairs: Pairs, made_of: dict[str, str]) -> None:
    tensors = {key: value.cpu().contiguous() for key, value in vars(pairs).items()}
    half = {key: tensors[key].half() for key in ("states", "aims")}
    with atomic_write(file) as temporary:
        save_file({**tensors, **half}, temporary, metadata=made_of)


def _read(file: Path) -> Pairs:
    with safe_open(file, "pt") as stored:
        tensors = {key: stored.get_tensor(key) for key in stored.keys()}  # noqa: SIM118
    return Pairs(**{k: v.float() if v.dtype == torch.float16 else v for k, v in tensors.items()})


def network_of(init: str, overrides: Sequence[str] = ()) -> NetworkConfig:
    """The network of a model that can be distilled.

    Raises:
        UserError: no such model, or of another kind.
        UsageError: it hears the tokens of a text, or does not predict clean motion.
    """
    network = network_of_model(init, overrides)
    if (kind := network.generation.prediction_type) != "sample":
        raise UsageError(
            f"init {init} predicts {kind}, of which a single step from noise makes no motion; name"
            " a model with prediction-type: sample"
        )
    if network.generation.text_conditioning != "pooled":
        raise UsageError(
            f"init {init} hears the tokens of a text, and pairs hold one vector a text; name a"
            " model with text-conditioning: pooled"
        )
    steps = {"sampler": "ddim", "timestep_spacing": SPACING}
    generation = network.generation.model_copy(update=steps)
    return network.model_copy(update={"generation": generation})


if __name__ == "__main__":
    STAGES["distill"].app()()
