"""What has to be set before torch is loaded, and so before any stage.

Threads of OpenMP that wait for the next operation of a training step sleep instead of spinning,
which other busy processes would pay for, and this one with them (docs/experiments.md, section 6).
Whoever sets OMP_WAIT_POLICY keeps it. Sampling, whose operations are too small to sleep between,
takes no more threads than there are idle cores instead: `src.shared.device.idle_threads`.

Each of several processes, whoever started them, would warn that DDP looks for weights without a
gradient and found none: some stages have such weights, in some steps.
"""

import os

os.environ.setdefault("OMP_WAIT_POLICY", "passive")
if "WORLD_SIZE" in os.environ:
    os.environ.setdefault("TORCH_CPP_LOG_LEVEL", "ERROR")
