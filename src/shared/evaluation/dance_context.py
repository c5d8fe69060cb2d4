"""What the performer is measured with: settings, songs, paths, and the bodies put on them.

Letters: T frames, N songs.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import accumulate
from pathlib import Path
from zlib import crc32

import numpy as np

from ..data.phrases.dataset import MotionPhraseDataset
from ..errors import UserError
from ..metrics.rhythm import beats_of_phase, strangers
from ..metrics.seams import REACH
from ..model.generation.motion_generator import TextToMotion
from ..motion.features import decode_features
from ..motion.motion import Motion
from ..motion.postprocess.footskate import lock_carried_feet
from ..motion.trajectory import FPS, MotionTrajectory, to_motion
from ..pipelines.body import Performer, PerformerSettings
from ..pipelines.dance import candidate_seed
from ..pipelines.song import SongGenerator, finished, own_noise
from ..pipelines.song_sampler import SongSampling
from ..pipelines.stream import OVERLAP, WINDOW, window_lengths
from .audio_songs import Piece, clock, held_out_songs, tracks
from .dance_sample import BodyDance, BodySample
from .floors import untrained
from .judge.evaluator import Evaluator

Progress = Callable[[str], None]
PROMPTS = (
    "a person dances", "a proud person dances", "a young person dances to the music",
    "an old man dances", "a person dances energetically",
)  # fmt: skip
MIN_BEATS = 4  # of a real dance that is held against its music


@dataclass(frozen=True)
class DanceSettings:
    """How much is measured; the report repeats it."""

    num_songs: int = 20
    song_seconds: float = 16.0
    replications: int = 5
    untrained: int = 1  # replications of the rows that only have to fail, at most
    max_real: int = 200  # test phrases with bodies
    track_seconds: float = 16.0  # of each sound file
    prompts: tuple[str, ...] = PROMPTS  # song after song
    style_songs: int = 8  # on which the same path is danced to different prompts
    edits: int = 24  # clips that are edited, and pairs of actions that follow each other
    worst: int = 4  # dances to be looked at
    seed: int = 0


class DanceContext:
    """Everything a table of the performer may draw on; songs, paths and dances are made once.

    Args:
        generator: the text branch.
        singer: the audio branch, which makes the paths.
        judge: the separate evaluator.
        settings: how much.
        data: pairs with bodies, whose test split is the real row; None = no such row.
        songs: folder of sound files; None = synthetic songs alone.
        other: another text model, for a row of its own; None = none.
        sampling: of the text branch.
        progress: told what begins.
    """

    def __init__(
        self,
        generator: TextToMotion,
        singer: SongGenerator,
        judge: Evaluator,
        settings: DanceSettings,
        *,
        data: str | None = None,
        songs: Path | None = None,
        other: TextToMotion | None = None,
        sampling: PerformerSettings | None = None,
        progress: Progress = lambda text: None,
    ) -> None:
        self.generator, self.singer, self.judge = generator, singer, judge
        self.settings, self.data, self.songs, self.other = settings, data, songs, other
        self.sampling, self.progress = sampling or PerformerSettings(), progress
        self.path, self.danced = cache(self._path), cache(self._danced)

    @cached_property
    def pieces(self) -> list[Piece]:
        """The sound files, then held-out synthetic songs."""
        settings = self.settings
        self.progress(f"{settings.num_songs} songs of {settings.song_seconds:g} s")
        found = [] if self.songs is None else list(tracks(self.songs, settings.track_seconds))
        return found + list(
            held_out_songs(settings.num_songs, settings.song_seconds, settings.seed)
        )

    @property
    def num_tracks(self) -> int:
        """How many of the pieces are sound files."""
        return len(self.pieces) - self.settings.num_songs

    def _path(self, number: int, replication: int) -> MotionTrajectory:
        """The path of a song, post-processed as it is pinned."""
        piece = self.pieces[number]
        settings = own_noise(
            SongSampling(seed=self.settings.seed), replication, crc32(piece.name.encode())
        )
        (made,) = self.singer.generate(piece.condition, phase=piece.phase, settings=settings)
        return finished(made)

    # ---------------------------------------------------------------- bodies

    def perform(
        self,
        performer: Performer,
        number: int,
        replication: int,
        prompt: str,
        seed: int | None = None,
    ) -> BodyDance:
        """A body on the path of a song; with the `seed` of its replication unless told."""
        piece, path = self.pieces[number], self.path(number, replication)
        again = replication if seed is None else seed
        own = candidate_seed(self.settings.seed, crc32(piece.name.encode()), again)
        raw = performer.perform(path, prompt, beats=heard_beats(piece), seed=own).motion
        return BodyDance(
            song=piece.name,
            motion=lock_carried_feet(raw),
            beats=piece.beats,
            raw=raw,
            path=path,
            seams=near_seams(path.num_frames),
        )

    def performer(self, generator: TextToMotion, *, on_beats: bool = True) -> Performer:
        """Puts bodies on paths, their feet not yet held."""
        settings = replace(self.sampling, foot_lock=False, on_beats=on_beats)
        return Performer(generator, settings)

    def _danced(self, who: str, replication: int) -> BodySample:
        """A dance for each song by one of the performers."""
        performer = self.performers[who]()
        prompts = self.settings.prompts
        return BodySample.of(
            [
                self.perform(performer, number, replication, prompts[number % len(prompts)])
                for number in range(len(self.pieces))
            ]
        )

    @property
    def performers(self) -> dict[str, Callable[[], Performer]]:
        """By the row that they dance in."""
        return {
            "generated": lambda: self.performer(self.generator),
            "beats not told": lambda: self.performer(self.generator, on_beats=False),
            "untrained": lambda: self.performer(self.fresh),
            "other": lambda: self.performer(self.other or self.generator),
        }

    @cached_property
    def fresh(self) -> TextToMotion:
        """The same denoiser without its training."""
        return untrained(self.generator, self.settings.seed)

    # ---------------------------------------------------------------- samples

    @cached_property
    def reference(self) -> BodySample:
        """Real bodies of the test split with their music; empty without data.

        Raises:
            UserError: the split holds no body with a beat.
        """
        if self.data is None:
            return BodySample.of([])
        self.progress(f"the test split of {self.data}")
        settings = self.settings
        frames = round(settings.song_seconds * FPS)
        dances = real_dances(self.data, frames, settings.max_real, settings.seed)
        if not dances:
            raise UserError(
                f"{self.data}: no test phrase has a body and beats; make the pairs with"
                " prepare-audio"
            )
        return BodySample(dances, np.arange(len(dances)))

    def real(self, replication: int) -> BodySample:
        """The same phrases each time."""
        return self.reference

    def another_song(self, replication: int) -> BodySample:
        """The generated dances, each on another song: what not listening scores."""
        sample = self.danced("generated", replication)
        rng = np.random.default_rng([self.settings.seed, 4, replication])
        return sample.reordered(strangers(len(sample), rng))

    def frozen_pose(self, replication: int) -> BodySample:
        """The first pose of each dance held where it is."""
        still = [held_still(dance.motion) for dance in self.danced("generated", 0).dances]
        return self._instead(still)

    def path_alone(self, replication: int) -> BodySample:
        """A statue carried along each path."""
        return self._instead(
            [to_motion(self.path(number, replication)) for number in range(len(self.pieces))]
        )

    def _instead(self, motions: Sequence[Motion]) -> BodySample:
        """Other motions to the same songs, on the same paths."""
        dances = self.danced("generated", 0).dances
        return BodySample.of(
            [
                BodyDance(dance.song, motion, dance.beats, path=dance.path)
                for dance, motion in zip(dances, motions, strict=True)
            ]
        )


def heard_beats(piece: Piece) -> np.ndarray | None:
    """Seconds of the beats that the tracker heard, which is what a performer is told."""
    return None if piece.phase is None else beats_of_phase(piece.phase * piece.meter, FPS)


def near_seams(frames: int) -> np.ndarray:
    """True [T] where a window of the body's stream ends, and just around."""
    cuts = list(accumulate(window_lengths(frames, 0, WINDOW, OVERLAP)))[:-1]
    near = np.zeros(frames, dtype=bool)
    for cut in cuts:
        near[max(0, cut - REACH) : cut + REACH] = True
    return near


def held_still(motion: Motion) -> Motion:
    """The first frame for all frames."""
    frames = motion.num_frames
    return replace(
        motion,
        quaternions=np.repeat(motion.quaternions[:1], frames, axis=0),
        root_position=np.repeat(motion.root_position[:1], frames, axis=0),
        contacts=np.repeat(motion.contacts[:1], frames, axis=0),
    )


def real_dances(data: str, frames: int, number: int, seed: int) -> list[BodyDance]:
    """Bodies of up to `number` test phrases that have beats, windows of at most `frames`."""
    split = MotionPhraseDataset(
        data, split="test", target_frames=frames, seed=seed, cache_in_memory=False, bodies=True
    )
    found: list[BodyDance] = []
    for index in split.order(0):
        item = split.item(int(index), 0)
        if len(found) == number:
            break
        if item is None or item.body is None:
            continue
        beats = clock(item.audio[:, item.mask])[1]
        if len(beats) >= MIN_BEATS:
            song = item.record.song or item.record.id
            found.append(BodyDance(song, decode_features(item.body[item.mask]), beats))
    return found
