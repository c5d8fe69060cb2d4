"""Every fuzzed reader by name."""

from tests.fuzz.targets_folders import FOLDER_TARGETS
from tests.fuzz.targets_motion import MOTION_TARGETS
from tests.fuzz.targets_parts import PART_TARGETS
from tests.fuzz.targets_text import TEXT_TARGETS

TARGETS = MOTION_TARGETS | TEXT_TARGETS | FOLDER_TARGETS | PART_TARGETS
