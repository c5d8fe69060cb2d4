"""`generate --path, --timeline, --then, --loop`: when what happens, and where."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..shared.errors import UsageError
from .directions import SECONDS, Directions

if TYPE_CHECKING:
    from ..shared.model.diffusion.samplers import Sampling
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.edit import ControlledMotion
    from ..shared.pipelines.path import DrawnPath
    from ..shared.pipelines.timeline import Timeline

FPS = 30.0


@dataclass(frozen=True)
class TimedTask:
    """What is to happen when, on which path if on any, and whether it closes a loop."""

    timeline: "Timeline"
    path: "DrawnPath | None"
    seconds: float | None
    loop: bool

    @property
    def texts(self) -> list[str]:
        """All of them, those of single parts of the body too."""
        whole = [passage.text for passage in self.timeline.passages]
        return whole + [part.text for part in self.timeline.parts]


def read_timed(directions: Directions, wanted: dict[str, Any]) -> TimedTask:
    """The files that were named, and the prompts one after another.

    Raises:
        UserError: a file cannot be read or says what cannot be.
    """
    from ..shared.pipelines.path import read_path
    from ..shared.pipelines.stream import Passage
    from ..shared.pipelines.timeline import Timeline, read_timeline

    path = None if directions.path is None else read_path(directions.path)
    if path is not None and path.times is not None and wanted["seconds"] is not None:
        raise UsageError(
            f"--seconds does not go with {directions.path}, which has times; leave it out"
        )
    if directions.timeline is not None:
        timeline = read_timeline(directions.timeline, fps=FPS)
    else:
        frames = round((wanted["seconds"] or SECONDS) * FPS)
        texts = wanted["prompts"]
        tags = wanted["tags"] or [None] * len(texts)
        pairs = zip(texts, tags, strict=True)
        timeline = Timeline(tuple(Passage(text, frames, tag) for text, tag in pairs))
    return TimedTask(timeline, path, wanted["seconds"], directions.loop)


def make_timed(
    generator: "TextToMotion",
    task: TimedTask,
    settings: "Sampling",
    foot_lock: bool | None,
) -> "ControlledMotion":
    """One motion of all that."""
    from ..shared.pipelines.path import along_path
    from ..shared.pipelines.timeline import by_timeline, in_a_loop

    if task.path is not None:
        return along_path(
            generator,
            task.timeline,
            task.path,
            settings,
            seconds=task.seconds,
            foot_lock=foot_lock,
        )
    make = in_a_loop if task.loop else by_timeline
    return make(generator, task.timeline, settings, foot_lock=foot_lock)
