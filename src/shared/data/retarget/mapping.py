"""Which joint of a source skeleton plays which of ours, and where its axes point.

By a profile of skeletons.yaml; where no profile names them all, by tree, bone lengths and names. A
body hangs two legs from its pelvis and two arms from its chest, alike in pairs, and a head between
the arms. In a limb the two long bones in a row are thigh and shin, or upper arm and forearm; words
in the names say so too, in any spelling. Left is told by the names, else by which way feet and
knees point. Legend: T frames, N joints of the file.
"""

import json
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from itertools import combinations, pairwise
from pathlib import Path
from typing import Literal, TypeVar

import numpy as np
from pydantic import BaseModel, ValidationError, field_validator

from ...config_loader import load_yaml, packaged_config
from ...errors import UsageError, UserError, first_fault
from ...formats.rig import SourceClip
from ...motion.skeleton import JOINT_NAMES

Table = TypeVar("Table", bound=BaseModel)


def load_table(path: str | Path, table_class: type[Table]) -> Table:
    """A file of the user's, or, by bare name, one of src/configs.

    Raises:
        UsageError: unreadable, no YAML, or a key or value the table does not know.
    """
    path = packaged_config(path) if isinstance(path, str) else path
    try:
        return table_class.model_validate(load_yaml(path))
    except ValidationError as error:
        fault = first_fault(error).replace("Input should be a valid tuple", "should be a list")
        fault = fault.replace("Input should be", "should be")
        raise UsageError(f"{path}: {fault}; mend the file") from None


Axis = Literal["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
# Joints without which a body cannot be told; the others are interpolated.
REQUIRED = tuple(
    name
    for name in JOINT_NAMES
    if name
    not in ("spine1", "spine2", "spine3", "neck", "l_collar", "r_collar", "l_foot", "r_foot")
)
COMMON_PREFIX = 0.8  # of a file's joints must share what is taken for their prefix


class SkeletonMapping(BaseModel, frozen=True, extra="forbid"):
    """One profile of skeletons.yaml."""

    name: str
    joints: dict[str, str]
    axes: dict[str, tuple[Axis, Axis, Axis]] = {}

    @field_validator("joints")
    @classmethod
    def _check_joints(cls, joints: dict[str, str]) -> dict[str, str]:
        if unknown := sorted(set(joints) - set(JOINT_NAMES)):
            raise ValueError(f"unknown joint {unknown[0]!r}; ours are {', '.join(JOINT_NAMES)}")
        if missing := [name for name in REQUIRED if name not in joints]:
            raise ValueError(f"joint {missing[0]!r} is not mapped")
        return joints

    @field_validator("axes")
    @classmethod
    def _check_axes(
        cls, axes: dict[str, tuple[Axis, Axis, Axis]]
    ) -> dict[str, tuple[Axis, Axis, Axis]]:
        for joint, directions in axes.items():
            if not np.isclose(np.linalg.det(_axes_matrix(directions)), 1):
                raise ValueError(f"axes {list(directions)} of {joint!r} are not right-handed")
        return axes

    def axes_of(self, source_joint: str) -> np.ndarray:
        """Rotation [3,3] of the source joint's axes in the T-pose."""
        return _axes_matrix(self.axes.get(source_joint, ("+X", "+Y", "+Z")))


def _axes_matrix(directions: tuple[Axis, Axis, Axis]) -> np.ndarray:
    columns = [
        (1.0 if axis[0] == "+" else -1.0) * np.eye(3)["XYZ".index(axis[1])] for axis in directions
    ]
    return np.stack(columns, -1)


class MappingFile(BaseModel, frozen=True, extra="forbid"):
    """skeletons.yaml."""

    profiles: tuple[SkeletonMapping, ...]


@cache
def _shipped() -> MappingFile:
    """Ours; reading them takes longer than reading a clip."""
    return load_table("skeletons.yaml", MappingFile)


def load_mappings(extra: Path | None = None) -> tuple[SkeletonMapping, ...]:
    """The user's profiles first, then ours."""
    files = [_shipped()]
    if extra is not None:
        files.insert(0, load_table(extra, MappingFile))
    return tuple(profile for file in files for profile in file.profiles)


def find_mapping(names: tuple[str, ...], mappings: tuple[SkeletonMapping, ...]) -> SkeletonMapping:
    """The profile that fits a file best, in the file's own joint names.

    The first profile whose joints are all there; else, of those that miss only joints that can
    be interpolated (left out of the result), the one that finds most. Spelling counts little:
    `mixamorig:LeftUpLeg`, `left_up_leg` and `LeftUpLeg` are one joint.

    Raises:
        UserError: no profile fits; names the closest one, the joints it misses, and what to do.
    """
    spelled = _spellings(names)
    found = [_translated(mapping, names, spelled) for mapping in mappings]
    for mapping, translated in zip(mappings, found, strict=True):
        if len(translated) == len(mapping.joints):
            return _renamed(mapping, translated)
    profiles = list(zip(mappings, found, strict=True))
    best, translated = max(profiles, key=lambda p: (_required(p[1]), len(p[1]), -len(p[0].joints)))
    if _required(translated) == len(REQUIRED):
        return _renamed(best, translated)
    raise UserError(_missing_text(names, best, translated))


def _required(translated: dict[str, str]) -> int:
    return sum(name in translated for name in REQUIRED)


def _translated(
    mapping: SkeletonMapping, names: tuple[str, ...], spelled: dict[str, str]
) -> dict[str, str]:
    """Our joint -> joint of the file, for those that are there."""
    found = {
        ours: theirs if theirs in names else spelled.get(plain(theirs), "")
        for ours, theirs in mapping.joints.items()
    }
    return {ours: theirs for ours, theirs in found.items() if theirs}


def _renamed(mapping: SkeletonMapping, translated: dict[str, str]) -> SkeletonMapping:
    """The profile with the file's own names, without joints that the file lacks."""
    if translated == mapping.joints:
        return mapping
    axes = {
        theirs: mapping.axes[mapping.joints[ours]]
        for ours, theirs in translated.items()
        if mapping.joints[ours] in mapping.axes
    }
    return mapping.model_copy(update={"joints": translated, "axes": axes})


def plain(name: str) -> str:
    """A joint's name without namespace, case and punctuation."""
    name = re.sub(r"^.*[:|]", "", name)
    name = re.sub(r"^mixamorig\d*", "", name, flags=re.I)
    return re.sub(r"[\W_]", "", name).casefold()


def words(name: str) -> list[str]:
    """The words of a name, told by case, digits and punctuation, in small letters."""
    found = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|[^\W\d_a-zA-Z]+", name)
    return [word.casefold() for word in found]


def _spellings(names: tuple[str, ...]) -> dict[str, str]:
    """Plain name -> name in the file, for names with and without a prefix that most share."""
    heads = Counter(head[0] for name in names if (head := re.match(r"^[^ _.\-]+[ _.\-]", name)))
    prefix, count = heads.most_common(1)[0] if heads else ("", 0)
    spelled: dict[str, str] = {}
    for name in names:
        spelled.setdefault(plain(name), name)
        if count >= COMMON_PREFIX * len(names):
            spelled.setdefault(plain(name.removeprefix(prefix)), name)
    return spelled


def _missing_text(
    names: tuple[str, ...], mapping: SkeletonMapping, translated: dict[str, str]
) -> str:
    missing = [name for name in REQUIRED if name not in translated]
    text = ", ".join(f"{ours} ({mapping.joints[ours]})" for ours in missing)
    free = [name[:40] for name in names if name not in translated.values()]
    shown = ", ".join(free[:12]) + (" …" if len(free) > 12 else "")
    return (
        f"no skeleton mapping fits; the closest, {mapping.name!r}, misses {text};"
        f" joints of the file without a part: {shown or 'none'};"
        " write a profile (`inspect FILE --write-mapping my.yaml` begins one), name the file's"
        f" joint after {missing[0]!r} in it, and give it by --mapping"
    )


def closest_joints(names: tuple[str, ...], mappings: tuple[SkeletonMapping, ...]) -> dict[str, str]:
    """Our joint -> joint of the file, of the profile that finds most."""
    spelled = _spellings(names)
    return max((_translated(mapping, names, spelled) for mapping in mappings), key=len)


def profile_text(names: tuple[str, ...], found: dict[str, str]) -> str:
    """YAML of a profile for a file, to be corrected: what was found, and `?` where nothing was."""
    lines = ["# Our joint: joint of the file. Fill in every ?; lines that no joint fits may go,",
             "# except " + ", ".join(REQUIRED) + ".",
             "# Joints of the file: " + ", ".join(names), "profiles:", "  - name: mine",
             "    joints:"]  # fmt: skip
    lines += [f"      {ours}: {json.dumps(found.get(ours, '?'), ensure_ascii=False)}"
              for ours in JOINT_NAMES]  # fmt: skip
    return "\n".join(lines) + "\n"


GUESSED = "guessed"  # name of a mapping that no profile gave

# Words of joint names without their side. One word may be two parts; the place in the limb tells.
_WORDS = {
    "hip": ("upleg", "upperleg", "thigh", "femur", "hip", "buttock"),
    "knee": ("leg", "lowleg", "lowerleg", "shin", "calf", "tibia", "knee"),
    "ankle": ("foot", "ankle"),
    "shoulder": ("arm", "uparm", "upperarm", "humerus", "shldr", "shoulder"),
    "elbow": ("forearm", "lowarm", "lowerarm", "farm", "radius", "elbow"),
    "wrist": ("hand", "wrist"),
    "neck": ("neck",),
    "head": ("head",),
}
_NOISE = {"bone", "jnt", "joint"}  # ends of names that say nothing
_SIDES = {"l": "l", "left": "l", "r": "r", "right": "r"}
LEG, ARM = ("hip", "knee", "ankle"), ("shoulder", "elbow", "wrist")
ALIKE_LIMBS = 0.15  # relative: how far two limbs of a pair may differ in length
LIKE_WORD = 0.8  # ratio of two spellings of one word
NAMED = 0.3  # what a fitting name counts beside a bone's share of its limb
SHORT, AFTER = 0.5, 0.4  # what other bones cost within a part, and the longest one beyond
MAPPING_SAMPLES = 50  # frames that are looked at


class Unclear(Exception):
    """The bones do not tell a body; the text says what of it is missing."""


@dataclass(frozen=True)
class _Limb:
    """A limb's joints from where it hangs to its tip, and which of them are the three joints."""

    chain: tuple[int, ...]
    joints: tuple[int, int, int]

    def before(self) -> int | None:
        """The joint between body and limb, if there is one: a collar."""
        place = self.chain.index(self.joints[0])
        return self.chain[place - 1] if place else None

    def after(self) -> int | None:
        """The joint after the last: a toe."""
        place = self.chain.index(self.joints[2])
        return self.chain[place + 1] if place + 1 < len(self.chain) else None


def mapping_of(
    path: Path, clip: SourceClip, mappings: tuple[SkeletonMapping, ...]
) -> SkeletonMapping:
    """The profile that fits a file's joints, or what its bones and names tell of them.

    Raises:
        UserError: neither does; names the file, the closest profile and the remedy.
    """
    try:
        return find_mapping(clip.names, mappings)
    except UserError as error:
        unnamed = error
    try:
        return SkeletonMapping(name=GUESSED, joints=detect_joints(clip))
    except Unclear as unclear:
        raise UserError(
            f"{path}: its bones tell no body ({unclear}) and its names none either: {unnamed}"
        ) from None


def detect_joints(clip: SourceClip) -> dict[str, str]:
    """Our joint -> joint of the file, with all that a body needs.

    Raises:
        Unclear: the bones are not those of one body.
    """
    return _Body(clip).joints()


class _Body:
    """The tree of a clip's bones."""

    def __init__(self, clip: SourceClip) -> None:
        self.clip = clip
        self.names, self.parents = clip.names, clip.parents
        self.lengths = np.linalg.norm(clip.offsets, axis=-1)
        self.children: list[list[int]] = [[] for _ in self.names]
        self.longest: list[tuple[int, ...]] = [() for _ in self.names]  # from it to a tip
        for joint in reversed(range(len(self.names))):
            below = max((self.longest[c] for c in self.children[joint]), key=self.reach, default=())
            self.longest[joint] = (joint, *below)
            if self.parents[joint] >= 0:
                self.children[self.parents[joint]].insert(0, joint)

    def reach(self, chain: tuple[int, ...]) -> float:
        """Length of a chain, from what it hangs on to its tip."""
        return float(self.lengths[list(chain)].sum())

    def above(self, joint: int) -> list[int]:
        """A joint and its ancestors, up to the root."""
        line = []
        while joint >= 0:
            line.append(joint)
            joint = self.parents[joint]
        return line

    def joints(self) -> dict[str, str]:
        """`detect_joints` of the clip."""
        (pelvis, *legs), (chest, *arms) = self.limb_pairs()
        left_leg, right_leg, left_arm, right_arm = self.sided(
            pelvis, [self.limb(leg, LEG) for leg in legs], [self.limb(arm, ARM) for arm in arms]
        )
        found = {"pelvis": pelvis, **self.trunk(pelvis, chest, arms)}
        for side, leg, arm in (("l", left_leg, left_arm), ("r", right_leg, right_arm)):
            found |= {f"{side}_{part}": j for part, j in zip(LEG, leg.joints, strict=True)}
            found |= {f"{side}_{part}": j for part, j in zip(ARM, arm.joints, strict=True)}
            for part, joint in (("foot", leg.after()), ("collar", arm.before())):
                if joint is not None:
                    found[f"{side}_{part}"] = joint
        return {ours: self.names[joint] for ours, joint in found.items()}

    def limb_pairs(self) -> tuple[tuple[int, int, int], tuple[int, int, int]]:
        """(joint they hang from, one, other) of the legs, and of the arms."""
        pairs = sorted(self.alike(), key=lambda pair: -self.reach(self.longest[pair[1]]))
        for one, other in combinations(pairs, 2):
            first, second = self.above(one[0]), self.above(other[0])
            if set(one[1:]) & {*second, *other[1:]} or set(other[1:]) & set(first):
                continue  # the same limb, or one hangs from the other: fingers
            # the spine grows from the pelvis; where neither carries the other, legs are longer
            return (other, one) if other[0] in first[1:] else (one, other)
        raise Unclear("no two pairs of limbs are alike in it")

    def alike(self) -> Iterator[tuple[int, int, int]]:
        """Pairs of branches of one joint with as many bones as a limb has, and alike in length."""
        for joint, children in enumerate(self.children):
            for one, other in combinations(children, 2):
                first, second = self.longest[one], self.longest[other]
                long, short = sorted((self.reach(first), self.reach(second)), reverse=True)
                if min(len(first), len(second)) >= 3 and 0 < long <= (1 + ALIKE_LIMBS) * short:
                    yield joint, one, other

    def limb(self, top: int, parts: tuple[str, str, str]) -> _Limb:
        """The joints of a limb: two long bones in a row, and names that say so."""
        chain = self.longest[top]
        bones, total = self.lengths[list(chain)], self.reach(chain)

        def score(places: tuple[int, int, int]) -> float:
            upper, lower = (bones[a + 1 : b + 1] for a, b in pairwise(places))
            long = upper.max() + lower.max()
            extra = upper.sum() + lower.sum() - long  # a collar, a finger
            long -= SHORT * extra + AFTER * bones[places[2] + 1 :].max(initial=0)
            called = [
                self.is_called(chain[place], part)
                for place, part in zip(places, parts, strict=True)
            ]
            return float(long / total + NAMED * sum(called))

        best = max(combinations(range(len(chain)), 3), key=score)
        first, second, third = (chain[place] for place in best)
        return _Limb(chain, (first, second, third))

    def trunk(self, pelvis: int, chest: int, arms: list[int]) -> dict[str, int]:
        """Spine, neck and head."""
        line = self.above(chest)
        spine = line[: line.index(pelvis)][::-1] if pelvis in line else [chest]
        upper = [c for c in self.children[chest] if c not in arms and chest != pelvis] or [
            c for c in self.children[chest] if c not in arms and len(self.longest[c]) < 4
        ]
        if not upper:
            raise Unclear(f"nothing between the arms at {self.names[chest]!r} is a head")
        neck = max(upper, key=lambda j: (self.is_called(j, "neck"), self.reach(self.longest[j])))
        called = [joint for joint in self.longest[neck] if self.is_called(joint, "head")]
        forks = [joint for joint in self.longest[neck][1:] if len(self.children[joint]) > 1]
        head = (called or forks or self.longest[neck][-1:])[0]
        found = {"head": head} | ({"neck": neck} if head != neck else {})
        found |= {"spine3": spine[-1]} if spine else {}
        found |= {"spine1": spine[0]} if len(spine) > 1 else {}
        return found | ({"spine2": spine[len(spine) // 2]} if len(spine) > 2 else {})

    def sided(self, pelvis: int, legs: list[_Limb], arms: list[_Limb]) -> Iterator[_Limb]:
        """Left leg, right leg, left arm, right arm."""
        told = [self.side(pair) for pair in (legs, arms)]
        if not all(told):
            told = self.sides_by_motion(pelvis, legs, arms)
        for pair, sign in zip((legs, arms), told, strict=True):
            yield from pair if sign > 0 else pair[::-1]

    def side(self, pair: list[_Limb]) -> int:
        """Whether the names say that the first limb is the left one: 1, the right one: -1, or 0."""
        first, second = (
            [_side_and_parts(self.names[joint])[0] for joint in limb.joints] for limb in pair
        )
        votes = sum((s == "l") - (s == "r") for s in first)
        votes -= sum((s == "l") - (s == "r") for s in second)
        return int(np.sign(votes))

    def sides_by_motion(self, pelvis: int, legs: list[_Limb], arms: list[_Limb]) -> list[int]:
        """The same by where feet and knees point, seen from the spine."""
        clip = self.clip.every(max(1, self.clip.num_frames // MAPPING_SAMPLES))
        places = clip.world()[0]
        hips, knees, ankles = (places[:, [leg.joints[i] for leg in legs]] for i in range(3))
        elbows = places[:, [arm.joints[1] for arm in arms]]
        across, forward = knees[:, 0] - knees[:, 1], (knees - (hips + ankles) / 2).sum(1)
        tips = [tip for leg in legs if (tip := leg.after()) is not None]
        if len(tips) == len(legs):
            forward += (places[:, tips] - ankles).sum(1)
        left = np.cross(elbows.mean(1) - places[:, pelvis], forward)
        leg = int(np.sign((across * left).sum()))
        arm = int(np.sign((across * (elbows[:, 0] - elbows[:, 1])).sum()))
        if not leg * arm:
            raise Unclear("neither names nor feet tell left from right")
        return [leg, leg * arm]

    def is_called(self, joint: int, part: str) -> bool:
        """Whether a joint's name has a word for a part of the body."""
        return part in _side_and_parts(self.names[joint])[1]


@cache
def _side_and_parts(name: str) -> tuple[str, tuple[str, ...]]:
    """Side (l, r or none) and the parts of the body that a joint's name may stand for."""
    tokens = words(name)
    side = next((_SIDES[word] for word in tokens if word in _SIDES), "")
    word = "".join(word for word in tokens if word not in _SIDES and word not in _NOISE)
    if not side and word[:1] in _SIDES and _parts(word[1:]):
        side, word = word[0], word[1:]
    return side, _parts(word)


def _parts(word: str) -> tuple[str, ...]:
    """Parts whose word is the longest that ends a name, else the one spelled most alike."""
    known = {text for spellings in _WORDS.values() for text in spellings}
    ends = sorted((text for text in known if word.endswith(text)), key=len)
    alike = ends[-1:] or get_close_matches(word, sorted(known), 1, LIKE_WORD)
    return tuple(part for part, spellings in _WORDS.items() if set(alike) & set(spellings))
