"""What has to be set before torch is loaded, and so before any stage.

Threads of OpenMP that wait for the next operation of a training step sleep instead of spinning,
which other busy processes would pay for, and this one with them (docs/experiments.md, section 6).
Whoever sets OMP_WAIT_POLICY keeps it. Sampling, whose operations are too small to sleep between,
takes no more threads than there are idle cores instead: `src.shared.device.idle_threads`.
"""

import os

os.environ.setdefault("OMP_WAIT_POLICY", "passive")
