"""Typed, frozen configurations: one line a field; YAML spells the keys in kebab-case."""

from collections.abc import Mapping
from typing import Any, ClassVar, Literal, NamedTuple, Self, get_args

from pydantic import BaseModel, ConfigDict, Field, model_validator

Precision = Literal["auto", "no", "bf16", "fp16"]
Provenance = Literal["captured", "procedural", "hand-made"]  # where a clip's motion comes from
PROVENANCES: tuple[Provenance, ...] = get_args(Provenance)


def _kebab(name: str) -> str:
    return name.replace("_", "-")


class Printed(NamedTuple):
    """How a setting that the documents print is read here (docs/rulings.md, 119).

    Attributes:
        key: ours for it; empty = it is no setting here.
        values: pairs of a printed value and ours; None = any value, as it is.
        why: no other value is taken, and what to do.
    """

    key: str = ""
    values: tuple[tuple[Any, Any], ...] | None = None
    why: str = ""


def only(value: Any, why: str) -> Printed:
    """No setting here: the printed value is what there is."""
    return Printed("", ((value, None),), why)


class Config(BaseModel):
    """Base of every configuration: frozen, strict about keys, kebab-case in YAML.

    Attributes:
        printed: keys of the documents that are not ours, in kebab-case.
    """

    printed: ClassVar[Mapping[str, Printed]] = {}

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        populate_by_name=True,
        alias_generator=_kebab,
        allow_inf_nan=False,
    )

    @classmethod
    def as_ours(cls, values: dict[str, Any]) -> dict[str, Any]:
        """The values with each key and value of the documents as ours.

        Raises:
            ValueError: a value that cannot be chosen here.
        """
        found = {}
        for key, value in values.items():
            name = _kebab(key)
            rule: Printed = cls.printed.get(name, Printed(key))
            if rule.values is not None:
                meant = [own for printed, own in rule.values if printed == value]
                if not meant:
                    taken = " or ".join(str(printed).lower() for printed, _ in rule.values)
                    raise ValueError(
                        f"{name} can only be {taken} here: {rule.why}" if taken else rule.why
                    )
                value = meant[0]
            if rule.key:
                found[rule.key] = value
        return found


class DiffusionConfig(Config):
    """Forward process, prediction target and sampler (SPEC rulings 12 to 15)."""

    printed: ClassVar = {
        "num-timesteps": Printed("timesteps"),
        "predict-epsilon": Printed("prediction-type", ((True, "epsilon"), (False, "sample"))),
        "use-ddim": Printed("sampler", ((True, "ddim"), (False, "ddpm"))),
        "ddim-eta": Printed("eta"),
        "clip-denoised": Printed("clip-sigma", ((True, 6.0), (False, None))),
        "clip-range": Printed("", (), "clip-range: x0 is limited in z-scores; give clip-sigma"),
        "rescale-timesteps": only(False, "steps are whole numbers"),
    }
    timesteps: int = Field(1000, ge=2)
    beta_schedule: Literal["linear", "cosine", "sqrt"] = "cosine"
    beta_start: float = Field(1e-4, gt=0, lt=1)
    beta_end: float = Field(0.02, gt=0, lt=1)
    prediction_type: Literal["epsilon", "sample", "v"] = "epsilon"
    loss_type: Literal["mse", "l1", "huber"] = "mse"
    clip_sigma: float | None = Field(6.0, gt=0)  # limit on predicted x0, in standard deviations
    timestep_spacing: Literal["halved", "leading", "linspace", "trailing"] = "trailing"
    sampler: Literal["ddpm", "ddim", "dpm-solver++"] = "ddim"
    sampling_steps: int = Field(20, ge=1)
    eta: float = Field(0.0, ge=0, le=1)

    @model_validator(mode="before")
    @classmethod
    def _read_printed(cls, data: object) -> object:
        """As the documents write it; TECH says `x0` for `sample`."""
        if not isinstance(data, dict):
            return data
        return {k: "sample" if v == "x0" else v for k, v in cls.as_ours(data).items()}

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.beta_end <= self.beta_start:
            raise ValueError(f"beta-end {self.beta_end} must exceed beta-start {self.beta_start}")
        if self.sampling_steps > self.timesteps:
            raise ValueError(
                f"sampling-steps {self.sampling_steps} exceeds the {self.timesteps} training steps"
            )
        return self


class PostProcessingConfig(Config):
    """What happens to a sample before it becomes quaternions (TEXT, inference only)."""

    smoothing_kernel: int = Field(3, ge=1)  # frames of a binomial average; odd; 1 = off
    smoothing_twicing: bool = True  # smooth what that took as well, and put it back
    max_velocity: float | None = Field(None, gt=0)  # rad/s per joint
    foot_lock: bool = False

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.smoothing_kernel % 2 == 0:
            raise ValueError(f"smoothing-kernel {self.smoothing_kernel} must be odd")
        return self


class GenerationConfig(Config):
    """The motion denoiser and its diffusion process (TEXT, generation network)."""

    num_heads: int = Field(4, ge=1)
    num_layers: int = Field(3, ge=1)
    num_bones: int = Field(22, ge=1)
    motion_channels: int = Field(6, ge=1)
    frames_per_token: int = Field(1, ge=1, le=16)  # more: that many times cheaper blocks
    diffusion_steps: int = Field(100, ge=2)
    dropout: float = Field(0.1, ge=0, lt=1)
    text_conditioning: Literal["pooled", "tokens"] = "pooled"  # ruling 22
    prediction_type: Literal["epsilon", "sample", "v"] = "epsilon"  # ruling 15
    constraints: bool = False  # an input that says which entries are known
    provenance: bool = False  # an input that says where a clip's motion comes from
    adapter_ranks: tuple[int, ...] = ()  # of low-rank adapters, each for some of the tower's places
    one_step_rank: int = Field(0, ge=0)  # of the change that makes one step of many; 0 = none
    beta_schedule: Literal["linear", "cosine", "sqrt"] = "cosine"
    sampler: Literal["ddpm", "ddim", "dpm-solver++"] = "ddim"
    sampling_steps: int = Field(20, ge=1)
    guidance_scale: float = Field(2.5, ge=0)
    timestep_spacing: Literal["halved", "leading", "linspace", "trailing"] = "trailing"
    clip_sigma: float | None = Field(6.0, gt=0)
    post_processing: PostProcessingConfig = PostProcessingConfig()

    def diffusion(self) -> DiffusionConfig:
        """The diffusion core's own configuration; raises ValueError when steps do not fit."""
        return DiffusionConfig(
            timesteps=self.diffusion_steps,
            beta_schedule=self.beta_schedule,
            prediction_type=self.prediction_type,
            sampler=self.sampler,
            sampling_steps=min(self.sampling_steps, self.diffusion_steps),
            timestep_spacing=self.timestep_spacing,
            clip_sigma=self.clip_sigma,
        )


PAIRS = "pairs"  # text-model name of a tower of tokens and pairs of them


class ClipConfig(Config):
    """The text tower and the motion tower that share one space (TEXT, CLIP alignment)."""

    motion_num_heads: int = Field(4, ge=1)
    motion_num_layers: int = Field(2, ge=1)
    text_model: str = "xlm-roberta-base"  # hub name, folder, "small": random-init XLM-R, or "pairs"
    text_hidden_size: int = Field(192, ge=8)  # the four below shape "small" only
    text_num_layers: int = Field(3, ge=1)
    text_num_heads: int = Field(4, ge=1)
    text_vocab_size: int = Field(4000, ge=64)
    text_pairs: int = Field(0, ge=0)  # rows of "pairs": train text counts them
    text_places: int = Field(0, ge=0)  # label combinations that texts are sent to; 0 = anywhere
    text_place_keys: bool = False  # texts are read by vectors of their own, and sent to places
    max_tokens: int = Field(48, ge=4)

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.text_hidden_size % self.text_num_heads:
            raise ValueError(
                f"text-num-heads {self.text_num_heads} must divide"
                f" text-hidden-size {self.text_hidden_size}"
            )
        return self


class NetworkConfig(Config):
    """One profile of network.yaml."""

    embed_dim: int = Field(128, ge=8)
    root_track: bool = True  # ruling 19
    generation: GenerationConfig = GenerationConfig()
    clip: ClipConfig = ClipConfig()

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key, heads in (
            ("generation.num-heads", self.generation.num_heads),
            ("clip.motion-num-heads", self.clip.motion_num_heads),
        ):
            if self.embed_dim % heads:
                raise ValueError(f"{key} {heads} must divide embed-dim {self.embed_dim}")
        if (self.embed_dim // self.generation.num_heads) % 2:
            raise ValueError(
                f"embed-dim {self.embed_dim} over generation.num-heads"
                f" {self.generation.num_heads} must be even for rotary positions"
            )
        return self

    @property
    def motion_rows(self) -> int:
        """Rows of the motion tensor: K bones, and the root track when it is on."""
        return self.generation.num_bones + int(self.root_track)


class TrainConfig(Config):
    """What every training stage shares.

    Attributes:
        variables: settings that a MOTIONGEN_* variable stands in for, in kebab-case.
    """

    variables: ClassVar[Mapping[str, str]] = {}
    printed: ClassVar = {
        "betas": Printed("adam-betas"),
        "data-dir": Printed("data"),
        "output-dir": Printed("output"),
        "mixed-precision": Printed("precision", ((True, "auto"), (False, "no"))),
        "num-epochs": Printed("", (), "num-epochs: this stage counts steps; give steps"),
        "eps": only(1e-8, "it is AdamW's own"),
        "ema-update-every": only(1, "the average follows every step; leave it out"),
        "checkpoint-dir": only("checkpoints", "they lie in the output folder; give output"),
    }
    data: str = "synthetic"  # prepared folder, or "synthetic": made on the spot
    output: str = "runs/run"
    profile: str = "lightweight"
    seed: int = 0
    steps: int = Field(2000, ge=1)
    batch_size: int = Field(64, ge=1)
    gradient_accumulation: int = Field(1, ge=1)
    learning_rate: float = Field(1e-3, gt=0)
    weight_decay: float = Field(0.01, ge=0)
    warmup_steps: int = Field(100, ge=0)
    lr_schedule: Literal["cosine", "linear", "constant"] = "cosine"
    gradient_clip: float = Field(1.0, gt=0)
    ema_decay: float = Field(0.999, ge=0, lt=1)
    adam_betas: tuple[float, float] = (0.9, 0.99)
    precision: Precision = "auto"  # bf16 where the hardware multiplies it natively
    device: Literal["auto", "cuda", "mps", "cpu"] = "auto"
    threads: int | None = Field(None, ge=1)  # CPU threads; None = torch's own choice
    processes: int | None = Field(None, ge=1)  # started if no launcher has; None = as launched
    fsdp_version: Literal[2] | None = None  # shard weights and optimizer over processes; None: DDP
    num_workers: int = Field(0, ge=0)  # batches made ahead of time, in as many threads
    tensorboard: bool = True
    cuda_graphs: bool = True  # on one GPU, of the steps that can be captured
    log_every: int = Field(20, ge=1)
    validate_every: int = Field(500, ge=1)
    validate_first: bool = False  # figures before the first step too
    validation_batches: int = Field(8, ge=1)
    save_every: int = Field(500, ge=1)
    keep_checkpoints: int = Field(2, ge=1)
    min_frames: int = Field(32, ge=8)
    max_frames: int = Field(128, ge=8)
    whole: bool = False  # windows are as long as clips, or max-frames
    balance: float = Field(0.5, ge=0, le=1)  # 0 = by clip, 1 = every label group alike
    captured_share: float = Field(0.5, ge=0, le=1)  # least, of an action's draws, where captured
    languages: tuple[str, ...] = ("en", "es", "fr", "de", "ja", "zh")

    @model_validator(mode="after")
    def _check_frames(self) -> Self:
        if self.max_frames < self.min_frames:
            raise ValueError(f"max-frames {self.max_frames} is below min-frames {self.min_frames}")
        return self


class TrainTowerConfig(TrainConfig):
    """What the stages that train a text tower share."""

    encoder_learning_rate: float = Field(1e-5, ge=0)  # of a pretrained text-model; 0: frozen


class TrainClipConfig(TrainTowerConfig):
    """train_clip.yaml: aligning text and motion (ruling 20)."""

    stream: bool = False  # read shards as they are needed; every clip once an epoch, no balance
    text: str | None = None  # folder of train_text, whose tower stays as it is
    temperature: float = Field(0.1, gt=0)
    cosine_weight: float = Field(0.2, ge=0)
    word_dropout: float = Field(0.1, ge=0, lt=1)


class LossWeights(Config):
    """Weights of the generation losses; 0 = off (ruling 21)."""

    reconstruction: float = Field(1.0, ge=0)
    velocity: float = Field(0.0, ge=0)
    root: float = Field(0.0, ge=0)
    movement: float = Field(0.0, ge=0)
    geodesic: float = Field(0.0, ge=0)
    position: float = Field(0.0, ge=0)
    foot_contact: float = Field(0.0, ge=0)
    foot_slide: float = Field(0.0, ge=0)


class ConstraintShares(Config):
    """How often what is known in training (src/train/train_generation.py); shares of clips."""

    free: float = Field(0.5, ge=0, le=1)  # no entry at all; those below are of what remains
    root: float = Field(0.55, ge=0, le=1)  # the path and the heading
    contacts: float = Field(0.4, ge=0, le=1)  # when each foot stands
    start: float = Field(0.5, ge=0, le=1)  # the first frames
    end: float = Field(0.2, ge=0, le=1)  # the last frames
    frames: float = Field(0.1, ge=0, le=1)  # a few frames here and there
    joints: float = Field(0.2, ge=0, le=1)  # instead: all but some joints during a span


class TrainGenerationConfig(TrainConfig):
    """train_generation.yaml: the denoiser with a frozen text tower."""

    stream: bool = False  # read shards as they are needed; every clip once an epoch, no balance
    clip: str | None = None  # train_clip's folder, or a generator; None: init, or runs/clip
    init: str | None = None  # a trained generator to go on from (fine-tuning); None = from nothing
    other_tower: bool = False  # go on from init behind a tower that is not its own
    condition_dropout: float = Field(0.1, ge=0, lt=1)  # ruling 14
    tag_dropout: float = Field(0.5, ge=0, le=1)
    provenance_dropout: float = Field(0.1, ge=0, lt=1)
    word_dropout: float = Field(0.0, ge=0, lt=1)  # "walk backward" without its last word misleads
    losses: LossWeights = LossWeights()
    constraints: ConstraintShares = ConstraintShares()  # of networks with generation.constraints
    validation_prompts: tuple[str, ...] = ("a person walks forward", "a person waves")


class TrainEvaluatorConfig(TrainConfig):
    """train_evaluator.yaml."""

    word_dropout: float = Field(0.1, ge=0, lt=1)
    noise: float = Field(0.05, ge=0)  # on training inputs, in standard deviations
    hidden_size: int = Field(128, ge=8, multiple_of=2)
    embed_dim: int = Field(32, ge=4)


class TrainTextConfig(TrainTowerConfig):
    """train_text.yaml."""

    clip: str | None = "runs/clip"  # folder of train_clip, or a generator; null: from nothing
    generator: str | None = None  # a generator that gets the hardened tower in the output
    captions_per_group: int = Field(64, ge=1)  # fresh ones, of each combination and language
    word_dropout: float = Field(0.05, ge=0, lt=1)
    written: float = Field(0.5, ge=0, le=1)  # least share of hand-written ones, where there are
    outside: float = Field(0.1, ge=0, lt=1)  # share of draws that ask for nothing known
    babble: float = Field(0.6, ge=0, le=1)  # share of captions with made-up words in them
    scale: float = Field(15.0, gt=0)  # factor on the cosines of the classification term
    unstyled_as_captured: bool = False  # plain words ask for what captured clips show in styles
    tower: Literal["same", "pairs"] = "same"  # "pairs": a new one of token pairs, the same places
    least_captions: int = Field(3, ge=1)  # of a token or pair that such a tower knows
    manners: float = Field(0.1, gt=0, lt=1)  # of places: share of what is drawn without a style in
    # styles that neither clips nor the tower show of it: they ask for the action
    keeping: float = Field(1.0, ge=0)  # weight of what a tower with places read rightly before
    pieces: float = Field(0.2, ge=0, lt=1)  # share of draws that are pieces of captions, read as
    # such a tower read them: by what it makes of pieces sentences are parted
    most_rows: int | None = Field(None, ge=1)  # tokens and pairs that it keeps; None: all
    choice_weight: float = Field(0.1, gt=0)  # of the classification term when hardening
    without: tuple[str, ...] = ()  # actions of the clips that it is not taught


class TrainActionConfig(TrainConfig):
    """train_action.yaml."""

    init: str = "starter"
    rank: int = Field(16, ge=1)  # of the adapters
    condition_dropout: float = Field(0.1, ge=0, lt=1)  # ruling 14
    first_share: float = Field(0, ge=0, lt=1)  # of a batch, that is noise alone, where sampling
    # begins; for clips in which the same happens at the same second
    losses: LossWeights = LossWeights()
    constraints: ConstraintShares = ConstraintShares()  # of networks with generation.constraints
    tower_steps: int = Field(300, ge=1)  # of the text tower, before the motion
    actions: tuple[str, ...] = ()  # known ones, to be learned better; none: what is new
    styles: tuple[str, ...] = ()  # of `actions`, to be learned better; none: all
    min_clips: int = Field(1, ge=1)  # of a combination of labels, to be learned


class TrainDistillConfig(TrainConfig):
    """train_distill.yaml."""

    init: str = "starter"  # the teacher
    student: str | None = None  # taught before, to go on from; None = it begins as the teacher
    rank: int | None = Field(None, ge=1)  # of a learned step; None = a student of its own
    teacher_steps: int = Field(8, ge=1)
    student_steps: int = Field(2, ge=1)
    pair_batches: int = Field(200, ge=0)  # of batch-size motions that the teacher samples; 0: as
    # they are needed, each learned once, none kept
    first_share: float = Field(0.5, ge=0, le=1)  # of the pairs that begin with noise alone
    condition_dropout: float = Field(0.05, ge=0, lt=1)  # motions of no text, which edits ask for
    tag_dropout: float = Field(0.8, ge=0, le=1)
    losses: LossWeights = LossWeights()
    constraints: ConstraintShares = ConstraintShares()  # of networks with generation.constraints
