"""Configurations of the audio branch's networks: UNet1D, AudioConditioner, decoders."""

from typing import ClassVar, Literal, Self

from pydantic import Field, model_validator

from .config_schema import Config, DiffusionConfig, Printed, TrainConfig, only
from .environment import DATA_DIR, DECODER_CHECKPOINT, DIFFUSION_CHECKPOINT

NORM_GROUPS = 32  # of every GroupNorm in UNet1D (TECH 3.1.3)


class MemoryConditionConfig(Config):
    """What UNet1D needs to take a memory: ContextTransformer, MPMSConditioner (REF, ruling 26)."""

    context_dim: int = Field(256, ge=1)  # of retrieved contexts
    prior_dim: int = Field(64, ge=1)  # channels of the encoded prior curves
    patch: int = Field(6, ge=1)  # frames of a piece that the transformer sees
    width: int = Field(128, ge=4)
    num_layers: int = Field(2, ge=1)
    num_heads: int = Field(4, ge=1)
    dropout: float = Field(0.1, ge=0, lt=1)

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.width % (2 * self.num_heads):
            raise ValueError(
                f"width {self.width} must be a multiple of {2 * self.num_heads}, twice the heads"
            )
        return self


class UNetConfig(Config):
    """UNet1D (TECH 3.1.1, REF); attention-resolutions are downsampling factors (ruling 4)."""

    printed: ClassVar = {"audio-cond-dim": only(163, "beats and bars add four rows")}
    in_channels: int = Field(25, ge=1)
    out_channels: int = Field(25, ge=1)
    model_channels: int = Field(192, ge=NORM_GROUPS)
    channel_mult: tuple[int, ...] = Field((1, 2, 4, 8), min_length=1)
    num_res_blocks: int = Field(2, ge=1)
    attention_resolutions: tuple[int, ...] = (2, 4, 8)
    num_heads: int = Field(8, ge=1)
    num_head_channels: int | None = Field(64, ge=2)  # instead of num-heads, when given
    conditioning: Literal["cross-attention", "film", "both"] = "both"  # ruling 2
    use_scale_shift_norm: bool = True  # false: REF's additive time embedding
    downsample_last: bool = False  # REF halves once more before its middle, TECH does not
    time_embed_dim: int = Field(256, ge=2)
    context_dim: int = Field(256, ge=1)
    rotary: bool = True  # relative positions in frames inside both attentions
    dropout: float = Field(0.1, ge=0, lt=1)
    use_checkpoint: bool = False  # recompute activations in the backward pass, to save memory
    memory: MemoryConditionConfig | None = None  # None: takes no memory; train_memory adds it

    @property
    def channels(self) -> tuple[int, ...]:
        """Channels of each level, finest first."""
        return tuple(self.model_channels * factor for factor in self.channel_mult)

    @property
    def factors(self) -> tuple[int, ...]:
        """Downsampling factor of each level, finest first; the middle's comes last."""
        levels = [2**level for level in range(len(self.channel_mult))]
        return (*levels, levels[-1] * (2 if self.downsample_last else 1))

    def heads(self, channels: int) -> int:
        """Attention heads at that width."""
        if self.num_head_channels is None:
            return self.num_heads
        return max(channels // self.num_head_channels, 1)

    @model_validator(mode="after")
    def _check(self) -> Self:
        for channels in self.channels:
            if channels % NORM_GROUPS:
                raise ValueError(f"{channels} channels: must be a multiple of {NORM_GROUPS}")
            heads = self.heads(channels)
            if channels % heads or (self.rotary and channels // heads % 2):
                raise ValueError(
                    f"{heads} heads must divide {channels} channels into even parts; change"
                    " num-heads or num-head-channels"
                )
        for factor in self.attention_resolutions:
            if factor not in self.factors:
                raise ValueError(
                    f"attention-resolutions: {factor} is no downsampling factor of this network;"
                    f" there are {', '.join(map(str, sorted(set(self.factors))))}"
                )
        return self


class AugmentationConfig(Config):
    """What training does to the audio condition; sampling never does."""

    noise: float = Field(0.05, ge=0)  # standard deviation added to mel, chroma, mfcc, energies
    group_dropout: float = Field(0.1, ge=0, lt=1)  # each feature group zeroed for a whole window
    condition_dropout: float = Field(0.1, ge=0, lt=1)  # whole condition -> learned null, ruling 14


class AudioConditionConfig(Config):
    """AudioConditioner (REF) and its augmentation."""

    dim: int = Field(256, ge=4, multiple_of=4)  # channels it hands to FiLM
    augmentation: AugmentationConfig = AugmentationConfig()


class DecoderConfig(Config):
    """Motion decoder (TECH 3.3.1, REF; rulings 5 to 10)."""

    printed: ClassVar = {
        "input-dim": only(25, "the rows of a trajectory"),
        "output-dim": only(25, "the rows of a trajectory"),
        "use-layer-norm": only(True, "batches of windows of one song are no sample to norm by"),
        "activation": only("gelu", "no other was compared; leave it out"),
        "output-activations": Printed(
            "", (), "output-activations: bounds are position-scale and the other scales; set those"
        ),
        "derive-velocity": only(True, "decoder: residual is the one that predicts it"),
        "derive-acceleration": only(True, "decoder: residual is the one that predicts it"),
    }
    decoder: Literal["residual", "derived"] = "derived"
    hidden_dim: int = Field(256, ge=1)
    num_layers: int = Field(3, ge=1)
    dropout: float = Field(0.1, ge=0, lt=1)  # of the residual decoder's blocks
    sees_gaps: bool = False  # residual: a frame sees how its derivatives miss its neighbours
    position_scale: float = Field(50.0, gt=0)  # m
    velocity_scale: float = Field(50.0, gt=0)  # m/s
    acceleration_scale: float = Field(100.0, gt=0)  # m/s^2
    angular_velocity_scale: float = Field(10.0, gt=0)  # rad/s
    fps: float = Field(30.0, gt=0)


class PostProcessConfig(Config):
    """What happens to a path before it is written, TECH §9.1's names and defaults.

    The phase is wrapped into its range (ruling 118); signs of quaternions are continuous.
    """

    normalize_quaternions: bool = True
    quat_eps: float = Field(1e-8, gt=0)  # below this norm there is no rotation: the identity
    smooth_quaternions: bool = False  # moving average, normalised again
    quat_smooth_window: int = Field(5, ge=1)  # frames, odd
    clamp_phase: bool = True  # wrap it into [phase-min, phase-max)
    phase_min: float = 0.0
    phase_max: float = 1.0
    enforce_phase_monotonic: bool = False  # hold the unwrapped phase where it would step back
    clamp_values: bool = True  # limit each component to ± the four maxima
    max_position: float = Field(100.0, gt=0)  # m
    max_velocity: float = Field(50.0, gt=0)  # m/s
    max_acceleration: float = Field(100.0, gt=0)  # m/s^2
    max_angular_velocity: float = Field(10.0, gt=0)  # rad/s
    enforce_velocity_coherence: bool = False  # blend the velocity with the position's difference
    enforce_accel_coherence: bool = False  # blend the acceleration with the velocity's difference
    coherence_blend: float = Field(0.5, ge=0, le=1)  # how far; TECH blends halves
    apply_smoothing: bool = False  # binomial average of all columns but the quaternion
    smoothing_kernel_size: int = Field(3, ge=1)  # frames, odd
    fps: float = Field(30.0, gt=0)

    @model_validator(mode="after")
    def _check(self) -> Self:
        for name in ("quat_smooth_window", "smoothing_kernel_size"):
            if getattr(self, name) % 2 == 0:
                raise ValueError(f"{name.replace('_', '-')} {getattr(self, name)} must be odd")
        if not self.phase_min < self.phase_max:
            raise ValueError(f"phase-max {self.phase_max} must be above phase-min {self.phase_min}")
        return self


class AudioNetworkConfig(Config):
    """One profile of audio_network.yaml."""

    unet: UNetConfig = UNetConfig()
    condition: AudioConditionConfig = AudioConditionConfig()
    decoder: DecoderConfig = DecoderConfig()
    diffusion: DiffusionConfig = DiffusionConfig()
    window: int = Field(180, ge=16)  # frames of a window, as training saw and sampling makes them
    guidance_scale: float = Field(1.0, ge=0)  # 1 = none, and no second forward (ruling 14)
    post_processing: PostProcessConfig = PostProcessConfig()


class DecoderLossConfig(Config):
    """Weights of the decoder's reconstruction terms; 0 = off. Raw units, squared."""

    position_weight: float = Field(1.0, ge=0)  # m
    velocity_weight: float = Field(0.1, ge=0)  # m/s
    acceleration_weight: float = Field(0.001, ge=0)  # m/s^2
    quaternion_weight: float = Field(1.0, ge=0)
    angular_velocity_weight: float = Field(0.05, ge=0)  # rad/s
    phase_weight: float = Field(1.0, ge=0)  # bars, on the circle
    style_weight: float = Field(0.1, ge=0)


class TemporalLossConfig(Config):
    """Weights and scales of the temporal coherence terms (TECH 7.2, 14.1; rulings 16, 23)."""

    velocity_weight: float = Field(10.0, ge=0)
    acceleration_weight: float = Field(5.0, ge=0)
    jerk_weight: float = Field(1.0, ge=0)
    quat_delta_weight: float = Field(2.0, ge=0)
    phase_monotonic_weight: float = Field(1.0, ge=0)
    smoothness_weight: float = Field(1.0, ge=0)
    target_jerk: float = Field(50_000.0, gt=0)  # m/s^3
    target_vel_coherence: float = Field(5.0, gt=0)  # m/s
    target_accel_coherence: float = Field(50.0, gt=0)  # m/s^2; TECH prints 100 and 50
    target_quat_delta: float = Field(0.95, gt=0, le=1)  # dot of neighbours
    max_step: float = Field(0.5, gt=0)  # m a frame and axis, free of charge
    fps: float = Field(30.0, gt=0)


class AudioTowerConfig(Config):
    """AudioTower's sizes; `embed-dim` is that of the motion tower it learns from."""

    embed_dim: int = Field(192, ge=8)
    dim: int = Field(160, ge=8)  # channels inside
    num_heads: int = Field(4, ge=1)
    num_layers: int = Field(2, ge=1)
    dropout: float = Field(0.1, ge=0, lt=1)
    augmentation: AugmentationConfig = AugmentationConfig()  # what training does to the sound

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.dim % self.num_heads:
            raise ValueError(f"num-heads {self.num_heads} must divide dim {self.dim}")
        return self


class MemoryConfig(Config):
    """Settings of `MPMService` and `memory build` (memory.yaml)."""

    folder: str = ""  # or address, that `memory build` wrote
    bars: int = Field(2, ge=1)  # length of a phrase
    min_frames: int = Field(24, ge=8)  # shorter rests at the ends of a song are left out
    top_k: int = Field(8, ge=1)
    temperature: float = Field(0.07, gt=0)  # of the softmax over similarities of the hits
    key: Literal["audio", "motion"] = "audio"  # which side of a phrase is compared with the query
    phase_weight: float = Field(0.1, ge=0)  # similarity that a phrase half a bar off loses
    deadline: float = Field(2.0, gt=0)  # seconds after which a query is answered by "nothing"
    workers: int = Field(4, ge=1)  # threads that search
    library_above: int = Field(50_000, ge=0)  # phrases; beyond, search by library if installed


class PhraseConfig(TrainConfig):
    """What every audio stage shares."""

    variables: ClassVar = {"data": DATA_DIR}
    target_frames: int = Field(180, ge=16)  # of a window; sampling makes windows of this length
    num_phrases: int | None = Field(None, ge=1)  # take only the first so many


class TrainAudioConfig(PhraseConfig):
    """train_audio.yaml."""

    init: str | None = None  # a trained model, by name or folder, to go on from
    velocity_weight: float = Field(1.0, ge=0)  # of the error of frame differences, m/s
    prefix_share: float = Field(0.5, ge=0, le=1)  # windows whose first frames are known
    prefix_frames: tuple[int, int] = (8, 60)  # how many, at least and at most
    style_share: float = Field(0.5, ge=0, le=1)  # windows whose style is known


class TrainDecoderConfig(PhraseConfig):
    """train_decoder.yaml."""

    variables: ClassVar = PhraseConfig.variables | {"audio": DIFFUSION_CHECKPOINT}
    audio: str = "runs/audio"  # folder written by train_audio
    noise: tuple[float, float] = (0.03, 1.0)  # least and most, times the UNet's error
    correlation: tuple[float, float] = (1.0, 30.0)  # frames, least and most, of correlated noise
    start_weight: float = Field(0.1, ge=0)  # of the guessed first bar phase
    losses: DecoderLossConfig = DecoderLossConfig()

    @model_validator(mode="after")
    def _check_limits(self) -> Self:
        for key, (low, high) in (("noise", self.noise), ("correlation", self.correlation)):
            if not 0 < low <= high:
                raise ValueError(f"{key} [{low}, {high}] must be two numbers above 0, least first")
        return self


class TrainMemoryConfig(TrainAudioConfig):
    """train_memory.yaml."""

    variables: ClassVar = TrainAudioConfig.variables | {"audio": DIFFUSION_CHECKPOINT}
    audio: str = "starter-audio"  # the model that learns
    space: str = ""  # where the memory's shared space is now; "" = where it was built with
    memory: MemoryConfig = MemoryConfig()
    part: MemoryConditionConfig = MemoryConditionConfig()  # sizes of what is added
    memory_dropout: float = Field(0.1, ge=0, lt=1)  # windows that remember nothing
    base_learning_rate: float = Field(0.0, ge=0)  # of what was there before; 0 = it rests


class TrainAudioTowerConfig(PhraseConfig):
    """train_audio_tower.yaml."""

    clip: str = "runs/clip"  # folder written by train_clip
    tower: AudioTowerConfig = AudioTowerConfig()  # its embed-dim is that of the CLIP model
    bars: int = Field(2, ge=1)  # of a window
    windows: int = Field(2, ge=1)  # of each phrase in a batch
    copies: int = Field(2, ge=0)  # of each phrase, faster or slower, sound and motion together
    stretch: float = Field(0.12, ge=0, lt=0.5)  # by how much at most
    temperature: float = Field(0.1, gt=0)  # start of the learned logit scale
    cosine_weight: float = Field(0.0, ge=0)


FROM_EPOCHS = ("steps", "log_every", "validate_every", "save_every", "learning_rate")


class FinetuneE2eConfig(TrainAudioConfig):
    """finetune_e2e.yaml."""

    variables: ClassVar = TrainAudioConfig.variables | {
        "checkpoint": DIFFUSION_CHECKPOINT, "decoder-checkpoint": DECODER_CHECKPOINT
    }  # fmt: skip
    printed: ClassVar = TrainAudioConfig.printed | {"num-epochs": Printed("epochs")}
    checkpoint: str = "runs/decoder"  # folder of train_decoder or train_audio: the UNet
    decoder_checkpoint: str | None = None  # folder whose decoder is taken; None = the same
    epochs: int = Field(50, ge=1)  # passes over the phrases
    patience: int = Field(10, ge=1)  # epochs without a better validation total
    lr_diffusion: float = Field(1e-6, gt=0)
    lr_decoder: float = Field(5e-5, gt=0)
    diffusion_weight: float = Field(0.1, ge=0)
    decoder_weight: float = Field(1.0, ge=0)
    temporal_weight: float = Field(10.0, ge=0)
    ddim_steps: int = Field(5, ge=1)  # of the sampler with gradients
    data_noise: float = Field(0.5, gt=0, le=1)  # ground truth is noised up to this share of steps
    losses: DecoderLossConfig = DecoderLossConfig()
    temporal: TemporalLossConfig = TemporalLossConfig()

    @model_validator(mode="after")
    def _check_steps(self) -> Self:
        for name in FROM_EPOCHS:
            if name in self.model_fields_set:
                instead = "lr-diffusion and lr-decoder" if name == "learning_rate" else "epochs"
                raise ValueError(f"{name.replace('_', '-')} has no place here; give {instead}")
        return self
