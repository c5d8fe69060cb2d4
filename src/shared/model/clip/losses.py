"""What pulls texts and motions together: multi-positive InfoNCE and cosine (ruling 20).

Letters: B batch, D embed dim. Embeddings are unit-norm.
"""

import torch
from torch import Tensor
from torch.nn.functional import softplus


def multi_positive_info_nce(
    text: Tensor,
    motion: Tensor,
    groups: Tensor,
    scale: Tensor,
    left_out: Tensor | None = None,
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
