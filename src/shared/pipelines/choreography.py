"""A choreographer: from the beats, bars and loudness of a song to a sequence of figures.

For each phrase of a song, about eight counts (`song.py`), dynamic programming takes a figure: what
it costs to join two (pose, velocity, turning, feet), how far its tempo has to be warped, how its
energy is against the loudness, whether it leads off the stage or away from the front, and whether
it repeats what the form asks for: a a' b a', a repetition best a mirror image, and what the song
plays again is danced again. Noise of the seed makes one choice of many good ones.

Letters: S slots, N figures, C candidates of a slot, n counts.
"""

import re
import unicodedata
import zlib
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.spatial.distance import cdist

from ..config_loader import load_yaml, packaged_config
from ..memory.figures import AXES, FigureMemory, Figures
from ..motion.staging import PLAIN, Manner
from .song import Slot
from .words import all_words

WARP, STRETCH = 0.2, 0.35  # of the tempo, at most; of a phrase that no figure fits so
UPRIGHT = 0.6  # metres; a lower pelvis is asked for, by a kind that is mostly danced so
CANDIDATES = 400  # figures of a slot, by what they cost alone
# What a unit of each costs; the first is a metre of pose, all joints and channels together.
JOIN, TEMPO, ENERGY, CLEAR, STAGE, FRONT = 1.0, 30.0, 1.0, 4.0, 7.0, 0.3
# Gain of a repetition; cost of an unasked one, of each earlier figure of the same take; the seed's.
REPEAT, AGAIN, SAME_TAKE, NOISE = 16.0, 0.8, 2.0, 1.0
OPENING = 3.0  # times that for the first figure, by which one knows a dance
NEW, MANY = 0.9, 16  # gain of a typical pose that was not yet seen, and of how many at most
WIDE = 5.0  # gain of a dimension of the poses
AT_END = 20.0  # of FRONT more, for the last figure: nobody ends with the back to those who watch
# Of both feet sliding all the time, of a metre gone backward, of both in the air at an end.
SLIDE, BACK, ON_BOTH = 26.0, 0.5, 14.0
# Cost of steps made by code, which join well and fill any dance; gain of threes in threes.
MADE, THREES = 5.0, 6.0
CHANGE = 1.5  # cost of another kind than the phrase before has, where none is asked for
FREE = 0.35  # metres from the middle that cost nothing, twice that on the way


@dataclass(frozen=True)
class Wish:
    """What a sentence asks of the figures.

    Attributes:
        kinds: only of these; empty = of any that stay on their feet.
        energy: the share of figures, by energy, to take: (0, 0.4) is calm.
        manner: how they are carried.
        unread: what else it says, that no figure shows.
    """

    kinds: frozenset[str] = frozenset()
    energy: tuple[float, float] = (0.0, 1.0)
    manner: Manner = PLAIN
    unread: str = ""


# ---------------------------------------------------------------- which figures


class Choreographer:
    """Chooses figures for songs.

    Args:
        memory: where they are.
    """

    def __init__(self, memory: FigureMemory) -> None:
        self.memory = memory
        self._figures: dict[int, Figures] = {}
        self._kinds = np.array([take.kind for take in memory.takes])
        names = [take.name.rpartition("-")[0] if take.meter else take.name for take in memory.takes]
        self._own = np.array([names.index(name) for name in names])  # one for all tempi of a step

    @property
    def kinds(self) -> frozenset[str]:
        """What is danced in the memory."""
        return frozenset(take.kind for take in self.memory.takes)

    def figures(self, counts: int) -> Figures:
        """All of so many counts."""
        if counts not in self._figures:
            self._figures[counts] = self.memory.figures(counts)
        return self._figures[counts]

    def choose(
        self,
        slots: Sequence[Slot],
        wish: Wish,
        seed: int,
        progress: Callable[[int, int], None] | None = None,
    ) -> list[Figures] | None:
        """One figure a slot (each `Figures` of one row); None where nothing fits most of them.

        Args:
            slots: S ≥ 1.
            wish: of the sentence.
            seed: with the song and the wish it decides everything; who carries the same figures in
                another manner has others.
            progress: told the slots done of S.
        """
        who = [] if wish.manner == PLAIN else [zlib.crc32(repr(wish.manner).encode())]
        rng = np.random.default_rng([seed, *who])
        options: list[Figures] = []
        back: list[np.ndarray] = []
        value = np.zeros(1)
        place = np.zeros((1, 3))  # left, forward and heading, seen from the front
        history, taken = (np.zeros((1, 0), dtype=int) for _ in range(2))
        mirrored = np.zeros((1, 0), dtype=bool)
        seen = np.zeros((1, 1), dtype=np.float32)
        spread, before = np.zeros((1, AXES**2), dtype=np.float32), np.zeros(1)
        if 2 * sum(self._fits(slot, wish) for slot in slots) < len(slots):
            return None
        for index, slot in enumerate(slots):
            found, alone = self._candidates(slot, wish, rng, 1.0 if index else OPENING)
            if not len(found):
                return None
            shown = found.shown.astype(np.float32)
            if not index:
                alone = alone + ON_BOTH * (found.entry[:, -2:] == 0).mean(1)
                middle = found.spread[:, :-1, -1].sum(0) / found.spread[:, -1, -1].sum()
            own = _about(found.spread, middle)
            cost = value[:, None] + alone
            fresh = (1 - seen) @ shown.T if index else shown.sum(1)[None]
            cost -= NEW * np.minimum(fresh, MANY)
            dimensions = _dimensions(spread, own)
            cost -= WIDE * (dimensions - before[:, None])
            if index:
                cost += JOIN * _joins(options[-1], found)
                if not wish.kinds:
                    kinds, before_them = (self._kinds[each.take] for each in (found, options[-1]))
                    cost += CHANGE * (kinds != before_them[:, None])
                cost += self._repeats(slot, found, history, mirrored)
                if slot.same is None:
                    cost += SAME_TAKE * (taken[:, None] == self._own[found.take][:, None]).sum(-1)
            ends, furthest = (_places(place, way, found.turn) for way in (found.travel, found.far))
            for at, free in ((ends, FREE), (furthest, 2 * FREE)):
                cost += STAGE * np.maximum(np.linalg.norm(at[..., :2], axis=-1) - free, 0)
            last = index == len(slots) - 1
            cost += (FRONT + AT_END * last) * (1 - np.cos(ends[..., 2]))
            cost += ON_BOTH * last * (found.leave[:, -2:] == 0).mean(1)
            best = cost.argmin(0)
            column = np.arange(len(found))
            value, place = cost[best, column], ends[best, column]
            history = np.concatenate((history[best], found.number[:, None]), 1)
            anew = self._own[found.take] if slot.same is None else np.full(len(found), -1)
            taken = np.concatenate((taken[best], anew[:, None]), 1)
            mirrored = np.concatenate((mirrored[best], found.mirrored[:, None]), 1)
            seen = np.maximum(seen[best], shown)
            spread, before = spread[best] + own, dimensions[best, column]
            options.append(found)
            back.append(best)
            if progress is not None:
                progress(index + 1, len(slots))
        at_end = int(value.argmin())
        chosen = [at_end]
        for best in back[:0:-1]:
            chosen.append(int(best[chosen[-1]]))
        return [each.rows(np.array([row])) for each, row in zip(options, chosen[::-1], strict=True)]

    def draw(
        self, slots: Sequence[Slot], wish: Wish, seed: int, _: object = None
    ) -> list[Figures] | None:
        """As `choose`, any figure that fits by its tempo."""
        rng, found = np.random.default_rng(seed), []
        for slot in slots:
            counts = len(slot.counts) - 1
            period = float(slot.counts[-1] - slot.counts[0]) / counts
            fits, _ = self.allowed(counts, wish, period, slot.meter)
            if not len(fits):
                return None
            found.append(fits.rows(rng.integers(len(fits), size=1)))
        return found

    def allowed(
        self,
        counts: int,
        wish: Wish,
        period: float | None = None,
        meter: int = 0,
        *,
        beside: bool = False,
        warp: float = WARP,
    ) -> tuple[Figures, np.ndarray]:
        """Figures of so many counts that a wish allows, and their ranks by energy [N], 0 to 1.

        Args:
            counts: n.
            wish: of the sentence.
            period: seconds of a count that they are to be warped to; None = no matter.
            meter: counts of a bar of the song; 0 = neither three nor four.
            beside: also those of other kinds that may stand in.
            warp: of the tempo, at most.
        """
        figures = self.figures(counts)
        kinds = self._kinds[figures.take]
        upright = figures.low > UPRIGHT
        usual = upright & np.isin(figures.meter, (0, meter))
        groups = [usual]
        if wish.kinds:
            own = np.isin(kinds, sorted(wish.kinds))
            if 2 * upright[own].sum() > own.sum():  # drops are of dances that live on the floor
                own &= upright
            others = usual & ~own & np.isin(kinds, sorted(_beside(wish.kinds)))
            groups = [own, others] if beside else [own]
        rows, ranks = [], []
        low, high = wish.energy
        for fits in groups:  # "calm" is the calmest of each
            if period is not None:
                fits = fits & (np.abs(figures.count / period - 1) < warp)
            row = np.flatnonzero(fits)
            rank = np.argsort(np.argsort(figures.energy[row])) / max(len(row) - 1, 1)
            inside = (rank >= low) & (rank <= high)
            if not inside.any():  # of one or two
                inside[:] = True
            rows.append(row[inside])
            ranks.append(((rank[inside] - low) / (high - low)).clip(0, 1))
        return figures.rows(np.concatenate(rows)), np.concatenate(ranks)

    def parted(self, slots: Sequence[Slot], wish: Wish) -> list[Slot]:
        """The phrases; halved those of which only half has a figure of the kinds asked for."""
        found: list[Slot] = []
        first: list[int] = []  # half of each phrase
        for slot in slots:
            counts = len(slot.counts) - 1
            whole = not wish.kinds or counts < 6 or self._fits(slot, wish, counts)
            halves = not whole and self._fits(slot, wish, counts // 2)
            cuts = [0, counts // 2, counts] if halves else [0, counts]
            first.append(len(found))
            for number, (start, stop) in enumerate(pairwise(cuts)):
                same = None if slot.same is None else first[slot.same] + number
                meter = slot.meter if slot.meter and start % slot.meter == 0 else 0
                own = slot.counts[start : stop + 1]
                found.append(replace(slot, counts=own, same=same, meter=meter))
        return found

    def _fits(self, slot: Slot, wish: Wish, counts: int | None = None) -> bool:
        """Whether figures of a wish have the tempo of a slot: of its own length, or what stands in
        for them; or of so many counts, they alone."""
        own = len(slot.counts) - 1
        period = float(slot.counts[-1] - slot.counts[0]) / own
        beside, warp = counts is None, STRETCH if wish.kinds else WARP
        found, _ = self.allowed(counts or own, wish, period, slot.meter, beside=beside, warp=warp)
        return len(found) > 0

    def _candidates(
        self, slot: Slot, wish: Wish, rng: np.random.Generator, chance: float
    ) -> tuple[Figures, np.ndarray]:
        """Figures that fit a slot, and what each costs alone [C]; the seed's part is so large."""
        counts = len(slot.counts) - 1
        noise = rng.gumbel(size=len(self.figures(counts)))  # as many draws whatever fits
        period = float(slot.counts[-1] - slot.counts[0]) / counts
        # What is asked for, stretched if need be; others in a part b, or where it has none.
        own = [(wish, WARP, False), (wish, STRETCH, False)] if wish.kinds else []
        others = [(wish, WARP, True), (wish, STRETCH, True)]
        any_kind = replace(wish, kinds=frozenset())
        tries = [*others[: slot.part.startswith("b")], *own, *others, (any_kind, WARP, False)]
        for what, warp, beside in tries:
            found, rank = self.allowed(counts, what, period, slot.meter, beside=beside, warp=warp)
            if len(found):
                break
        cost = TEMPO * np.log(found.count / period) ** 2 + ENERGY * (rank - slot.loudness) ** 2
        clear = 2 * found.clear_beats if slot.halved else found.clear
        cost -= CLEAR * clear + chance * NOISE * noise[: len(found)]
        cost += SLIDE * found.slide + BACK * found.back + MADE * (found.meter > 0)
        cost -= THREES * ((found.meter == 3) & (slot.meter == 3))
        kept = np.argsort(cost)[:CANDIDATES]
        return found.rows(kept), cost[kept]

    @staticmethod
    def _repeats(
        slot: Slot, found: Figures, history: np.ndarray, mirrored: np.ndarray
    ) -> np.ndarray:
        """Gain of the repetition that is asked for, cost of any other [H,C]."""
        apart = np.abs(history[:, None, :] - found.number[None, :, None])  # H C slots
        length = found.times.shape[1] - 1
        seen = np.maximum(1 - apart / length, 0)
        if slot.same is None:
            return np.asarray(AGAIN * seen.sum(-1))
        asked = seen[..., slot.same] == 1
        other_side = mirrored[:, None, slot.same] != found.mirrored[None]
        return np.asarray(-REPEAT * asked * np.where(other_side, 1.0, 0.5))


def _joins(before: Figures, after: Figures) -> np.ndarray:
    """What it costs to go from the end of each figure to the beginning of each other [H,C]."""
    return np.asarray(cdist(before.leave, after.entry))


def _about(spread: np.ndarray, middle: np.ndarray) -> np.ndarray:
    """Products [C,A+1,A+1] about a pose [A]: [C,A*A]."""
    to = np.concatenate((np.eye(len(middle)), -middle[:, None]), 1).astype(np.float32)
    return np.asarray(to @ spread @ to.T).reshape(len(spread), -1)


def _dimensions(before: np.ndarray, own: np.ndarray) -> np.ndarray:
    """Participation ratio of the poses of each dance so far [H,A*A] with each figure [C,A*A]."""
    trace = [each.reshape(len(each), AXES, AXES).trace(axis1=1, axis2=2) for each in (before, own)]
    square = [(each**2).sum(1) for each in (before, own)]
    norm = square[0][:, None] + 2 * before @ own.T + square[1]
    return np.asarray((trace[0][:, None] + trace[1]) ** 2 / norm)


def _places(place: np.ndarray, way: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """Where ways [C,2] and turns [C] lead from each place [H,3]: [H,C,3]."""
    sine, cosine = np.sin(place[:, 2, None]), np.cos(place[:, 2, None])
    x = place[:, 0, None] + way[:, 1] * sine + way[:, 0] * cosine
    z = place[:, 1, None] + way[:, 1] * cosine - way[:, 0] * sine
    return np.stack([x, z, place[:, 2, None] + turn], -1)


# ---------------------------------------------------------------- what a sentence asks

CALM, LIVELY = (0.0, 0.4), (0.5, 1.0)  # shares of the figures by their energy
ENERGY_OF = {"calm": CALM, "lively": LIVELY}
_WORD = re.compile(r"[^\W\d_]")


def wish_of(sentence: str, kinds: Collection[str], others: Collection[str] = ()) -> Wish | None:
    """What a sentence asks of figures of some kinds; None where they cannot show it.

    A kind that is named is danced, whatever else the sentence says.

    Args:
        sentence: in any of the six languages.
        kinds: of the figures that there are; their own names are understood, too, also without
            "my" and articles, and each answers what else its name is called ("indian", "ballet").
        others: of which there are none, and that may be asked for.
    """
    wish, asks, left = _read(sentence, kinds)
    unread = left if wish.kinds and asks else ""
    if left and not unread:
        return None  # "an Indian man walks" dances nothing
    if not asks or not wish.kinds <= {*kinds, *others}:
        return None
    return replace(wish, unread=unread)


def unshown(sentence: str, kinds: Collection[str]) -> str:
    """What no figure shows of a sentence that asks for a dance alone; "" of any other."""
    wish, asks, left = _read(sentence, kinds)
    asks |= bool(wish.kinds) or says_dance(sentence)
    return left if asks and not all_words().then.search(left) else ""


def says_dance(sentence: str) -> bool:
    """Whether a sentence has a word of dance that it does not deny."""
    return bool(_danced().search(_undanced().sub(" ", _plain(sentence))))


def _read(sentence: str, kinds: Collection[str]) -> tuple[Wish, bool, str]:
    """A wish, whether the sentence asks for a dance, and what else it says."""
    text, undanced = _plain(sentence), _undanced(frozenset(map(str.casefold, kinds)))
    denied = " ".join(match.group() for match in undanced.finditer(text))
    rest = undanced.sub(" ", text)
    said, staged, named, wish, wanted = False, False, False, Wish(), set()
    names = {_bare(name): ("kinds", name) for name in kinds}
    names |= {name.casefold(): ("kinds", name) for name in kinds}
    for word, (about, what) in sorted(
        (_words() | names).items(), key=lambda item: len(item[0]), reverse=True
    ):
        left, found = _pattern(word).subn(" ", rest)
        if not found:
            continue
        rest = left
        said |= about == "dance"
        staged |= about == "scene"
        named |= about == "kinds" and word not in _dances()["adjectives"]
        if about == "kinds":
            wanted.add(what)
        elif about == "manners":
            manner, energy = _manners()[what]
            wish = replace(wish, manner=wish.manner & manner, energy=energy or wish.energy)
        elif about in ENERGY_OF:
            wish = replace(wish, energy=ENERGY_OF[about])
    called = {_words().get(_bare(name), ("", name))[1]: name for name in kinds}
    wanted = {kind if kind in kinds else called.get(kind, kind) for kind in wanted}
    left = " ".join(rest.split()).strip(" ,;.:!?、，。") if _WORD.search(rest) else ""
    asks = said or bool(
        wanted and (named or not staged) and not _WORD.search(all_words().then.sub(" ", left))
    )
    return replace(wish, kinds=frozenset(wanted)), asks, f"{left} {denied}".strip()


def _bare(kind: str) -> str:
    """A kind's name without "my" and articles: "my tango" is asked for as a tango."""
    words = [each for each in kind.casefold().split() if each not in ("my", "the", "a", "an")]
    return " ".join(words) or kind.casefold()


def named_kinds() -> set[str]:
    """Kinds that words of some language name."""
    return {what for about, what in _words().values() if about == "kinds"}


@cache
def _words() -> dict[str, tuple[str, str]]:
    """Each word with what it is about and, of a kind or a manner, which."""
    found: dict[str, tuple[str, str]] = {}
    for table in _dances()["words"].values():
        for about in ("plain", "scene", "calm", "lively", "dance"):
            found |= {word.casefold(): (about, "") for word in table[about]}
        for about in ("manners", "kinds"):
            for what, words in table[about].items():
                found |= {word.casefold(): (about, what) for word in words}
    return found


@cache
def _danced() -> re.Pattern[str]:
    """Any word of dance, of any language, and names of dances of which there are no figures."""
    found = [word for word, (about, _) in _words().items() if about == "dance"]
    return re.compile("|".join(_pattern(w).pattern for w in (*found, *_dances()["others"])))


@cache
def _undanced(kinds: frozenset[str] = frozenset()) -> re.Pattern[str]:
    """What is denied: a word that denies and one of dance, or of a kind of it, either way round,
    with a kind behind or before them. Two words may stand between; none before a finite verb, which
    is somebody else's ("who does not smile dances")."""
    found, links = [], "|".join(map(re.escape, _dances()["links"]))
    for table in _dances()["words"].values():
        own = [*kinds, *(word for words in table["kinds"].values() for word in words)]
        dance, named, verbs, no, behind = (
            "|".join(_pattern(word.casefold()).pattern for word in words) or "(?!)"
            for words in (table["dance"], own, table.get("verbs", table["dance"]),
                          table.get("not", ()), table.get("not-behind", ()))
        )  # fmt: skip
        parted = _is_parted(table["dance"][0])
        gap = rf"(?:\s+(?!(?:{links})\b)[^\W\d]+){{0,2}}" if parted else r"[^\W\d]{0,2}"
        to, kind = rf"{gap}\s*", rf"(?:{gap}\s*(?:{named}))?"
        found += [f"(?:{no})(?:{to}(?:{verbs})|\\s*(?:{dance}|{named})){kind}",
                  f"(?:(?:{named}){to})?(?:{dance}|{named}){to}(?:{behind}){kind}"]  # fmt: skip
    return re.compile("|".join(found))


def _plain(sentence: str) -> str:
    """In small letters, with plain apostrophes, and French "n'aime" as "ne aime"."""
    plain = unicodedata.normalize("NFC", sentence).casefold().replace("\u2019", "'")
    return re.sub(r"(?<![\w'])n'(?=\w)", "ne ", plain)


@cache
def _manners() -> dict[str, tuple[Manner, tuple[float, float] | None]]:
    """Each manner, and the share of the figures by energy that it takes."""
    found = {}
    for name, row in _dances()["manners"].items():
        energy = row.get("energy")
        carried = {what: value for what, value in row.items() if what != "energy"}
        found[name] = Manner(**carried), energy and (energy[0], energy[1])
    return found


def _beside(kinds: Collection[str]) -> set[str]:
    """Kinds that may stand in for some."""
    return {other for kind in kinds for other in _dances()["beside"].get(kind, ())}


@cache
def _dances() -> dict[str, Any]:
    return load_yaml(packaged_config("dances.yaml"))


@cache
def _pattern(word: str) -> re.Pattern[str]:
    """The word where it stands alone, or anywhere in writing that parts no words."""
    escaped = re.escape(word)
    return re.compile(rf"(?<!\w){escaped}(?!\w)" if _is_parted(word) else escaped)


def _is_parted(word: str) -> bool:
    """Whether its writing parts words."""
    return word.isascii() or unicodedata.name(word[0], "").startswith("LATIN")
