"""What to do with padded frames and tokens; masks are bool, True = real.

Letters: B batch, T frames or tokens, D embed dim.
"""

from torch import Tensor


def masked_mean(values: Tensor, mask: Tensor | None) -> Tensor:
    """Mean over the real rows: values [B, T, D], mask [B, T] or None -> [B, D]."""
    if mask is None:
        return values.mean(dim=1)
    weights = mask.to(values.dtype)[..., None]  # [B, T, 1]
    return (values * weights).sum(dim=1) / weights.sum(dim=1).clamp_min(1.0)


def without_full_mask(mask: Tensor | None) -> Tensor | None:
    """None when nothing is padded, so that attention takes its faster path.

    Only looked at on the CPU: elsewhere the look itself would stall the device.
    """
    if mask is not None and mask.device.type == "cpu" and bool(mask.all()):
        return None
    return mask
