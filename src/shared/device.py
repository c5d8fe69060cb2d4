"""Where to compute and how precisely: cuda > mps > cpu, bf16 where the hardware has it.

Every choice comes with its reason, which the caller prints.
"""

import os
import shutil
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from .environment import DEVICE, variable
from .errors import UsageError

if TYPE_CHECKING:
    import torch

DeviceName = Literal["cuda", "mps", "cpu"]
READINGS = 3  # of the idle cores: what runs for an instant only takes none


@dataclass(frozen=True)
class ComputeChoice:
    """A device and an autocast precision (`no` is float32), with the reason for each."""

    device: DeviceName
    device_reason: str
    precision: Literal["no", "bf16", "fp16"]
    precision_reason: str

    def __str__(self) -> str:
        name = {"no": "float32"}.get(self.precision, self.precision)
        return f"{self.device} ({self.device_reason}), {name} ({self.precision_reason})"


def choose_device(requested: str = "auto") -> tuple[DeviceName, str]:
    """The device to use and why.

    Args:
        requested: auto, cuda, mps or cpu; auto is what MOTIONGEN_DEVICE names, else the best.

    Raises:
        UsageError: the requested device does not exist here.
    """
    from .tensors import torch, torch_is_here

    reason = "as requested"
    if requested == "auto" and (named := variable(DEVICE)):
        requested, reason = named, f"as {DEVICE} says"
    cuda = torch_is_here and torch.cuda.is_available()
    mps = torch_is_here and torch.backends.mps.is_available()
    available = {"cuda": cuda, "mps": mps, "cpu": True}
    if requested == "auto":
        if available["cuda"]:
            return "cuda", torch.cuda.get_device_name()
        return ("mps", "Apple GPU found") if available["mps"] else ("cpu", "no GPU found")
    if requested not in available:
        raise UsageError(f"device {requested!r} is unknown; use auto, cuda, mps or cpu")
    if not available[requested]:
        here = ", ".join(name for name, there in available.items() if there)
        raise UsageError(f"device {requested!r} is not available here; use auto or one of: {here}")
    return requested, reason  # type: ignore[return-value]


def computes_on_cpu(requested: str = "auto") -> bool:
    """Whether `choose_device` will say cpu, without asking PyTorch: by the drivers."""
    named = variable(DEVICE) if requested == "auto" else requested
    if named:
        return named == "cpu"
    apple = sys.platform == "darwin" and os.uname().machine == "arm64"
    nvidia = Path("/dev/nvidiactl").exists() or shutil.which("nvidia-smi") is not None
    return not (apple or nvidia)


def _native_bf16(device: DeviceName) -> tuple[bool, str]:
    """Whether bf16 products run in hardware, in words."""
    from .tensors import torch

    if device == "cuda":
        major, minor = torch.cuda.get_device_capability()
        return major >= 8, f"compute capability {major}.{minor}"
    if device == "mps":
        return False, "float32 is as fast on Apple GPUs at this size and works on every macOS"
    # private, but the only way torch tells; a missing function counts as a missing instruction
    for function, name in (
        ("_is_amx_tile_supported", "AMX"),
        ("_is_avx512_bf16_supported", "AVX512-BF16"),
    ):
        if getattr(torch.cpu, function, lambda: False)():
            return True, f"this CPU has {name}"
    return False, "this CPU has no bf16 instructions"


def choose_compute(device: str = "auto", precision: str = "auto") -> ComputeChoice:
    """Device and precision together.

    Where the caller leaves it open, what `accelerate launch --cpu --mixed_precision` asked for
    (it speaks through the environment) comes first.

    Args:
        device: auto, cuda, mps or cpu.
        precision: auto, no (float32), bf16 or fp16.

    Raises:
        UsageError: the device does not exist here, or cannot compute in that precision.
    """
    on_cpu = os.environ.get("ACCELERATE_USE_CPU", "").lower() in ("true", "1", "yes")
    if device == "auto" and on_cpu:
        device = "cpu"
    # "no" is what the launcher says when nobody asked for anything
    launcher = os.environ.get("ACCELERATE_MIXED_PRECISION", "no")
    if precision == "auto" and launcher in ("bf16", "fp16"):
        precision = launcher
    name, reason = choose_device(device)
    native, detail = _native_bf16(name)
    if precision == "auto":
        return ComputeChoice(name, reason, "bf16" if native else "no", detail)
    if precision not in ("no", "bf16", "fp16"):
        raise UsageError(f"precision {precision!r} is unknown; use auto, no, bf16 or fp16")
    if precision == "fp16" and name == "cpu":
        raise UsageError("precision 'fp16' needs a GPU; use bf16 or no on the CPU")
    why = "as requested" if precision != "bf16" or native else f"as requested, though {detail}"
    return ComputeChoice(name, reason, precision, why)  # type: ignore[arg-type]


_named = os.environ.get("OMP_NUM_THREADS", "").partition(",")[0]
_chosen_threads: int | None = int(_named) if _named.isdigit() else None


def set_threads(threads: int | None) -> int:
    """Set the CPU threads and return how many there are.

    On a machine that others use too, one thread can be faster than two.
    """
    from .tensors import torch, torch_is_here

    global _chosen_threads
    if threads is not None:
        _chosen_threads = threads
        if torch_is_here:
            torch.set_num_threads(threads)
    return _num_threads()


def _num_threads() -> int:
    from .tensors import torch, torch_is_here

    if torch_is_here:
        return torch.get_num_threads()
    return _chosen_threads or os.cpu_count() or 1


_within = threading.local()  # of a thread: its `depth` in idle_threads


@contextmanager
def idle_threads(most: int | None = None) -> Iterator[None]:
    """Inside, torch takes no more CPU threads than cores are idle when the outermost begins, unless
    someone chose a number, and never more than `most`.

    Threads that share out small operations wait for each other by spinning: one that has lost its
    core to another process makes all of them twenty times slower (docs/experiments.md, section 6).
    """
    from .tensors import torch, torch_is_here

    before, depth = _num_threads(), getattr(_within, "depth", 0)
    if torch_is_here and _chosen_threads is None and not depth:  # once, by the outermost
        idle = max(idle_cores() for _ in range(READINGS))
        torch.set_num_threads(max(1, min(before, idle)))
    if torch_is_here and most is not None:
        torch.set_num_threads(min(most, torch.get_num_threads()))
    try:
        _within.depth = depth + 1
        yield
    finally:
        _within.depth -= 1
        if torch_is_here:
            torch.set_num_threads(before)


def sampling_threads() -> int:
    """Threads for a network that keeps those it starts with; see `idle_threads`."""
    return _chosen_threads or max(1, min(_num_threads(), idle_cores()))


def idle_cores() -> int:
    """Cores that no other process uses at this moment; all of them where nobody can tell."""
    cores = os.cpu_count() or 1
    try:
        running = int(Path("/proc/loadavg").read_text().split()[3].partition("/")[0])
        states = [task.read_text().rpartition(")")[2].split()[0]
                  for task in Path("/proc/self/task").glob("*/stat")]  # fmt: skip
    except (OSError, ValueError, IndexError):  # no Linux, or a thread that has just ended
        return cores
    return cores - (running - states.count("R"))


def autocast(compute: ComputeChoice) -> "torch.autocast":
    """A context in which a frozen model computes in the chosen precision."""
    from .tensors import torch

    dtype = {"no": torch.float32, "bf16": torch.bfloat16, "fp16": torch.float16}[compute.precision]
    return torch.autocast(compute.device, dtype, enabled=compute.precision != "no")
