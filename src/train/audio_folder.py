"""The audio model folder that a stage goes on from: its network, and changes to it."""

from collections.abc import Sequence
from pathlib import Path

from ..shared.config_audio import AudioNetworkConfig
from ..shared.config_loader import NETWORK_PREFIX, dump_config, load_config
from ..shared.errors import UsageError
from ..shared.model.audio.audio_motion_model import KIND
from ..shared.model.checkpoint import read_card
from ..shared.model.zoo import resolve_model, wrong_kind

DECODER_PREFIX = NETWORK_PREFIX + "decoder."


def network_of(
    name_or_folder: str | Path, overrides: Sequence[str] = (), *, of: str | None = None
) -> AudioNetworkConfig:
    """The network of a trained model.

    Args:
        name_or_folder: as `AudioMotionModel.from_pretrained` takes it.
        overrides: `network.decoder.…=…`; what is trained already cannot change.
        of: the flags that name it, where its decoder is trained, too.

    Raises:
        UserError: no audio model there.
        UsageError: an override of a trained part, an unknown key or a wrong value.
    """
    folder = resolve_model(name_or_folder)
    card = read_card(folder)
    if card.kind != KIND or card.audio_network is None:
        raise wrong_kind(folder, card.kind, KIND)
    for override in overrides:
        if of is not None:
            raise UsageError(f"{override}: the network is that of {of}; leave it out")
        if not override.startswith(DECODER_PREFIX):
            raise UsageError(
                f"{override}: the network is that of {folder}; only {DECODER_PREFIX}* can change"
                "; leave the rest out"
            )
    values = dump_config(card.audio_network)
    return load_config(AudioNetworkConfig, values, str(folder), overrides, prefix=NETWORK_PREFIX)
