"""OutOfDomainDetector: is a prompt near anything the model was trained on, and to which actions?

What tells is its evidence: how near it lies to an action and how much nearer than to the next one,
how many of its words training saw, and whether its key words agree with the place it lies at. A
logistic model of these (`calibrated`) was fitted to prompts whose right action is known: sentences
with words in them that nobody knows, and without their key words, which ask for nothing. Its log
odds tell how sure an action is, and by them sentences are parted. Whether to warn is told by a
second one (`with_warnings`), which also sees how near the text came to any place before places were
mixed: in a tower that trained on sentences of other things too, those come near none (outlier
exposure, Hendrycks et al. 2019). Where that is not known the first one decides; without any (older
folders) a prompt is known when it has a key word of some action, or nothing but trained words that
are not all fillers. And an action that a model seldom shows when asked is not known, however well
the words are understood (`reliability`).

The key words of an action are a small set of telling words that covers its training captions
(greedy set cover), so "turn" is one and the "make" of "make a turn" is not. A text tower trained
from nothing puts nonsense somewhere too, so its cosine alone tells little; a pretrained tower also
knows synonyms, so there a close embedding is enough.

Letters: N captions, A actions, D embed dim.
"""

import hashlib
import math
import re
import unicodedata
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from pathlib import Path
from typing import ClassVar, Self

import numpy as np
from pydantic import ConfigDict, TypeAdapter, ValidationError

from ...errors import UserError
from ...io.files import atomic_write, load_json, write_json
from ..checkpoint import of_another_version

TABLE_FILE, META_FILE = "scope.safetensors", "scope.json"
WORDS = ("words", "fillers")  # some ten thousand, with a blank between them, in META_FILE
COVERAGES = (0.9, 0.95, 0.98, 0.99, 1.0)  # share of an action's captions its key words cover
MAX_FALSE_ALARMS = 0.01  # share of held-out captions judged unknown
OFTENER = 20.0  # times as frequent in a new action's captions as in others is what tells of it
MANY = 200  # captions of a new action; of more, what a word of few tells is a story
KEYED, HEARD = 35, 70  # one of so many more of them has to have a key word, and a known one
HELD_OUT = 10  # every tenth caption calibrates
MIN_TELLING = 0.5  # of log A, the evidence of a word that one action alone uses
SAME_STEM = 0.65  # share of the longer word that two forms of one word begin alike
MIN_STEM = 4  # letters
MIN_SEEN = 0.5  # share of words seen in training that a likeness to a key word needs around it
BARE, BARELY = 3, 0.1  # words of an order without anybody, and how sure it is at least
NUM_NEAREST = 3
TWINS = ({"wave", "bye"},)  # one gesture under two names
RELIABLE = 0.5  # share of tries in which an action has to come out to be known
SCALE, FIT_STEPS = 20.0, 60  # of the cosines in the classifier of actions; of its optimizer
FALSE_ALARMS = 0.03  # share of the prompts it calibrates on that are understood, and doubted
# Of the understood sentences kept from training; chosen on a development set, of whose understood
# ones less than .10 are doubted then (benchmarks/reading.py). It is in the weights of scope.json
# from then on: for those that exist see `check`, and the studio's in scope.js.
FALSE_WARNINGS = 0.18
NEWTON_STEPS, RIDGE = 30, 1e-2

_CJK = re.compile(r"[\u3040-\u30ff\u3400-\u9fff]")
_HAN = re.compile(r"[\u3400-\u9fff]")
_RUNS = re.compile(r"[\u3040-\u30ff\u3400-\u9fff]+|[^\W\u3040-\u30ff\u3400-\u9fff]+")

KeyWords = dict[str, tuple[int, ...]]  # word -> the actions it tells of


@dataclass(frozen=True)
class ScopeResult:
    """Verdict on one prompt.

    Attributes:
        known: near what was trained, and to an action that comes out.
        nearest: known actions, nearest first.
        unreliable: the action that was understood and seldom comes out, if that is why.
        certainty: log odds that the nearest action is what it asks for; by words alone, 1 or -1.
        mistaken: the action of the training caption that it is, if it lies at another.
    """

    known: bool
    nearest: list[str]
    unreliable: str | None = None
    certainty: float = 0.0
    mistaken: str | None = None


def words_of(text: str) -> list[str]:
    """The words of a text; Chinese and Japanese go by two characters, and by one Chinese one.

    `Wave 手を` -> ["wave", "手を", "手"].
    """
    words: list[str] = []
    for run in _RUNS.findall(unicodedata.normalize("NFKC", text).casefold()):
        if _CJK.match(run):
            words += [run[i : i + 2] for i in range(len(run) - 1)]
            words += _HAN.findall(run)
        else:
            words.append(run)
    return words


def caption_key(text: str) -> int:
    """Of 64 bits, the same for captions of the same words."""
    digest = hashlib.blake2b(" ".join(words_of(text)).encode(), digest_size=8).digest()
    return int.from_bytes(digest, "little", signed=True)


@dataclass(frozen=True, eq=False)
class OutOfDomainDetector:
    """What the training captions were about.

    Attributes:
        actions: A names.
        key_words: word -> indices of the actions it tells of.
        words: all words of the training captions.
        fillers: words of the captions of more than half of the actions.
        means: [A, D] float32 unit-norm places of the actions among text embeddings.
        false_alarms: share of held-out captions it called unknown.
        min_cosine: for a pretrained text tower, enough on its own; None otherwise.
        weights: of the evidence, the last one the bias: certain where the sum is positive. None =
            the rule of words alone.
        warning_weights: of the closeness and of the evidence: known where the sum is positive.
            None = as certain.
        reliability: share of tries in which each action came out, where that was measured.
        gestures: actions done in place, from hanging arms to hanging arms.
        arms: actions done with the arms alone.
        still: actions that end where they began, and face the same way.
        checked: actions that `metrics.measurements` tells, as captured clips bear out.
        cycles: actions done again and again in one go -> seconds of rest before and after, and
            from one to the next.
        handed: actions learned of one side alone -> left or right.
        captions: `caption_key` of a training caption -> its action; older folders have none.
    """

    __pydantic_config__: ClassVar = ConfigDict(  # of what scope.json holds
        alias_generator=lambda name: name.replace("_", "-"), arbitrary_types_allowed=True
    )

    actions: tuple[str, ...]
    key_words: KeyWords
    words: frozenset[str]
    fillers: frozenset[str]
    means: np.ndarray
    false_alarms: float
    min_cosine: float | None
    weights: tuple[float, ...] | None = None
    warning_weights: tuple[float, ...] | None = None
    reliability: Mapping[str, float] = field(default_factory=dict)
    gestures: tuple[str, ...] = ()
    arms: tuple[str, ...] = ()
    still: tuple[str, ...] = ()
    checked: tuple[str, ...] = ()
    cycles: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    handed: Mapping[str, str] = field(default_factory=dict)
    captions: Mapping[int, int] = field(default_factory=dict)

    @classmethod
    def fit(
        cls,
        captions: Sequence[str],
        actions: Sequence[str],
        embeddings: np.ndarray,
        *,
        pretrained_tower: bool = False,
    ) -> Self:
        """Learn from N training captions of any languages, their actions and embeddings [N, D].

        How many key words it takes is calibrated on every tenth caption, with key words of the
        others: as few as leave at most 1% of them unknown.

        Raises:
            UserError: there are no captions.
        """
        if not captions:
            raise UserError(
                "cannot learn what prompts are known: no captions in the data"
                "; prepare the data with captions"
            )
        names = tuple(sorted(set(actions)))
        labels = np.array([names.index(action) for action in actions])
        means = _places(_unit(embeddings), labels, rivals=np.array(names)[labels] != "")
        cosines = (_unit(embeddings) @ means.T).max(axis=1)

        texts = [frozenset(words_of(caption)) for caption in captions]
        held = np.arange(len(texts)) % HELD_OUT == HELD_OUT - 1
        kept = [text for text, out in zip(texts, held, strict=True) if not out]
        judged = [text for text, out in zip(texts, held, strict=True) if out] or texts
        fillers = _fillers(texts, labels, len(names))
        telling, seen = _telling(kept, labels[~held], len(names)), frozenset[str]().union(*kept)
        for coverage in COVERAGES:
            trial = _key_words(telling, coverage)
            stems = _by_stem(trial)
            unknown = (not _known(text, trial, stems, seen, fillers) for text in judged)
            false_alarms = sum(unknown) / len(judged)
            if false_alarms <= MAX_FALSE_ALARMS:
                break
        return cls(
            actions=names,
            key_words=_key_words(_telling(texts, labels, len(names)), coverage),
            words=frozenset[str]().union(*texts),
            fillers=fillers,
            means=means.astype(np.float32),
            false_alarms=false_alarms,
            min_cosine=float(np.quantile(cosines, 0.01)) if pretrained_tower else None,
            captions=dict(zip(map(caption_key, captions), labels.tolist(), strict=True)),
        )

    def with_action(
        self,
        action: str,
        captions: Sequence[str],
        places: np.ndarray,
        others: Sequence[str],
        taken: Collection[str] = (),
    ) -> Self:
        """The same scope, with an action more.

        Args:
            action: its name.
            captions: N of it.
            places: [M, D] that a tower is taught to send them to; it may not send them all yet.
            others: captions of all other actions; what is seldom in them tells of this one.
            taken: words that tell of others: neither these nor other forms of them tell of it.
        """
        texts = [frozenset(words_of(caption)) for caption in captions]
        here = Counter(word for text in texts for word in text)
        there = Counter(word for caption in others for word in {*words_of(caption)} & here.keys())
        share = {word: there[word] / max(len(others), 1) for word in here}
        more = max(0, len(texts) - MANY)
        telling = {
            word: math.log(2 / (1 + share[word] * len(texts) / number))
            for word, number in here.items()
            if number / len(texts) >= OFTENER * share[word]
            and number > more / KEYED
            and word not in taken
            and not any(_same_stem(word, each) for each in taken)
        }
        key_words, heard = dict(self.key_words), {w for w in here if here[w] > more / HEARD}
        for word, _ in sorted(_cover(texts, telling, max(COVERAGES))):
            key_words[word] = (*key_words.get(word, ()), len(self.actions))
        place = _unit(places.mean(axis=0))[None].astype(np.float32)
        return replace(
            self,
            actions=(*self.actions, action),
            key_words=key_words,
            words=self.words | heard,
            means=np.concatenate((self.means, place)),
            captions={
                **dict.fromkeys(map(caption_key, captions), len(self.actions)),
                **self.captions,
            },
        )

    def check(
        self, prompt: str, embedding: np.ndarray, closeness: float | None = None
    ) -> ScopeResult:
        """Judge one prompt by its words, its pooled text embedding [D], and the cosine with the
        nearest place before places were mixed."""
        cosines = self.means @ _unit(embedding)
        evidence = np.zeros(0)
        if self.weights is not None or self.warning_weights is not None:
            evidence = self.evidence(prompt, cosines)
        if self.weights is not None:
            certainty = float(evidence @ self.weights)
        else:
            certainty = 1.0 if self.familiar(prompt) else -1.0
        if self.min_cosine is not None and float(cosines.max()) >= self.min_cosine:
            certainty = max(certainty, 1.0)
        known = certainty > 0
        if self.warning_weights is not None and closeness is not None:
            known = float(np.array([closeness, *evidence]) @ self.warning_weights) > 0
        ranked, said = self.ranked(cosines), words_of(prompt)
        keys = [self.key_words.get(word) for word in said] if len(said) <= BARE else []
        if known and tuple(ranked[:1]) in keys:  # "verbeuge dich": captions have somebody before it
            certainty = max(certainty, BARELY)
        nearest = [self.actions[index] for index in ranked[:NUM_NEAREST]]
        own = self.captions.get(caption_key(prompt))
        if own is not None and not known:
            # word for word a training caption: unknown it is not, though a tower of few steps, or
            # few captions to calibrate on, may say so
            if self.actions[own] and own not in self._twins(ranked[0]):
                return ScopeResult(False, nearest, None, certainty, self.actions[own])
            known, certainty = True, max(certainty, 1.0)
        if known and nearest and self.reliability.get(nearest[0], 1.0) < RELIABLE:
            return ScopeResult(False, nearest, nearest[0], certainty)
        return ScopeResult(known, nearest, certainty=certainty)

    def ranked(self, cosines: np.ndarray) -> list[int]:
        """Indices of the actions by their cosines [A], nearest first; without that of clips that
        nobody labelled, whose captions may ask for any of the others."""
        return [row for row in np.argsort(-cosines, kind="stable").tolist() if self.actions[row]]

    def familiar(self, prompt: str) -> bool:
        """Whether the words of a prompt are those of training, whatever it asks for."""
        words = frozenset(words_of(prompt))
        return _known(words, self.key_words, self._stems, self.words, self.fillers)

    def _twins(self, row: int) -> set[int]:
        """The rows of the actions that are the same motion as one row's, that row among them."""
        names = set[str]().union(*(twins for twins in TWINS if self.actions[row] in twins))
        return {row} | {self.actions.index(name) for name in names.intersection(self.actions)}

    @cached_property
    def _stems(self) -> "Stems":
        return _by_stem(self.key_words)

    def evidence(self, prompt: str, cosines: np.ndarray) -> np.ndarray:
        """What speaks for a prompt [6], its cosines with the A actions given; the last is 1."""
        words = frozenset(words_of(prompt))
        first, *others = self.ranked(cosines)
        same = self._twins(first)
        second = next((row for row in others if row not in same), first)
        named = {action for word in words for action in self.key_words.get(word, ())}
        for word in words - self.key_words.keys():
            for key in _alike(word, self._stems):
                named.update(self.key_words[key])
        seen = len(words & self.words) / max(len(words), 1)
        agreement = 0.0 if not named else 1.0 if same & named else -1.0
        only_fillers = float(words <= self.fillers)
        margin = float(cosines[first] - cosines[second])
        return np.array([float(cosines[first]), margin, seen, agreement, only_fillers, 1.0])

    def calibrated(
        self, prompts: Sequence[str], embeddings: np.ndarray, right: Sequence[bool]
    ) -> Self:
        """The same scope, with weights for its evidence by logistic regression.

        Args:
            prompts: N.
            embeddings: [N, D].
            right: whether the place of each is that of the action it asks for.
        """
        rows = self._evidence(prompts, embeddings)
        return replace(self, weights=_logistic(rows, np.asarray(right, float), FALSE_ALARMS))

    def with_warnings(
        self,
        prompts: Sequence[str],
        embeddings: np.ndarray,
        closeness: np.ndarray,
        right: Sequence[bool],
    ) -> Self:
        """The same scope, that warns by closeness [N], too; the rest as of `calibrated`."""
        rows = np.concatenate((closeness[:, None], self._evidence(prompts, embeddings)), axis=1)
        weights = _logistic(rows, np.asarray(right, float), FALSE_WARNINGS)
        return replace(self, warning_weights=weights)

    def _evidence(self, prompts: Sequence[str], embeddings: np.ndarray) -> np.ndarray:
        cosines = _unit(embeddings) @ self.means.T
        return np.stack([self.evidence(*each) for each in zip(prompts, cosines, strict=True)])

    def warning(self, prompt: str, result: ScopeResult) -> str | None:
        """A line for the user when the prompt, of which this was found, is far from anything
        trained, else None."""
        if result.known:
            return None
        if result.unreliable is not None:
            return (
                f"prompt {prompt!r} asks for {result.unreliable!r}, which this model shows in about"
                f" {self.reliability[result.unreliable]:.0%} of tries; look at the motion before"
                " you use it"
            )
        if result.mistaken is not None:
            return (
                f"prompt {prompt!r} is a training caption of {result.mistaken!r} that this model"
                f" takes for {result.nearest[0]!r}: it has not learned to tell them apart; train it"
                " for more steps, or on more clips"
            )
        near = f"; nearest known actions: {', '.join(result.nearest)}" if result.nearest else ""
        return f"prompt {prompt!r} is far from anything this model was trained on{near}"

    def save_pretrained(self, folder: str | Path) -> None:
        """Write scope.safetensors and scope.json into a model folder."""
        from safetensors.numpy import save_file

        folder = Path(folder)
        with atomic_write(folder / TABLE_FILE) as temporary:
            tables = {"means": self.means.astype(np.float16)}
            if self.captions:
                tables["captions"] = np.array([*self.captions.items()], np.int64)
            save_file(tables, temporary)
        names = [each.name for each in fields(self) if each.name not in ("means", "captions")]
        meta = {name.replace("_", "-"): getattr(self, name) for name in names}
        meta |= {name: " ".join(sorted(getattr(self, name))) for name in WORDS}
        meta |= {"reliability": dict(self.reliability)}
        write_json(folder / META_FILE, meta, indent=None)

    @classmethod
    def from_pretrained(cls, folder: str | Path) -> Self | None:
        """Read a scope; None where the folder has none.

        Raises:
            UserError: the files are damaged.
        """
        from safetensors import SafetensorError
        from safetensors.numpy import load_file

        folder = Path(folder)
        if not (folder / META_FILE).is_file():
            return None
        try:
            tables = load_file(folder / TABLE_FILE)
            means = tables["means"].astype(np.float32)
            captions = dict(tables.get("captions", np.zeros((0, 2), np.int64)).tolist())
            meta = load_json(folder / META_FILE) | {"means": means, "captions": captions}
            if meta.get("fillers") is None:
                # folders of before had none: a prompt of trained words alone told nothing
                meta["fillers"] = meta.get("words")
            for name in WORDS:  # they had lists
                if isinstance(meta.get(name), str):
                    meta[name] = meta[name].split()
            found = TypeAdapter(cls).validate_python(meta)
            rows = {row for actions in found.key_words.values() for row in actions}
            rows |= {*found.captions.values()}
            if means.ndim != 2 or len(means) != len(found.actions) or not np.isfinite(means).all():
                raise ValueError(f"{len(found.actions)} actions and means {list(means.shape)}")
            if rows and not 0 <= min(rows) <= max(rows) < len(found.actions):
                raise ValueError("a key word or caption tells of an action that is not there")
            return found
        except ValidationError as error:
            raise of_another_version(folder / META_FILE, error) from error
        except (
            OSError,
            ValueError,
            LookupError,
            TypeError,
            AttributeError,
            SafetensorError,
        ) as error:
            raise UserError(
                f"{folder / META_FILE} or {TABLE_FILE} is damaged ({error});"
                " copy the model folder again"
            ) from error


def _logistic(rows: np.ndarray, wanted: np.ndarray, false: float) -> tuple[float, ...]:
    """Weights [E] of rows [N, E], the last of them 1, whose sum is negative for a share `false` of
    those that are wanted [N]."""
    weights = np.zeros(rows.shape[1])
    for _ in range(NEWTON_STEPS):
        chance = 1 / (1 + np.exp(-(rows @ weights).clip(-30, 30)))
        slope = rows.T @ (wanted - chance) - RIDGE * weights
        curve = (rows * (chance * (1 - chance))[:, None]).T @ rows
        weights += np.linalg.solve(curve + RIDGE * np.eye(len(weights)), slope)
    if wanted.any():
        weights[-1] -= np.quantile(rows[wanted > 0] @ weights, false)
    return tuple(weights.tolist())


def _unit(vectors: np.ndarray) -> np.ndarray:
    norms = np.linalg.norm(vectors, axis=-1, keepdims=True)
    unit: np.ndarray = vectors / np.maximum(norms, 1e-12)
    return unit


def _places(embeddings: np.ndarray, labels: np.ndarray, rivals: np.ndarray) -> np.ndarray:
    """Unit vectors [A, D] that tell the labels [N] of unit embeddings [N, D] apart.

    From the mean of each label on, the weights of a cosine classifier (softmax of SCALE times the
    cosines), every label alike: between two means lies much that is said of neither. Where rows are
    no `rivals` [N], their label stays at its mean: captions of clips that nobody labelled may ask
    for any of the others, which are not to make way for them.
    """
    import torch
    from torch.nn.functional import cross_entropy, normalize

    number = np.bincount(labels)
    means = [embeddings[labels == label].mean(axis=0) for label in range(len(number))]
    places = torch.tensor(_unit(np.stack(means)), dtype=torch.float32, requires_grad=True)
    x, y = torch.as_tensor(embeddings[rivals], dtype=torch.float32), torch.as_tensor(labels[rivals])
    share = torch.as_tensor(1.0 / number / len(number), dtype=torch.float32)
    open_to = torch.full((len(number),), -math.inf)
    open_to[np.unique(labels[rivals])] = 0.0
    optimizer = torch.optim.LBFGS([places], max_iter=FIT_STEPS, line_search_fn="strong_wolfe")

    def loss() -> torch.Tensor:
        optimizer.zero_grad()
        logits = SCALE * x @ normalize(places, dim=-1).T + open_to
        total = cross_entropy(logits, y, weight=share, reduction="sum")
        total.backward()  # type: ignore[no-untyped-call]
        return total

    optimizer.step(loss)  # type: ignore[no-untyped-call]
    return _unit(places.detach().numpy())


@dataclass(frozen=True)
class _Telling:
    """Words that tell of an action, the best first, each with how many of the action's captions
    have none of those before it; and how many captions there are."""

    words: list[tuple[str, int]]
    captions: int


def _telling(
    texts: Sequence[frozenset[str]], labels: np.ndarray, num_actions: int
) -> list[_Telling]:
    """Of each action, as many as the largest of COVERAGES takes."""
    captions = np.bincount(labels, minlength=num_actions).clip(min=1)
    counts: dict[str, np.ndarray] = {}
    for text, label in zip(texts, labels, strict=True):
        for word in text:
            counts.setdefault(word, np.zeros(num_actions))[label] += 1
    rates = {word: row / captions for word, row in counts.items()}
    telling = MIN_TELLING * math.log(num_actions)
    found = []
    for action in range(num_actions):
        evidence = {
            word: math.log(num_actions * rate[action] / rate.sum())
            for word, rate in rates.items()
            if rate[action] > 0
        }
        strength = {word: value for word, value in evidence.items() if value >= telling}
        mine = [text for text, label in zip(texts, labels, strict=True) if label == action]
        found.append(_Telling(_cover(mine, strength, max(COVERAGES)), len(mine)))
    return found


def _key_words(telling: Sequence[_Telling], coverage: float) -> KeyWords:
    """Telling words that together cover `coverage` of each action's captions."""
    found: dict[str, list[int]] = {}
    for action, of in enumerate(telling):
        for word, uncovered in of.words:
            if uncovered > (1 - coverage) * of.captions:
                found.setdefault(word, []).append(action)
    return {word: tuple(actions) for word, actions in sorted(found.items())}


def _cover(
    texts: Sequence[frozenset[str]], strength: Mapping[str, float], coverage: float
) -> list[tuple[str, int]]:
    """Greedy set cover: the strongest word of the most captions still uncovered, and so on; each
    with how many were uncovered before it."""
    uncovered = [text & strength.keys() for text in texts]
    target = (1 - coverage) * len(uncovered)
    gains = Counter(word for text in uncovered for word in text)
    chosen: list[tuple[str, int]] = []
    while gains and len(uncovered) > target:
        best = max(gains, key=lambda word: (gains[word] * (0.1 + strength[word]), word))
        if not gains[best]:
            break
        chosen.append((best, len(uncovered)))
        gains.subtract(word for text in uncovered if best in text for word in text)
        uncovered = [text for text in uncovered if best not in text]
    return chosen


def _fillers(texts: Sequence[frozenset[str]], labels: np.ndarray, num: int) -> frozenset[str]:
    """Words that the captions of more than half of the actions use."""
    users: dict[str, set[int]] = {}
    for text, label in zip(texts, labels, strict=True):
        for word in text:
            users.setdefault(word, set()).add(int(label))
    return frozenset(word for word, actions in users.items() if len(actions) > num / 2)


Stems = Mapping[str, Sequence[str]]


def _by_stem(key_words: Iterable[str]) -> Stems:
    """Key words by their first letters."""
    found: dict[str, list[str]] = {}
    for key in key_words:
        found.setdefault(key[:MIN_STEM], []).append(key)
    return found


def _alike(word: str, stems: Stems) -> list[str]:
    """Key words of which a word may be another form."""
    return [key for key in stems.get(word[:MIN_STEM], ()) if _same_stem(word, key)]


def _known(
    prompt: frozenset[str],
    key_words: Mapping[str, tuple[int, ...]],
    stems: Stems,
    seen: frozenset[str],
    fillers: frozenset[str],
) -> bool:
    """Whether a word is a key word, or another form of one among mostly familiar words.

    Trained words alone will do as well, unless all are fillers: "waves" may tell of two actions
    and is then a key word of neither. A filler is a form of no key word: "person" is not one of
    French "perso".
    """
    if not prompt.isdisjoint(key_words) or (prompt <= seen and not prompt <= fillers):
        return True
    alike = {word for word in prompt - fillers if _alike(word, stems)}
    return bool(alike) and len(prompt & seen | alike) >= MIN_SEEN * len(prompt)


def _same_stem(first: str, second: str) -> bool:
    longer = max(len(first), len(second))
    needed = max(MIN_STEM, math.ceil(SAME_STEM * longer))
    return min(len(first), len(second)) >= needed and first[:needed] == second[:needed]
