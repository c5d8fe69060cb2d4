"""What has to be set before torch is loaded, and so before any module of this package.

Threads of OpenMP that wait for a network's next operation sleep instead of spinning, which other
busy processes would pay for, and this one with them (docs/experiments.md, section 6). Whoever sets
OMP_WAIT_POLICY keeps it.
"""

import os

os.environ.setdefault("OMP_WAIT_POLICY", "passive")
