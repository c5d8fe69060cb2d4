"""How fast are the audio UNet's step, its samples and its training?

python -m benchmarks.audio_unet [--parts step,sample,rivals,tables] [--profile default]
    [--device cpu | cuda | mps] [--threads 2] [--rounds 7] [--quick] [--json OUT]

step: one denoising step of 4 s, the document's literal one (literal_unet.py) and ours at equal
weights, in float32 and with bf16 autocast. sample: the same for 20 DDIM steps. Both networks are
put together as the document draws them, with cross-attention and without positions; the sampling
copy is what `generate` runs on a CPU.
rivals: seconds a second of motion of ours as shipped, with FiLM, rotary positions and a further
halving, beside samplers of rivals' sizes.
tables: the three of the document's section 13 (training, end-to-end fine-tuning, sampling) on this
machine, on --device with its peak of memory; all else is of the CPU.

Weights are random, zero-initialised layers filled: speed does not depend on training.
"""

import argparse
import json
import os
import platform
import resource
from collections.abc import Callable
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from benchmarks import audio_rivals, audio_stages
from benchmarks.literal_unet import LiteralDDIMSampler, LiteralUNet, literal_twin
from benchmarks.turns import as_rows, in_turns, ratio
from src.shared.config_audio import AudioNetworkConfig
from src.shared.config_loader import load_audio_network
from src.shared.model.audio import CONDITION_ROWS, FEATURE_ROWS
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.audio.unet import UNet1D, sampling_copy
from src.shared.model.diffusion import DDIMSampler, ModelFn
from src.shared.motion.postprocess.trajectory import MotionPostProcessor

FRAMES, SECONDS = 120, 4.0
STEPS = 20
PARTS = ("step", "sample", "rivals", "tables")
LITERAL, OURS, COPY = "literal", "ours", "ours, sampling copy"


def filled(model: AudioMotionModel) -> AudioMotionModel:
    """Random numbers where training would start from zeros, so that outputs mean something."""
    draws = torch.Generator().manual_seed(0)
    with torch.no_grad():
        for parameter in model.unet.parameters():
            if not parameter.any():
                parameter.copy_(0.02 * torch.randn(parameter.shape, generator=draws))
    return model.eval()


def network_as_printed(profile: str) -> AudioNetworkConfig:
    """A profile's widths, put together as the document draws it."""
    network = load_audio_network(profile)
    printed = {"conditioning": "cross-attention", "rotary": False, "downsample_last": False}
    unet = network.unet.model_copy(update=printed)
    return network.model_copy(update={"unet": unet})


class Pair:
    """The literal network and ours at equal weights, with one input."""

    def __init__(self, profile: str) -> None:
        torch.manual_seed(0)
        self.model = filled(AudioMotionModel(network_as_printed(profile)))
        self.ours = self.model.unet
        self.literal: LiteralUNet = literal_twin(self.ours)
        self.x, self.audio = torch.randn(1, 25, FRAMES), torch.rand(1, FEATURE_ROWS, FRAMES)
        self.t = torch.tensor([500])
        self.networks: dict[str, torch.nn.Module] = {
            LITERAL: self.literal,
            OURS: self.ours,
            COPY: sampling_copy(self.ours),
        }

    def step(self, network: torch.nn.Module, bf16: bool) -> Callable[[], Tensor]:
        """One denoising step; ours with its condition prepared, as in sampling."""
        with torch.no_grad(), autocast(bf16):
            heard = self.audio
            if isinstance(network, UNet1D):
                heard = network.prepare(self.audio)

        @torch.no_grad()
        def run() -> Tensor:
            with autocast(bf16):
                return network(self.x, self.t, heard)

        return run

    def sample(self, network: torch.nn.Module, bf16: bool) -> Callable[[], Tensor]:
        """20 DDIM steps: the printed loop, or ours, which prepares the condition once."""

        @torch.no_grad()
        def run() -> Tensor:
            with autocast(bf16):
                if not isinstance(network, UNet1D):
                    loop = LiteralDDIMSampler(self.model.diffusion, STEPS)
                    return loop.sample(network, self.x, self.audio)
                return sampled(self.model, network, self.x, self.audio, STEPS)

        return run


def autocast(enabled: bool) -> torch.autocast:
    """bf16 on the CPU, or nothing."""
    return torch.autocast("cpu", torch.bfloat16, enabled=enabled)


def sampled(
    model: AudioMotionModel, network: UNet1D, noise: Tensor, audio: Tensor, steps: int
) -> Tensor:
    """x_0 [B, 25, T] of the model's diffusion by DDIM."""
    heard = network.prepare(audio)
    model_fn: ModelFn = lambda x_t, t: network(x_t, t, heard)  # noqa: E731
    return DDIMSampler(model.diffusion, steps).run(model_fn, noise)


def paired(pair: Pair, what: str, rounds: int) -> dict[str, Any]:
    """Times, ratios and differences of literal and ours, for `step` or `sample`."""
    make = getattr(pair, what)
    runs = {
        f"{name}, {precision}": make(network, bf16)
        for precision, bf16 in (("fp32", False), ("bf16", True))
        for name, network in pair.networks.items()
    }
    timings = in_turns(runs, rounds)
    outputs = {name: pair.step(*_candidate(pair, name))() for name in runs}
    reference = outputs[f"{LITERAL}, fp32"]
    return {
        "seconds": as_rows(timings),
        "times_faster": {
            f"{name}, {precision}, than literal, {other}": ratio(
                timings, f"{LITERAL}, {other}", f"{name}, {precision}"
            )
            for precision in ("fp32", "bf16")
            for other in ("fp32", "bf16")
            for name in (OURS, COPY)
        },
        "largest_difference_of_a_step": {
            name: float((output.float() - reference).abs().max())
            for name, output in outputs.items()
        },
        "largest_output": float(reference.abs().max()),
    }


def _candidate(pair: Pair, name: str) -> tuple[torch.nn.Module, bool]:
    network, _, precision = name.rpartition(", ")
    return pair.networks[network], precision == "bf16"


def rivals(profile: str, rounds: int) -> dict[str, Any]:
    """Seconds a second of motion: ours as shipped, float32 and sampling copy, and the rivals."""
    model = filled(AudioMotionModel(load_audio_network(profile)))
    noise, audio = torch.randn(1, 25, FRAMES), torch.rand(1, CONDITION_ROWS, FRAMES)
    networks = {
        f"ours, {profile}, fp32": model.unet,
        f"ours, {profile}, sampling copy": sampling_copy(model.unet),
    }
    edge, unet1d = audio_rivals.edge_sized(FRAMES), audio_rivals.unet1d_model(FRAMES)
    size = sum(p.numel() for p in model.unet.parameters())

    def ours(network: UNet1D) -> Callable[[], Tensor]:
        return torch.no_grad()(lambda: sampled(model, network, noise, audio, STEPS))

    runs: dict[str, Callable[[], Any]] = {name: ours(net) for name, net in networks.items()}
    runs |= {"EDGE-sized": edge.sample, "diffusers UNet1DModel": unet1d.sample}
    seconds = dict.fromkeys(networks, SECONDS)
    seconds |= {"EDGE-sized": edge.frames / 30, "diffusers UNet1DModel": unet1d.frames / 30}
    steps = dict.fromkeys(networks, STEPS)
    steps |= {"EDGE-sized": edge.steps, "diffusers UNet1DModel": unet1d.steps}
    sizes = dict.fromkeys(networks, size)
    sizes |= {"EDGE-sized": edge.parameters, "diffusers UNet1DModel": unet1d.parameters}
    timings = in_turns(runs, rounds)
    return {
        name: {
            "parameters": sizes[name],
            "steps": steps[name],
            "seconds_a_second": timing.wall / seconds[name],
            "processor_seconds_a_second": timing.processor / seconds[name],
        }
        for name, timing in timings.items()
    }


def tables(
    profile: str, rounds: int, batches: tuple[int, ...], device: str = "cpu"
) -> dict[str, Any]:
    """TECH 13.1 to 13.3 on this machine."""
    network = load_audio_network(profile)
    training = {
        f"batch {batch}, {precision}": audio_stages.training_step(
            network, batch, FRAMES, bf16=precision == "bf16", device=device
        )
        for batch in batches
        for precision in ("fp32", "bf16")
    }
    found: dict[str, Any] = {"profile": profile, "frames": FRAMES}
    found["training"] = {
        name: {"iterations_a_second": 1 / timing.wall, "processor_seconds": timing.processor}
        for name, timing in in_turns(training, rounds).items()
    }
    batch = min(8, max(batches))  # TECH 13.2 has 8
    e2e = {
        f"batch {batch}, 5 steps, {precision}": audio_stages.e2e_step(
            network, batch, FRAMES, 5, bf16=precision == "bf16", device=device
        )
        for precision in ("fp32", "bf16")
    }
    found["end_to_end"] = as_rows(in_turns(e2e, rounds))
    found["inference"] = as_rows(in_turns(inference(network, device), rounds))
    if device == "cuda":
        found["device"] = torch.cuda.get_device_name()
        found["peak_gib_of_the_device"] = torch.cuda.max_memory_allocated() / 2**30
    return found


def inference(network: AudioNetworkConfig, device: str) -> dict[str, Callable[[], object]]:
    """4 s of motion in 5 to 50 DDIM steps; decoder and post-processing by themselves."""
    model = filled(AudioMotionModel(network)).to(device)
    fast = sampling_copy(model.unet)
    noise = torch.randn(1, 25, FRAMES, device=device)
    audio = torch.rand(1, CONDITION_ROWS, FRAMES, device=device)

    def steps(number: int, unet: UNet1D) -> Callable[[], object]:
        return torch.no_grad()(lambda: sampled(model, unet, noise, audio, number).cpu())

    with torch.no_grad():
        rows = sampled(model, model.unet, noise, audio, 5)
        trajectory = model.decode(rows).trajectory.cpu().numpy()
    runs = {f"{number} steps, fp32": steps(number, model.unet) for number in (5, 10, 20, 50)}
    runs |= {f"{number} steps, sampling copy": steps(number, fast) for number in (5, 10, 20, 50)}
    runs["decoder"] = torch.no_grad()(lambda: model.decode(rows).trajectory.cpu())
    runs["post-processing"] = lambda: MotionPostProcessor().process(trajectory)
    return runs


def show(result: dict[str, Any], indent: int = 0) -> None:
    """The figures as an indented list."""
    for name, value in result.items():
        if name in ("all_wall", "json"):
            continue
        label = " " * indent + str(name)
        if isinstance(value, dict):
            print(label)
            show(value, indent + 2)
        else:
            print(f"{label}: {value:.4g}" if isinstance(value, float) else f"{label}: {value}")


def main() -> None:
    """Parse, measure, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--parts", default=",".join(PARTS), help=", ".join(PARTS))
    parser.add_argument("--profile", default="default", help="of audio_network.yaml")
    parser.add_argument("--table-profile", default="lightweight", help="of the tables")
    parser.add_argument("--batches", default="4,16,32", help="of the training table")
    parser.add_argument("--device", choices=("cpu", "cuda", "mps"), default="cpu")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--quick", action="store_true", help="one round, small batches")
    parser.add_argument("--json", type=Path, help="write the result here")
    arguments = parser.parse_args()
    parts = arguments.parts.split(",")
    if unknown := set(parts) - set(PARTS):
        parser.error(f"no such part: {', '.join(sorted(unknown))}")
    rounds = 1 if arguments.quick else arguments.rounds
    batches = (2,) if arguments.quick else tuple(map(int, arguments.batches.split(",")))
    torch.set_num_threads(arguments.threads)
    result: dict[str, Any] = {
        "threads": arguments.threads,
        "processors": len(os.sched_getaffinity(0)),
        "rounds": rounds,
        "profile": arguments.profile,
        "torch": torch.__version__,
        "machine": platform.machine(),
    }
    if {"step", "sample"} & set(parts):
        pair = Pair(arguments.profile)
        for what in ("step", "sample"):
            if what in parts:
                result[what] = paired(pair, what, rounds)
        del pair
    if "rivals" in parts:
        result["rivals"] = rivals(arguments.profile, rounds)
    if "tables" in parts:
        result["tables"] = tables(arguments.table_profile, rounds, batches, arguments.device)
    result["peak_gib"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    show(result)
    if arguments.json:
        arguments.json.write_text(json.dumps(result, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
