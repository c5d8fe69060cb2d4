"""Learning rate as a function of the step alone, so that resuming needs no scheduler state."""

import math


def learning_rate_factor(step: int, *, steps: int, warmup: int, schedule: str) -> float:
    """Factor on the base learning rate at a step that counts from 0.

    Linear warm-up from 1/warmup to 1, then cosine or linear decay that reaches 0 just after the
    last step, or a constant 1.
    """
    if step < warmup:
        return (step + 1) / warmup
    progress = min(1.0, (step - warmup) / max(1, steps - warmup))
    if schedule == "cosine":
        return 0.5 * (1 + math.cos(math.pi * progress))
    return 1.0 - progress if schedule == "linear" else 1.0
