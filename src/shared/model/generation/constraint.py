"""What one motion is asked to be: its request, what of it is known, and the moments of its beats.

A network with `generation.constraints` sees the known entries clean, beside a mask of them (Cohan
et al. 2024, CondMDI: observed entries overwrite the noisy ones and the mask is an input). Any other
network gets them noised to each step (Lugmayr et al. 2022, RePaint, without its resampling). Beats
are no input: knowing them hardly helps to denoise (docs/experiments.md); they guide the sampling:
each predicted clean motion is moved down the gradient of

    E = mean over t of w(t) log(v(t) + v0),    w(t) = cos 2 pi phi(t),

v the mean speed of the joints in the world, phi counting beats: slow on a beat, fast halfway
(guidance by a loss on the predicted x0: Chung et al. 2023, DPS; Bansal et al. 2023, universal
guidance; here without going back through the network). The gradient is smoothed over time, so that
a limb is led and not jerked; the steps that follow make the result a motion again.

Letters: B batch, T frames, K rows (bones, root track), C channels, M beats.
"""

import math
import zlib
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from ...config_loader import did_you_mean
from ...errors import UsageError, UserError
from ...motion.features import mirror_features, world_joints
from ...motion.rotations import gaussian_smooth
from ...tensors import Tensor, torch
from ..noise import NoiseStream

STEP = 0.02  # root mean square of one move, in standard deviations of the data
MOVES = 3  # a prediction
SMOOTHING = 2.5  # frames, standard deviation of the kernel over the gradient
SLOW = 0.05  # m/s, v0: below it speed hardly counts, a standing body is not shaken
BEYOND = 1.5  # beats; further than this from the first and the last one there is no beat to meet


@dataclass(frozen=True, eq=False)
class RhythmGuidance:
    """Leads a batch of z-scored motions to their beats.

    Attributes:
        weight: w [B, T - 1], 0 where there is no beat to meet.
        mean, std: [K, C] of the z-scores.
        fps: frames per second.
    """

    weight: Tensor
    mean: Tensor
    std: Tensor
    fps: float

    @classmethod
    def of(
        cls, beats: Sequence[Tensor | None], frames: int, mean: Tensor, std: Tensor, *, fps: float
    ) -> Self | None:
        """For beats in seconds [M], one row a motion; None where no row tells a tempo."""
        if frames < 2 or all(row is None or len(row) < 2 for row in beats):
            return None
        weight = torch.stack([beat_weight(row, frames, fps) for row in beats])
        return cls(weight.to(mean.device), mean, std, fps)

    def __call__(self, x_0: Tensor, *, free: Tensor) -> Tensor:
        """Motions [B, T, K, C] moved where `free` [B, T, K, C] bool."""
        for _ in range(MOVES):
            with torch.inference_mode(False), torch.enable_grad():
                leaf = x_0.clone().requires_grad_()  # inference tensors have no gradient
                joints = world_joints(leaf * self.std.clone() + self.mean.clone(), self.fps)
                speed = (joints[:, 1:] - joints[:, :-1]).norm(dim=-1).mean(-1) * self.fps  # B T-1
                energy = (self.weight.clone() * torch.log(speed + SLOW)).mean(-1).sum()
                (gradient,) = torch.autograd.grad(energy, leaf)
            gradient = gaussian_smooth(gradient.detach(), SMOOTHING) * free
            size = gradient.square().mean((1, 2, 3), keepdim=True).sqrt()
            x_0 = x_0 - STEP * gradient / size.clip(min=1e-12)
        return x_0


def beat_weight(beats: Tensor | None, frames: int, fps: float) -> Tensor:
    """cos 2 pi phi between neighbouring frames [T - 1]; 1 on beats [M] in seconds, 0 far away."""
    if beats is None or len(beats) < 2:
        return torch.zeros(frames - 1)
    times = np.sort(beats.cpu().numpy().astype(np.float64))
    before, after = times[1] - times[0], times[-1] - times[-2]
    known = np.concatenate((times[:1] - 2 * before, times, times[-1:] + 2 * after))
    count = np.concatenate(([-2.0], np.arange(len(times)), [len(times) + 1.0]))
    phase = np.interp((np.arange(frames - 1) + 0.5) / fps, known, count)
    near = (phase > -BEYOND) & (phase < len(times) - 1 + BEYOND)
    return torch.from_numpy(np.where(near, np.cos(2 * np.pi * phase), 0.0)).float()


# ---------------------------------------------------------------- what is known


@dataclass(frozen=True, eq=False)
class Constraint:
    """What is given of one motion.

    Attributes:
        values: raw features [T, K, C], not z-scored; used where `known`.
        known: [T, K, C] bool.
        beats: seconds [M] from the first frame at which the body is to have a beat, a minimum of
            its joints' mean speed; None = it keeps its own time.
        shown: [T, K, C] bool, which of the known entries the network is shown clean, if it is one
            that can be; it gets the others noised, as any network does. A network that sees
            most of a body makes the rest fit it, whatever the text says. None = all of them.
    """

    values: Tensor
    known: Tensor
    beats: Tensor | None = None
    shown: Tensor | None = None

    @classmethod
    def free(cls, frames: int, rows: int = 23, channels: int = 6) -> Self:
        """Nothing is given."""
        shape = (frames, rows, channels)
        return cls(torch.zeros(shape), torch.zeros(shape, dtype=torch.bool))

    def __len__(self) -> int:
        return len(self.values)

    def window(self, start: int, stop: int, *, fps: float = 30.0) -> "Constraint":
        """Frames [start, stop); the beats count from its first frame."""
        beats = None if self.beats is None else self.beats - start / fps
        shown = None if self.shown is None else self.shown[start:stop]
        return Constraint(self.values[start:stop], self.known[start:stop], beats, shown)

    def mirrored(self) -> "Constraint":
        """Of the mirror image of the motion."""
        known, shown = mirror_features(self.known.float()) != 0, self.shown
        if shown is not None:
            shown = mirror_features(shown.float()) != 0
        return replace(self, values=mirror_features(self.values), known=known, shown=shown)

    def over(self, other: "Constraint") -> "Constraint":
        """Both, of T frames each; its own entries and beats where both give some."""
        ours, theirs = (each.known if each.shown is None else each.shown for each in (self, other))
        return Constraint(
            self.keep(other.values),
            self.known | other.known,
            other.beats if self.beats is None else self.beats,
            ours | (theirs & ~self.known),
        )

    def keep(self, features: Tensor) -> Tensor:
        """Raw features [T, K, C] with the known entries as they were given."""
        rows = features.shape[1]
        return torch.where(self.known[:, :rows], self.values[:, :rows], features)


@dataclass(frozen=True, eq=False)
class KnownBatch:
    """Constraints of one batch.

    Attributes:
        values: [B, T, K, C] z-scored, used where `known` [B, T, K, C] bool.
        shown: [B, T, K, C] bool, the known entries that the network is shown clean.
        rhythm: what leads the bodies to their beats; None where nobody has any.
    """

    values: Tensor
    known: Tensor
    shown: Tensor
    rhythm: RhythmGuidance | None

    @classmethod
    def of(
        cls,
        constraints: Sequence[Constraint | None],
        frames: int,
        mean: Tensor,
        std: Tensor,
        *,
        fps: float,
    ) -> Self | None:
        """Padded to `frames` on the device of mean and std [K, C]; None where nothing is given."""
        if all(constraint is None for constraint in constraints):
            return None
        rows, channels = mean.shape
        values = torch.zeros(len(constraints), frames, rows, channels)
        known, shown = (torch.zeros(values.shape, dtype=torch.bool) for _ in range(2))
        beats: list[Tensor | None] = [None] * len(constraints)
        for row, constraint in enumerate(constraints):
            if constraint is not None:
                length = len(constraint)
                values[row, :length] = constraint.values[:, :rows]
                known[row, :length] = constraint.known[:, :rows]
                seen = constraint.known if constraint.shown is None else constraint.shown
                shown[row, :length] = (constraint.known & seen)[:, :rows]
                beats[row] = constraint.beats
        known, shown = known.to(mean.device), shown.to(mean.device)
        z_scored = torch.where(known, (values.to(mean.device) - mean) / std, 0.0)
        rhythm = RhythmGuidance.of(beats, frames, mean, std, fps=fps)
        return cls(z_scored, known, shown, rhythm)


# ---------------------------------------------------------------- requests

MIN_FRAMES = 8


@dataclass(frozen=True)
class SampleRequest:
    """One motion to be made.

    Attributes:
        prompt: what it shows.
        frames: its length.
        tag: index of the action label; the number of tags where there is none.
        stream: what its noise depends on: seed, prompt, and which sample of that prompt it is;
            never what else is in the batch.
    """

    prompt: str
    frames: int
    tag: int
    stream: tuple[int, int, int]

    def noise(self) -> NoiseStream:
        """Its noise, from the first draw on; the same on every device and runtime."""
        return NoiseStream(*self.stream)


def make_requests(
    prompts: Sequence[str],
    *,
    seconds: float | Sequence[float],
    tags: Sequence[str | None] | None,
    known_tags: Sequence[str],
    num_samples: int,
    seed: int,
    fps: float,
) -> list[SampleRequest]:
    """Requests in prompt-major order.

    Raises:
        UserError: no or empty prompts, lists of unequal length, an unknown tag, a length that is
            no number or too short, a negative seed.
    """
    if isinstance(prompts, str):
        raise UserError("prompts is a string; give a list of prompts, e.g. ['a person walks']")
    if not prompts:
        raise UserError("no prompt given; describe a motion, e.g. 'a person walks forward'")
    if num_samples < 1:
        raise UserError(f"num-samples {num_samples} must be at least 1")
    if seed < 0:
        raise UserError(f"seed {seed} must be 0 or more")
    lengths = _each(seconds, len(prompts), "seconds")
    labels = _each(tags, len(prompts), "tags")
    count: Counter[str] = Counter()
    requests = []
    for prompt, length, label in zip(prompts, lengths, labels, strict=True):
        frames, tag = _frames(length, fps), tag_index(label, known_tags)
        text = zlib.crc32(prompt.encode())
        for _ in range(num_samples):
            requests.append(SampleRequest(prompt, frames, tag, (seed, text, count[prompt])))
            count[prompt] += 1
    return requests


def batches(
    requests: Sequence[SampleRequest],
    size: int,
    *,
    equal_lengths: bool,
    kinds: Sequence[int] | None = None,
) -> list[list[int]]:
    """Indices of at most `size` requests of like length, the shortest first.

    Args:
        equal_lengths: never two lengths in one batch. Samplers that draw noise on the way need
            it, or the padding would shift the streams.
        kinds: of the requests: never two of them in one batch; the least first.
    """
    kinds = kinds or [0] * len(requests)
    found: list[list[int]] = []
    for index in sorted(range(len(requests)), key=lambda i: (kinds[i], requests[i].frames)):
        last = found[-1][-1] if found else index
        other_length = requests[last].frames != requests[index].frames
        other = kinds[last] != kinds[index] or (equal_lengths and other_length)
        if not found or other or len(found[-1]) == size:
            found.append([])
        found[-1].append(index)
    return found


def _each(value: Any, count: int, name: str) -> list[Any]:
    if value is None or isinstance(value, str | int | float):
        return [value] * count
    values = list(value)
    if len(values) != count:
        raise UserError(
            f"{name} has {len(values)} entries for {count} prompts; give one for all or one each"
        )
    return values


def _frames(seconds: float | None, fps: float) -> int:
    if not isinstance(seconds, int | float) or not math.isfinite(seconds):
        raise UserError(f"seconds {seconds!r} is not a number; give one, such as 4")
    frames = round(seconds * fps)
    if frames < MIN_FRAMES:
        raise UserError(f"seconds {seconds:g} is too short; ask for {MIN_FRAMES / fps:.2f} or more")
    return frames


def tag_index(tag: str | None, known: Sequence[str]) -> int:
    """The place of a tag among those known, their number for None; raises UsageError."""
    if tag is None:
        return len(known)
    if tag not in known:
        hint = f"; {did_you_mean(tag, known)}known: {', '.join(known)}" if known else ""
        raise UsageError(f"tag {tag!r} is not one this model was trained with{hint}")
    return list(known).index(tag)
