"""Fresh, untrained networks by kind and profile."""

from typing import TYPE_CHECKING

from ..config_loader import load_audio_network, load_network
from ..errors import UsageError

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
        from .clip.core import MotionClip

        return MotionClip(network)
    from .generation.denoiser import MotionDenoiser

    return MotionDenoiser(network, num_tags)


def _create_audio_model(kind: str, profile: str) -> "nn.Module":
    from .audio.audio_motion_model import AudioMotionModel
    from .audio.decoder import create_motion_decoder
    from .audio.unet import UNet1D

    network = load_audio_network(profile)
    if kind == "audio-unet":
        return UNet1D(network.unet, network.condition)
    if kind == "audio-decoder":
        return create_motion_decoder(network.decoder)
    return AudioMotionModel(network)
