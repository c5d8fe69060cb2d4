"""MotionGenerator: all that a user can ask for, in one object; `motion-tools generate` asks it too.

    generator = load("starter")
    generator.generate(["a person waves, then walks three metres"])
    generator.dance("song.mp3", "a proud old man dances")

Letters: N candidates, T frames.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import cached_property
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..config_loader import ConfigT, dump_config, load_config
from ..environment import TEXT_MODEL, default_audio_model
from ..errors import UsageError
from ..model.checkpoint import read_card, resolve_model
from ..model.diffusion import Sampling
from ..model.generation.motion_generator import Progress, TextToMotion
from ..model.onnx_card import AUDIO_KIND, chosen_runtime
from ..motion.motion import Motion
from .edit import ControlledMotion, Given, edited
from .path import DrawnPath, TimedPath, along_path, time_path
from .ranking import PerformanceJudge, ScoreTable, TextJudge, load_tower, own_tower, unranked
from .sentence import whole
from .stream import DEFAULT_SAMPLING, MotionStream, Passage
from .text import SentenceGenerator
from .timeline import Timeline

if TYPE_CHECKING:  # who asks for a sentence waits for nothing that songs need
    from ..audio.song import Song
    from ..io.storage import Place
    from ..motion.trajectory import MotionTrajectory
    from .choreography import Choreographer
    from .dance import DancePrompter, Dances
    from .song import SongCondition, SongGenerator, SongMotions

SHORTEST, LONGEST = 0.2, 3600.0  # seconds of a clause
log = logging.getLogger(__name__)
Stage = Callable[[str], AbstractContextManager[Progress]]


def silently(stage: str) -> AbstractContextManager[Progress]:
    """For a `Stage`: nobody is told how far it is."""
    return nullcontext(lambda done, total: None)


@dataclass(frozen=True, eq=False)
class PromptResult:
    """The best motion for one prompt; all N, as sampled, if asked for; their scores."""

    motion: Motion
    all_candidates: list[Motion] | None
    table: ScoreTable

    def ranked(self) -> list[Motion]:
        """All candidates, best first; only the best where the others were not kept."""
        if self.all_candidates is None:
            return [self.motion]
        return [self.all_candidates[place] for place in self.table.order]


class PromptSampler:
    """Best of N for prompts, the text side's `MotionSampler`.

    Args:
        generator: trained; a `SentenceGenerator` is used as it is.
        judge: of the candidates; one with the generator's motion tower sees the prompt, None
            makes one without.
    """

    def __init__(
        self, generator: TextToMotion | SentenceGenerator, judge: TextJudge | None = None
    ) -> None:
        if isinstance(generator, TextToMotion):
            generator = SentenceGenerator(generator)
        self.generator = generator
        self.judge = judge or TextJudge()

    def sample(
        self,
        prompts: Sequence[str],
        num_samples: int = 8,
        *,
        return_all: bool = False,
        **options: Any,
    ) -> list[PromptResult]:
        """Sample N candidates a prompt and keep the one that the judge puts first.

        Args:
            prompts: see `SentenceGenerator.generate`.
            num_samples: N; candidate i depends on (seed, prompt, i) alone.
            return_all: keep the others too.
            options: what else `SentenceGenerator.generate` takes.

        Raises:
            UserError: as `SentenceGenerator.generate`.
        """
        motions = self.generator.generate(prompts, num_samples=num_samples, **options)
        embeddings = None if num_samples == 1 else self.generator.encode_prompts(prompts).pooled
        results = []
        for number in range(len(prompts)):
            made = motions[number * num_samples : (number + 1) * num_samples]
            table = unranked()
            if embeddings is not None:
                table = self.judge.judge(made, embeddings[number])
            results.append(PromptResult(made[table.best], made if return_all else None, table))
        return results


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
        self._text, self._body, self._path = text, post_processing, path_post_processing
        self._audio = default_audio_model() if audio is None else audio
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
        from ..memory.figures import is_figure_memory
        from .song import SongGenerator

        model: SongGenerator[Any] | str | Path = self._audio
        if not isinstance(model, SongGenerator):
            memory = None
            if self._memory is not None and not is_figure_memory(self._memory):
                from .song_memory import SongMemory

                memory = SongMemory.open(self._memory)
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
        texts = _texts(prompts)
        if not isinstance(sampling, Sampling):
            raise UsageError(f"sampling is {sampling!r}; give Sampling(seed=…, steps=…)")
        found = self.candidates(
            texts,
            num_samples,
            seconds=_lengths(seconds, len(texts)),
            tags=[tags] * len(texts) if isinstance(tags, str) else tags,
            return_all=return_all,
            sampling=sampling,
            foot_lock=foot_lock,
            progress=progress,
        )
        return [motion for result in found for motion in result.ranked()]

    def candidates(
        self,
        prompts: Sequence[str],
        num_samples: int = 8,
        *,
        return_all: bool = True,
        sampling: Sampling = DEFAULT_SAMPLING,
        **options: Any,
    ) -> list[PromptResult]:
        """As `generate`, with the scores of the candidates."""
        judge = TextJudge(self.tower) if num_samples > 1 else None
        sampler = PromptSampler(self.sentences, judge)
        return sampler.sample(
            prompts, num_samples, return_all=return_all, **vars(sampling), **options
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
            UserError: the file cannot be used.
        """
        from .song import styled
        from .song_sampler import SongSampling

        song = _analysed(audio, meter)
        style = styled(style) if isinstance(style, str) else style
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
        path: DrawnPath | None = None,
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
            tag: action label beside the prompt.
            figures: recorded ones, wherever they show what the prompt asks; else the text model
                dances alone.
            follow_path: the audio model makes a path that the body follows.
            path: where it goes instead; see `path.read_path`. Without times it takes as long as
                the song.
            style: of the audio model's path, see `trajectory`; None = what the prompt says of it.
            sampling: the guidance is the body's; the path keeps its model's own.
            foot_lock: hold standing feet; None = the model's own setting.
            stage: given "path" and "body", see `trajectory`.

        Raises:
            UserError: the file cannot be used, or the path is too long for the song.
        """
        from .body import Performer, PerformerSettings
        from .dance import SongPerformer
        from .song import SongCondition, finished

        song = SongCondition.of(_analysed(audio, meter), seconds)
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
        elif path is not None:
            raw, paths = None, [_drawn(path, song)] * num_samples
        with stage("body") as progress:
            if not follow_path and path is None:
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

        own = styled(style) if isinstance(style, str) else style
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
        """
        own, said, miss = self.sentences, prompt, None
        if prompt is not None:
            said, miss = whole(prompt, own.clauses(prompt)), own.unseen(prompt)
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
        timeline: Timeline | Sequence[str],
        *,
        path: DrawnPath | None = None,
        seconds: float | None = None,
        loop: bool = False,
        sampling: Sampling = DEFAULT_SAMPLING,
        foot_lock: bool | None = None,
    ) -> ControlledMotion:
        """One motion with one or several texts, on a path or in a loop.

        Args:
            timeline: see `timeline.read_timeline` and `Timeline.of`; or texts, one after another.
            path: where it goes; see `path.read_path`.
            seconds: how long a path without times takes; None = as its text is wont to go.
            loop: the last frame leads into the first one.
            sampling, foot_lock: see `generate`.
        """
        if not isinstance(timeline, Timeline):
            timeline = Timeline.of(_texts(timeline))
        if path is not None:
            return along_path(
                self.text, timeline, path, sampling, seconds=seconds, foot_lock=foot_lock
            )
        if loop:
            return self.sentences.loop(timeline, sampling, foot_lock=foot_lock)
        return ControlledMotion(self.sentences.timeline(timeline, sampling, foot_lock=foot_lock))

    def stream(self, prompts: str | Iterable[str | Passage], **options: Any) -> MotionStream:
        """Motion without end while prompts change; see `MotionStream`."""
        return MotionStream(self.text, prompts, **options)


def _texts(prompts: str | Sequence[str]) -> list[str]:
    if isinstance(prompts, str):
        return [prompts]
    found = list(prompts) if isinstance(prompts, Iterable) else [prompts]
    if not all(isinstance(each, str) for each in found):
        raise UsageError(f"prompts is {prompts!r}; give a sentence, or a list of sentences")
    return found


def _lengths(seconds: float | Sequence[float], number: int) -> list[float]:
    """Of so many prompts, each a number of seconds that one can wait for."""
    found: list[Any] = [*seconds] if isinstance(seconds, Iterable) else [seconds] * number
    if len(found) != number:
        raise UsageError(f"{len(found)} lengths for {number} prompts; give one for all or one each")
    for each in found:
        if not (isinstance(each, Real) and SHORTEST <= float(each) <= LONGEST):
            raise UsageError(
                f"seconds {each!r} is out of range; choose from {SHORTEST} to {LONGEST:g}"
            )
    return [float(each) for each in found]


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


def _analysed(audio: Song | str | Path, meter: int | None) -> Song:
    from ..audio.song import Song, analyse

    if not isinstance(audio, Song | str | Path):
        raise UsageError(
            f"audio is a {type(audio).__name__}; give a sound file, or a Song (of samples in"
            " memory: write them as WAV first)"
        )
    return audio if isinstance(audio, Song) else analyse(audio, meter=meter)


def _drawn(path: DrawnPath, song: SongCondition) -> MotionTrajectory:
    """A drawn path in the time of a song, at most as long as it."""
    from ..motion.trajectory import FPS

    frames = song.condition.shape[1]
    seconds = None if path.times is not None else (frames - 1) / FPS
    timed = time_path(path, fps=FPS, seconds=seconds)
    length = min(len(timed), frames)
    phase = None if song.phase is None else song.phase[:length]
    return TimedPath(timed.points[:length], timed.headings[:length], FPS).trajectory(phase)


def _changed(config: ConfigT, overrides: Sequence[str]) -> ConfigT:
    """A configuration with `key=value` over it."""
    return load_config(type(config), dump_config(config), "post-processing", overrides)
