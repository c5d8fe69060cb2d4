"""Opening the phrases of an audio stage, with the errors a user can act on."""

from src.shared.config_schema import TrainConfig
from src.shared.data.phrases.dataset import MotionPhraseDataset
from src.shared.errors import UsageError


def open_phrases(config: TrainConfig, split: str, num_phrases: int | None) -> MotionPhraseDataset:
    """One split of the folder or bucket that `data` names.

    Raises:
        UsageError: there is no default data; UserError: it cannot be read.
    """
    if config.data == "synthetic":
        raise UsageError(
            "data is missing: give --data DIR_OR_URL; make it with"
            " `motion-tools prepare-audio --motion synthetic --music synthetic:100 --out DIR`"
        )
    frames = getattr(config, "target_frames")  # noqa: B009 - every audio stage has it
    return MotionPhraseDataset(
        config.data,
        num_phrases=num_phrases,
        target_frames=frames,
        split=split,
        seed=config.seed,
    )
