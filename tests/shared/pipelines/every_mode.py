"""Each mode of `generate` that needs no gradient: `every_mode.py FOLDER` makes them without torch.

Run by test_without_torch.py in a process of its own, since one process has one kind of tensors.
"""

import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

NAMES = (
    "prompts", "clauses", "held", "meanwhile", "ddpm", "dpm-solver++", "one-step", "two-steps",
    "null", "timeline", "loop", "path", "joints", "span", "ends", "stream",
    "song",
)  # fmt: skip


def modes(generator: Any) -> dict[str, Callable[[], list[Any]]]:
    """By name, what gives the motions of a mode."""
    from src.shared.model.diffusion import Sampling
    from src.shared.pipelines.edit import continue_clips, edit_clip
    from src.shared.pipelines.path import DrawnPath
    from src.shared.pipelines.song_sampler import SongSampling
    from src.shared.pipelines.timeline import Part, Timeline

    make = generator.generate
    few = Sampling(seed=3, steps=4)
    (clip,) = make("a person walks forward", seconds=2.0, sampling=Sampling(seed=1))
    two = Timeline.of(["a person walks", "a person jumps"], seconds=3.0)
    drawn = DrawnPath(np.array([[0.0, 0.0], [0.0, 1.5], [0.8, 2.0]]))

    def passed(name: str, scale: float | None = None) -> list[Any]:
        sampling = Sampling(seed=2, steps=6, sampler=name, guidance_scale=scale)
        return make("a person kicks", seconds=1.5, sampling=sampling)

    def at_once(steps: int) -> list[Any]:
        sampling = Sampling(seed=2, steps=steps)
        return make(["a person kicks", "a person walks"], seconds=1.5, sampling=sampling)

    def streamed() -> list[Any]:
        stream = generator.stream("a person walks", seconds=1.0, sampling=few)
        pieces = iter(stream)
        first = next(pieces)
        stream.say("a person waves")
        second = next(pieces)
        stream.stop()
        return [first, second, *pieces]

    def edited(given: Any, text: str | None) -> list[Any]:
        return [generator.edit(given, text, sampling=few).motion]

    def parted() -> list[Any]:
        part = Part("a person waves", 15, 60, frozenset({"r_shoulder", "r_elbow"}))
        timeline = Timeline(two.passages, (part,))
        return [generator.timeline(timeline, sampling=few).motion]

    def song() -> list[Any]:
        rows = np.random.default_rng(0).random((167, 300), dtype=np.float32)
        settings = SongSampling(seed=3, steps=3)
        paths = generator.audio.generate(rows, phase=np.arange(300) / 60, settings=settings)
        return [SimpleNamespace(quaternions=each.quaternion, root_position=each.position)
                for each in paths]  # fmt: skip

    found = (
        lambda: make(["a person walks", "una persona salta"], seconds=[1.0, 1.5], sampling=few),
        lambda: make("a person turns 90 degrees to the left, then waves twice", sampling=few),
        lambda: make("raises a hand, holds it up, then sleeps", seconds=2.0, sampling=few),
        lambda: make("a person walks while waving", seconds=2.0, sampling=few),
        lambda: passed("ddpm"),
        lambda: passed("dpm-solver++", 1.0),
        lambda: at_once(1),
        lambda: at_once(2),
        lambda: edited(edit_clip(clip, 0.5, 1.0), None),
        parted,
        lambda: [generator.timeline(two, loop=True, sampling=few).motion],
        lambda: [generator.timeline(two, path=drawn, sampling=few).motion],
        lambda: edited(edit_clip(clip, joints={"l_shoulder", "l_elbow"}), "a person waves"),
        lambda: edited(edit_clip(clip, 0.5, 1.2), "a person jumps"),
        lambda: edited(continue_clips(clip, clip, keep=0.5, seconds=3.0), "a person jumps"),
        streamed,
        song,
    )
    return dict(zip(NAMES, found, strict=True))


def main(folder: Path) -> None:
    """Write what each mode makes without PyTorch, and what it took to be imported."""
    from src.shared.environment import compute_without_torch

    compute_without_torch()
    from src.shared.pipelines.motion_generator import MotionGenerator

    generator = MotionGenerator(device="cpu", runtime="onnx")
    for name, made in modes(generator).items():
        motions = made()
        np.savez(
            folder / f"{name}.npz",
            quaternions=np.concatenate([each.quaternions for each in motions]),
            root=np.concatenate([each.root_position for each in motions]),
        )
    heavy = {"torch", "transformers", "librosa", "rich", "scipy.ndimage", "scipy.signal"}
    heavy &= sys.modules.keys()
    (folder / "imported.txt").write_text(" ".join(sorted(heavy)))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
