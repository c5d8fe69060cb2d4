"""Whether a short training run has learned: figures that move early, each beside chance, with 95%.

python -m benchmarks.short_runs text --data PREPARED --models FOLDER,FOLDER [--num 256]
python -m benchmarks.short_runs audio --data PAIRS --models FOLDER,FOLDER [--num 8]

text: R@3 of motions for the captions of `num` held-back clips of seen combinations (the shipped
judge, batches of 32), of the same motions under shuffled captions, and of the clips themselves;
jerk of both. audio: the error of the motion that the network finds in noise (z-scores, squared,
high and middle noise), hearing the window's own sound, that of seven other phrases, or none:
`num` windows of each held-back phrase, differences phrase by phrase; and how often another phrase's
sound fits worse than its own, which is half of the time if the network does not hear.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import torch

from src.shared.data.phrases.dataset import MotionPhraseDataset, collate
from src.shared.data.prepared import PreparedData
from src.shared.evaluation.samples import Clips, real_clips
from src.shared.evaluation.stats import Estimate, bootstrap_mean, paired_bootstrap
from src.shared.metrics.physical import mean_jerk
from src.shared.metrics.retrieval import guo_retrieval
from src.shared.model.audio import with_phase_rows
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.evaluator import Evaluator, evaluator_folder
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.motion.motion import Motion

FPS = 30
OTHERS = 7  # phrases whose sound is heard in place of a phrase's own


def shown(found: Estimate) -> str:
    """Value and interval."""
    return f"{found.value:.3f} [{found.low:.3f}, {found.high:.3f}]"


def text(data: str, models: list[str], num: int) -> Iterator[str]:
    """A line for the clips and for each model."""
    prepared = PreparedData.open(data)
    made = [TextToMotion.from_pretrained(folder, device="cpu") for folder in models]
    frames = min(round(model.card.max_seconds * FPS) for model in made)
    clips = real_clips(prepared, prepared.records("test_seen"), num=num, max_frames=frames)
    judge = Evaluator.from_pretrained(evaluator_folder("evaluator"))
    captions = judge.embed_text(clips.captions).numpy()
    yield _scored("held-back clips", clips.motions, clips, judge, captions)
    seconds = [motion.seconds for motion in clips.motions]
    for folder, model in zip(models, made, strict=True):
        motions = model.generate(clips.captions, seconds=seconds)
        yield _scored(Path(folder).name, motions, clips, judge, captions)


def _scored(
    name: str, motions: list[Motion], clips: Clips, judge: Evaluator, captions: np.ndarray
) -> str:
    embedded, equal = judge.embed_motion(motions).numpy(), (clips.groups, clips.captions)
    own = guo_retrieval(captions, embedded, equal)[2]
    order = np.random.default_rng(1).permutation(len(motions))
    chance = guo_retrieval(captions, embedded[order], equal)[2]
    jerk = bootstrap_mean([mean_jerk(motion.positions(), motion.fps) for motion in motions])
    told = f"R@3 {shown(bootstrap_mean(own))}, shuffled {shown(bootstrap_mean(chance))}"
    return f"{name}: {told}, jerk {shown(jerk)} m/s^3, N {len(own)}"


@torch.no_grad()
def audio(data: str, models: list[str], num: int) -> Iterator[str]:
    """A line for each model."""
    for folder in models:
        model = AudioMotionModel.from_pretrained(folder).eval()
        found = np.concatenate([_errors(model, data, split, num) for split in ("val", "test")])
        own, other, none, worse = found.T
        yield (
            f"{Path(folder).name}: own sound {shown(bootstrap_mean(own))}, another's"
            f" {shown(bootstrap_mean(other))}, none {shown(bootstrap_mean(none))};"
            f" another's above own {shown(paired_bootstrap(own, other))},"
            f" another's fits worse {shown(bootstrap_mean(worse))}, by chance 0.5"
            f"; N {len(own)} phrases"
        )


def _errors(model: AudioMotionModel, data: str, split: str, num: int) -> np.ndarray:
    """Means over its windows of each phrase [N, 4]: errors with its own sound, other phrases' and
    none, and the share of the others that fit worse (alike: half)."""
    phrases = MotionPhraseDataset(data, split=split, target_frames=model.config.window)
    steps, draws = model.diffusion.config.timesteps, torch.Generator().manual_seed(0)
    sums = np.zeros((len(phrases), 4))
    for window in range(num):
        items = [phrases.item(index, window) for index in range(len(phrases))]
        batch = collate([item for item in items if item is not None])
        assert len(batch) == len(phrases)
        clean = model.normalise(batch.motion) * batch.mask[:, None]
        noise = torch.randn(clean.shape, generator=draws)
        timesteps = torch.randint(steps // 3, steps, (len(clean),), generator=draws)
        sound = with_phase_rows(batch.audio)
        for row in range(len(clean)):
            others = [(row + step) % len(sound) for step in range(1, min(OTHERS + 1, len(sound)))]
            heard = sound[[row, *others, row]]
            at, length = timesteps[row].expand(len(heard)), int(batch.mask[row].sum())
            x_0, unknown = (each[row].expand(len(heard), -1, -1) for each in (clean, noise))
            noisy = model.diffusion.q_sample(x_0, at, unknown)
            silent = torch.arange(len(heard)) > len(others)
            output = model.unet(noisy, at, heard, silent, None)
            errors = (model.diffusion.predict_x0(output, noisy, at) - x_0).square()
            own, *rest, none = errors[..., :length].mean((1, 2)).tolist()
            worse = (1 + np.sign(np.array(rest) - own)) / 2  # alike: half
            sums[row] += own, np.mean(rest), none, worse.mean()
    return sums / num


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("branch", choices=("text", "audio"))
    parser.add_argument("--data", required=True)
    parser.add_argument("--models", required=True)
    parser.add_argument("--num", type=int)
    given = parser.parse_args()
    models = given.models.split(",")
    lines = (
        text(given.data, models, given.num or 256)
        if given.branch == "text"
        else audio(given.data, models, given.num or 8)
    )
    for line in lines:
        print(line, flush=True)


if __name__ == "__main__":
    main()
