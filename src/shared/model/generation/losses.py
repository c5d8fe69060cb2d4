"""What the denoiser is trained on (ruling 21): each term masked, computed only if its weight > 0.

All but the reconstruction look at the predicted clean motion, which only `prediction-type: sample`
gives at every step; with epsilon they weigh the noisiest steps out of proportion.

Letters: B batch, T frames, K joints, R = K + 1 rows with the root track.
"""

from collections.abc import Callable
from functools import cached_property

import torch
from torch import Tensor, nn

from ...config_schema import LossWeights
from ...errors import UsageError
from ...motion.features import HEIGHT, LEFT_CONTACT, ROOT_ROW, heading_joints, to_world
from ...motion.rotations import rotation_6d_to_matrix
from ...motion.skeleton import FOOT_JOINTS, NUM_JOINTS
from ..diffusion import GaussianDiffusion

NEED_ROOT_TRACK = ("root", "foot_contact", "foot_slide")
LEAST_MOVED = 1e-3  # mean square about the mean pose, z-scored, below which a clip stands still


class GenerationLoss(nn.Module):
    """Weighted sum of the losses of one noised batch.

    Args:
        weights: 0 switches a term off.
        diffusion: knows the network's target and what motion an output stands for.
        mean: [R, 6] of the training data, to leave z-scores.
        std: [R, 6].
        fps: frames per second of the data.

    Raises:
        UsageError: a foot term is on, yet the motion has no root track.
    """

    mean: Tensor
    std: Tensor

    def __init__(
        self,
        weights: LossWeights,
        diffusion: GaussianDiffusion,
        mean: Tensor,
        std: Tensor,
        *,
        fps: float = 30.0,
    ) -> None:
        super().__init__()
        for key in NEED_ROOT_TRACK:
            if getattr(weights, key) > 0 and len(mean) <= ROOT_ROW:
                name = key.replace("_", "-")
                raise UsageError(f"losses.{name} needs root-track: true; set it to 0 or turn it on")
        self.weights = weights
        self.diffusion = diffusion
        self.fps = fps
        self.register_buffer("mean", mean, persistent=False)
        self.register_buffer("std", std, persistent=False)

    def forward(
        self,
        output: Tensor,
        clean: Tensor,
        noisy: Tensor,
        noise: Tensor,
        timesteps: Tensor,
        mask: Tensor | None = None,
    ) -> dict[str, Tensor]:
        """The terms that are on, and their weighted sum as `loss`; all scalars.

        Args:
            output: what the denoiser returned, [B, T, R, 6].
            clean: z-scored motion [B, T, R, 6].
            noisy: `q_sample(clean, timesteps, noise)`.
            noise: what was mixed in, [B, T, R, 6].
            timesteps: [B].
            mask: [B, T] bool, True = real frame; None = all.
        """
        if mask is None:
            mask = torch.ones(clean.shape[:2], dtype=torch.bool, device=clean.device)
        terms = {}
        with torch.autocast(clean.device.type, enabled=False):  # metres do not fit into bf16
            output = output.float()
            if self.weights.reconstruction > 0:
                target = self.diffusion.target(clean, noise, timesteps)
                terms["reconstruction"] = self.diffusion.loss(output, target, mask=mask)
            active = {name: term for name, term in TERMS.items() if getattr(self.weights, name) > 0}
            if active:
                # Limiting what is the output itself would only stop its gradient.
                clip = self.diffusion.config.prediction_type != "sample"
                predicted = self.diffusion.predict_x0(output, noisy, timesteps, clip=clip)
                motions = Motions(predicted, clean, mask, self)
                terms |= {name: term(motions) for name, term in active.items()}
            total = sum(getattr(self.weights, name) * value for name, value in terms.items())
        return {"loss": torch.as_tensor(total, device=clean.device), **terms}


class RawMotion:
    """One side, predicted or true, out of z-scores; what several losses need is made once."""

    def __init__(self, features: Tensor, owner: GenerationLoss) -> None:
        self.features = features * owner.std + owner.mean  # [B, T, R, 6]

    @cached_property
    def rotations(self) -> Tensor:
        """Local rotations [B, T, K, 3, 3]."""
        return rotation_6d_to_matrix(self.features[..., :NUM_JOINTS, :])

    @cached_property
    def joints(self) -> Tensor:
        """Joints [B, T, K, 3] in the heading frame, pelvis over the origin, metres."""
        rooted = self.features.shape[2] > ROOT_ROW
        height = self.features[..., ROOT_ROW, HEIGHT] if rooted else self.features.new_zeros(1)
        return heading_joints(self.rotations, height.expand(self.features.shape[:2]))


class Motions:
    """Predicted and true motion [B, T, R, 6], z-scored and raw, with their mask [B, T]."""

    def __init__(self, predicted: Tensor, true: Tensor, mask: Tensor, owner: GenerationLoss):
        self.predicted, self.true, self.mask = predicted, true, mask
        self.raw_predicted = RawMotion(predicted, owner)
        self.raw_true = RawMotion(true, owner)
        self.fps = owner.fps


def masked_frames_mean(values: Tensor, mask: Tensor) -> Tensor:
    """Mean over the real frames: values [B, T, ...], mask [B, T] bool -> scalar."""
    weights = mask.view(*mask.shape, *(1,) * (values.ndim - 2))
    per_frame = values[0, 0].numel()
    return (values * weights).sum() / (mask.sum() * per_frame).clamp_min(1)


def velocity_loss(motions: Motions) -> Tensor:
    """MSE of frame differences, z-scored (Tevet et al. 2023, MDM, equation 5)."""
    error = motions.predicted - motions.true
    pairs = motions.mask[:, 1:] & motions.mask[:, :-1]
    return masked_frames_mean((error[:, 1:] - error[:, :-1]).square(), pairs)


def root_loss(motions: Motions) -> Tensor:
    """MSE of the root row, z-scored: of 23 rows alike, the one that says how fast and whither."""
    error = (motions.predicted - motions.true)[:, :, ROOT_ROW]
    return masked_frames_mean(error.square(), motions.mask)


def movement_loss(motions: Motions) -> Tensor:
    """Squared error of what a clip moves about its mean pose, z-scored, as a share of that; mean
    over the clips [B]. A nod weighs as much as a jump, which is all that a mean of squares sees."""
    real = motions.mask[:, :, None, None]
    frames = real.sum(1, keepdim=True).clamp_min(1)

    def moved(motion: Tensor) -> Tensor:
        about = motion - (motion * real).sum(1, keepdim=True) / frames
        return (about * real).square().sum((1, 2, 3))  # [B]

    least = LEAST_MOVED * frames.flatten() * motions.true[0, 0].numel()
    missed = moved(motions.predicted - motions.true)
    return (missed / moved(motions.true).clamp_min(least)).mean()


def geodesic_loss(motions: Motions) -> Tensor:
    """Mean angle in radians between predicted and true local rotations."""
    predicted, true = motions.raw_predicted.rotations, motions.raw_true.rotations
    trace = (predicted * true).sum(dim=(-1, -2))  # trace(P' Q)
    cosine = ((trace - 1) / 2).clamp(-1 + 1e-6, 1 - 1e-6)  # acos has no gradient at its ends
    return masked_frames_mean(cosine.acos(), motions.mask)


def position_loss(motions: Motions) -> Tensor:
    """Mean squared joint distance per axis in m^2, heading frame (MDM, equation 3)."""
    error = motions.raw_predicted.joints - motions.raw_true.joints
    return masked_frames_mean(error.square(), motions.mask)


def foot_contact_loss(motions: Motions) -> Tensor:
    """MSE of the two contact channels on their raw 0 ... 1 scale."""
    error = motions.raw_predicted.features - motions.raw_true.features
    return masked_frames_mean(error[:, :, ROOT_ROW, LEFT_CONTACT:].square(), motions.mask)


def foot_slide_loss(motions: Motions) -> Tensor:
    """Mean squared world speed (m/s)^2 of feet that truly stand (MDM, equation 4)."""
    joints = motions.raw_predicted.joints
    balls = torch.stack([joints[:, :, ball] for _, ball in FOOT_JOINTS], 2)  # [B, T, 2, 3]
    root = motions.raw_predicted.features[:, :, ROOT_ROW]  # [B, T, 6]
    world = to_world(balls, root, motions.fps)  # [B, T, 2, 3]
    speed = (world[:, 1:] - world[:, :-1]) * motions.fps  # [B, T-1, 2, 3]
    stands = motions.raw_true.features[:, :, ROOT_ROW, LEFT_CONTACT:] > 0.5  # [B, T, 2]
    pairs = motions.mask[:, 1:, None] & stands[:, 1:] & stands[:, :-1]  # [B, T-1, 2]
    return (speed.square().sum(dim=-1) * pairs).sum() / pairs.sum().clamp_min(1)


TERMS: dict[str, Callable[[Motions], Tensor]] = {  # beside the reconstruction
    "velocity": velocity_loss,
    "root": root_loss,
    "movement": movement_loss,
    "geodesic": geodesic_loss,
    "position": position_loss,
    "foot_contact": foot_contact_loss,
    "foot_slide": foot_slide_loss,
}
