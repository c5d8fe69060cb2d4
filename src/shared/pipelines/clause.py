"""One clause: what it asks for, and how often, how far, how long and how fast.

What its words say of that is taken out of them: "waves twice" is "waves", 2 times. The words are
those of words.py.
"""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from .words import (
    ARRIVES,
    CJK_SIGN,
    EDGES,
    FEW,
    MAX_COUNT,
    MOST,
    STANDS,
    UNITS,
    all_words,
    bare,
    plain_text,
    side_of,
    units_said,
    value_of,
    wholly,
)

SURE = 0.0  # log odds: how sure it must be what a text asks for
HELD = "\u23f8"  # behind what is held
GOING = frozenset({"walk", "run", "crouch-walk"})
STEPPING = GOING | {"side-step"}
ONCE = 5.0  # seconds in which most is done once, at most
REPEATED, LAP = (2.5, 3.0), 4.75  # seconds of one repetition, from … to; of many in one window
LONG_REST = 1.0  # seconds before and after a cycle: who rests for less goes on in the next window
PACES = {"walk": (0.4, 1.3), "run": (0.8, 1.4)}  # times as fast as usual, at least and at most
HOP = ("hop", "on one leg", "hops on one leg")  # an action, and words for it
ABOUT = 180.0  # degrees, which need no side
ENGLISH = re.compile(r"(?:an?|the|my|your|his|her|our|their|this|that)\s", re.I)  # of a name
SHORT = 3  # letters of a pronoun behind an article of another language ("die er …")
SQUATS, UNDEAD = "squats down", "zombie"  # words, and an action that is somebody
CROUCHING = (None, "squat", "crouch-walk", "crouch")  # what "crouches" is taken for
HELD_MARK = re.compile(f"{HELD}(?:([\\d.]+){HELD})?")


@dataclass(frozen=True)
class Reading:
    """What a text alone asks for.

    Attributes:
        action: None where nobody can say.
        certainty: log odds that this is it.
        arms: whether the arms alone do it.
        known: whether it is near enough to what was learned.
        handed: the side, left or right, that alone was learned to do it; "" where that is not so.
        surely: the action, where it is sure.
    """

    action: str | None = None
    certainty: float = -math.inf
    arms: bool = False
    known: bool = True
    handed: str = ""
    surely: str | None = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "surely", self.action if self.certainty > SURE else None)


Read = Callable[[str], Reading]
GOT_UP = Reading("stand", 3.0)  # as surely as an action is known
PLAINLY = {  # what whole patterns ask for, and words of a tower that knows them
    "ups": (GOT_UP, STANDS),
    "bends": (Reading("turn", 3.0), "turns left"),
    "posed": (Reading("raise", 3.0, arms=True), "raises both arms"),
    "falls": (Reading("die", 3.0), "dies"),
}
LIES = frozenset({"die", "get-up", "lie-down", "sleep", "pick-up"})  # what falls are taken for


@dataclass(frozen=True)
class Clause:
    """One thing to do.

    Attributes:
        text: the sentence's own words for it, without the measures below.
        count: how often.
        degrees: to turn, positive to the left; None where nothing is said.
        metres: to go; 0 = on the spot.
        seconds: to go on.
        steps: to take; None where nothing is said.
        meanwhile: the words of what the arms, or `side`'s arm alone, do at the same time.
        side: left, right or both.
        seat: what the body goes on to do meanwhile, who sits or kneels.
        held: whether it stays as it is when it is done, to the end.
        once: whether it says that it is done once.
        tempo: how many times as fast as usual.
        mirrored: whether it, or what the arms do meanwhile, names the hand of which it was not
            learned.
        unheard: of the last of some clauses, the words beside them of which nothing is made.
    """

    text: str
    count: int = 1
    degrees: float | None = None
    metres: float | None = None
    seconds: float | None = None
    steps: float | None = None
    meanwhile: str = ""
    side: str = "both"
    seat: str = ""
    held: bool = False
    once: bool = False
    tempo: float = 1.0
    mirrored: bool = False
    unheard: str = ""

    def lasting(self, seconds: float) -> float:
        """Seconds in which something is done once, of those that are asked for: who is slow takes
        longer, who is fast is done sooner; where they are more, it lasts as long as they do."""
        return seconds / self.tempo if seconds <= ONCE else seconds

    def repeated(
        self, seconds: float, fps: float, cycle: tuple[float, float] | None = None
    ) -> tuple[int, int]:
        """Frames of all repetitions, and of each window of them: of one, or of as many as fit into
        it where they have a `cycle`, seconds of rest and from one to the next."""
        if cycle is None:
            once = round(min(max(seconds / self.count, REPEATED[0]), REPEATED[1]) * fps)
            return once * self.count, once
        rest, period = cycle
        lap = self.count * period
        least = 1 if rest + lap <= ONCE else math.ceil(lap / (LAP - rest))
        most = self.count if rest >= LONG_REST else self.count // 2  # one each, or two at least
        even = (number for number in range(least, most + 1) if self.count % number == 0)
        windows = next(even, least)  # windows are alike in length
        once = round((rest + math.ceil(self.count / windows) * period) * fps)
        return round((windows * rest + lap) * fps), once

    @property
    def far(self) -> bool:
        """Whether it says how far to go or to turn."""
        return not (self.metres is self.steps is self.degrees is None)

    @property
    def said(self) -> dict[str, Any]:
        """What it says, by name: its text, and what is not as it is where nothing is said."""
        plain = vars(Clause(""))
        return {name: value for name, value in vars(self).items() if value != plain[name]}

    @property
    def plain(self) -> bool:
        """Whether it says nothing but what to do, be it once."""
        return self == Clause(self.text, once=self.once, unheard=self.unheard)


def measured(text: str) -> Clause:
    """A clause with its measures and its mark taken out."""
    mark = HELD_MARK.search(text)
    if mark is None:
        return _with_measures(text)
    clause = _with_measures(HELD_MARK.sub("", text))
    if clause.far or clause.count > 1:  # led, and over when it is done
        return clause
    own = clause.seconds
    seconds = own if mark[1] is None else (own or ARRIVES) + float(mark[1])
    return replace(clause, seconds=seconds, held=True)


def _with_measures(text: str) -> Clause:
    words, clause = all_words(), Clause(text)
    said = words.angle.sub(" ", text)  # a right angle is on no side
    side = side_of(said)
    for name in units_said(text):
        of, factor, least = UNITS[name]
        if (match := measure_of(name, clause.text, least)) is None:
            continue
        if name == "steps" and words.uncounted.search(match["manner"] or ""):
            continue  # "raises two arms steps back"
        number = value_of(match["number"])
        number += 0.5 * bool(match.groupdict().get("half"))
        value = number * factor + (getattr(clause, of) or 0)  # a minute and ten seconds
        if not 0 < value <= MOST[of]:
            continue
        stays, before = "", clause.text[: match.start()]
        if words.larger.search(before):
            return clause  # "a hundred and fifty metres" are not fifty
        if name == "steps" and (not before.strip() or words.takes.search(before)):
            article, _, noun = words.steps[bare(match["noun"])].rpartition(" ")
            stays = f"{article} {match['manner'] or ''}{noun}".strip()
        rest = without(clause.text, match, stays)
        if rest or name != "steps":
            said_so: dict[str, Any] = {"text": rest, of: value}
            clause = replace(clause, **said_so)
    if clause.degrees is None and (match := words.angle.search(clause.text)) and side != "both":
        clause = replace(clause, degrees=words.angles[bare(match[0])])
    round_it = words.corner.search(text) or words.round.search(text)
    about = words.about.search(clause.text) and not round_it and _counted(clause).count == 1
    if clause.degrees is None and about:
        clause = replace(clause, degrees=ABOUT)
    if clause.degrees is not None:
        sign = -1.0 if side == "right" else 1.0
        return replace(clause, degrees=sign * clause.degrees)
    if clause.metres is None and clause.seconds is None and clause.steps is None:
        return _counted(clause)
    return clause


def _counted(clause: Clause) -> Clause:
    """Times, or a bare number before what is done: "twice", "3 times", "x4", "two jumps"."""
    words = all_words()
    if match := words.often.search(clause.text):
        number = words.adverbs[bare(match[0])]
    elif match := words.times.search(clause.text) or words.bare.search(clause.text):
        number = int(value_of(next(filter(None, match.groups()))))
    else:
        return clause
    rest = without(clause.text, match)
    if number < 1:
        return clause
    if number == 1:
        return replace(clause, once=rest != "" and words.piece.search(match[0]) is None)
    if number > MAX_COUNT:  # nobody means it: it is told that nothing is made of it
        return replace(clause, text=rest, unheard=match[0]) if rest else clause
    return replace(clause, text=rest, count=number) if rest else clause


def measure_of(unit: str, text: str, least: float) -> re.Match[str] | None:
    """The first measure in a text that is so large."""
    found = all_words().units[unit].finditer(text)
    return next((each for each in found if value_of(each["number"]) >= least), None)


def place_kept(text: str) -> re.Match[str] | None:
    """The words by which somebody who goes is to stay where he is: last of what is done, or before
    the verb, where Chinese and Japanese have them; "his helmet in place" is no such thing."""
    words = all_words()
    found = words.in_place.search(text)
    if found is None or words.off.search(text):
        return None
    before, after = text[: found.start()].strip(EDGES), text[found.end() :].strip(EDGES)
    if re.match(CJK_SIGN, found[0]):
        return found if after else None
    first = not before and len(after.split()) <= FEW
    last = not after or words.sign.match(after)
    another = words.sign.search(before) or words.joint.search(before)  # thing that is in place
    return found if first or (last and not another) else None


def without(text: str, match: re.Match[str], stays: str = "") -> str:
    """A text with what `stays` in place of what was found."""
    before, after = text[: match.start()].rstrip(), text[match.end() :].lstrip()
    return trimmed(f"{before} {stays} {after}" if stays else f"{before} {after}")


def trimmed(text: str) -> str:
    """A text without the stops and conjunctions at its ends."""
    return all_words().loose.sub("", text.strip(EDGES)).strip(EDGES)


def without_tempo(text: str) -> tuple[str, float]:
    """A text without the word that says how fast, and how many times as fast that is; as it is
    where two say otherwise ("quick, quick, slow")."""
    words = all_words()
    if words.tempo.search(text) is None:
        return text, 1.0
    found = {words.tempos[bare(plain_text(said[0]))] for said in words.tempo.finditer(text)}
    if len(found) != 1:
        return text, 1.0
    while said := words.tempo.search(text):
        text = without(text, said)  # no blank is left where writing has none
    return closed(text), found.pop()


def without_hand(text: str, read: Read) -> Clause | None:
    """A clause without the words that say with which hand or foot it is done, where it was learned
    of one of them alone ("salutes with the left hand", which is nearer to waves)."""
    words = all_words()
    if (said := words.handed.search(text)) is None or words.denies.search(text[: said.start()]):
        return None
    clause, side = measured(closed(without(text, said))), side_of(said[0])
    whole = read(text)
    if whole.action == HOP[0] and (whole.surely or words.footed.search(said[0])):
        # without a foot it is a jump
        hops = measured(closed(without(text, said, HOP[1])))
        clause = hops if read(hops.text).surely == HOP[0] else replace(clause, text=HOP[2])
    own, legs = read(clause.text), words.footed.search(said[0]) is not None
    sure = own.surely or (own.known and own.action == whole.action)
    if side == "both" or not sure or not own.handed or legs != (own.action == HOP[0]):
        return None
    return replace(clause, mirrored=side != own.handed)


def without_subject(text: str, read: Read) -> str:
    """A text without who does it: a word for a person, or a name behind an article, in English with
    a word between them, where it is sure what the rest asks for; as it is where it has none."""
    words = all_words()
    rest = words.subject.sub("", text)
    if rest != text:
        return rest
    for number, (stop, start) in enumerate(blanks(text)[1:3]):
        who, rest = text[:stop], text[start:]
        told = is_told_of(text) if number else ENGLISH.match(who) or len(who.split()[-1]) > SHORT
        somebody = words.named.match(who) and words.things.search(who) is None
        if told and somebody and read(rest).surely:
            return rest
    return text


def understood(patterns: Sequence[str], text: str, read: Read) -> list[str]:
    """Those of the patterns that a text is that are of `PLAINLY`, and whose words `read` knows."""
    plain = ((name, *PLAINLY[name]) for name in patterns if name in PLAINLY)
    return [name for name, own, said in plain if read(said).action == own.action
            and (name != "falls" or read(text).surely in (None, *LIES))]  # fmt: skip


def plainly(clause: Clause, read: Read, *, alone: bool) -> Clause:
    """A clause in words of the tower; a bend that is all there is may be a walk."""
    text, arms = bared(clause.text, read), clause.meanwhile
    said = understood(patterns := wholly(text), text, read)
    if "ups" in said:
        text = STANDS
    elif "falls" in said:
        text = PLAINLY["falls"][1]
    elif (
        "crouched" in patterns and read(SQUATS).action == "squat" and read(text).surely in CROUCHING
    ):
        text = SQUATS
    elif "bends" in said and not alone and read(text).surely != "turn":
        text = f"turns {side_of(text)}"
    if arms and "posed" in understood(wholly(arms), arms, read) and read(arms).surely != "raise":
        arms = f"raises {clause.side} arm{'s' * (clause.side == 'both')}"
    spot = place_kept(text) if clause.metres is clause.degrees is None else None
    if spot and read(rest := bared(without(text, spot), read)).surely in GOING:
        text, clause = rest, replace(clause, metres=0.0)
    return replace(clause, text=text, meanwhile=arms)


def bared(text: str, read: Read) -> str:
    """A text without its subject, where only then it is sure, or known, what it asks for; or where
    the subject alone asks for something else ("a zombie dies")."""
    asked, someone = read(text), all_words().subject.match(text) is not None
    if someone and asked.surely and asked.known:
        return text
    if (rest := without_subject(text, read)) == text:
        return text
    own = read(rest)
    if own.surely is None or asked.surely is None:
        turns = own.action in GOING and asked.action in ("turn", "spin")  # near to each other
        return rest if own.surely and (someone or not (asked.known or turns)) else text
    if own.action == asked.action:
        return rest if someone and own.known and not asked.known else text
    moved = own.action in GOING | {"stand"} and asked.action == UNDEAD  # a way to move
    return rest if is_told_of(text) and not (someone or moved) else text


def is_told_of(text: str) -> bool:
    """Whether a text says in English of somebody behind an article what he does."""
    named, cuts = all_words().named, blanks(text)[1:3] if ENGLISH.match(text) else []
    return any(named.match(text[:at]) and is_verb(text[to:]) for at, to in cuts)


def is_verb(text: str) -> bool:
    """Whether a text may begin with an English verb that has somebody before it."""
    return re.match(r"\S{3,}s(?!\S)", text) is not None


def blanks(text: str) -> list[tuple[int, int]]:
    """Where words meet, in writing without blanks all places but behind the first sign."""
    return [m.span() for m in re.finditer(rf"\s+|(?<={CJK_SIGN}{{2}})(?={CJK_SIGN}{{2}})", text)]


def closed(text: str) -> str:
    """A text without blanks between signs of a writing that has none, and before stops."""
    return re.sub(rf"(?<={CJK_SIGN})\s+(?={CJK_SIGN})|\s+(?=[,;.])", "", text)


def in_tempo(clause: Clause, read: Read) -> Clause:
    """A clause that has its tempo, where what is done is read without that word, and no other thing
    is than with it."""
    rest, tempo = without_tempo(clause.text)
    if clause.steps is not None or rest == clause.text:
        return clause
    own = replace(clause, text=rest)
    own = replace(measured(rest), unheard=clause.unheard) if clause.plain else own
    what, said = read(own.text), read(clause.text)
    if not (what.surely or (what.action and what.known)) or said.surely not in (None, what.action):
        return clause
    least, most = PACES.get(what.action or "", (0.0, math.inf))
    return replace(own, tempo=min(max(tempo, least), most))
