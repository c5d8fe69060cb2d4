"""A song and a prompt become dances, the best first.

The body dances near the middle of a stage, or follows a path: the audio branch's or a drawn one.
Where nothing is heard it stands. Without a prompt, one is drawn every few bars from a fixed list,
by a softmax over three terms: how near it is to the sound in the shared space, how near its energy
is to the loudness, and whether a body that does it could keep to the path, or to the stage. The
space learned from rendered songs laid on mocap by tempo: it knows a song's tempo, nothing of its
mood (docs/experiments.md), so the first term says little more than fast or slow.

Letters: N candidates, P prompts, T frames, M beats, D width of the shared space.
"""

import logging
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Self

import numpy as np
import torch
from torch import Tensor

from ..errors import UserError
from ..model.audio import ENERGY
from ..model.audio.shared_space import SharedSpace
from ..model.clip.pretrained import tower_hash
from ..model.generation.constraint import Constraint, tag_index
from ..model.generation.motion_generator import Progress, TextToMotion
from ..motion.features import FORWARD, HEIGHT, LATERAL
from ..motion.motion import Danced
from ..motion.skeleton import REST_PELVIS_HEIGHT
from ..motion.trajectory import FPS, MotionTrajectory, from_motion, to_root
from .body import Performance, Performer
from .choreography import Choreographer, Wish, named_kinds, says_dance, unshown, wish_of
from .figure_dance import STAND, FigureDancer
from .ranking import PerformanceJudge, ScoreTable, unranked
from .song import BEATLESS, SongCondition
from .stream import Passage
from .text import SentenceGenerator

log = logging.getLogger(__name__)

SPACE = "starter-space"
SECTION = 6.0  # seconds, about; whole bars where a beat is known
HEARD = 150  # frames that the audio tower hears at once: it learned from five seconds at most
SHORTEST = 40  # frames of them
# Actions that are a dance, and walks whose arms tell who walks: legs of figures are lent to both.
DANCED, CARRIED = ("dance", "salsa", "indian-dance", "charleston"), ("zombie",)
CLAUSE = 4.0  # seconds of a clause that does not dance and names no length
SPEED_WIDTH, HEIGHT_WIDTH, ENERGY_WIDTH = 0.6, 0.12, 0.5  # m/s, m, share: one unit of logit


@dataclass(frozen=True)
class DancePrompt:
    """What the starter does for a prompt when no path tells it where to go.

    Attributes:
        text: the prompt.
        forward, left: mean velocity of the pelvis as it sees it, m/s.
        height: of the pelvis, m.
        energy: rank of the mean speed of all joints in the list, 0 to 1.
    """

    text: str
    forward: float
    left: float
    height: float
    energy: float


PROMPTS = (
    DancePrompt("a person dances", 0.1, 0.1, 0.87, 0.4),
    DancePrompt("a proud person dances", 0.0, 0.0, 0.95, 0.1),
    DancePrompt("a child dances", 0.1, 0.0, 0.96, 0.2),
    DancePrompt("a tired person dances", 0.5, 0.2, 0.95, 0.4),
    DancePrompt("an old man dances", 0.5, 0.1, 0.93, 0.5),
    DancePrompt("a young person dances to the music", 0.4, 0.1, 0.95, 0.6),
    DancePrompt("a masculine person dances", 1.1, 0.3, 0.92, 0.8),
    DancePrompt("a feminine person dances", 1.3, 0.1, 0.94, 0.9),
    DancePrompt("a person dances energetically", 1.5, 0.2, 0.93, 1.0),
    DancePrompt("a person dances fast", 1.0, 0.2, 0.66, 0.8),
    DancePrompt("a person spins around", 0.0, 0.0, 0.93, 0.2),
    DancePrompt("a person side-steps to the left", 0.0, 0.5, 0.91, 0.4),
    DancePrompt("a person side-steps to the right", 0.0, -0.5, 0.91, 0.4),
)


class DancePrompter:
    """Finds prompts in music.

    Args:
        embeddings: of the prompts in the shared space [P,D], unit-norm.
        space: where sounds are compared with them; None = loudness and path choose alone.
        prompts: P of them.
    """

    def __init__(
        self,
        embeddings: Tensor,
        space: SharedSpace | None = None,
        prompts: Sequence[DancePrompt] = PROMPTS,
    ) -> None:
        self.embeddings, self.space, self.prompts = embeddings.float().cpu(), space, tuple(prompts)

    @classmethod
    def beside(cls, generator: TextToMotion, space: str = SPACE) -> Self:
        """For a generator's prompts; without the space where its text tower is another one."""
        embeddings = generator.encode_prompts([prompt.text for prompt in PROMPTS]).pooled
        try:
            found = SharedSpace.from_pretrained(space)
        except UserError as error:
            log.warning("%s; loudness and path choose the dance alone", error)
            return cls(embeddings)
        if found.card.text_tower != tower_hash(generator.text):
            log.warning(
                "%s has another text tower than this model; loudness and path choose the dance"
                " alone",
                space,
            )
            return cls(embeddings)
        return cls(embeddings, found)

    def passages(
        self,
        condition: Tensor,
        phase: np.ndarray | None,
        path: MotionTrajectory | None = None,
        *,
        seed: int = 0,
    ) -> list[Passage]:
        """Prompts that follow each other for as long as a song lasts.

        Args:
            condition: the song [163 or 167, T].
            phase: bars [T], unwrapped; None = no beat known.
            path: T frames that the body is to follow; None = it stays where it is.
            seed: of the draws.
        """
        rng = np.random.default_rng(seed)
        frames = condition.shape[1]
        root = torch.zeros(frames, 6) if path is None else to_root(path)
        if path is None:
            root[:, HEIGHT] = REST_PELVIS_HEIGHT
        loudness = condition[ENERGY][0].double().numpy()
        found: list[Passage] = []
        for start, stop in sections(frames, phase):
            part = slice(start, stop)
            energy = float((loudness <= loudness[part].mean()).mean())
            logits = self._near_sound(condition[:, part])
            logits = logits + self._near_path(root[part])
            logits -= (np.array([p.energy for p in self.prompts]) - energy) ** 2 / ENERGY_WIDTH**2
            share = np.exp(logits - logits.max())
            text = self.prompts[rng.choice(len(share), p=share / share.sum())].text
            length = stop - start
            if found and found[-1].text == text:
                length += found.pop().frames
            found.append(Passage(text, length))
        return found

    @torch.inference_mode()
    def _near_sound(self, condition: Tensor) -> np.ndarray:
        """Cosine of each prompt and the sound [163 or 167, t], standardised over the list: [P]."""
        if self.space is None or condition.shape[1] < SHORTEST:
            return np.zeros(len(self.prompts))
        parts = max(1, round(condition.shape[1] / HEARD))
        windows = [part[None, :, :HEARD] for part in condition.float().tensor_split(parts, dim=1)]
        heard = torch.cat([self.space.embed_audio(window) for window in windows]).mean(0)
        cosine = (self.embeddings @ heard.cpu()).double().numpy()
        return np.asarray((cosine - cosine.mean()) / max(float(cosine.std()), 1e-6))

    def _near_path(self, root: Tensor) -> np.ndarray:
        """0 for prompts that move as the root rows [t,6] do, less for others: [P]."""
        mean = root.double().mean(0).numpy()
        own = np.array([(p.forward, p.left, p.height) for p in self.prompts])  # P 3
        away = (own - mean[[FORWARD, LATERAL, HEIGHT]]) / (SPEED_WIDTH, SPEED_WIDTH, HEIGHT_WIDTH)
        return np.asarray(-(away**2).sum(1))


def sections(frames: int, phase: np.ndarray | None) -> list[tuple[int, int]]:
    """First and last-plus-one frame of parts of about `SECTION` seconds that cover [0, frames).

    They begin at downbeats where bars [T] are known; a part of less than half the length joins the
    one before it.
    """
    if phase is None or phase[-1] - phase[0] < 1:
        cuts = np.arange(0, frames, round(SECTION * FPS))
    else:
        bar = (frames - 1) / FPS / float(phase[-1] - phase[0])  # seconds
        bars = max(1, round(SECTION / bar))
        whole = np.arange(np.ceil(phase[0]), phase[-1], bars)
        cuts = np.searchsorted(phase, whole)
    kept = [0]
    for cut in cuts:
        if min(cut - kept[-1], frames - cut) >= SECTION * FPS / 2:
            kept.append(int(cut))
    return list(zip(kept, [*kept[1:], frames], strict=True))


def with_waits(passages: Sequence[Passage], waits: Sequence[tuple[int, int]]) -> list[Passage]:
    """Passages in which a body stands in the frames [start, stop) of each wait."""
    silent = np.zeros(sum(passage.frames for passage in passages), dtype=bool)
    for start, stop in waits:
        silent[start:stop] = True
    found, at = [], 0
    for passage in passages:
        stop = at + passage.frames
        cuts = [at, *(at + 1 + np.flatnonzero(np.diff(silent[at:stop]))).tolist(), stop]
        for first, last in pairwise(cuts):
            stands = Passage(STAND, last - first)
            found.append(stands if silent[first] else replace(passage, frames=last - first))
        at = stop
    return found


@dataclass(frozen=True, eq=False)
class Dances:
    """What was asked for, the dances by rank, what was found of them in the order sampled, and what
    was said of them that whoever asked should know."""

    prompt: str | None
    ranked: list[Performance]
    table: ScoreTable
    warning: str | None = None


class SongPerformer:
    """Dances to songs, on a stage or on paths.

    Args:
        performer: of bodies.
        prompter: finds prompts in music; None = a prompt must be given.
        judge: of the candidates; None = one without the words.
        choreographer: of recorded figures; None = the generator dances alone.
    """

    def __init__(
        self,
        performer: Performer,
        *,
        prompter: DancePrompter | None = None,
        judge: PerformanceJudge | None = None,
        choreographer: Choreographer | None = None,
    ) -> None:
        self.performer, self.prompter, self.choreographer = performer, prompter, choreographer
        self.judge = judge or PerformanceJudge()
        self._told: list[str] = []  # of the dance that is made

    def dance(
        self,
        song: SongCondition,
        prompt: str | None = None,
        *,
        num_samples: int = 1,
        tag: str | None = None,
        seed: int = 0,
        progress: Progress | None = None,
    ) -> Dances:
        """Bodies that dance where they like, near the middle of the stage, ranked.

        Args:
            song: T frames.
            prompt: what the body does; None = what the music says.
            num_samples: candidates N.
            tag: action label beside the prompt; of a dance in figures, a kind of these, beside
                those that the prompt names.
            seed: candidate n depends on (seed, song, n) and its prompts alone.
            progress: told the frames done of N · T.

        Raises:
            UsageError: a tag that neither knows.
            UserError: as `Performer.improvise`.
        """
        frames, made = song.condition.shape[1], []
        self._told = []
        still = sum(stop - start for start, stop in song.waits)
        if not len(song.beats):
            self._tell("no beat was found: the body stands" if still == frames else BEATLESS)
        elif 2 * still > frames:
            self._tell(
                f"silence or noise for {still / FPS:.0f} of {frames / FPS:.0f} s: there the body"
                " stands"
            )
        kind = self._kind(tag)
        if kind is None:
            tag_index(tag, self.performer.generator.card.tags)
        wish = self._wish(prompt, tag)
        for number in range(num_samples):
            own = candidate_seed(seed, song.seed, number)
            told = _from(progress, number * frames, num_samples * frames)
            dance = None if wish is None else self._in_figures(song, wish, prompt, own, told)
            if dance is None:
                passages = with_waits(self._passages(song, None, prompt, tag, own), song.waits)
                plan, figures = self._plan(song, passages, own) or (None, ())
                dance = self.performer.improvise(
                    passages,
                    beats=song.beats if len(song.beats) else None,
                    phase=song.phase,
                    waits=song.waits,
                    plan=plan,
                    seed=own,
                    progress=told,
                )
                dance = replace(dance, figures=figures)
            elif tag not in (None, "dance") and kind is None:
                self._tell(
                    f"figures do not hear the tag {tag!r}: with --no-figures the model dances"
                    " alone, and does"
                )
            made.append(dance)
        return self._ranked(made, song, prompt)

    def _tell(self, line: str) -> None:
        """Say it, once a dance, and keep it."""
        if line not in self._told:
            log.warning("%s", line)
            self._told.append(line)

    def _wish(self, prompt: str | None, tag: str | None) -> Wish | None:
        """What is asked of recorded figures, None where they do not show it; a tag may add a kind
        of them. Says what they do not show of a sentence that names a kind."""
        if self.choreographer is None or prompt is None:
            return None if self.choreographer is None else Wish()
        here = self.choreographer.kinds
        wish = wish_of(prompt, here, named_kinds())
        if wish is not None and (kind := self._kind(tag)):
            wish = replace(wish, kinds=wish.kinds | {kind})
        there = f"figures that there are: {', '.join(sorted(here))}"
        if wish is None and (other := unshown(prompt, here)):
            self._tell(f"no figure shows {other!r}: the model makes it; {there}")
        if wish is None or not wish.kinds:
            return wish
        if missing := wish.kinds - set(here):
            self._tell(f"the memory holds no figure of {' or '.join(sorted(missing))}; {there}")
            wish = replace(wish, kinds=wish.kinds - missing)
        if wish.kinds and wish.unread:
            kinds = " and ".join(sorted(wish.kinds))
            self._tell(
                f"of {prompt!r} figures of {kinds} are danced, in any order; they do not show"
                f" {wish.unread!r}"
            )
        return wish if wish.kinds else None

    def _kind(self, tag: str | None) -> str | None:
        """The kind of figures that a tag names."""
        if tag is None or self.choreographer is None:
            return None
        named = {each.casefold().replace("-", " "): each for each in self.choreographer.kinds}
        return named.get(tag.casefold().replace("-", " "))

    def _plan(
        self, song: SongCondition, passages: Sequence[Passage], seed: int
    ) -> tuple[Constraint, tuple[Danced, ...]] | None:
        """Steps of figures, where a passage dances, and which; None where none does or fits."""
        if self.choreographer is None:
            return None
        said = {each.text for each in passages if says_dance(each.text)}
        dances = {text for text in said if self._reads(text, DANCED)}
        scope = self.performer.generator.scope
        arms = (*CARRIED, *(scope.arms if scope is not None else ()))
        asked = dances | {text for text in said if self._reads(text, arms)}
        if not asked:
            return None
        lengths = torch.tensor([each.frames for each in passages])
        where, seen = (
            torch.tensor([each.text in own for each in passages]).repeat_interleave(lengths)
            for own in (asked, dances)
        )
        dancer = FigureDancer(self.choreographer, self.performer.generator)
        return dancer.plan(song, Wish(), seed, where, seen)

    def _in_figures(
        self,
        song: SongCondition,
        wish: Wish,
        prompt: str | None,
        seed: int,
        progress: Progress | None,
    ) -> Performance | None:
        """A dance of recorded figures; None where none fits the song."""
        assert self.choreographer is not None, "a wish is asked of figures"
        dancer, own = FigureDancer(self.choreographer, self.performer.generator), self.performer
        found = dancer.dance(
            song,
            wish,
            text=prompt or "a person dances",
            sampling=replace(own.settings, seed=seed),
            foot_lock=own.settings.foot_lock,
            progress=progress,
        )
        if found is None:
            if wish.kinds and len(song.beats):
                named = " or ".join(sorted(wish.kinds))
                self._tell(
                    f"no figure of {named} fits the tempo of this song: the model makes the dance"
                )
            return None
        motion, figures = found
        others = [figure for figure in figures if wish.kinds and figure.kind not in wish.kinds]
        if others:
            seconds = sum(figure.times[-1] - figure.times[0] for figure in others)
            asked, came = " or ".join(sorted(wish.kinds)), sorted({each.kind for each in others})
            self._tell(
                f"{seconds:.0f} s of this dance are {', '.join(came)}, beside {asked}: for variety,"
                " and where nothing of it fits the tempo"
            )
        if progress is not None:
            progress(motion.num_frames, motion.num_frames)
        passages = (Passage(motion.text, motion.num_frames),)
        return Performance(motion, from_motion(motion, song.phase), passages, figures=figures)

    def follow(
        self,
        paths: Sequence[MotionTrajectory],
        song: SongCondition,
        prompt: str | None = None,
        *,
        raw: Sequence[MotionTrajectory] | None = None,
        tag: str | None = None,
        seed: int = 0,
        progress: Progress | None = None,
    ) -> Dances:
        """A body on each path, ranked.

        Args:
            paths: N ≥ 1 of T frames each.
            song: that they belong to.
            prompt: what the body does; None = what the music says.
            raw: the same as the audio branch made them, for the judge; None = they are drawn.
            tag: action label beside the prompt.
            seed: candidate n depends on (seed, song, n), its path and its prompts alone.
            progress: told the frames done of N · T.

        Raises:
            UsageError: as `Performer.perform`.
            UserError: as `Performer.perform`.
        """
        beats, self._told = song.beats if len(song.beats) else None, []
        if beats is None:
            self._tell(BEATLESS)
        made = []
        for number, path in enumerate(paths):
            own = candidate_seed(seed, song.seed, number)
            passages = self._passages(song, path, prompt, tag, own)
            told = _from(progress, number * path.num_frames, len(paths) * path.num_frames)
            made.append(
                self.performer.perform(path, passages, beats=beats, seed=own, progress=told)
            )
        return self._ranked(made, song, prompt, raw)

    def _ranked(
        self,
        made: Sequence[Performance],
        song: SongCondition,
        prompt: str | None,
        raw: Sequence[MotionTrajectory] | None = None,
    ) -> Dances:
        table = unranked()
        if len(made) > 1:
            prompts = [self._embedded(dance.passages) for dance in made]
            beats = song.beats if len(song.beats) else None
            table = self.judge.judge(made, prompts, beats, raw=raw)
        told = "; ".join(self._told) or None
        return Dances(prompt, [made[place] for place in table.order], table, told)

    def _passages(
        self,
        song: SongCondition,
        path: MotionTrajectory | None,
        prompt: str | None,
        tag: str | None,
        seed: int,
    ) -> Sequence[Passage]:
        frames = song.condition.shape[1] if path is None else path.num_frames
        if prompt is not None:
            return self._clauses(prompt, frames, tag)
        assert self.prompter is not None, "give a prompt, or a prompter that finds one"
        phase = None if song.phase is None else song.phase[:frames]
        return self.prompter.passages(song.condition[:, :frames], phase, path, seed=seed)

    def _clauses(self, prompt: str, frames: int, tag: str | None) -> Sequence[Passage]:
        """The clauses of a sentence, in order: what dances has the time that the others leave."""
        generator = self.performer.generator
        parts, fps = SentenceGenerator(generator).clauses(prompt), generator.card.fps
        if len(parts) == 1 or frames < len(parts) * fps:
            return [Passage(prompt, frames, tag)]
        own = [
            part.seconds or (None if self._reads(part.text, DANCED) else CLAUSE) for part in parts
        ]
        fixed = [0 if seconds is None else round(seconds * fps) for seconds in own]
        dancing = own.count(None)
        left = frames - sum(fixed)
        if not dancing or left < dancing * fps:  # alike
            fixed, dancing, left = [0] * len(parts), len(parts), frames
        lengths = [length or left // dancing for length in fixed]
        lengths[-1] += frames - sum(lengths)
        return [Passage(part.text, n, tag) for part, n in zip(parts, lengths, strict=True)]

    def _reads(self, text: str, actions: Collection[str]) -> bool:
        """Whether a text comes out as one of some actions."""
        [found] = self.performer.generator.read([text])
        return found is not None and bool(found.nearest) and found.nearest[0] in actions

    def _embedded(self, passages: Sequence[Passage]) -> Tensor:
        return self.performer.generator.encode_prompts([each.text for each in passages]).pooled


def candidate_seed(seed: int, song: int, number: int) -> int:
    """A seed of its own for each candidate of each song."""
    mixed = np.random.SeedSequence((seed, song, number)).generate_state(1, np.uint64)
    return int(mixed[0] >> np.uint64(1))


def _from(progress: Progress | None, before: int, total: int) -> Progress | None:
    return None if progress is None else lambda done, _: progress(before + done, total)
