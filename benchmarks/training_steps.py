"""What a training step and a sample take, by profile, batch and precision; on a GPU, of its roof.

python -m benchmarks.training_steps [--device cuda] [--profiles lightweight,default,spark]
    [--branches text,audio] [--batches 16,64,256] [--precisions no,bf16] [--compile]
    [--frames 120] [--rounds 5] [--write FILE.md] [--json FILE]

A step is forward, backward and AdamW of the network that is learned: the denoiser behind its
frozen text tower (of XLM-R's published size, nothing downloaded), or the UNet behind its sound.
Weights and data are random: speed does not depend on them. The roof is what a large product of
matrices reaches here in that precision. A batch that does not fit ends a row. Memory is the
device's peak. On a CPU seconds are of processor time, which a busy machine does not change, of one
thread (OMP_NUM_THREADS=1), and memory is the process's peak so far.
"""

import argparse
import json
import platform
import resource
import time
from collections.abc import Callable
from itertools import groupby
from pathlib import Path
from typing import Any

import torch
from torch import nn
from torch.utils.flop_counter import FlopCounterMode

from benchmarks.audio_stages import random_batch
from src.cli.shape_tables import without_download
from src.shared.config_loader import load_audio_network, load_network
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.clip.core import MotionClip
from src.shared.model.generation.denoiser import MotionDenoiser
from src.train.task import to_device
from src.train.train_audio import audio_losses
from src.train.train_generation import Conditions, GuidedDenoiser

TOKENS, TAGS = 32, 40
HEAD = (
    "branch",
    "profile",
    "precision",
    "batch",
    "s a step",
    "clips a second",
    "TFLOP",
    "of the roof",
    "GB",
)


def text_step(profile: str, batch: int, frames: int, device: torch.device) -> tuple[Any, Any]:
    """Denoiser and loss of one batch; the frozen tower reads its captions in every step."""
    network = load_network(profile)
    network = network.model_copy(update={"clip": without_download(network.clip)})
    rows, channels = network.motion_rows, network.generation.motion_channels
    with device:
        tower = MotionClip(network).text.freeze()
        module = GuidedDenoiser(MotionDenoiser(network, TAGS)).train()
        ids = torch.randint(5, 1000, (batch, TOKENS))
        motion, clean = torch.randn(2, batch, frames, rows, channels)
        steps = torch.randint(0, 100, (batch,))
        tag = torch.full((batch,), TAGS)
        mask = torch.ones(batch, frames, dtype=torch.bool)
        drop = torch.rand(batch) < 0.1
        known = torch.zeros(motion.shape, dtype=torch.bool)
        provenance = torch.zeros(batch, dtype=torch.long)

    def loss(network: nn.Module) -> torch.Tensor:
        with torch.no_grad():
            text = tower(ids, torch.ones_like(ids))
        told = Conditions(steps, tag, mask, drop, known, provenance)
        found = network(motion, text, told)
        return (found.float() - clean).square().mean()

    return module, loss


def audio_step(profile: str, batch: int, frames: int, device: torch.device) -> tuple[Any, Any]:
    """UNet and loss of one batch of windows."""
    model = AudioMotionModel(load_audio_network(profile))
    module, diffusion, std = model.unet.to(device).train(), model.diffusion.to(device), model.std
    windows = to_device(random_batch(batch, frames), device)

    def loss(network: nn.Module) -> torch.Tensor:
        losses = audio_losses(network, windows, diffusion, std.to(device), velocity_weight=1.0)
        return losses["loss"]

    return module, loss


def seconds(action: Callable[[], Any], rounds: int, device: torch.device) -> float:
    """The fastest of several, after one that does not count."""
    best, now = float("inf"), time.perf_counter if device.type == "cuda" else time.process_time
    for number in range(rounds + 1):
        begin = now()
        action()
        if device.type == "cuda":
            torch.cuda.synchronize()
        best = min(best, now() - begin) if number else best
    return best


def roof(bf16: bool, device: torch.device) -> float:
    """Floating-point operations a second of a large product of matrices."""
    size = 8192 if device.type == "cuda" else 1024
    kind = torch.bfloat16 if bf16 else torch.float32
    left, right = torch.randn(2, size, size, device=device, dtype=kind)
    return 2 * size**3 / seconds(lambda: left @ right, 5, device)


def measure(branch: str, profile: str, batch: int, given: argparse.Namespace, bf16: bool) -> Any:
    """One row; raises torch.OutOfMemoryError where it does not fit."""
    device = torch.device(given.device)
    if device.type == "cuda":
        torch.cuda.reset_peak_memory_stats()
    make = {"text": text_step, "audio": audio_step}[branch]
    module, loss = make(profile, batch, given.frames, device)
    learned: Any = torch.compile(module) if given.compile else module
    optimizer = torch.optim.AdamW(module.parameters(), 1e-4, fused=device.type == "cuda")

    def step(network: Any) -> None:
        with torch.autocast(device.type, torch.bfloat16, enabled=bf16):
            value = loss(network)
        value.backward()
        optimizer.step()
        optimizer.zero_grad()

    with FlopCounterMode(display=False) as counter:
        step(module)
    taken = seconds(lambda: step(learned), given.rounds, device)
    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    if device.type == "cuda":
        used = torch.cuda.max_memory_allocated()
    work = counter.get_total_flops()
    share = work / taken / given.roofs[bf16]
    precision = ("bf16" if bf16 else "float32") + (", compiled" if given.compile else "")
    values = (
        branch,
        profile,
        precision,
        batch,
        taken,
        batch / taken,
        work / 1e12,
        share,
        used / 1e9,
    )
    return dict(zip(HEAD, values, strict=True))


def rows(given: argparse.Namespace) -> list[dict[str, Any]]:
    """Every row that fits, as it comes."""
    found = []
    for branch in given.branches.split(","):
        for profile in given.profiles.split(","):
            for precision in given.precisions.split(","):
                for batch in map(int, given.batches.split(",")):
                    try:
                        row = measure(branch, profile, batch, given, precision == "bf16")
                    except torch.OutOfMemoryError:
                        print(f"{branch} {profile} {precision}: batch {batch} does not fit")
                        break
                    found.append(row)
                    print(" ".join(shown(value) for value in row.values()), flush=True)
    return found


def of_the_roof(table: list[dict[str, Any]]) -> list[str]:
    """From which batch each profile does half of what the device can, or how near it comes."""
    told = []
    for key, rows in groupby(table, lambda row: [row[name] for name in HEAD[:3]]):
        most = max(found := list(rows), key=lambda row: row["of the roof"])
        half = [row["batch"] for row in found if row["of the roof"] >= 0.5]
        where = f"half of the roof from batch {half[0]}" if half else (
            f"{most['of the roof']:.0%} of the roof at most, at batch {most['batch']}"
        )  # fmt: skip
        told.append(f"{' '.join(key)}: {where}")
    return told


def shown(value: Any) -> str:
    """A value of a table."""
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--device", default="cuda" if torch.cuda.is_available() else "cpu")
    parser.add_argument("--profiles", default="lightweight,default,spark")
    parser.add_argument("--branches", default="text,audio")
    parser.add_argument("--batches", default="16,64,256")
    parser.add_argument("--precisions", default="no,bf16")
    parser.add_argument("--compile", action="store_true")
    parser.add_argument("--frames", type=int, default=120)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--write", type=Path, help="Markdown of the table")
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    device = torch.device(given.device)
    given.roofs = {bf16: roof(bf16, device) for bf16 in (False, True)}
    name = torch.cuda.get_device_name() if device.type == "cuda" else platform.processor() or "CPU"
    told = ", ".join(
        f"{roof / 1e12:.3g} TFLOP/s in {'bf16' if bf16 else 'float32'}"
        for bf16, roof in given.roofs.items()
    )
    about = f"{name}, {torch.get_num_threads()} threads, torch {torch.__version__}; roof {told}"
    print(about)
    table = rows(given)
    roofs = of_the_roof(table)
    print("\n".join(roofs))
    if given.json:
        given.json.write_text(json.dumps({"about": about, "rows": table}, indent=1) + "\n")
    if given.write:
        lines = [" | ".join(map(shown, row.values())) for row in table]
        rule = " | ".join("---" for _ in HEAD)
        body = "\n".join(f"| {line} |" for line in (" | ".join(HEAD), rule, *lines))
        text = f"# Training steps on {name}\n\n`make gpu-check` wrote this: {about}.\n\n{body}\n\n"
        text += "".join(f"- {line}\n" for line in roofs)
        given.write.write_text(text)


if __name__ == "__main__":
    main()
