"""How fast is sampling? Ours against an MDM-sized yardstick timed in the same run, and the command.

python -m benchmarks.sampling [--model starter | --profile lightweight] [--runtime onnx]
    [--steps N] [--threads 2] [--device cpu | cuda | mps] [--json OUT]

The yardstick is a plain transformer encoder of MDM's size (Tevet et al. 2023: 8 layers, 512 wide,
FFN 1024, 4 heads) with random weights, 50 guided steps, 120 frames. Ours is the whole of
`TextToMotion.generate` for one prompt of 4 s with the model's own steps (or --steps) and guidance,
from text to finished motion. The two alternate, so that both see the same machine.

Letters: B batch, T frames, D width.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

ROOT = Path(__file__).resolve().parent.parent
FRAMES, SECONDS = 120, 4.0
PROMPT = "a person walks forward and waves with the left hand"
MARK = "@seconds "

if TYPE_CHECKING:
    import torch

    from src.shared.model.clip.features import TextFeatures
    from src.shared.model.generation.motion_generator import TextToMotion


def yardstick(device: str = "cpu", steps: int = 50) -> Callable[[], None]:
    """A sampler of MDM's size: classifier-free guidance as one doubled batch a step."""
    import torch
    from torch import nn

    width, features = 512, 263
    layer = nn.TransformerEncoderLayer(width, 4, 1024, activation="gelu", batch_first=True)
    encoder = nn.TransformerEncoder(layer, 8, enable_nested_tensor=False).eval().to(device)
    into, out = (
        nn.Linear(*size).eval().to(device) for size in ((features, width), (width, features))
    )
    condition = torch.randn(
        2, 1, width, device=device
    )  # one token for text and step: [prompt, nothing]

    @torch.inference_mode()
    def sample() -> None:
        x = torch.randn(1, FRAMES, features, device=device)
        for step in range(steps, 0, -1):
            tokens = torch.cat([condition, into(x.expand(2, -1, -1))], dim=1)  # [2, T + 1, D]
            told, untold = out(encoder(tokens)[:, 1:])
            clean = untold + 2.5 * (told - untold)
            x = (x * (step - 1) + clean) / step  # any cheap update: its cost does not show
        x.cpu()  # a device computes on when the call is over

    return sample


def load_generator(
    model: str | None, profile: str, runtime: str = "torch", device: str = "cpu"
) -> "TextToMotion":
    """A trained model, or random weights of a profile: speed does not depend on training."""
    from src.shared.model.generation.motion_generator import TextToMotion

    if model:
        return TextToMotion.from_pretrained(model, device=device, runtime=runtime)
    import torch

    from src.shared.config_loader import load_network
    from src.shared.model.checkpoint import ModelCard
    from src.shared.model.clip.core import TextTower
    from src.shared.model.clip.tokenizer import PromptTokenizer
    from src.shared.model.generation.denoiser import MotionDenoiser

    network = load_network(profile)
    words = ["a", "person", "walks", "runs", "jumps", "waves", "turns", "forward", "left", "slowly"]
    captions = [f"{a} {b} {c}" for a in words for b in words for c in words]
    return TextToMotion(
        MotionDenoiser(network, 0),
        TextTower(network.clip, network.embed_dim),
        PromptTokenizer.train(captions, 400, max_tokens=network.clip.max_tokens),
        mean=torch.zeros(network.motion_rows, 6),
        std=torch.ones(network.motion_rows, 6),
        card=ModelCard(kind="motion-generator", trained=True, network=network),
        device=device,
    )


def timed(run: Callable[[], object]) -> float:
    """Seconds of one call."""
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def compare(
    generator: "TextToMotion", repeats: int, steps: int | None, device: str = "cpu"
) -> dict[str, Any]:
    """Seconds of ours and of the yardstick, alternating; the order changes every round."""
    runs: dict[str, Callable[[], object]] = {
        "ours": lambda: generator.generate([PROMPT], seconds=SECONDS, steps=steps),
        "yardstick": yardstick(device),
    }
    for run in runs.values():  # first calls allocate and choose kernels
        run()
    times: dict[str, list[float]] = {name: [] for name in runs}
    for round_number in range(repeats):
        names = list(runs) if round_number % 2 == 0 else list(reversed(runs))
        for name in names:
            times[name].append(timed(runs[name]))
    medians = {name: statistics.median(values) for name, values in times.items()}
    settings = generator.network.generation
    return {
        "seconds": medians,
        "all": times,
        "times_faster": medians["yardstick"] / medians["ours"],
        "steps": steps or settings.sampling_steps,
        "sampler": settings.sampler,
        "guidance_scale": settings.guidance_scale,
        "parameters": sum(p.numel() for p in generator.denoiser.parameters()),
    }


def parts(generator: "TextToMotion", repeats: int, steps: int | None) -> dict[str, float]:
    """Median seconds of the parts of `generate`: text, denoising, finishing."""

    def encoded() -> "TextFeatures":
        generator._encoded.clear()  # what was encoded before is kept
        return generator.encode_prompts([PROMPT])

    def sampled() -> "list[torch.Tensor]":
        generator._encoded.clear()
        return generator.sample_features([PROMPT], seconds=SECONDS, steps=steps)

    sample = sampled()[0]
    calls: dict[str, Callable[[], object]] = {
        "text": encoded,
        "text and denoising": sampled,
        "post-processing": lambda: generator.post_processor(sample, text=PROMPT),
    }
    found = {
        name: statistics.median(timed(call) for _ in range(repeats)) for name, call in calls.items()
    }
    return {
        "text": found["text"],
        "denoising": found["text and denoising"] - found["text"],
        "post-processing": found["post-processing"],
    }


STAGES = f"""
import sys, time
import src
start = time.perf_counter()
def told(name):
    global start
    print({MARK!r} + name + " " + str(time.perf_counter() - start), flush=True)
    start = time.perf_counter()
import torch
told("import-torch")
from src.shared.device import set_threads
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.formats.registry import write_motion
set_threads(int(sys.argv[2]))
told("import-ours")
generator = TextToMotion.from_pretrained(sys.argv[1], device=sys.argv[5])
told("load-model")
motions = generator.generate([sys.argv[3]], seconds={SECONDS})
told("sample")
from pathlib import Path
for name in ("bvh", "glb", "npz", "html"):
    write_motion(motions[0], Path(sys.argv[4]) / ("motion." + name))
    told("write-" + name)
"""


def command_times(model: str, threads: int, repeats: int, device: str = "cpu") -> dict[str, Any]:
    """The whole `generate` command in fresh processes: first run, then warm ones, and stages.

    The first run compiles every module to bytecode, as it does after an installation: the cache
    folder starts empty. Files may still be in the memory of the operating system.
    """
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": str(Path(folder) / "bytecode")}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)  # else no run would ever be warm
        command = [sys.executable, "-m", "src.cli.tools", "generate", "--prompt", PROMPT]
        command += ["--seconds", str(SECONDS), "--model", model, "--out", folder]
        command += ["--threads", str(threads), "--device", device]

        def run(arguments: list[str]) -> str:
            done = subprocess.run(
                arguments, cwd=ROOT, env=environment, capture_output=True, text=True
            )
            if done.returncode:
                raise SystemExit(f"{' '.join(arguments[:5])} failed: {done.stderr.strip()[-500:]}")
            return done.stdout

        first = timed(lambda: run(command))
        warm = [timed(lambda: run(command)) for _ in range(repeats)]
        staged = [sys.executable, "-c", STAGES, model, str(threads), PROMPT, folder, device]
        run(staged)
        whole, stages = time.perf_counter(), {}
        for line in run(staged).splitlines():
            if line.startswith(MARK):
                name, value = line.removeprefix(MARK).rsplit(" ", 1)
                stages[name] = float(value)
        stages["python-start-and-end"] = time.perf_counter() - whole - sum(stages.values())
    return {"first": first, "warm": statistics.median(warm), "all_warm": warm, "stages": stages}


def show(result: dict[str, Any]) -> None:
    """The result as tables on the terminal."""
    from rich.console import Console
    from rich.table import Table

    console = Console()
    ours = result["sampling"]
    title = (
        f"4 s of motion, {result['device']}, {result['threads']} CPU threads,"
        f" median of {result['repeats']} ({ours['sampler']}, {ours['steps']} steps,"
        f" guidance {ours['guidance_scale']:g})"
    )
    table = Table("what", "seconds", title=title)
    for name, value in ours["seconds"].items():
        table.add_row(name, f"{value:.3f}")
    for name, value in result["parts"].items():
        table.add_row(f"  ours: {name}", f"{value:.3f}")
    table.add_row("times faster than the yardstick", f"{ours['times_faster']:.1f}")
    sampling = result["parts"]["text"] + result["parts"]["denoising"]
    alone = ours["seconds"]["yardstick"] / sampling  # which samples and does no more
    table.add_row("  sampling alone", f"{alone:.1f}")
    console.print(table)
    if command := result.get("command"):
        table = Table("the whole command", "seconds")
        table.add_row("first run", f"{command['first']:.2f}")
        table.add_row("warm", f"{command['warm']:.2f}")
        for name, value in command["stages"].items():
            table.add_row(f"  {name}", f"{value:.2f}")
        console.print(table)


def main() -> None:
    """Parse, measure, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--model", help="shipped name or folder; left out: random weights")
    parser.add_argument("--profile", default="lightweight", help="of the random weights")
    parser.add_argument("--runtime", choices=("torch", "onnx"), default="torch", help="of --model")
    parser.add_argument("--steps", type=int, help="of sampling; left out: the model's own")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--device", choices=("cpu", "cuda", "mps"), default="cpu")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--no-command", action="store_true", help="time sampling only")
    parser.add_argument("--json", type=Path, help="write the result here")
    arguments = parser.parse_args()

    from src.shared.device import set_threads

    set_threads(arguments.threads)
    model, profile, device = arguments.model, arguments.profile, arguments.device
    generator = load_generator(model, profile, arguments.runtime, device)
    result: dict[str, Any] = {
        "device": device,
        "threads": arguments.threads,
        "repeats": arguments.repeats,
        "model": arguments.model or f"random weights, profile {arguments.profile}",
        "runtime": arguments.runtime,
        "sampling": compare(generator, arguments.repeats, arguments.steps, device),
        "parts": parts(generator, arguments.repeats, arguments.steps),
    }
    if arguments.model and not arguments.no_command:
        result["command"] = command_times(model, arguments.threads, arguments.repeats, device)
    show(result)
    if arguments.json:
        arguments.json.write_text(json.dumps(result, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
