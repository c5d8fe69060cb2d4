"""motionsuite: a sentence or a song becomes human motion.

    import motionsuite as ms
    [wave] = ms.load("starter").generate("a person waves")
    ms.save(wave, "wave.bvh")

What a user can mend is raised as `UserError`, of which `UsageError` is one.
Every name is imported when it is first used; what has none here lies in `motionsuite.src`, as in
`from motionsuite.src.shared.pipelines.path import read_path`. In a checkout that is `src`, beside
this folder, where `python -m src.cli.tools` finds it, too.
"""

import sys
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .src.shared.audio.song import Song
    from .src.shared.data.prepare import prepare
    from .src.shared.data.retarget.read_motion import read_motion
    from .src.shared.errors import UsageError, UserError
    from .src.shared.formats.registry import write_motion as save
    from .src.shared.model.checkpoint import list_models as models
    from .src.shared.model.diffusion import Sampling
    from .src.shared.model.generation.constraint import Constraint
    from .src.shared.model.hub import pull, push_to_hub
    from .src.shared.motion.motion import Motion
    from .src.shared.motion.trajectory import MotionTrajectory as Trajectory
    from .src.shared.pipelines.edit import continue_clips, edit_clip
    from .src.shared.pipelines.motion_generator import MotionGenerator, load

__all__ = [
    "Constraint",
    "Motion",
    "MotionGenerator",
    "Sampling",
    "Song",
    "Trajectory",
    "UsageError",
    "UserError",
    "continue_clips",
    "edit_clip",
    "load",
    "models",
    "prepare",
    "pull",
    "push_to_hub",
    "read_motion",
    "save",
]

_PLACES = {
    "Constraint": "shared.model.generation.constraint",
    "Motion": "shared.motion.motion",
    "MotionGenerator": "shared.pipelines.motion_generator",
    "Sampling": "shared.model.diffusion",
    "Song": "shared.audio.song",
    "Trajectory": "shared.motion.trajectory:MotionTrajectory",
    "UsageError": "shared.errors",
    "UserError": "shared.errors",
    "continue_clips": "shared.pipelines.edit",
    "edit_clip": "shared.pipelines.edit",
    "load": "shared.pipelines.motion_generator",
    "models": "shared.model.checkpoint:list_models",
    "prepare": "shared.data.prepare",
    "pull": "shared.model.hub",
    "push_to_hub": "shared.model.hub",
    "read_motion": "shared.data.retarget.read_motion",
    "save": "shared.formats.registry:write_motion",
}


class _Beside(MetaPathFinder, Loader):
    """Finds `motionsuite.src…` as the modules of a checkout's `src`, no second ones."""

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        return ModuleSpec(name, self) if f"{name}.".startswith(f"{__name__}.src.") else None

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        found = import_module(spec.name.removeprefix(f"{__name__}."))
        spec.loader_state = found.__spec__
        return found

    def exec_module(self, module: ModuleType) -> None:
        if module.__spec__ is not None:  # which the import has put in the place of its own
            module.__spec__ = module.__spec__.loader_state


def _root() -> str:
    """Name of the package that holds the code; never a `src` that is somebody else's."""
    here = Path(__file__).resolve().parent
    if not (here / "src").is_dir():
        found = find_spec("src")
        beside = here.parent / "src" / "__init__.py"
        if found is not None and found.origin and Path(found.origin).resolve() == beside:
            sys.meta_path.insert(0, _Beside())  # before those who would load them a second time
            return "src"
        __path__.append(str(here.parent))
    return f"{__name__}.src"


_ROOT = _root()


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module, _, attribute = _PLACES[name].partition(":")
    value = getattr(import_module(f"{_ROOT}.{module}"), attribute or name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
