"""The words by which a sentence says order and measure, as patterns; and those of what a model may
not have learned.

They are those of src/configs/measures.yaml and unlearned.yaml, of all languages at once.
"""

import gc
import re
import unicodedata
from collections.abc import Callable, Iterator, Sequence
from functools import cache, cached_property, lru_cache, partial
from itertools import groupby
from typing import Any

from ..config_loader import load_yaml, packaged_config
from ..model.clip.out_of_domain import OutOfDomainDetector, words_of

MAX_COUNT = 20
MOST = {"metres": 100.0, "degrees": 720.0, "seconds": 600.0, "steps": 50.0}
UNITS = {  # of a sentence: what they measure, how much of it one is, and the least number of them
    "degrees": ("degrees", 1.0, 15.0),  # Japanese counts with the same word: a few 度 are times
    "minutes": ("seconds", 60.0, 0.0),
    "seconds": ("seconds", 1.0, 0.0),
    "feet": ("metres", 0.3048, 3.0),  # one and two are a body's own
    "yards": ("metres", 0.9144, 0.0),
    "centimetres": ("metres", 0.01, 20.0),  # fewer are how far a hand is raised
    "metres": ("metres", 1.0, 0.0),
    "steps": ("steps", 1.0, 2.0),  # one step is mostly a way of saying where to
}
WHOLE = ("ups", "bends", "posed", "falls", "crouched")  # patterns of whole clauses
ARROW, STANDS = " → ", "stands still"  # what then follows; who waits
FEW = 2  # words that may follow "in place" where nothing is before it
ARRIVES = 1.5  # seconds until what is held so many seconds is there, and until it is no more
EDGES = " \t,;.!?:()/+&|。、，！？：；（）「」…—–·-"  # what no clause begins or ends with
_CJK = "\u3040-\u30ff\u3400-\u9fff"
# Classes without case and, but for the few of CJK_SIGN, without wide ranges: re spells out every
# character of a range, seconds in all; and makes a table of a class of three ranges beyond Latin-1.
CJK_SIGN = f"(?-i:[{_CJK}])"
_LATIN, _MORE = "_A-Za-zÀ-ÖØ-öø-ÿ", "[Ā-ɏ\u1e00-\u1eff]"
_LETTER, _SIGN = (f"(?-i:[{each}]|{_MORE})" for each in (_LATIN, f"{_LATIN}0-9"))  # or a digit
_COMMAS = r"[,;、，；]"
# Where a clause may end: not at the point of a number, the dash of a word.
_STOPS = (
    r"(?:[;!?:()。、，；！？：（）「」…—–]+|(?<!\d)[,.]|[,.](?!\d)"
    r"|(?<=\s)[-/+&|](?=\s)|(?<!\S)\d[.)](?=\s))"
)
_ARROWS = r"\s*(?:[-=]*>+|[→➜➔⇒▶»])"
_TAIL = re.compile(
    "[いえきぎくぐけげこしじすずせそたちってなねびべぶまみむめらりるれろん]{0,2}"
)  # of a verb
_ARTICLE = re.compile(" (a|an|the|un|una|une|el|la|los|las|le|les|ein|eine|einen|den|die|das)$")
_ONES = "一二三四五六七八九"
_VALUES = {sign: value for value, sign in enumerate(_ONES, 1)} | {"两": 2}
_TENS = f"(?:[{_ONES}]十|十(?=[{_ONES}]))[{_ONES}]?"  # 十 alone is a word of its own
_DIGITS = rf"(?:\d+(?:[.,]\d+)?|(?:[{_ONES}两]百零?(?:{_TENS}|[{_ONES}])?|{_TENS}))"
# Japanese says what is not done before its denial.
_NOT = "(?:[のん](?:では|じゃ)なく(?:て)?|の?(?:代|か)わりに)"
_NOT_THIS = f"(?:^|(?<=[、。，,]))[^、。，,]{{1,40}}?{_NOT}[、，,]?"
# German says its verb behind what is done with it.
_STATT = rf"(?<!{_LETTER})(?:an)?statt\s[^,;.!?]{{0,60}}?\bzu\s+{_LETTER}+n\b,?"
_TRAIL = r"(?:\s+lang(?!\w))?"  # behind a measure, and nothing without it
_STEP = r"(?:(?:step|schritt|paso|étape|etape|take|toma|prise)\s*)?"  # before a number of a list
_RUN = rf"[{_CJK}]+|(?:{_LETTER})+"  # of signs or of letters, as patterns part words
WORD = re.compile(r"\w+")
NUMBERED = re.compile(rf"(?<![^\s,;:.]){_STEP}(\d\d?)\s*[.):](?!\d)\s*", re.I)


class Rare:
    """A pattern that holds one of some words, compiled where a text first has letters of one: most
    sentences never do, and to compile all of them took a third of a command's time.

    Args:
        pattern: no text without one of the words matches it.
        words: as they stand in measures.yaml.
    """

    def __init__(self, pattern: str, words: Sequence[str]) -> None:
        self.pattern = pattern
        self._whole, self._parts = _keys(words)

    @cached_property
    def _compiled(self) -> re.Pattern[str]:
        return re.compile(self.pattern, re.I)

    def may(self, text: str) -> bool:
        said, own = _said(text)
        return not self._whole.isdisjoint(own) or any(part in said for part in self._parts)

    def search(self, text: str, start: int = 0) -> re.Match[str] | None:
        """As of a compiled pattern, and so are the others."""
        return self._compiled.search(text, start) if self.may(text) else None

    def match(self, text: str, start: int = 0) -> re.Match[str] | None:
        return self._compiled.match(text, start) if self.may(text) else None

    def fullmatch(self, text: str) -> re.Match[str] | None:
        return self._compiled.fullmatch(text) if self.may(text) else None

    def finditer(self, text: str) -> Iterator[re.Match[str]]:
        return self._compiled.finditer(text) if self.may(text) else iter(())

    def sub(self, by: str | Callable[[re.Match[str]], str], text: str) -> str:
        return self._compiled.sub(by, text) if self.may(text) else text


class Words:
    """The patterns of all languages."""

    def __init__(self, tables: Sequence[dict[str, Any]]) -> None:
        def all_of(key: str) -> list[str]:
            return [word for table in tables for word in table.get(key, [])]

        numbers: dict[str, int] = {}
        adverbs: dict[str, int] = {}
        sides: dict[str, list[str]] = {}
        for table in tables:
            numbers |= {word: i for i, word in enumerate(table["numbers"], 1)}
            numbers |= table["more_numbers"]
            adverbs |= {word: i for i, word in enumerate(table.get("often", []), 1)}
            sides |= table.get("other", {})
        self.numbers = {bare(word): value for word, value in numbers.items()}
        self.adverbs = {bare(word): value for word, value in adverbs.items()}
        self.angles, self.tempos = (
            {bare(word.rpartition("|")[2].rstrip("$")): float(value)
             for table in tables for word, value in table[key].items()}
            for key in ("angles", "tempos")
        )  # fmt: skip
        joints = all_of("and")
        self.conjunction = re.compile(rf"\s*{_any(joints)}\s*", re.I)
        self.comma = re.compile(rf"\s*{_COMMAS}\s*")
        self.stop = re.compile(rf"{_STOPS}|{_any(joints)}", re.I)
        self.joint = re.compile(rf"{self.stop.pattern}|{_any(all_of('next'))}", re.I)
        then = rf"(?:{_any(all_of('then'))}|{_ARROWS})"
        # Who has arrived, at a head: "and once she lands she waves", but not "lands a blow".
        head = rf"(?:^|{_STOPS}\s*(?:{_any(joints)}\s*)?|{_any(joints)}\s*|(?<=[て了来起]))\s*"
        there = rf"{_any(all_of('arrived'))}(?!\s+{_any([*all_of('own'), *all_of('places')])})"
        self.then = re.compile(rf"(?:{_STOPS}?\s*{then}|{head}{there}){_COMMAS}?", re.I)
        self.earlier = re.compile(_any(all_of("earlier")) + _COMMAS + "?", re.I)
        self.later = re.compile(_any(all_of("later")) + _COMMAS + "?", re.I)
        self.meanwhile, self.throughout, self.before, self.after = (
            re.compile(rf"{_COMMAS}?\s*{_any(all_of(key))}\s*", re.I)
            for key in ("meanwhile", "throughout", "before", "after")
        )
        behind = rf"(?:{_STOPS}\s*(?:{_any(joints)}\s*)?|{_any(joints)}\s*)"
        said = rf"{_STOPS}?\s*{_any(all_of('beforehand'))}|{behind}{_any(all_of('previously'))}"
        self.beforehand = re.compile(rf"(?:{said}){_COMMAS}?", re.I)
        self.greeting = re.compile(rf"^\s*{_any(all_of('greetings'))}\s*{_STOPS}\s*(?=\S)", re.I)
        self.closing = re.compile(rf"\s*{_STOPS}\s*{_any(all_of('closings'))}\W*$", re.I)
        cut = "|".join(re.escape(word[:-1]) for word in all_of("short"))
        self.short = re.compile(rf"(?<!{_SIGN})(?:{cut})\.(?=\s+{_any(all_of('limbs'))})", re.I)
        idioms = {said: plain for table in tables for plain, many in table.get("idioms", {}).items()
                  for said in many}  # fmt: skip
        self.idiom = Rare(_any(idioms), [*idioms])
        self.plainly = {bare(re.sub(r"^.*\||/.*$|\$$", "", said)): idioms[said] for said in idioms}
        nouns = rf"{_any(all_of('prepositions'))}\s*{_any(all_of('own'))}"
        self.noun = re.compile(rf"{_COMMAS}?\s*{nouns}", re.I)
        owned = [*all_of("own"), *all_of("left"), *all_of("right")]
        asides = [*all_of("limbs"), *all_of("aside"), *all_of("throughout")]
        self.ended = re.compile(rf"(?:(?P<stop>[.!?;。！？；…])|{_any(joints)},?)\s*$", re.I)
        self.aside = re.compile(_any([*owned, *asides]), re.I)
        denial = rf"\s*{_any(all_of('denied'))}.{{0,120}}?(?:{_STOPS}|{_any(all_of('but'))})"
        self.denial = re.compile(rf"(?:{denial})+", re.I)
        own = _any(owned)
        limbs = rf"(?:{own}\s*)*{_any(all_of('limbs'))}"
        # But "coup de poing" neither names a fist nor is it a gerund.
        self.sign = re.compile(rf"(?<!de )(?:{_any(all_of('with'))}|{limbs})", re.I)
        self.dangling = re.compile(rf"\s+{_any([*filter(str.isalpha, all_of('with'))])}$", re.I)
        self.limb = re.compile(rf"^{limbs}$", re.I)
        self.manner = re.compile(rf"{_any(all_of('manner'))}$", re.I)
        # "right at the corner", but "a right at the corner", "turns right at the corner"
        apart = "".join(rf"(?<!(?<!{_LETTER}){word}\s)" for word in all_of("to_side"))
        self.no_side = re.compile(apart + _any(all_of("no_side")), re.I)
        self.left, self.right, self.round, self.corner, self.uncounted, self.takes, self.lacking = (
            re.compile(_any(all_of(key)), re.I)
            for key in ("left", "right", "round", "corners", "uncounted", "takes", "lacking")
        )
        self.eights, self.winds, self.similes = (
            Rare(_any(all_of(key)), all_of(key)) for key in ("eights", "winds", "similes")
        )
        self.other = re.compile(_any(sides), re.I)
        self.others = {bare(word.partition("/")[0]): both for word, both in sides.items()}
        self.angle = re.compile(_any(all_of("angles")), re.I)
        self.often = re.compile(_any(adverbs), re.I)
        number = rf"(?P<number>{_DIGITS}|{_any(numbers)})"
        ready = rf"(?:(?<![\w.])(?<!\d,)|(?<={CJK_SIGN}))"
        articles = all_of("articles")
        fractions = {word: value for table in tables for word, value in table["fractions"].items()}
        self.numbers |= {bare(word): value for word, value in fractions.items()}
        self.numbers |= {bare(word): 1 for word in articles}
        steps = {noun: stays for table in tables for noun, stays in table["steps"].items()}
        self.steps = {bare(noun.partition("/")[0]): stays for noun, stays in steps.items()}
        larger = rf"(?:{_any(all_of('larger'))}|{_any(numbers)})"
        self.larger = re.compile(rf"{larger}(?:\s+{_any(all_of('and'))})?[\s-]*$", re.I)
        half = rf"(?P<half>\s*{_any(all_of('half'))})?{_TRAIL}"

        def measure(name: str) -> str:
            one = articles if name in ("metres", "minutes") else []  # not "a second wave"
            words = {*numbers, *fractions, *one}
            words -= set(all_of("vague")) if name == "steps" else set()
            amount = rf"{_lead()}{ready}(?P<number>{_DIGITS}|{_any(sorted(words))})"
            if name == "steps":
                return rf"{amount}\s*(?P<manner>{_LETTER}+\s+)?(?P<noun>{_any(steps)})"
            return rf"{amount}[\s-]*{_any(all_of(name))}{half}"

        self.units = {
            name: Rare(measure(name), [*steps] if name == "steps" else all_of(name))
            for name in UNITS
        }
        heads_only = rf"(?:^|(?<=[,;:.!?、。])\s*|(?<!{_SIGN}){_any(joints)}\s*)"
        after, later = _any(all_of("after_time")), _any(all_of("later_time"))
        self.pauses = {
            f"{when}_{name}": Rare(f"{pattern}{_COMMAS}?", all_of(name))
            for name in ("seconds", "minutes")
            for when, pattern in (
                ("after", rf"(?<!{_SIGN}){after}\s*{measure(name)}"),
                ("later", rf"{heads_only}{measure(name)}\s*{later}(?!\s+(?:de|du|des)\b)"),
            )
        }
        ends = rf"(?=\s*(?:$|{_STOPS}|{_any(joints)}|{then}))"
        verb = rf"(?<!{_LETTER})(?P<verb>{_LETTER}+(?:\s+{_any(all_of('reflexive'))}){{0,2}})\s+"
        rest = rf"\s+(?P<rest>(?:{_any(all_of('again'))}\s+)?{_any(all_of('particles'))}){ends}"
        lasts = [*all_of("seconds"), *all_of("minutes")]
        lasting = _any(lasts)
        long = rf"[^\s,;.]+(?:\s+[^\s,;.]+)?\s*{lasting}"
        self.late = Rare(rf"{verb}(?P<pause>{after}\s+{long}){rest}", lasts)
        undone = rf"{_any(all_of('undone'))}(?:\s*{_any(all_of('again'))})*"
        first = rf"(?:\s*{_COMMAS}\s*|\s+|(?<={CJK_SIGN}))"
        joined = rf"(?:{_any(joints)}\s*)?(?:{_any(all_of('then'))}\s*)?"
        self.undone = Rare(rf"{first}{joined}{undone}{ends}", all_of("undone"))
        # None of them begins within a row of signs, which would be tried from each of them.
        stops = rf"(?<![\s,.;!?:()。、，！？：；（）「」…—–])\s*{_STOPS}\s*"
        blank = rf"(?:{stops}|\s+|(?<={CJK_SIGN}))"
        further = rf"(?:{stops}{joined}|{blank}{_any(joints)}\s*(?:{then}\s*)?"
        further += rf"|{blank}{then}\s*{_COMMAS}?\s*|(?<={CJK_SIGN}))"
        further += rf"(?:{_any(all_of('who'))}\s*)?"
        halts = rf"{_any(all_of('halts'))}(?:\s*{_any(all_of('abruptly'))})*"
        amount = rf"(?:{_DIGITS}|{_any([*numbers, *fractions])})[\s-]*{lasting}"
        ends = rf"(?:{ends}|(?=\s*{_lead()}{amount}))"
        self.halts = Rare(rf"{further}{halts}{ends}", all_of("halts"))
        self.halt_alone = Rare(rf"^(?:{_any(all_of('who'))}\s+)?{halts}\W*$", all_of("halts"))
        someone = rf"(?:(?:{_any(all_of('who'))}|{_any(all_of('own'))}(?:\s+{_LETTER}+){{1,2}})\s+"
        someone += rf"|{CJK_SIGN}{{1,8}})?"
        self.downs = Rare(rf"^{someone}{_any(all_of('downs'))}", all_of("downs"))
        self.crouched = Rare(rf"^{someone}{_any(all_of('crouches'))}\W*$", all_of("crouches"))
        self.falls = Rare(rf"^{someone}{_any(all_of('falls'))}\W*$", all_of("falls"))
        self.things = Rare(_any(all_of("things")), all_of("things"))
        whose = _any(all_of("own"))
        self.another = re.compile(rf"^{whose}", re.I)  # who or what does it, behind an "and"
        self.named = re.compile(rf"^{whose}\s*(?:{_LETTER}+\s+)?{_LETTER}+$", re.I)  # somebody
        person = rf"(?:{whose}\s+(?:{_LETTER}+\s+)?)?{_any(all_of('someone'))}"
        subject = rf"^(?:{person}|{_any(all_of('who'))})\s*(?=\S)"
        self.subject = re.compile(subject, re.I)
        bends = rf"{_any(all_of('bends'))}(?:\s*{_any(all_of('bending'))})*\W*$"
        bends = re.sub(f"(?<={CJK_SIGN})SIDE|SIDE(?={CJK_SIGN})", "[左右]", bends)
        bends = bends.replace("SIDE", r"\w+")  # one of them is said somewhere
        bends = rf"^(?=.*{_any(all_of('sides'))}){someone}{bends}"
        self.bends = Rare(bends, [word.replace("SIDE", " ") for word in all_of("bends")])
        self.verb_then = re.compile(rf"\s*{_any(all_of('verb_then'))}", re.I)
        again = rf"(?:\s*{_any(all_of('again'))})*"
        up = rf"{_any(all_of('ups'))}(?:\s+{_any(all_of('seats'))})?{again}"
        self.ups = Rare(rf"^{someone}{up}\W*$", all_of("ups"))
        # "with both arms raised", "mit erhobenen Armen", "arms up" behind a comma, in whole phrases
        arms = _any(sorted({*all_of("limbs")} - {*all_of("fists")}))
        aloft = rf"\s+{_any(all_of('aloft'))}"
        up = rf"{arms}(?:\s+{_any(all_of('sided'))})?(?:{aloft}){{1,3}}"
        having = rf"{_any(all_of('having'))}\s+(?:{_LETTER}+\s+){{0,3}}?"
        raised = rf"{having}(?:{up}|{_any(all_of('lifted'))}\s+{arms}(?:{aloft})?)"
        alone = rf"(?:^|(?<=[,;:、]))\s*(?:{whose}\s+){{0,3}}{up}(?=\s*(?:$|{_STOPS}))"
        posed = rf"{raised}|{alone}|{_any(all_of('posed'))}"
        self.posed = Rare(posed, [w for key in ("aloft", "lifted", "posed") for w in all_of(key)])
        holds, kept = _any(all_of("holds")), _any(all_of("kept"))
        there = rf"(?:\s*{_any(all_of('there'))})"
        goes_on = rf"(?:{holds}\s+{kept}|{kept}\s+{holds}){there}*|{_any(all_of('stays'))}{there}+"
        held = rf"{further}(?:{_any(all_of('held'))}|{goes_on}){ends}"
        self.held = Rare(held, [w for key in ("held", "holds", "stays") for w in all_of(key)])
        self.arms, self.about = (re.compile(_any(all_of(w)), re.I) for w in ("limbs", "about"))
        side, wields = _any(all_of("sided")), _any(all_of("wields"))
        tools = [_any(all_of(limbs)) for limbs in ("limbs", "legs")]
        tools = [
            rf"{wields}\s+(?:{whose}\s+)?(?:{side}\s+{tool}|{tool}\s+{side})" for tool in tools
        ]
        near = rf"(?!\s+{wields}\s+{whose})"  # "with his left hand on his hip"
        self.footed = Rare(
            f"(?:{tools[1]}|{_any(all_of('footed'))})", all_of("sided") + all_of("footed")
        )
        handed = rf"(?:{tools[0]}|{_any(all_of('handed'))}){near}|{self.footed.pattern}"
        self.handed = Rare(
            handed, [w for key in ("sided", "handed", "footed") for w in all_of(key)]
        )
        self.denies = re.compile(
            _any([w for key in ("lacking", "denied", "refuses") for w in all_of(key)]), re.I
        )
        refused = rf"{_any(all_of('refuses'))}.{{0,120}}?(?:{_STOPS}|{_any(all_of('but'))})"
        self.refusal = re.compile(refused, re.I)
        who = rf"[,;]|(?=\s+{_any(all_of('who'))}\s)"  # as far as a stop, or whoever does it
        self.whoever = re.compile(rf"{_any(all_of('who'))}$", re.I)  # does what follows
        instead = rf"{_any(all_of('instead'))}(?:[^,;.!?]{{0,60}}?(?:{who}))?"
        self.instead = re.compile(rf"(?:{instead}|{_STATT}|{_NOT_THIS})\s*", re.I)
        goals, ways, verbs_to = dict[str, str](), list[str](), list[str]()
        for table in filter(lambda table: "goals" in table, tables):
            verbs = {verb: plain for plain, many in table["goals"].items() for verb in many}
            tos, verbs_to = table.get("goes_to", []), [*verbs_to, *verbs]
            goals |= {f"{verb} {to}".rstrip(): verbs[verb] for verb in verbs for to in tos or [""]}
            ways.append(rf"{_any(verbs)}\s+{_any(tos)}" if tos else _any(verbs))
        there = rf"(?![左右]){CJK_SIGN}{{1,5}}?{_any(all_of('beside'))}"
        nowhere = _any([*all_of("left"), *all_of("right"), *all_of("nowhere")])
        goal = rf"(?P<way>{'|'.join(ways)})(?:\s+(?!{nowhere}){_LETTER}+{ends}|{there})"
        self.goal = Rare(goal, verbs_to)
        self.plainly |= {bare(to): plain for to, plain in goals.items()} | goals
        self.sideways = re.compile(rf"^(?:{_any([*owned, *all_of('toward')])}\s*)+$", re.I)
        others = rf"(?![\s-]*{_any(all_of('uncounted'))})"
        self.piece = Rare(_any(all_of("pieces")), all_of("pieces"))
        times = rf"{_any(all_of('times'))}|(?:{_any(all_of('pieces'))}|[x×](?!\w)){others}"
        self.tempo, self.many, self.head_turns = (
            Rare(_any(all_of(key)), all_of(key)) for key in ("tempos", "many", "head_turns")
        )
        self.in_place, self.off, self.crouches, self.bowed = (
            Rare(_any(all_of(key)), all_of(key)) for key in ("in_place", "off", "crouches", "bowed")
        )
        low = {said: does for t in tables for does, many in t["postures"].items() for said in many}
        self.posture = Rare(rf"{_any(low)}(?:\s*{_COMMAS})?", [*low])
        self.postures = {bare(said): does for said, does in low.items()}
        back = {said: does for t in tables for does, many in t["returns"].items() for said in many}
        self.returns = Rare(_any(back), [*back])
        self.returned = {bare(said): does for said, does in back.items()}
        self.times = re.compile(rf"{ready}(?:{number}\s*(?:{times})|[x×]\s*(?P<after>\d+))", re.I)
        several = [word for word, value in numbers.items() if value > 1]  # "one" is mostly somebody
        counted = rf"(?:{others}(?=[\s-]+\w)|(?={_any(all_of('nouns'))}))"
        self.bare = re.compile(rf"{ready}(?P<number>\d+|{_any(several)}){counted}", re.I)
        heads = _any(joints + all_of("first"))
        self.loose = re.compile(rf"^(?:{heads}\s*{_COMMAS}?\s*)+|\s+{_any(joints)}$", re.I)


def _lead() -> str:
    """Words before a measure that mean nothing without it."""
    leads = "for|during|by|about|around|roughly|durante|por|unos|unas|pendant|environ|de"
    leads += "|für|um|von|etwa|ungefähr|rund"
    return rf"(?:(?<!\w)(?:{leads})\s+)*"


def _any(words: Sequence[str] | dict[str, Any]) -> str:
    """One of the words, whole where the writing parts words; never empty."""
    longest_first = map(_whole, sorted(dict.fromkeys(words), key=len, reverse=True))
    ordered = sorted(longest_first, key=lambda parts: (parts[0], parts[2]))
    alike = groupby(ordered, key=lambda parts: (parts[0], parts[2]))
    runs = [f"{before}(?:{'|'.join(word for _, word, _ in run)}){after}"
            for (before, after), run in alike]  # fmt: skip
    return "(?:" + "|".join(runs) + ")" if runs else r"(?!)"


def _whole(word: str) -> tuple[str, str, str]:
    """A word's pattern, and what must stand before and behind it."""
    stays, bar, word = word.rpartition("|")
    word, slash, never = word.partition("/")
    follows = f"(?![{never}])" if slash else r"(?=\W*$)" if word.endswith("$") else ""
    word = word.removesuffix("$")
    if bar:
        before = f"(?<![{stays[1:]}])" if stays.startswith("^") else f"(?<={stays})"
        return before, word, follows
    pattern = "|".join(map(_loosely, _misspelt(word[:-1]) if word.endswith("~") else [word]))
    if re.search(f"[{_CJK}°]", word):
        return "", pattern, follows
    return f"(?<!{_LETTER})", pattern, follows + ("" if word.endswith("'") else f"(?!{_SIGN})")


def _loosely(word: str) -> str:
    """The pattern of a word, whose accents may be missing."""
    if word.isascii() and word.isalpha():
        return word
    pattern = re.sub("[à-öø-ÿ]", lambda each: f"[{each[0]}{bare(each[0])}]", re.escape(word))
    pattern = pattern.replace("ß", "(?:ß|ss)").replace("'", "['’]").replace(r"\ ", r"\s+")
    return pattern.replace(r"\*", f"{_LETTER}+")


def _misspelt(word: str) -> list[str]:
    """A word, and it with two letters swapped, one doubled or one left out; the first one stays."""
    inner = range(1, len(word) - 1)
    swapped = [word[:i] + word[i + 1] + word[i] + word[i + 2 :] for i in inner]
    doubled = [word[:i] + word[i] + word[i:] for i in range(1, len(word))]
    short = [word[:i] + word[i + 1 :] for i in inner] if len(word) > 4 else []
    return [word, *swapped, *doubled, *short]


def _keys(words: Sequence[str]) -> tuple[frozenset[str], tuple[str, ...]]:
    """Of each word what a text that has it has as well, without case and accents: a whole word in
    letters, or, in Chinese and Japanese and where a word may go on, signs somewhere."""
    whole, parts = set[str](), set[str]()
    for word in words:
        _, bar, word = word.rpartition("|")
        word = word.partition("/")[0].removesuffix("$")
        for each in _misspelt(word[:-1]) if word.endswith("~") else [word]:
            key = max(re.findall(_RUN, bare(each)), key=len, default=bare(each))
            if bar and not re.fullmatch(r"[\w\s]+", word):
                key = ""  # a pattern of its own
            alone = not bar and "*" not in word and re.fullmatch(f"(?:{_LETTER})+", key)
            (whole if alone else parts).add(key)
    return frozenset(whole), tuple(parts)


@lru_cache(16)
def _said(text: str) -> tuple[str, frozenset[str]]:
    """A text without case and accents, and its words in letters."""
    said = bare(text)
    return said, frozenset(re.findall(_RUN, said))


def bare(word: str) -> str:
    """A word without case and accents, its apostrophes straight."""
    if word.isascii():
        return word.casefold()
    letters = unicodedata.normalize("NFD", word.casefold().replace("’", "'").replace("ı", "i"))
    return "".join(letter for letter in letters if not unicodedata.combining(letter))


@cache
def all_words() -> Words:
    """Those of all languages, read once."""
    tables, collects = list(load_yaml(packaged_config("measures.yaml")).values()), gc.isenabled()
    gc.disable()  # else a third of the time goes into looking for garbage, of which there is none
    try:
        return Words(tables)
    finally:
        if collects:
            gc.enable()


# ---------------------------------------------------------------- plain words


def plain_text(text: str) -> str:
    """A text with single blanks, its signs of one kind."""
    return unicodedata.normalize("NFKC", " ".join(text.split()))


def tidied(sentence: str) -> str:
    """A sentence without greeting and thanks, with plain words for idioms and pauses and arrows for
    the numbers of a list; it itself where it has nothing of these."""
    words, plain = all_words(), plain_text(sentence)
    text = plain_text(re.sub("([\u2460-\u2468])", r" \1) ", sentence))  # circled 1 to 9
    text = words.greeting.sub("", text)
    text = words.closing.sub("", text) or text
    text = words.short.sub(lambda cut: cut[0][:-1], text)
    text = words.halt_alone.sub(STANDS, text)
    text = words.idiom.sub(lambda said: words.plainly[bare(plain_text(said[0]))], text)
    text = words.goal.sub(_going, text)
    text = words.instead.sub(_without, text).lstrip(EDGES) or text
    text = words.undone.sub(_undone, text)
    text = words.late.sub(r"\g<pause> \g<verb> \g<rest>", text)
    for name, pause in words.pauses.items():
        factor = UNITS[name.partition("_")[2]][1]
        text = pause.sub(partial(_pause, factor=factor), text)
    text = text.removeprefix(ARROW.lstrip())
    if text.endswith(ARROW):  # "he waves after two seconds"
        *parts, rest = text.removesuffix(ARROW).split(ARROW)
        text = ARROW.join([*parts[:-1], rest, *parts[-1:]])
    numbers = list(NUMBERED.finditer(text))
    if len(numbers) > 1 and [int(each[1]) for each in numbers] == list(range(1, len(numbers) + 1)):
        lead = text[: numbers[0].start()].strip()
        if lead.endswith((":", "：")) or len(lead.split()) < 3:  # "please do the following:"
            text = text[numbers[0].end() :]
        text = NUMBERED.sub(ARROW, text)
    return sentence if text == plain else text


def _going(said: re.Match[str]) -> str:
    """Only that somebody goes, in the words of the language that it is."""
    way, plainly = plain_text(said["way"]).casefold(), all_words().plainly
    return str(plainly[way if way in plainly else bare(way)])


def _without(said: re.Match[str]) -> str:
    """Nothing of what is not done, but for a stop that parts what stands around it."""
    return ", " if said.start() and said[0].rstrip()[-1:] in (",", ";", "，", "、") else ""


def _pause(said: re.Match[str], factor: float) -> str:
    seconds = (value_of(said["number"]) + 0.5 * bool(said["half"])) * factor
    return f"{ARROW}{STANDS} for {seconds:g} seconds{ARROW}" if seconds else said[0]


def _undone(said: re.Match[str]) -> str:
    """Nothing, of arms that come down anyway; where they are held, a stand in which they do."""
    before, more = said.string[: said.start()], said.string[said.end() :].strip(EDGES)
    if not all_words().arms.search(before):
        return said[0]
    lowers = f"{ARROW}{STANDS} for {ARRIVES:g} seconds{ARROW if more else ''}"
    return lowers if all_words().held.search(before + ",") else ""


# ---------------------------------------------------------------- what nobody taught


@cache
def unlearned_words() -> list[tuple[list[str], str, bool]]:
    """Of unlearned.yaml: actions, what is looked for, whether accents may be missing in it."""
    found = []
    for actions, languages in load_yaml(packaged_config("unlearned.yaml")).items():
        for language, phrases in languages.items():
            loose = language in ("es", "fr")
            for phrase in phrases:
                words = _between_blanks(phrase, loose=loose)
                words = words.strip() if re.search(f"[{_CJK}]", phrase) else words
                found.append((actions.split(), words[:-1] if phrase[-1] == "*" else words, loose))
    return found


def unlearned(text: str, scope: OutOfDomainDetector | None) -> str | None:
    """A line if a text asks for what is none of a model's actions, whatever else it asks for."""
    asked = "the head alone to turn" if turns_head(text) else scope and _others(text, scope)
    return f"prompt {text!r} asks {asked}, which this model has not learned" if asked else None


def _others(text: str, scope: OutOfDomainDetector) -> str:
    spans = [word.span() for word in WORD.finditer(plain_text(text))]
    said = [_between_blanks(text, loose=loose) for loose in (False, True)]
    found = sorted(
        (said[loose].index(words), -len(words), words, said[loose], {*actions} & {*scope.actions})
        for actions, words, loose in unlearned_words()
        if words in said[loose]
        and not any(words in _between_blanks(name, loose=False) for name in scope.actions)
        and not (scope.captions and scope.words.issuperset(words_of(words)))
    )
    asked, end = list[str](), 0
    for start, size, words, read, learned in found:
        if start < end:  # a part of what is named, or learned, already
            continue
        end = start - size - words.startswith(" ")  # words share the blank between them
        if learned:
            continue
        if words.startswith(" "):  # as it is written, to the end of its last word
            first, last = len(read[:start].split()), len(read[:end].split())
            words = _ARTICLE.sub("", plain_text(text)[spans[first][0] : spans[last - 1][1]])
        else:
            words += _TAIL.match(read[start + len(words) :])[0]  # type: ignore[index]
        asked.append(repr(words))
    return f"for {' and '.join(asked)}" if asked else ""


def _between_blanks(text: str, *, loose: bool) -> str:
    """The words of a text without case, where loose without accents, each between blanks."""
    fold = bare if loose else str.casefold
    return f" {' '.join(fold(word) for word in WORD.findall(plain_text(text)))} "


def value_of(text: str) -> float:
    """The number that digits or a word say."""
    number = all_words().numbers.get(bare(text))
    if number is None and re.fullmatch(f"[{_ONES}两零十百]+", text):
        total, last = 0, 0
        for sign in text.replace("零", ""):
            tens = {"十": 10, "百": 100}.get(sign, 0)
            total, last = (total + (last or 1) * tens, 0) if tens else (total, _VALUES[sign])
        return float(total + last)
    return float(text.replace(",", ".")) if number is None else float(number)


def units_said(text: str) -> list[str]:
    """Those of UNITS of which a text has a word."""
    return [name for name, unit in all_words().units.items() if unit.may(text)]


def wholly(text: str) -> list[str]:
    """Which patterns of WHOLE a text is, end to end; what is no body falls otherwise (rain)."""
    words = all_words()
    found = [name for name in WHOLE if vars(words)[name].fullmatch(text)]
    return [name for name in found if name != "falls" or words.things.search(text) is None]


def side_of(text: str) -> str:
    """left, right, or both where a text names neither or both."""
    words = all_words()
    said = words.no_side.sub(" ", text)
    left, right = (bool(side.search(said)) for side in (words.left, words.right))
    return "both" if left == right else "left" if left else "right"


def names_both(text: str) -> bool:
    """Whether a text names the left and the right, or one of them and the other one."""
    words = all_words()
    said = words.no_side.sub(" ", text)
    return sum(bool(each.search(said)) for each in (words.left, words.right, words.other)) > 1


def says_number(text: str) -> bool:
    """Whether a text says how often, were it once."""
    words = all_words()
    return bool(words.often.search(text) or words.times.search(text))


def turns_head(text: str) -> bool:
    """Whether a text asks the head alone to turn."""
    return bool(all_words().head_turns.search(text))


def bows_head(text: str) -> bool:
    """Whether a text says that the head is down meanwhile."""
    words = all_words()
    if (said := words.bowed.search(text)) is None:
        return False
    return not any(no.search(text, 0, said.start()) for no in (words.denies, words.lacking))
