"""`evaluate-sanity`: do motions for unheard audio hold together, and move as people do?

The rows are what the decoder gave, neither clamped nor made coherent, nor joined or derived anew.
Real motion, a frozen one and an untrained model stand beside them; the last two must fail.

Letters: B windows, T frames, C rows of sound.
"""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional as F

from ..errors import UserError
from ..metrics.bands import Bands
from ..metrics.sanity import SEVEN, SanityChecker, frozen, sanity_row
from ..model.audio.audio_motion_model import AudioMotionModel
from ..model.audio.conditioning import BEAT, CONDITION_ROWS
from ..model.diffusion.noise import sample_generators, standard_normal
from ..model.diffusion.samplers import make_sampler
from ..motion.trajectory import MotionTrajectory
from ..pipelines.song_sampler import SPARE
from .audio_songs import (
    TEMPI,
    conditions_of_songs,
    open_split,
    phrases,
)
from .stats import success_rate

Progress = Callable[[str], None]
BATCH = 10
PASS_SHARE = 0.95  # of samples, all seven checks
FREE = ("mean_speed", "path_rate", "turning")  # the figures that the issue names


@dataclass(frozen=True)
class SanitySettings:
    """How much is measured; the report repeats it."""

    num_samples: int = 100
    num_frames: int = 120
    num_steps: int = 20
    max_training: int = 1000  # windows behind the bands
    seed: int = 0


@dataclass(eq=False)
class SanityEvaluation:
    """The report as plain data, the motions by row, and the bands of training motions."""

    report: dict[str, Any]
    motions: dict[str, list[MotionTrajectory]]
    bands: Bands | None


def evaluate_sanity(
    model: AudioMotionModel,
    *,
    data: str | None = None,
    bands: Bands | None = None,
    settings: SanitySettings | None = None,
    about: dict[str, Any] | None = None,
    progress: Progress = lambda text: None,
) -> SanityEvaluation:
    """Sample, check, compare.

    Args:
        model: trained, on the device to use.
        data: folder or bucket of pairs: its test split's sound is what is danced to, its training
            split gives the bands, at the same number of frames. None = held-out synthetic songs.
        bands: of training motions, where there is no data.
        settings: see `SanitySettings`.
        about: what to repeat in the report.
        progress: told what begins.

    Raises:
        UserError: the data cannot be used.
    """
    settings, started = settings or SanitySettings(), time.perf_counter()
    facts: dict[str, Any] = {}
    real: list[MotionTrajectory] = []
    progress("sound that training never saw")
    if data is None:
        conditions = conditions_of_songs(settings.num_samples, settings.num_frames, settings.seed)
        facts["sound"] = f"held-out synthetic songs, tempi {TEMPI} BPM"
    else:
        conditions, real, bands, found = _from_data(data, model, settings)
        facts |= found
    motions = {"generated": generate_raw(model, conditions, settings, progress)}
    few = conditions[: max(1, len(conditions) // 5)]
    motions["untrained"] = generate_raw(untrained(model, settings.seed), few, settings, progress)
    motions["frozen"] = [frozen(motion) for motion in real or motions["generated"]]
    if real:
        motions["real"] = real
    checker = SanityChecker(bands=bands)
    rows = {name: sanity_row(name, group, checker) for name, group in motions.items()}
    weights = model.card.weights
    report = {
        "about": {**(about or {}), "model_hash": weights.sha256[:12] if weights else "", **facts},
        "settings": asdict(settings),
        "rows": rows,
        "bands": None if bands is None else {k: asdict(b) for k, b in bands.bands.items()},
        "verdict": verdict(rows, bands),
        "seconds": round(time.perf_counter() - started, 1),
    }
    return SanityEvaluation(report, motions, bands)


def _from_data(
    data: str, model: AudioMotionModel, settings: SanitySettings
) -> tuple[list[Tensor], list[MotionTrajectory], Bands, dict[str, Any]]:
    """Sound and motion of test phrases, bands of training phrases, and what the hashes tell."""
    test = open_split(data, "test", settings.num_frames, settings.seed)
    train = open_split(data, "train", settings.num_frames, settings.seed)
    held_back = phrases(test, settings.num_samples, whole=True)
    if not held_back:
        raise UserError(
            f"{data}: no test phrase has {settings.num_frames} frames; ask for --num-frames fewer"
        )
    learned = phrases(train, settings.max_training, whole=True)
    bands = Bands.of(phrase.motion for phrase in learned)
    same = model.card.data == train.fingerprint
    facts = {
        "sound": f"test split of {data}",
        "held_out": "yes: the model was trained on this data's train split"
        if same
        else "unknown: the model was trained on other data than this train split",
        "test_phrases": len(held_back),
        "training_windows": len(learned),
        "data_hash": test.fingerprint[:12],
    }
    conditions = [phrase.audio for phrase in held_back]
    rounds = math.ceil(settings.num_samples / len(held_back))
    for draw in range(1, rounds):  # too few phrases: other windows of the same
        conditions += [p.audio for p in phrases(test, len(held_back), whole=True, draw=draw)]
    return conditions[: settings.num_samples], [p.motion for p in held_back], bands, facts


# ---------------------------------------------------------------- sampling


@torch.no_grad()
def generate_raw(
    model: AudioMotionModel,
    conditions: Sequence[Tensor],
    settings: SanitySettings,
    progress: Progress = lambda text: None,
) -> list[MotionTrajectory]:
    """One window [T,25] for each condition [C,T], as the decoder gives it.

    The window is as long as any that `generate` makes; what is beyond T is cut off. Sample i has
    noise of its own seed, whatever the batch.
    """
    device = model.mean.device
    sampler = make_sampler(model.diffusion, model.config.diffusion.sampler, settings.num_steps)
    draws = sample_generators(settings.seed, len(conditions))
    made: list[MotionTrajectory] = []
    for first in range(0, len(conditions), BATCH):
        progress(f"sample {first + 1} of {len(conditions)}")
        sound = torch.stack([_full(condition) for condition in conditions[first : first + BATCH]])
        size, _, frames = sound.shape
        length = max(frames + SPARE, model.config.window)  # as `generate` makes them
        padded = F.pad(sound, (0, length - frames), mode="replicate").to(device)
        own = draws[first : first + size]
        noise = standard_normal((size, len(model.mean), length), own, device=device)
        z = sampler.run(model.model_fn(padded), noise, generator=own)
        decoded = model.decode(z, _starts(sound).to(device))
        rows = decoded.trajectory[:, :frames].float().cpu().numpy()
        made += [MotionTrajectory(np.ascontiguousarray(row)) for row in rows]
    return made


def _full(condition: Tensor) -> Tensor:
    """Rows for beat and bar are zero, "unknown", where a condition lacks them."""
    return F.pad(condition.float(), (0, 0, 0, CONDITION_ROWS - len(condition)))


def _starts(sound: Tensor) -> Tensor:
    """Bar phase [B] of the first frame of sound [B,C,T]."""
    cosine, sine = sound[:, BEAT][:, 2:, 0].unbind(dim=1)
    return torch.remainder(torch.atan2(sine, cosine) / (2 * torch.pi), 1.0)


def untrained(model: AudioMotionModel, seed: int, *, still: bool = True) -> AudioMotionModel:
    """The same network with fresh weights but the trained one's row statistics: a floor.

    Its last layer is zero, as training begins: every motion stands still. Not `still`, that layer
    is random as well.
    """
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        fresh = AudioMotionModel(model.config)
        if not still:
            torch.nn.init.xavier_uniform_(fresh.unet.output_conv.get_parameter("weight"))
    fresh.set_statistics(model.mean.cpu(), model.std.cpu())
    return fresh.to(model.mean.device).eval()


# ---------------------------------------------------------------- verdict


def verdict(rows: dict[str, dict[str, Any]], bands: Bands | None) -> dict[str, Any]:
    """What must hold, by name: value and whether it does.

    Args:
        rows: of `sanity_row`, by name.
        bands: of training motions, if known.

    Returns:
        seven_checks: share of generated motions that pass all of the documents' checks, Wilson
        interval; whole_suite likewise; frozen_fails, untrained_fails: no such motion passes the
        suite; inside: for each of `FREE` the share of generated motions between p5 and p95, their
        mean, and whether that lies there.
    """
    generated = rows["generated"]
    seven = success_rate(generated["passed_seven"], generated["motions"]).as_dict()
    result: dict[str, Any] = {
        "checks": list(SEVEN),
        "seven_checks": seven | {"holds": seven["value"] >= PASS_SHARE},
        "whole_suite": success_rate(generated["passed"], generated["motions"]).as_dict(),
    }
    for name in ("frozen", "untrained"):
        result[f"{name}_fails"] = rows[name]["passed"] == 0
    result["inside"] = {} if bands is None else _inside(generated, bands)
    return result


def _inside(row: dict[str, Any], bands: Bands) -> dict[str, Any]:
    means = {name: row["checks"][f"band_{name}"]["mean"] for name in FREE}
    return {
        name: {
            "share": row["inside"][name],
            "mean": mean,
            "holds": mean is not None and bands.bands[name].holds(mean),
        }
        for name, mean in means.items()
    }
