"""What a sentence says of order and measure: its clauses, and how often, how far, how long each.

    "walks three metres, then waves twice" -> Clause("walks", metres=3), Clause("waves", count=2)

The words are those of words.py. What a clause asks to be done is left to the text tower; how sure
that is of it decides where no word does.
"""

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from typing import NamedTuple

from .clause import (
    ABOUT,
    GOING,
    GOT_UP,
    HELD,
    HELD_MARK,
    PLAINLY,
    SQUATS,
    SURE,
    Clause,
    Read,
    Reading,
    bared,
    blanks,
    closed,
    in_tempo,
    is_told_of,
    is_verb,
    measured,
    plainly,
    trimmed,
    understood,
    without,
    without_hand,
    without_tempo,
)
from .words import (
    ARRIVES,
    ARROW,
    CJK_SIGN,
    EDGES,
    STANDS,
    all_words,
    bare,
    names_both,
    plain_text,
    says_number,
    side_of,
    tidied,
    wholly,
)

# How sure it must be what each part asks for where they are parted by a comma, "and", a participle
# or "with"; by a word that says "at once"; by a comma beside such a word.
SURE_AT_MARK, SURE_IF_SAID = -14.0, -2.0
SITS = "sits"
BEFORE = 0.8  # seconds that one stands or sits before sitting down or getting up
# Seconds that one who got up stands, or who sat down sits, before the next thing; who lies down.
RISEN, LAID = 1.5, 3.0
HALT = 2.5  # seconds that it takes to come to a stand
LOW = frozenset({"sit", "kneel", "meditate"})  # which one stays in as it is
SEATED = LOW | {"sit-floor", "lie-down", "sleep"}  # while the arms do something
HOLDABLE = frozenset({"raise", "bow", "squat"})
HEADING, NAMED = 3, 2  # words before the colon of a list, and of what it names, at most
MOST_PIECES = 8  # between commas, that may be one part
_ABOUT = ABOUT, -ABOUT
_AGAIN = re.compile(r"(?<!\w)([^\W\d]{4,})(?:[,;]?\s+\1)+(?=\s*(?:[,;.!?]|$))", re.I)

Strange = Callable[[str], object]
Span = tuple[int, int]
_Last = tuple[str | None, str, bool]  # action, side, and whether it says how far
_SIDES = {"left", "right"}


def clauses(
    sentence: str, read: Read = lambda _: Reading(), strange: Strange = lambda _: None
) -> list[Clause]:
    """The clauses of a sentence in the order in which they are to be done; at least one.

    Where no word tells of an order, a comma or an "and" parts two clauses only if `read` finds an
    action of its own in each: "walks forward and waves", but not "jumps up and down"; what is not
    understood beside them is `unheard`, and so is what is `strange` (asks for what nobody taught):
    "walks and picks up a coin". "Walks while waving", "walks with one hand up" and "raises the left
    hand and waves with the right one" are one clause, with what the arms do meanwhile.
    """
    words, found = all_words(), list[Clause]()

    @cache
    def known(text: str) -> Reading:
        calm = without_tempo(text)[0] if words.tempo.search(text) else text
        plain = understood(wholly(calm), calm, read)
        found = PLAINLY[plain[0]][0] if plain else read(bared(text, read))
        if found.surely is None and calm not in ("", text):
            paced = known(calm)  # how fast is no part of what is done
            return paced if paced.surely else found
        return found

    def heard(text: str) -> Reading:
        return read(clause.text) if (clause := without_hand(text, known)) else known(text)

    for whole in _ordered(_staying(plain_text(tidied(sentence)), known), heard):
        (pieces, unheard), last = _joined(whole, heard, strange), found[-1] if found else None
        in_row = len(re.findall("[てで]、", whole)) > 1
        while pieces:
            first, *others = pieces
            pair = _at_once(first, others[0], known, in_row=in_row) if others else None
            clause = pair or _handed(first, known) or measured(first)
            found.append(_as_before(last, clause) if last else clause)
            last, pieces = None, others[1:] if pair else others
        found[-1] = replace(found[-1], unheard=unheard or found[-1].unheard)
    found = [in_tempo(clause, known) for clause in found if clause.text] or [Clause(sentence)]
    first = found[0].text
    waits = first == STANDS and len(found) == 2  # "gets up after three seconds"
    if words.downs.match(first) and known(first).action in LOW:
        found.insert(0, Clause(STANDS, seconds=BEFORE))
    elif words.ups.fullmatch(up := found[waits].text) and (
        understood(["ups"], up, read) and read(SITS).action in LOW
    ):
        sits = replace(found[0], text=SITS) if waits else Clause(SITS, seconds=BEFORE)
        found[:waits] = [sits]
    said, found = found[-1], [plainly(each, read, alone=len(found) == 1) for each in found]
    if found[-1].text == SQUATS != said.text and found[-1].plain and not said.once:
        found[-1] = replace(found[-1], held=True)  # who crouches stays there
    for at, clause in enumerate(found):
        before, ends = found[at - 1] if at else Clause(""), at == len(found) - 1
        if at and clause.text == STANDS and clause.seconds is None and not ends:
            found[at] = replace(clause, seconds=RISEN)
            continue
        back = _walking_back(before, clause, known) if at else clause
        found[at] = _seated(before, back, known)
        if at and found[at].seat and found[at] != clause and before == Clause(before.text):
            down = RISEN if known(before.text).action in LOW else LAID
            found[at - 1] = replace(before, seconds=down)  # there is more to come
    return found


def _handed(text: str, read: Read) -> Clause | None:
    """A clause that names a hand which alone does it, or one of two things at once; a hand by
    itself is no other thing."""
    parted, own = _parted(text, read), without_hand(text, read)
    if parted is None or (own and not all_words().handed.sub("", parted.meanwhile).strip(EDGES)):
        return own or parted
    arms = without_hand(parted.meanwhile, read)
    return replace(parted, meanwhile=arms.text, mirrored=arms.mirrored) if arms else parted


def _walking_back(before: Clause, clause: Clause, read: Read) -> Clause:
    """Who has turned round and goes back goes ahead."""
    said = all_words().returns.search(clause.text)
    if said is None or clause.degrees is not None:
        return clause
    turns = before.plain and read(before.text).surely == "turn" and side_of(before.text) == "both"
    if not (turns or before.degrees in _ABOUT):
        return clause
    text = without(clause.text, said, all_words().returned[bare(plain_text(said[0]))])
    return replace(clause, text=closed(text)) if read(text).surely in GOING else clause


def _seated(before: Clause, clause: Clause, read: Read) -> Clause:
    """What the arms do of who sits, kneels or lies: he goes on to, whether he does so already, does
    both at once, or a word says that he does ("kneeling, he waves")."""
    if clause.meanwhile and read(clause.text).action in SEATED:
        own = measured(clause.meanwhile)
        own = replace(own, seat=clause.text, side=clause.side, mirrored=clause.mirrored)
        return replace(own, unheard=clause.unheard)
    if clause.meanwhile or clause.held:
        return clause
    words, seat = all_words(), before.seat or before.text
    stays = seat and read(clause.text).arms and read(seat).action in SEATED
    said = None if stays else words.posture.search(clause.text)
    if not (stays or said) or clause.far:
        return clause
    if said is None:
        return replace(clause, seat=seat, side=side_of(clause.text))
    rest = without(clause.text, said)
    if not read(rest).arms:
        return clause
    seat = words.postures[bare(plain_text(said[0].strip(EDGES)))]
    return replace(clause, text=rest, seat=seat, side=side_of(rest))


def whole(sentence: str, found: Sequence[Clause]) -> str:
    """A sentence as one sample hears it: without what it denies, if one plain clause is left."""
    text, first = tidied(sentence), found[0]
    cut = first.text != trimmed(plain_text(text)) and len(found) == 1 and first.plain
    return first.text if cut else text


def _staying(text: str, read: Read) -> str:
    """A text with marks behind what is held, and clauses for where a body comes to a stand."""
    words, place = all_words(), 0
    while found := [m for each in (words.held, words.halts) if (m := each.search(text, place))]:
        match = min(found, key=lambda each: each.start())
        left, stop = text[: match.start()], match.end()
        if long := _lasting(text, stop):
            stop = long[0]
        own = left[left.rfind(ARROW.strip()) + 1 :]
        tail = own[max((each.end() for each in words.joint.finditer(own)), default=0) :]
        tried = (read(measured(trimmed(each)).text).surely for each in (tail, own))
        denied = re.search("[不没别勿]", left[-4:])
        action, said = None if denied else next(filter(None, tried), None), ""
        stays, comes = (each.match(text, match.start()) for each in (words.held, words.halts))
        # "crouches and stays down", not "sneaks, staying low"
        if stays and not denied and action in ("crouch-walk", "crouch", "dodge", None):
            whole = action and read(measured(trimmed(own + match[0])).text).surely
            if whole == "squat" or words.crouches.search(own):
                left, action = f"{left[: len(left) - len(own)]}{SQUATS}", "squat"
        if stays and action in HOLDABLE:
            said = f"{HELD}{long[1]:g}{HELD}" if long else HELD
        elif stays and action in LOW:
            said = f" for {ARRIVES + long[1]:g} seconds" if long else " "
        elif comes and action and action not in HOLDABLE | LOW:
            said = f"{ARROW}{STANDS} for {long[1] if long else HALT:g} seconds"
        place = match.end()
        if said:
            more = text[stop:].strip(EDGES)
            text, place = f"{left}{said}{ARROW if more else ''}{more}", len(left) + len(said)
    return text


def _lasting(text: str, place: int) -> tuple[int, float] | None:
    """Where seconds or minutes that stand at a place end, and how long they are."""
    place += len(text[place:]) - len(text[place:].lstrip())
    for name in ("seconds", "minutes"):
        if match := all_words().units[name].match(text, place):
            return match.end(), measured(match[0]).seconds or 0.0
    return None


def _as_before(before: Clause, clause: Clause) -> Clause:
    """A clause that names nothing but a side ("and then to the left") does what the one before it
    does, to that side."""
    words = all_words()
    if clause.degrees is not None or not words.sideways.match(clause.text):
        return clause
    said, other = (words.left.search(each.text) or words.right.search(each.text)
                   for each in (clause, before))  # fmt: skip
    if said is None or other is None or words.no_side.search(before.text):
        return clause
    text = before.text
    return replace(clause, text=f"{text[: other.start()]}{said[0]}{text[other.end() :]}")


# ---------------------------------------------------------------- order


def _ordered(text: str, read: Read) -> list[str]:
    """Parts that words of order part, first things first."""
    words = all_words()
    if listed := _listed(text, read):
        return listed
    found: tuple[str, str] | None = None
    after = words.after.match(text)
    if match := after or words.before.match(text):
        found = _subordinate(text[match.end() :], read)
        if found and not _is_time(text, match, found[0], read):
            found = None
    if found and not after:
        found = found[::-1]
    for pattern, swapped in (
        (words.beforehand, True), (words.then, False), (words.earlier, False),
        (words.later, True), (words.before, False), (words.after, True),
    ):  # fmt: skip
        for match in () if found else pattern.finditer(text):
            left, right = text[: match.start()], text[match.end() :]
            if pattern is words.then and _begins_after(text, match):
                continue  # "después" alone, not "después de haber saltado"
            bound = pattern in (words.before, words.after)
            stop = words.ended.search(left) if bound else None
            if stop and (words.comma.search(right.lstrip(), 1)
                         or (not stop["stop"] and _subordinate(right, read))):  # fmt: skip
                found = left, text[match.start() :]  # "Sits. Once he has waved, he bows."
                break
            if bound and not _is_time(text, match, right, read, sure=True):
                continue
            inner = bound and match[0].lstrip()[:1] == "," and words.named.match(left.strip())
            if inner and words.comma.search(right) and (two := _subordinate(right, read)):
                own = f"{left} {two[1].lstrip()}"  # "The actor, after waving, bows."
                found = (two[0], own) if swapped else (own, two[0])
                break
            if pattern is words.then and match[0].lstrip()[:1].isalpha():
                left, right = _around(left, right, match[0], read)
            if left.strip(EDGES) and right.strip(EDGES):
                found = (right, left) if swapped else (left, right)
                break
    if found:
        return [part for each in found for part in _ordered(each, read)]
    return [trimmed(words.then.sub(" ", text) if words.then.match(text) else text)]


def _listed(text: str, read: Read) -> list[str]:
    """What a list behind a few words and a colon asks for, where all of it is sure."""
    head, *rest = re.split("[:：]", text, maxsplit=1)
    items = [trimmed(item) for item in all_words().joint.split(rest[0])] if rest else []
    short = len(head.split()) <= HEADING and all(len(item.split()) <= NAMED for item in items)
    found = [read(measured(item).text) for item in items] if short else []
    return items if len(found) > 1 and all(each.surely and each.known for each in found) else []


def _is_time(text: str, word: re.Match[str], right: str, read: Read, sure: bool = False) -> bool:
    """Whether "before" or "after" says when; a noun behind it may be a place or a thing."""
    if all_words().noun.match(text, word.start()) is None:
        return True
    noun = read(measured(trimmed(all_words().stop.split(right, maxsplit=1)[0])).text)
    return noun.action is None or (noun.certainty > SURE and (noun.known or not sure))


def _subordinate(text: str, read: Read) -> tuple[str, str] | None:
    """A clause at the head of a sentence and the rest: parted at the comma (or else the blank)
    that leaves two actions, else at the first comma."""
    words = all_words()
    commas = [match.span() for match in words.comma.finditer(text)]
    if not commas:  # "after walking in he waves | and then bows"
        ends = [found.start() for each in (words.then, words.joint) if (found := each.search(text))]
        ands = [match.span() for match in words.joint.finditer(text)]  # not beside one
        cuts = [cut for cut in blanks(text) if not words.whoever.search(text[: cut[0]])
                and not any(cut[1] >= one[0] and cut[0] <= one[1] for one in ands)]  # fmt: skip
        early = [cut for cut in cuts if cut[1] < min(ends, default=0)]
        return _best(text, early, read) or _best(text, cuts, read)
    halves = _best(text, commas, read) or (text[: commas[0][0]], text[commas[0][1] :])
    return halves if all(half.strip(EDGES) for half in halves) else None


def _around(left: str, right: str, then: str, read: Read) -> tuple[str, str]:
    """Clauses on both sides of a word of order; where it stands late in its own clause ("und winkt
    dann"), that begins at the conjunction or comma before it."""
    borders = list(all_words().joint.finditer(left))
    own = left[borders[-1].end() :] if borders else ""
    if not own.strip(EDGES):
        return left, right
    late = all_words().verb_then.match(then)  # "und läuft dann langsam rückwärts" is one
    if right.strip(EDGES) and not late:  # "walks in, waves then bows" is three
        two = _differ(read(trimmed(own)), read(trimmed(right)))
        if two or len(own.split()) > 3 or re.search(CJK_SIGN, own):
            return left, right
    return left[: borders[-1].start()], f"{own.rstrip()} {right.lstrip()}"


def _joined(text: str, read: Read, strange: Strange) -> tuple[list[str], str]:
    """The text parted at stops and "and" into as many parts as tell of actions of their own, and
    what none of them holds: what is strange, and what tells of no action and would make unsure what
    stands beside it. Nothing stays of what is denied at the head ("don't run, …")."""
    words, text = all_words(), _counting(text, read)
    denial = words.denial.match(text) or words.refusal.search(text)
    who = denial and trimmed(text[: denial.start()])  # "she" of "she doesn't walk, she jumps"
    if denial and not (who and read(who).certainty > SURE):
        rest = trimmed(text[denial.end() :])
        instead, denied = read(measured(rest).text), read(trimmed(denial[0]))
        if instead.certainty > SURE or (rest and denied.surely not in (None, instead.action)):
            text = rest  # not in "don't move, please"
    borders = [match.span() for match in words.joint.finditer(text)]
    pieces = [(start, stop)
              for (_, start), (stop, _) in pairwise([(0, 0), *borders, (len(text), len(text))])
              if text[start:stop].strip(EDGES)]  # fmt: skip
    if len(pieces) < 2:
        return [text], ""
    each = [trimmed(text[start:stop]) for start, stop in pieces]
    asides = [_is_aside(text[start:stop], first=not place)
              for place, (start, stop) in enumerate(pieces)]  # fmt: skip
    more = [words.meanwhile.search(piece) or HELD_MARK.search(piece) for piece in each]
    kept = [bool(aside or said) for aside, said in zip(asides, more, strict=True)]
    odd = [not (aside or said or read(measured(piece).text).surely) and strange(piece)
           for aside, said, piece in zip(asides, more, each, strict=True)]  # fmt: skip
    # The best ways up to a piece, one for what their last part is.
    ways: list[dict[_Last, _Way]] = [{(None, "both", False): _Way()}]
    for stop in range(1, len(pieces) + 1):
        here = {last: way._replace(passed=(*way.passed, stop - 1))
                for last, way in ways[-1].items()}  # fmt: skip
        for start in range(max(0, stop - MOST_PIECES), stop):
            if (asides[start] and (start or all(asides[:stop]))) or any(odd[start:stop]):
                continue  # an aside stays with what stands before it, or else behind it
            part = trimmed(text[pieces[start][0] : pieces[stop - 1][1]])
            clause, side = measured(part), side_of(part)
            reading, far = read(clause.text), clause.far
            last = reading.action, side, far
            before = [way for (action, other, was_far), way in ways[start].items()
                      if action != reading.action or (reading.certainty > SURE
                      and ({other, side} == _SIDES or (far and was_far)))]  # fmt: skip
            led = far and reading.action in GOING  # its measure says that it is to be done
            led |= clause.seconds is not None and reading.action == "stand"
            sure = SURE_AT_MARK if led else SURE
            if before and reading.certainty > sure:
                parts, passed, certainty = max(before, key=_Way.rank)
                way = _Way((*parts, part), passed, certainty + reading.certainty)
                here[last] = max(way, here.get(last, way), key=_Way.rank)
        ways.append(here)
    best = max(ways[-1].values(), key=_Way.rank)
    if len(best.parts) > 1 or (
        any(odd) and any(read(measured(part).text).known for part in best.parts)
    ):
        return list(best.parts), HELD_MARK.sub("", ", ".join(each[at] for at in best.passed))
    if lost := _lost(text, pieces, each, kept, read):
        heard = [span for span, piece in zip(pieces, each, strict=True) if piece not in lost]
        text = trimmed(text[heard[0][0] : heard[-1][1]])
    return [text], HELD_MARK.sub("", ", ".join(lost))


def _counting(text: str, read: Read) -> str:
    """A text in which what is said again and again is said once, and how often."""

    def times(said: re.Match[str]) -> str:
        number = said[0].casefold().count(said[1].casefold())
        counted = read(said[1]).surely not in (None, *GOING)
        return f"{said[1]} {number} times" if counted else said[0]

    if _AGAIN.search(text) is None or says_number(text):
        return text
    return trimmed(_AGAIN.sub(times, text))


def _lost(
    text: str, pieces: Sequence[Span], each: Sequence[str], kept: Sequence[bool], read: Read
) -> list[str]:
    """Pieces beside an "and", not `kept`, of which nothing is heard where another is known."""
    words, known, lost = all_words(), False, list[str]()
    joined = [words.conjunction.fullmatch(text, one[1], other[0]) is not None
              and text[other[0] : other[0] + 1] != "'"
              for one, other in pairwise(pieces)]  # fmt: skip
    for at, piece in enumerate(each):
        own = measured(piece).text
        reading = read(own)
        known |= reading.surely is not None and reading.known
        if at > 0 and joined[at - 1]:  # with nobody or nothing else that does it
            size = len(own) / 2 if re.match(CJK_SIGN, own) else len(own.split())
            told = (size > 2 or (size > 1 and is_verb(own))) and not words.another.match(piece)
        else:  # elsewhere it may be a scene
            told = at < len(joined) and joined[at] and is_told_of(piece)
        heard = reading.surely is not None or reading.known or words.tempo.search(piece)
        if told and not (kept[at] or heard):
            lost.append(piece)
    return lost if known else []


def _begins_after(text: str, then: re.Match[str]) -> bool:
    """Whether a word of order is the first one of a longer phrase that says the opposite."""
    word = then[0].lstrip(EDGES)
    after = all_words().after.match(text, then.end() - len(word))
    units = all_words().units
    if after is None or any(
        units[name].match(text, after.end()) for name in ("seconds", "minutes")
    ):
        return False
    return len(after[0].rstrip()) > len(word.rstrip(EDGES))


def _is_aside(piece: str, *, first: bool) -> bool:
    """Whether a piece names but limbs, sides and posture, or, behind another, what is not done or
    what it is like."""
    words, rest = all_words(), all_words().aside.sub(" ", piece).strip(EDGES)
    return not rest or (not first and bool(words.lacking.match(rest) or words.similes.match(rest)))


class _Way(NamedTuple):
    """A parting of the first pieces of a sentence, and which of them no part holds."""

    parts: tuple[str, ...] = ()
    passed: tuple[int, ...] = ()
    certainty: float = 0.0

    def rank(self) -> tuple[int, int, float]:
        return len(self.parts), -len(self.passed), self.certainty


def _differ(first: Reading, second: Reading, sure: float = SURE) -> bool:  # as two actions
    return min(first.certainty, second.certainty) > sure and first.action != second.action


def _best(text: str, cuts: Iterable[Span], read: Read) -> tuple[str, str] | None:
    """The halves of a text that tell most surely of two actions, both known if any are; None where
    none do."""
    best, most = None, (False, SURE)
    for stop, start in cuts:
        left, right = trimmed(text[:stop]), trimmed(text[start:])
        first, second = (read(measured(half).text) for half in (left, right))
        if second is GOT_UP and _differ(first, second):  # "se | pone de pie" is surer, and wrong
            return left, right
        rank = first.known and second.known, min(first.certainty, second.certainty)
        if _differ(first, second) and rank > most:
            best, most = (left, right), rank
    return best


# ---------------------------------------------------------------- at once


def _at_once(first: str, second: str, read: Read, *, in_row: bool) -> Clause | None:
    """A clause and what the arms do meanwhile, if a word says so, a participle or "with" begins the
    second one, て ends the first one (not in a row of such), or each arm does one; else None."""
    words = all_words()
    marks = words.meanwhile, words.throughout
    said = any(mark.search(each) for each in (first, second) for mark in marks)
    if pair := _pair(first, second, read, SURE_IF_SAID if said else SURE):
        sign = words.sign.match(second)
        manner = words.manner.search(first) and pair.clause.meanwhile == first and not in_row
        if said or pair.one_arm_each or (not pair.arms_alone and (sign or manner)):
            return pair.clause
    return None


def _parted(text: str, read: Read) -> Clause | None:
    words = all_words()  # as `_at_once`
    marks = [match.span() for match in words.meanwhile.finditer(text)]
    joints = [match.span() for match in words.joint.finditer(text)]
    signs = [(match.start(), match.start()) for match in words.sign.finditer(text)]
    said = bool(marks or words.throughout.search(text))
    each = names_both(text)
    for cuts, sure, enough in (
        (marks, SURE_AT_MARK, SURE_AT_MARK),
        (joints, SURE_AT_MARK if each else SURE_IF_SAID, SURE_IF_SAID),
        (signs + (blanks(text) if said or each else []), SURE, SURE),
    ):
        found = [pair for stop, start in cuts
                 if (pair := _pair(text[:stop], text[start:], read, sure))
                 and (pair.one_arm_each or (said and pair.certainty > enough)
                      or ((stop, start) in signs and not pair.arms_alone))]  # fmt: skip
        if found:
            return max(found, key=lambda pair: pair.certainty).clause
    for pose in words.posed.finditer(text):
        rest = f"{text[: pose.start()].rstrip()} {text[pose.end() :].lstrip()}"
        pair = _pair(rest, pose[0], read, SURE)
        if pair and (pair.one_arm_each or not pair.arms_alone):
            return pair.clause
    return None


@dataclass(frozen=True)
class _Pair:
    """A clause of two things done at once, how surely each is one of its own, and whether the arms
    do both, or each arm one."""

    clause: Clause
    certainty: float
    arms_alone: bool
    one_arm_each: bool


def _pair(left: str, right: str, read: Read, sure: float) -> _Pair | None:
    """Two halves as one clause; None where they are not two actions, or the arms do neither."""
    words = all_words()
    halves = [
        trimmed(words.meanwhile.sub(" ", words.throughout.sub(" ", half))) for half in (left, right)
    ]
    halves = [words.dangling.sub("", half) for half in halves]  # "walks with"
    if any(words.limb.search(half) for half in halves):  # which nothing is said of
        return None
    first, second = [read(measured(half).text) for half in halves]
    if not (first.arms or second.arms) or not _differ(first, second, sure):
        return None
    body, other = (1, 0) if first.arms and not second.arms else (0, 1)
    sides, alone = _sides(*halves), first.arms and second.arms
    halves = [_naming(half, side) for half, side in zip(halves, sides, strict=True)]
    meanwhile, certainty = HELD_MARK.sub("", halves[other]), min(first.certainty, second.certainty)
    clause = replace(measured(halves[body]), meanwhile=meanwhile, side=sides[other])
    return _Pair(clause, certainty, alone, alone and set(sides) == _SIDES)


def _sides(first: str, second: str) -> list[str]:
    """Those of two halves, of which one may say "the other"."""
    sides = [side_of(first), side_of(second)]
    for row, half in enumerate((first, second)):
        if sides[row] == "both" and sides[1 - row] in _SIDES and all_words().other.search(half):
            sides[row] = "left" if sides[1 - row] == "right" else "right"
    return sides


def _naming(half: str, side: str) -> str:
    """A half that names its side, where it said "the other"."""
    words = all_words()
    if side not in _SIDES or side_of(half) == side:
        return half
    return words.other.sub(lambda said: words.others[bare(said[0])][side == "right"], half)
