"""What a GPU does is what the processor does: stages in bf16, and what ships.

Each test runs on the processor as well, which shows that it can pass.
"""

import math
from pathlib import Path

import numpy as np
import pytest
import torch
from test_several_processes import losses
from tiny_audio_stage import audio_config, train_audio
from tiny_stage import clip_config, generation_config, train_clip, train_generation

from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.model.diffusion import Sampling
from src.shared.pipelines.motion_generator import load

CUDA = pytest.param(
    "cuda",
    marks=[pytest.mark.gpu, pytest.mark.skipif(not torch.cuda.is_available(), reason="no CUDA")],
)
SETTINGS = ("steps=4", "log-every=1", "save-every=2", "lr-schedule=constant")


@pytest.mark.parametrize("device", [pytest.param("cpu", marks=pytest.mark.slow), CUDA])
def test_stages_train_in_bf16_and_go_on_elsewhere(
    device: str, circles: Path, prepared: Path, held_back: None, tmp_path: Path
) -> None:
    """Every loss is finite; what was trained here can be trained further on the processor."""
    clip = tmp_path / "towers"
    train_clip(clip_config(prepared, clip, "steps=2"))
    precision = "no" if device == "cpu" else "bf16"
    here = (f"device={device}", f"precision={precision}", *SETTINGS)
    for stage, train in {
        "clip": lambda *more, **how: train_clip(clip_config(prepared, *more), **how),
        "text": lambda out, *more, **how: train_generation(
            generation_config(prepared, clip, out, *more), **how
        ),
        "audio": lambda out, *more, **how: train_audio(audio_config(circles, out, *more), **how),
    }.items():
        whole = tmp_path / stage
        train(whole, *here)
        (whole / "model.safetensors").unlink()
        (whole / "finished.json").unlink()
        train(whole, f"precision={precision}", *SETTINGS, "steps=6", resume=True)
        told = losses(whole)
        assert len(told) == 6 and all(map(math.isfinite, told)), stage


@pytest.mark.parametrize("device", ["cpu", CUDA])
def test_what_ships_moves_alike(device: str, tmp_path: Path) -> None:
    """Noise comes from the processor: the same seed is the same motion, to a centimetre."""
    song, sampling = tmp_path / "song.wav", Sampling(seed=3)
    render_song(SongSpec(seconds=4.0, seed=1)).write_wav(song)
    made = []
    for where in ("cpu", device):
        generator = load("starter", device=where)
        [wave] = generator.generate("a person waves", seconds=2.0, sampling=sampling)
        dances = generator.dance(song, "a person dances", sampling=sampling, figures=False)
        [path] = generator.trajectory(song, sampling=sampling).trajectories
        made.append([wave.positions(), dances.ranked[0].motion.positions(), path.position])
    for one, other in zip(*made, strict=True):
        np.testing.assert_allclose(other, one, atol=0.01)
