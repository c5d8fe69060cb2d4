"""What `generate` is told beside prompts: clips, paths, timelines, and which go together."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..shared.errors import UsageError
from .console import flag_of

if TYPE_CHECKING:
    from ..shared.pipelines.edit import Given
    from ..shared.pipelines.path import DrawnPath
    from ..shared.pipelines.timeline import Timeline


@dataclass(frozen=True)
class Directions:
    """What `generate` was told beside prompts; None and False = not.

    To add a way: its option in `generate.py`, a field here and what it goes with in `check`, and a
    `Constraint` made of it where `MotionGenerator` has `timeline` or `edit`: `text.turned` makes
    one of a heading alone, `path.TimedPath.constraint` of way and heading.
    """

    start: Path | None = None
    end: Path | None = None
    keep: float | None = None
    edit: Path | None = None
    joints: str | None = None
    begin: float | None = None
    until: float | None = None
    path: Path | None = None
    timeline: Path | None = None
    then: list[str] | None = None
    loop: bool = False

    def given(self) -> list[str]:
        """The flags that were given, as they are typed."""
        return [
            flag_of(name) for name, value in vars(self).items() if value not in (None, False, [])
        ]

    @property
    def kind(self) -> str:
        """edit, ends, path or timeline: what has the say."""
        if self.edit is not None:
            return "edit"
        if self.start is not None or self.end is not None:
            return "ends"
        return "timeline" if self.path is None else "path"

    def refuse(self, beside: str) -> None:
        """Raises UsageError if any was given: none means anything beside that flag."""
        if given := self.given():
            raise UsageError(f"{given[0]} does not go with {beside}; leave one out")

    def check(self, prompts: int, *, num_samples: int, seconds: float | None) -> None:
        """Refuse what does not go together, before anything slow starts.

        Args:
            prompts: how often --prompt was given.
            num_samples: of --num-samples.
            seconds: of --seconds.

        Raises:
            UsageError: naming the flags.
        """
        own = {
            "edit": ("--edit", "--joints", "--from", "--to"),
            "ends": ("--start", "--end", "--keep"),
            "path": ("--path", "--timeline", "--then"),
            "timeline": ("--timeline", "--then", "--loop"),
        }[self.kind]
        given = self.given()
        chief = next(flag for flag in (*own, *given) if flag in given)
        for flag in given:
            if flag in ("--joints", "--from", "--to") and self.edit is None:
                raise UsageError(f"{flag} says what of a clip is made anew: give --edit CLIP too")
            if flag == "--keep" and self.kind != "ends":
                raise UsageError("--keep says how much of a clip stays: give --start or --end too")
            if flag not in own:
                raise UsageError(f"{flag} does not go with {chief}; leave one out")
        if self.edit is not None and given == ["--edit"]:
            raise UsageError("--edit: say what is made anew, by --joints, or --from and --to")
        if self.timeline is not None and self.then:
            raise UsageError("--timeline does not go with --then; leave one out")
        if num_samples > 1:
            raise UsageError(
                f"--num-samples does not go with {chief}, which makes one motion; another --seed"
                " makes another one"
            )
        self._check_spans(seconds)
        self._check_prompts(prompts)

    def _check_spans(self, seconds: float | None) -> None:
        if seconds is not None and (self.edit is not None or self.timeline is not None):
            file = "--edit" if self.edit is not None else "--timeline"
            raise UsageError(
                f"--seconds does not go with {file}, which says how long it is; leave it out"
            )
        if self.begin is not None and self.until is not None and self.until <= self.begin:
            raise UsageError(
                f"--to {self.until:g} is not after --from {self.begin:g}; give a later --to"
            )

    def _check_prompts(self, prompts: int) -> None:
        if self.timeline is not None and prompts:
            raise UsageError(
                "--prompt does not go with --timeline, which has texts of its own; leave one out"
            )
        if prompts > 1:
            raise UsageError(
                f"--prompt is given {prompts} times beside {self.given()[0]}, which makes one"
                " motion: --then TEXT says what comes next"
            )
        if not prompts and self.timeline is None and self.kind in ("path", "timeline"):
            raise UsageError('--prompt is missing; give one, e.g. --prompt "a person walks"')


# ---------------------------------------------------------------- clips, paths, timelines


def read_timed(
    directions: Directions, texts: list[str], tags: list[str | None] | None, seconds: float | None
) -> "tuple[DrawnPath | None, Timeline]":
    """The files that were named, and the prompts one after another.

    Raises:
        UserError: a file cannot be read or says what cannot be.
    """
    from ..shared.pipelines.path import read_path
    from ..shared.pipelines.timeline import Timeline, read_timeline

    path = None if directions.path is None else read_path(directions.path)
    if path is not None and path.times is not None and seconds is not None:
        raise UsageError(
            f"--seconds does not go with {directions.path}, which has times; leave it out"
        )
    if directions.timeline is not None:
        return path, read_timeline(directions.timeline)
    return path, Timeline.of(texts, seconds, tags)


def read_given(directions: Directions, seconds: float | None) -> "Given":
    """What is kept of the clips that were named.

    Raises:
        UserError: a clip cannot be read, or is shorter than what is asked of it.
    """
    from ..shared.data.retarget.read_motion import read_motion
    from ..shared.pipelines.edit import KEEP, chosen_joints, continue_clips, edit_clip

    names = [part.strip() for part in (directions.joints or "").split(",") if part.strip()]
    if directions.joints is not None and not names:
        raise UsageError("--joints is empty; name joints or groups, e.g. --joints left-arm,head")
    joints = chosen_joints(names) if names else None
    if directions.edit is not None:
        clip = read_motion(directions.edit)
        return edit_clip(clip, directions.begin or 0.0, directions.until, joints)
    start, end = (
        None if path is None else read_motion(path) for path in (directions.start, directions.end)
    )
    return continue_clips(
        start,
        end,
        keep=KEEP if directions.keep is None else directions.keep,
        seconds=seconds,
        rejoin=directions.start == directions.end,
    )
