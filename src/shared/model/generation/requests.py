"""Requests: one motion each, with its length, its tag and its own noise; and their batches."""

import math
import zlib
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ...config_loader import nearest
from ...errors import UserError
from ..noise import NoiseStream

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
        frames, tag = _frames(length, fps), _tag_index(label, known_tags)
        text = zlib.crc32(prompt.encode())
        for _ in range(num_samples):
            requests.append(SampleRequest(prompt, frames, tag, (seed, text, count[prompt])))
            count[prompt] += 1
    return requests


def batches(
    requests: Sequence[SampleRequest], size: int, *, equal_lengths: bool
) -> Iterator[list[int]]:
    """Indices of at most `size` requests of like length, the shortest first.

    Args:
        equal_lengths: never two lengths in one batch. Samplers that draw noise on the way need
            it, or the padding would shift the streams.
    """
    batch: list[int] = []
    for index in sorted(range(len(requests)), key=lambda i: requests[i].frames):
        other_length = bool(batch) and requests[batch[-1]].frames != requests[index].frames
        if len(batch) == size or (equal_lengths and other_length):
            yield batch
            batch = []
        batch.append(index)
    if batch:
        yield batch


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


def _tag_index(tag: str | None, known: Sequence[str]) -> int:
    if tag is None:
        return len(known)
    if tag not in known:
        hint = f"; did you mean {nearest(tag, known)!r}? known: {', '.join(known)}" if known else ""
        raise UserError(f"tag {tag!r} is not one this model was trained with{hint}")
    return list(known).index(tag)
