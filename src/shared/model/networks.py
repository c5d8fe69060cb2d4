"""Fresh, untrained networks by kind and profile."""

from typing import TYPE_CHECKING

from src.shared.config_loader import load_audio_network, load_network
from src.shared.errors import UsageError

if TYPE_CHECKING:
    from torch import nn

KINDS = ("motion-denoiser", "motion-clip", "audio-unet", "audio-decoder", "audio-motion")


def create_model(kind: str, profile: str, *, num_tags: int = 0) -> "nn.Module":
    """A fresh, untrained network of a profile.

    Args:
        kind: motion-denoiser, motion-clip, audio-unet, audio-decoder or audio-motion (both).
        profile: a profile of network.yaml, or audio_network.yaml for the audio kinds.
        num_tags: action labels of the data, for the denoiser.

    Raises:
        UsageError: an unknown kind or profile.
    """
    if kind not in KINDS:
        raise UsageError(f"no model kind {kind!r}; choose from {', '.join(KINDS)}")
    if kind.startswith("audio-"):
        return _create_audio_model(kind, profile)
    network = load_network(profile)
    if kind == "motion-clip":
        from src.shared.model.clip.core import MotionClip

        return MotionClip(network)
    from src.shared.model.generation.denoiser import MotionDenoiser

    return MotionDenoiser(network, num_tags)


def _create_audio_model(kind: str, profile: str) -> "nn.Module":
    from src.shared.model.audio.audio_motion_model import AudioMotionModel
    from src.shared.model.audio.decoder import create_motion_decoder
    from src.shared.model.audio.unet import UNet1D

    network = load_audio_network(profile)
    if kind == "audio-unet":
        return UNet1D(network.unet, network.condition)
    if kind == "audio-decoder":
        return create_motion_decoder(network.decoder)
    return AudioMotionModel(network)
