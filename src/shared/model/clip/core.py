"""MotionClip: a text tower and a motion tower (TemporalUNet) in one space, and their loss (TEXT).

The text tower is XLM-R's, or a `TokenPairEncoder`: bags of words and of pairs are hard to beat
where sentences are short and few (Joulin et al. 2017, Bag of Tricks for Efficient Text
Classification, section 2.2).

Letters: B batch, L tokens, T frames, K rows (bones, root track), C channels, D embed dim; of token
pairs N rows, H width.
"""

import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import torch
from torch import Tensor, nn
from torch.nn.functional import normalize, softplus

from ...config_schema import PAIRS, ClipConfig, NetworkConfig
from ...errors import UserError
from ..layers import TemporalUNet, masked_mean
from .features import TextFeatures

BASE = 1 << 15  # token ids stay below, so that keys are int32
SPECIAL = 3  # ids below are bos, pad and eos
ENTRY_DROPOUT = 0.3  # of tokens and pairs, in training


def keys_of(input_ids: Tensor) -> Tensor:
    """Key of each token and of each pair that begins there [B, L, 2] int32; 0 where there is none.

    Ids from `BASE` on are unknown.
    """
    input_ids = torch.where(input_ids < BASE, input_ids, SPECIAL).int()
    real = input_ids >= SPECIAL
    tokens = torch.where(real, input_ids, 0)
    pairs = (input_ids[:, :-1] + 1) * BASE + input_ids[:, 1:]
    # a pair with bos or eos tells what begins or ends a sentence
    pairs = torch.where((real[:, :-1] | real[:, 1:]), pairs, 0)
    pairs = torch.cat((pairs, torch.zeros_like(pairs[:, :1])), 1)
    return torch.stack((tokens, pairs), -1)


def counted_keys(batches: Iterable[Tensor]) -> tuple[Tensor, Tensor]:
    """The keys [N] of these texts, ascending; and in how many of them each stands [N]."""
    found = [torch.cat([torch.unique(keys_of(row[None])) for row in batch]) for batch in batches]
    keys, counts = torch.unique(torch.cat(found), return_counts=True)
    return keys[keys > 0], counts[keys > 0]


class TokenPairEncoder(nn.Module):
    """Stands where XLM-R stands: ids in, hidden states out.

    Rows are kept for the tokens and pairs that training captions share; others add nothing, so a
    word that nobody knows cannot mislead.

    Args:
        num_rows: N.
        hidden_size: H.
    """

    keys: Tensor  # [N] ascending

    def __init__(self, num_rows: int, hidden_size: int) -> None:
        super().__init__()
        self.config = SimpleNamespace(hidden_size=hidden_size)
        self.register_buffer("keys", torch.arange(1, num_rows + 1, dtype=torch.int32))
        self.rows = nn.Embedding(num_rows + 1, hidden_size, padding_idx=num_rows)  # last: unknown
        nn.init.normal_(self.rows.weight[:-1], std=0.1)

    def forward(self, input_ids: Tensor, attention_mask: Tensor) -> SimpleNamespace:
        """[B, L] ids and mask -> `last_hidden_state` [B, L, H]: a token with the pair it begins."""
        keys = keys_of(input_ids)  # [B, L, 2]
        unknown = len(self.keys)
        index = self._places(keys)
        index = torch.where(self.keys[index] == keys, index, unknown)
        if self.training:
            dropped = torch.rand(index.shape, device=index.device) < ENTRY_DROPOUT
            index = index.masked_fill(dropped, unknown)
        hidden = self.rows(index).sum(2)  # [B, L, H]
        return SimpleNamespace(last_hidden_state=hidden * attention_mask.unsqueeze(-1))

    def _places(self, keys: Tensor) -> Tensor:
        """Where each key stands in the table if it is in it, else some other row of the table."""
        return torch.searchsorted(self.keys, keys).clamp(max=len(self.keys) - 1)


# ---------------------------------------------------------------- towers

if TYPE_CHECKING:
    from transformers import PreTrainedModel, XLMRobertaConfig

SMALL = "small"  # text-model name of the random-init tower
OWN = (SMALL, PAIRS)  # made here, with a tokenizer of our own; any other is a pretrained one
PLACE_SCALE = 30.0  # factor on cosines to places, in training of them, too
ALIKE = 0.7  # cosine with the likeliest place, of places that a text may lie between
OWN_SHARE = 0.01  # what a place's own share adds to that of all about it: decides between equals
INITIAL_TEMPERATURE = 0.1  # TMR's value
MAX_LOGIT_SCALE = math.log(100.0)  # Radford et al. 2021, section 2.5


class TextTower(nn.Module):
    """XLM-R, masked mean, `text_proj` to D.

    Args:
        config: `text_model` "small" is a random-init XLM-R of the `text-*` sizes, "pairs" a
            table of tokens and pairs of them (`TokenPairEncoder`); any other value is a folder or
            hub name whose weights transformers reads.
        embed_dim: D.
        encoder_config: transformers' own configuration from a model folder; builds that
            architecture without reading weights, for a state dict that follows.

    Raises:
        UserError: the named model is not on this machine and cannot be fetched.
    """

    def __init__(
        self, config: ClipConfig, embed_dim: int, *, encoder_config: Mapping[str, Any] | None = None
    ) -> None:
        super().__init__()
        self.config, self.embed_dim = config, embed_dim
        self.encoder = _build_encoder(config, encoder_config)
        self.text_proj = nn.Linear(self.encoder.config.hidden_size, embed_dim)
        if config.text_places:
            self.register_buffer("places", torch.zeros(config.text_places, embed_dim))
        if config.text_place_keys:
            self.register_buffer("keys", torch.zeros(config.text_places, embed_dim))

    def encoder_config(self) -> dict[str, Any] | None:
        """What a model folder must keep to rebuild the encoder; None for our own."""
        if self.config.text_model in OWN:
            return None
        kept: dict[str, Any] = self.encoder.config.to_dict()
        return kept

    def forward(self, input_ids: Tensor, attention_mask: Tensor) -> TextFeatures:
        """input_ids [B, L] long, attention_mask [B, L] (1 = real) -> TextFeatures."""
        mask = attention_mask.bool()
        hidden = self.encoder(
            input_ids=input_ids, attention_mask=attention_mask
        ).last_hidden_state  # [B, L, H_text]
        tokens = self.text_proj(hidden)  # [B, L, D]
        mean = masked_mean(hidden, mask)
        return TextFeatures(self.pool(mean), tokens, mask, closeness=self.closeness(mean))

    def pool(self, mean: Tensor) -> Tensor:
        """The encoder's mean over a text's tokens [B, H_text] -> [B, D] unit-norm.

        With places [P, D], the mean by probability of those that are alike (`ALIKE`), about the one
        that has most of the probability about it: a denoiser that has learned what lies there is
        never asked for what lies between. Where places have keys, those are what
        a text is compared with, as in attention (Vaswani et al. 2017, section 3.2.1): places that a
        denoiser grew up with need not lie so that words are told apart.
        """
        pooled = self._embedding(mean)
        if not self.config.text_places or self.training:
            return pooled
        places = self.get_buffer("places").float()
        shares = (PLACE_SCALE * pooled @ self.place_keys().T).softmax(-1)  # [B, P]
        with torch.autocast(places.device.type, enabled=False):  # bf16 takes others for alike
            alike = (places @ places.T >= ALIKE).to(shares)  # half a run and half a bow is neither
        likeliest = (shares @ alike + OWN_SHARE * shares).argmax(-1)
        return normalize((shares * alike[likeliest]) @ places, dim=-1)

    def closeness(self, mean: Tensor) -> Tensor | None:
        """Cosine [B] of the encoder's mean [B, H_text] with the nearest place's key, before places
        are mixed; None without places."""
        if not self.config.text_places or self.training:
            return None
        return (self._embedding(mean) @ self.place_keys().T).amax(-1)

    def place_keys(self) -> Tensor:
        """What texts are compared with [P, D]: the places themselves, unless they have keys."""
        return self.get_buffer("keys" if self.config.text_place_keys else "places").float()

    def _embedding(self, mean: Tensor) -> Tensor:
        return normalize(self.text_proj(mean).float(), dim=-1)

    def freeze(self) -> "TextTower":
        """Fix the weights and switch dropout off for good (generation training)."""
        self.requires_grad_(False)
        return self.eval()


class MotionClip(nn.Module):
    """Both towers and the learned inverse temperature of the contrastive loss."""

    def __init__(
        self, config: NetworkConfig, *, encoder_config: Mapping[str, Any] | None = None
    ) -> None:
        super().__init__()
        dim, clip = config.embed_dim, config.clip
        self.config = config
        self.text = TextTower(clip, dim, encoder_config=encoder_config)
        self.motion = TemporalUNet(
            config.motion_rows * config.generation.motion_channels,
            dim,
            num_heads=clip.motion_num_heads,
            num_layers=clip.motion_num_layers,
        )
        self.motion_proj = nn.Linear(dim, dim)
        self.logit_scale = nn.Parameter(torch.tensor(-math.log(INITIAL_TEMPERATURE)))

    def encode_text(self, input_ids: Tensor, attention_mask: Tensor) -> Tensor:
        """[B, L] ids and mask -> [B, D] unit-norm."""
        features: TextFeatures = self.text(input_ids, attention_mask)
        return features.pooled

    def encode_motion(self, motion: Tensor, mask: Tensor | None = None) -> Tensor:
        """Normalised motion [B, T, K, C], mask [B, T] bool or None -> [B, D] unit-norm."""
        features = self.motion_proj(self.motion(motion, mask))  # [B, D]
        return normalize(features.float(), dim=-1)

    def scale(self) -> Tensor:
        """Inverse temperature [], at most 100."""
        return self.logit_scale.clamp(max=MAX_LOGIT_SCALE).exp()

    def forward(
        self, input_ids: Tensor, attention_mask: Tensor, motion: Tensor, mask: Tensor | None = None
    ) -> tuple[Tensor, Tensor]:
        """Text and motion embeddings [B, D], unit-norm (one call for DDP)."""
        return self.encode_text(input_ids, attention_mask), self.encode_motion(motion, mask)


def small_text_config(config: ClipConfig) -> "XLMRobertaConfig":
    """The XLM-R configuration of "small", with XLM-R's own special ids."""
    from transformers.models.xlm_roberta.configuration_xlm_roberta import XLMRobertaConfig

    return XLMRobertaConfig(
        vocab_size=config.text_vocab_size,
        hidden_size=config.text_hidden_size,
        num_hidden_layers=config.text_num_layers,
        num_attention_heads=config.text_num_heads,
        intermediate_size=4 * config.text_hidden_size,
        max_position_embeddings=config.max_tokens + 2,  # XLM-R counts positions from pad id + 1
        type_vocab_size=1,
        bos_token_id=0,
        pad_token_id=1,
        eos_token_id=2,
    )


def _build_encoder(
    config: ClipConfig, encoder_config: Mapping[str, Any] | None
) -> "PreTrainedModel | TokenPairEncoder":
    if config.text_model == PAIRS:
        return TokenPairEncoder(config.text_pairs, config.text_hidden_size)
    # Only XLM-R's own module: the Auto classes cost seconds more to import.
    if config.text_model == SMALL:
        from transformers.models.xlm_roberta.modeling_xlm_roberta import XLMRobertaModel

        return XLMRobertaModel(small_text_config(config), add_pooling_layer=False)

    from transformers import AutoConfig, AutoModel

    if encoder_config is not None:
        rest = {key: value for key, value in encoder_config.items() if key != "model_type"}
        return AutoModel.from_config(AutoConfig.for_model(encoder_config["model_type"], **rest))
    try:
        return AutoModel.from_pretrained(
            config.text_model, use_safetensors=True, trust_remote_code=False
        )
    except (OSError, ValueError) as error:
        where = "folder" if Path(config.text_model).exists() else "hub model"
        raise UserError(
            f"clip.text-model: cannot load the {where} {config.text_model!r}"
            f" ({str(error).splitlines()[0]}); download it once, name a local folder,"
            " or set clip.text-model to small"
        ) from error


# ---------------------------------------------------------------- losses


def multi_positive_info_nce(
    text: Tensor, motion: Tensor, groups: Tensor, scale: Tensor, left_out: Tensor | None = None
) -> Tensor:
    """Symmetric InfoNCE where every pair of one label group is positive and never negative.

    For a row i with positives P and negatives N, averaged over p in P:
    -log exp(s_ip) / (exp(s_ip) + sum over n in N of exp(s_in))
    (van den Oord et al. 2018, equation 4; positives kept out of the denominator, ruling 20).

    Args:
        text: [B, D] unit-norm.
        motion: [B, D] unit-norm; row i belongs to text row i.
        groups: [B] long; equal numbers mean equal labels.
        scale: [] inverse temperature.
        left_out: [B, B] bool, symmetric, pairs of different groups that are no negatives either.

    Returns:
        Scalar loss; 0 when the batch holds one group only.
    """
    with torch.autocast(text.device.type, enabled=False):
        similarity = scale * (text.float() @ motion.float().T)  # [B, B]
    positive = groups[:, None] == groups[None, :]  # [B, B]
    related = positive if left_out is None else positive | left_out
    one_way = _one_way(similarity, positive, related)
    return 0.5 * (one_way + _one_way(similarity.T, positive, related.T))


def _one_way(similarity: Tensor, positive: Tensor, related: Tensor) -> Tensor:
    floor = torch.finfo(similarity.dtype).min / 2  # finite: an empty row keeps finite gradients
    negatives = similarity.masked_fill(related, floor).logsumexp(dim=1, keepdim=True)  # [B, 1]
    losses = softplus(negatives - similarity) * positive  # [B, B]
    return (losses.sum(dim=1) / positive.sum(dim=1)).mean()


def cosine_alignment(text: Tensor, motion: Tensor) -> Tensor:
    """Mean of 1 - cos over the matching rows: text and motion [B, D] unit-norm -> scalar."""
    return 1 - (text.float() * motion.float()).sum(dim=-1).mean()


def clip_loss(
    text: Tensor,
    motion: Tensor,
    groups: Tensor,
    scale: Tensor,
    *,
    cosine_weight: float,
    left_out: Tensor | None = None,
) -> dict[str, Tensor]:
    """Total loss and its two terms: `loss`, `contrastive`, `cosine` (ruling 20)."""
    contrastive = multi_positive_info_nce(text, motion, groups, scale, left_out)
    cosine = cosine_alignment(text, motion)
    return {
        "loss": contrastive + cosine_weight * cosine,
        "contrastive": contrastive,
        "cosine": cosine,
    }
