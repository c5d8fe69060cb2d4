"""MotionGenerator: all that a user can ask for, in one object; `motion-tools generate` asks it too.

    generator = load("starter")
    generator.generate(["a person waves, then walks three metres"])
    generator.dance("song.mp3", "a proud old man dances")

Letters: N candidates, T frames.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..config_loader import ConfigT, dump_config, load_config
from ..environment import TEXT_MODEL, default_audio_model
from ..errors import UsageError, check_text, in_range
from ..model.checkpoint import read_card, resolve_model
from ..model.diffusion import Sampling
from ..model.generation.motion_generator import Progress, TextToMotion
from ..model.onnx_card import AUDIO_KIND, RUNTIMES, chosen_runtime
from ..motion.motion import Motion
from .edit import ControlledMotion, Given, edited
from .path import Way, along_path, path_of
from .ranking import PerformanceJudge, PromptResult, PromptSampler, TextJudge, load_tower, own_tower
from .stream import DEFAULT_SAMPLING, MotionStream, Passage
from .text import SentenceGenerator
from .timeline import Timeline, read_timeline

if TYPE_CHECKING:  # who asks for a sentence waits for nothing that songs need
    from ..audio.song import Song
    from ..io.storage import Place
    from ..motion.trajectory import MotionTrajectory
    from .choreography import Choreographer
    from .dance import DancePrompter, Dances
    from .song import SongCondition, SongGenerator, SongMotions

SECONDS = (0.2, 3600.0)  # of a clause
RANGES = {"num_samples": (1, 100_000), "meter": (3, 4), "song": (1.0, 7200.0)}
log = logging.getLogger(__name__)
Stage = Callable[[str], AbstractContextManager[Progress]]


def silently(stage: str) -> AbstractContextManager[Progress]:
    """For a `Stage`: nobody is told how far it is."""
    return nullcontext(lambda done, total: None)


class MotionGenerator:
    """Text and songs in, motions out.

    Models are loaded when something first needs them.

    Args:
        text: makes bodies: a model, or the name or folder of one.
        audio: makes the paths of songs, likewise; None = what MOTIONGEN_DIFFUSION_CHECKPOINT names,
            else what is shipped.
        device: auto, cuda, mps or cpu.
        runtime: torch; onnx, for models whose folders hold an export; or auto, which is onnx on a
            CPU where onnxruntime is installed and the model holds one, and hears no memory.
        memory: folder or address of `memory build`: of figures that are danced (None = the shipped
            ones), or of phrases, for an audio model that hears them.
        judge: folder of `train_clip` that holds candidates against their prompt; None = what
            belongs to the text model, where it is shipped.
        post_processing: of bodies, `key=value` of `PostProcessingConfig` over the model's own.
        path_post_processing: of paths, `key=value` of `PostProcessConfig` over the model's own.

    Raises:
        UsageError: an unknown runtime.
        UserError: wherever a model is first needed and cannot be used.
    """

    def __init__(
        self,
        text: TextToMotion | str | Path = TEXT_MODEL,
        audio: SongGenerator[Any] | str | Path | None = None,
        *,
        device: str = "auto",
        runtime: str = "auto",
        memory: str | Place | None = None,
        judge: str | Path | None = None,
        post_processing: Sequence[str] = (),
        path_post_processing: Sequence[str] = (),
    ) -> None:
        if runtime not in RUNTIMES:
            raise UsageError(f"runtime {runtime!r} is unknown; choose from {', '.join(RUNTIMES)}")
        self._text, self._audio = text, audio
        self._body, self._path = post_processing, path_post_processing
        self._device, self._runtime, self._memory, self._judge = device, runtime, memory, judge

    @classmethod
    def from_pretrained(cls, name_or_folder: str | Path, **options: Any) -> MotionGenerator:
        """With a text model or an audio model, and the shipped one of the other kind.

        Args:
            name_or_folder: a name that `models` lists, a folder that training wrote, or
                `user/model[@revision]` on a hub.
            options: as of the class.

        Raises:
            UserError: no such model, or damaged.
        """
        named: Any = name_or_folder
        if not isinstance(named, str | Path):
            kind = type(named).__name__
            raise UsageError(f"the model is a {kind}; give a name or a folder")
        if read_card(resolve_model(name_or_folder)).kind == AUDIO_KIND:
            generator = cls(audio=name_or_folder, **options)
            _ = generator.audio
        else:
            generator = cls(name_or_folder, **options)
            _ = generator.text
        return generator

    def __getstate__(self) -> dict[str, Any]:
        """As it was opened: what is loaded stays here, and a copy loads its own."""
        return {name: value for name, value in vars(self).items() if name.startswith("_")}

    # ------------------------------------------------------------ models

    @cached_property
    def text(self) -> TextToMotion:
        """The text model."""
        model = self._text
        if not isinstance(model, TextToMotion):
            runtime = chosen_runtime(self._runtime, model, self._device)
            model = TextToMotion.from_pretrained(model, device=self._device, runtime=runtime)
        if self._body:
            settings = _changed(model.network.generation.post_processing, self._body)
            update = {"post_processing": settings}
            generation = model.network.generation.model_copy(update=update)
            model.network = model.network.model_copy(update={"generation": generation})
        return model

    @cached_property
    def audio(self) -> SongGenerator[Any]:
        """The audio model, with its memory."""
        from .song import SongGenerator

        model = default_audio_model() if self._audio is None else self._audio
        if not isinstance(model, SongGenerator):
            memory = None
            if self._memory is not None:
                from ..memory.figures import is_figure_memory
                from .song_memory import SongMemory

                memory = None if is_figure_memory(self._memory) else SongMemory.open(self._memory)
            model = SongGenerator.from_pretrained(
                model, device=self._device, runtime=self._runtime, memory=memory
            )
        if self._path:
            model.post_processing = _changed(model.post_processing, self._path)
        return model

    @cached_property
    def sentences(self) -> SentenceGenerator:
        """The text model, reading what a sentence says of order and measure."""
        return SentenceGenerator(self.text)

    @cached_property
    def tower(self) -> Any:
        """Motions into the space of the text model's prompts, for judges; None if there is none."""
        if self._judge is None:
            return own_tower(self.text.text)
        return load_tower(self._judge, self.text.text)

    @cached_property
    def choreographer(self) -> Choreographer:
        """Chooses recorded figures: of the memory, if it has figures, else the shipped ones."""
        from ..memory.figures import SHIPPED, FigureMemory, is_figure_memory
        from .choreography import Choreographer

        own = self._memory if self._memory is not None and is_figure_memory(self._memory) else None
        return Choreographer(FigureMemory.open(SHIPPED if own is None else own))

    @cached_property
    def prompter(self) -> DancePrompter:
        """Finds prompts in music."""
        from .dance import DancePrompter

        return DancePrompter.beside(self.text)

    # ------------------------------------------------------------ text

    def generate(
        self,
        prompts: str | Sequence[str],
        *,
        seconds: float | Sequence[float] = 4.0,
        tags: str | Sequence[str | None] | None = None,
        num_samples: int = 1,
        return_all: bool = False,
        sampling: Sampling = DEFAULT_SAMPLING,
        foot_lock: bool | None = None,
        progress: Progress | None = None,
    ) -> list[Motion]:
        """The best motion for each prompt, or all candidates, prompt by prompt, the best first.

        Args:
            prompts: sentences; what they say of order, number, angle and length is done.
            seconds: of each clause that names no length of its own; one for all or one a prompt.
            tags: action labels beside the prompts; one for all or one a prompt.
            num_samples: candidates N a prompt.
            return_all: the other candidates, too.
            sampling: seed, steps, sampler and guidance.
            foot_lock: hold standing feet; None = the model's own setting.
            progress: told the motions that are done.

        Raises:
            UsageError: an argument cannot be worked with.
            UserError: the model is untrained.
        """
        found = self.candidates(
            prompts,
            num_samples,
            seconds=seconds,
            tags=tags,
            return_all=return_all,
            sampling=sampling,
            foot_lock=foot_lock,
            progress=progress,
        )
        return [motion for result in found for motion in result.ranked()]

    def candidates(
        self,
        prompts: str | Sequence[str],
        num_samples: int = 8,
        *,
        seconds: float | Sequence[float] = 4.0,
        tags: str | Sequence[str | None] | None = None,
        return_all: bool = True,
        sampling: Sampling = DEFAULT_SAMPLING,
        foot_lock: bool | None = None,
        progress: Progress | None = None,
    ) -> list[PromptResult]:
        """As `generate`, with the scores of the candidates, and what is to be warned of."""
        texts = _texts(prompts)
        _check(sampling, num_samples=num_samples, return_all=return_all, foot_lock=foot_lock)
        if not texts:
            return []
        if progress is not None and not callable(progress):
            raise UsageError(f"progress is {progress!r}; give a function of two numbers")
        lengths, labels = _lengths(seconds, len(texts)), _labels(tags, len(texts))
        judge = TextJudge(self.tower) if num_samples > 1 else None
        return PromptSampler(self.sentences, judge).sample(
            texts,
            num_samples,
            return_all=return_all,
            seconds=lengths,
            tags=labels,
            **vars(sampling),
            foot_lock=foot_lock,
            progress=progress,
        )

    # ------------------------------------------------------------ songs

    def trajectory(
        self,
        audio: Song | str | Path,
        *,
        meter: int | None = None,
        seconds: float | None = None,
        style: str | np.ndarray | None = None,
        num_samples: int = 1,
        sampling: Sampling = DEFAULT_SAMPLING,
        stage: Stage = silently,
    ) -> SongMotions:
        """The path of a song, the best of N first.

        Args:
            audio: analysed, or a file: wav, flac, ogg or mp3.
            meter: beats a bar of a file; None = as heard.
            seconds: only the first so many; None = all.
            style: words, a sentence, or a vector [8]; None = the model's choice.
            num_samples: candidates N.
            sampling: seed, steps, sampler and guidance.
            stage: given "path", a context of what is told the frames that are done.

        Raises:
            UsageError: an argument cannot be worked with.
            UserError: the file cannot be used.
        """
        from .song import analysed, styled
        from .song_sampler import SongSampling

        _check(sampling, num_samples=num_samples, meter=meter, song=seconds)
        style = styled(style)
        song = analysed(audio, meter)
        settings = SongSampling(num_samples, **vars(sampling))
        with stage("path") as progress:
            return self.audio.trajectories(
                song, settings, seconds=seconds, style=style, progress=progress
            )

    def dance(
        self,
        audio: Song | str | Path,
        prompt: str | None = None,
        *,
        tag: str | None = None,
        meter: int | None = None,
        seconds: float | None = None,
        figures: bool = True,
        follow_path: bool = False,
        path: Way | None = None,
        style: str | np.ndarray | None = None,
        num_samples: int = 1,
        sampling: Sampling = DEFAULT_SAMPLING,
        foot_lock: bool | None = None,
        stage: Stage = silently,
    ) -> Dances:
        """A body that dances to a song, near the middle of a stage; the best of N first.

        Args:
            audio, meter, seconds, num_samples: see `trajectory`.
            prompt: what the body does; None = what the music says.
            tag: action label beside the prompt; of a dance in figures, a kind of these.
            figures: recorded ones, wherever they show what the prompt asks; else they lend the text
                model their steps. False = it dances alone.
            follow_path: the audio model makes a path that the body follows.
            path: where it goes instead; see `timeline`. Without times it takes as long as the song.
            style: of the path that is followed, see `trajectory`; None = what the prompt says.
            sampling: the guidance is the body's; the path keeps its model's own.
            foot_lock: hold standing feet; None = the model's own setting.
            stage: given "path" and "body", see `trajectory`.

        Raises:
            UsageError: an argument cannot be worked with, or does not go with the others.
            UserError: the file cannot be used, or the path is too long for the song.
        """
        _check(sampling, num_samples=num_samples, meter=meter, song=seconds, figures=figures,
               follow_path=follow_path, foot_lock=foot_lock, prompt=prompt, tag=tag)  # fmt: skip
        if style is not None and not follow_path:
            raise UsageError(f"style {style!r} is of a followed path; give follow_path=True")
        if path is not None and follow_path:
            raise UsageError(f"path {path!r} does not go with follow_path; leave one out")
        drawn = None if path is None else path_of(path)
        from .body import Performer, PerformerSettings
        from .dance import SongPerformer
        from .song import SongCondition, analysed, finished, in_time_of

        song = SongCondition.of(analysed(audio, meter), seconds)
        judge = None
        if num_samples > 1:
            judge = PerformanceJudge(self.audio.bands if follow_path else None, self.tower)
        settings = PerformerSettings(**vars(sampling), foot_lock=foot_lock)
        dancers = SongPerformer(
            Performer(self.text, settings),
            prompter=self.prompter if prompt is None else None,
            judge=judge,
            choreographer=self.choreographer if figures else None,
        )
        own: dict[str, Any] = {"tag": tag, "seed": sampling.seed}
        if follow_path:
            raw = self._song_path(song, prompt, style, num_samples, sampling, stage)
            paths = [finished(each, self.audio.post_processing) for each in raw]
        elif drawn is not None:
            raw, paths = None, [in_time_of(song, drawn)] * num_samples
        with stage("body") as progress:
            if not follow_path and drawn is None:
                return dancers.dance(
                    song, prompt, num_samples=num_samples, **own, progress=progress
                )
            return dancers.follow(paths, song, prompt, raw=raw, **own, progress=progress)

    def _song_path(
        self,
        song: SongCondition,
        prompt: str | None,
        style: str | np.ndarray | None,
        num_samples: int,
        sampling: Sampling,
        stage: Stage,
    ) -> list[MotionTrajectory]:
        """Candidates of the audio model, as its decoder gave them."""
        from .song import styled
        from .song_sampler import SongSampling

        own = styled(style)
        if own is None and prompt is not None:
            own = self.text.style_of(prompt)
        settings = SongSampling(num_samples, **vars(sampling) | {"guidance_scale": None})
        with stage("path") as progress:
            return self.audio.sample(song, settings, style=own, progress=progress)

    # ------------------------------------------------------------ controlled motion

    def edit(
        self,
        given: Given,
        prompt: str | None = None,
        *,
        tag: str | None = None,
        sampling: Sampling = DEFAULT_SAMPLING,
        foot_lock: bool | None = None,
    ) -> ControlledMotion:
        """What is given stays, the rest is made as the prompt says.

        Args:
            given: of clips; see `edit.edit_clip` and `edit.continue_clips`.
            prompt: what the rest shows, sampled again and warned of where it does not, as far as
                kinematics tell; None = nothing is said.
            tag, sampling, foot_lock: see `generate`.

        Raises:
            UsageError: an argument cannot be worked with.
        """
        _check(sampling, foot_lock=foot_lock, prompt=prompt, tag=tag)
        what: Any = given
        if not isinstance(what, Given):
            kind = type(what).__name__
            raise UsageError(f"given is a {kind}; make it with edit_clip or continue_clips")
        own, said, miss = self.sentences, prompt, None
        if prompt is not None:
            said, miss = own.whole(prompt), own.unseen(prompt)
        made = edited(self.text, said, given, sampling, tag=tag, foot_lock=foot_lock, miss=miss)
        made = replace(made, motion=replace(made.motion, text=prompt or ""))
        free = np.flatnonzero(~given.constraint.known.flatten(1).all(1).numpy())
        if prompt is not None and len(free):
            anew = made.motion.frames(free[0], free[-1] + 1)
            if line := self.sentences.unless_shown(prompt, anew):
                log.warning("%s", line)
                return replace(made, warning=line)
        return made

    def timeline(
        self,
        timeline: Timeline | str | Path | Sequence[str],
        *,
        path: Way | None = None,
        seconds: float | None = None,
        loop: bool = False,
        sampling: Sampling = DEFAULT_SAMPLING,
        foot_lock: bool | None = None,
    ) -> ControlledMotion:
        """One motion with one or several texts, on a path or in a loop.

        Args:
            timeline: a text, or several, one after another; a `Path` of what `read_timeline`
                reads; or a `Timeline`.
            path: where it goes: points, each x, z in metres and, if you like, t and heading; a file
                of them, see `read_path`; or a `DrawnPath`.
            seconds: of each text that names no length, 4 if None; of one text on a path without
                times, how long that takes, None = as its text is wont to go.
            loop: the last frame leads into the first one.
            sampling, foot_lock: see `generate`.

        Raises:
            UsageError: an argument cannot be worked with, or does not go with the others.
            UserError: a file cannot be read, or the path is too long for its seconds.
        """
        _check(sampling, loop=loop, foot_lock=foot_lock)
        drawn = None if path is None else path_of(path)
        if drawn is not None and loop:
            raise UsageError(f"path {path!r} does not go with loop; leave one out")
        if seconds is not None:
            in_range("seconds", seconds, *SECONDS)
        if isinstance(timeline, Path):
            timeline = read_timeline(timeline)
        if not isinstance(timeline, Timeline):
            timeline = Timeline.of(_texts(timeline), seconds)
        elif seconds is not None and (drawn is None or (timeline.timed and timeline.passages[1:])):
            raise UsageError(f"seconds {seconds:g}: the timeline has times; leave one out")
        if not timeline.passages:
            raise UsageError(f"{timeline!r} is empty; give a text, e.g. ['a person walks']")
        if drawn is not None:
            if drawn.times is not None and seconds is not None:
                raise UsageError(f"seconds {seconds:g}: the path has times; leave one out")
            return along_path(
                self.text, timeline, drawn, sampling, seconds=seconds, foot_lock=foot_lock
            )
        if loop:
            return self.sentences.loop(timeline, sampling, foot_lock=foot_lock)
        return ControlledMotion(self.sentences.timeline(timeline, sampling, foot_lock=foot_lock))

    def stream(self, prompts: str | Iterable[str | Passage], **options: Any) -> MotionStream:
        """Motion without end while prompts change; see `MotionStream`."""
        return MotionStream(self.text, prompts, plan=self._plan, **options)

    def _plan(self, text: str) -> list[Passage]:
        """What a live body does of a text: its clauses, the last of them on and on."""
        said, fps = self.sentences, self.text.card.fps
        parts, found = said.clauses(text), list[Passage]()
        for part in parts:
            mirrored = part.mirrored and not part.meanwhile
            whole = len(parts) == 1 and not mirrored
            found.append(
                Passage(
                    said.whole(text) if whole else part.text,
                    max(1, round(said.ways.lasting(part) * fps)),
                    low=said.ways.nearest(part.text) == "sit",
                    mirrored=mirrored,
                    straight=said.ways.goes_straight(part.text),
                )
            )
        return found


def _texts(prompts: str | Sequence[str]) -> list[str]:
    several = isinstance(prompts, Iterable) and not isinstance(prompts, str | Mapping)
    found: list[Any] = [*prompts] if several else [prompts]
    if not all(isinstance(each, str) for each in found):
        raise UsageError(f"prompts is {prompts!r}; give a sentence, or a list of sentences")
    for each in found:
        check_text("prompt", each)
    return found


def _check(sampling: Sampling, **given: Any) -> None:
    """Refuse what is no sampling, number, text or flag, whatever its name says it is to be."""
    if not isinstance(sampling, Sampling):
        raise UsageError(f"sampling is {sampling!r}; give Sampling(seed=…, steps=…)")
    for name, value in given.items():
        if value is None and name != "num_samples":
            continue
        if name in RANGES:
            least, most = RANGES[name]
            shown = "seconds" if name == "song" else name
            in_range(shown, value, least, most, whole=isinstance(least, int))
        elif name in ("prompt", "tag"):
            check_text(name, value)
        elif not isinstance(value, bool | np.bool_):
            raise UsageError(f"{name} is {value!r}; give True or False")


def _lengths(seconds: float | Sequence[float], number: int) -> list[float]:
    """Of so many prompts, each a number of seconds that one can wait for."""
    found: list[Any] = [seconds] * number
    if isinstance(seconds, Iterable) and np.ndim(seconds):
        found = [*seconds]
    if len(found) != number:
        raise UsageError(f"{len(found)} lengths for {number} prompts; give one for all or one each")
    for each in found:
        in_range("seconds", each, *SECONDS)
    return [float(each) for each in found]


def _labels(tags: str | Sequence[str | None] | None, number: int) -> list[str | None]:
    """Of so many prompts, each a tag or None."""
    found: list[Any] = [tags] * number
    if isinstance(tags, Iterable) and not isinstance(tags, str):
        found = [*tags]
    if len(found) != number:
        raise UsageError(f"{len(found)} tags for {number} prompts; give one for all or one each")
    for each in found:
        if each is not None:
            check_text("tag", each)
    return found


def load(
    name_or_folder: str | Path = TEXT_MODEL,
    *,
    revision: str | None = None,
    cache_dir: str | Path | None = None,
    local_files_only: bool = False,
    endpoint: str | None = None,
    **options: Any,
) -> MotionGenerator:
    """See `MotionGenerator.from_pretrained`; of `user/model` on a hub more can be said.

    Args:
        name_or_folder: a name that `models` lists, a folder, or `user/model[@revision]`.
        revision, cache_dir, local_files_only, endpoint: as of `hub.pull`; of a hub's model alone.
        options: as of `MotionGenerator`.

    Raises:
        UsageError: they are given for what is no name on a hub.
        UserError: no such model, damaged, or not to be had.
    """
    if revision or cache_dir or local_files_only or endpoint:
        from ..model.hub import pull

        name_or_folder = pull(
            str(name_or_folder),
            revision=revision,
            cache_dir=cache_dir,
            local_files_only=local_files_only,
            endpoint=endpoint,
        )
    return MotionGenerator.from_pretrained(name_or_folder, **options)


def _changed(config: ConfigT, overrides: Sequence[str]) -> ConfigT:
    """A configuration with `key=value` over it."""
    overrides = [overrides] if isinstance(overrides, str) else overrides
    return load_config(type(config), dump_config(config), "post-processing", overrides)
