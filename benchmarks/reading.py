"""What is read of development sentences, and which of them are warned of; moves nothing.

    python -m benchmarks.reading [--model starter] [--floor] [--json FILE]

A sentence is read if it is one clause and its nearest action is the one it asks for; a spin may be
read as a turn, and waves and goodbyes are one gesture. None of the sentences is one of training or
of `evaluate-requests`. *Users* are more of them (users.yaml), by others who wrote as people would
type: which of them are read, warned of though they are read, or misread in silence, and which that
ask for other things are taken for something known; with `--floor` also which of them the nearest
training sentence reads, by words in common. *Moods* are actions done in a manner (moods.yaml, by
two more): who bows sadly is no sad walker. Those of another hand (other_hand.tsv, by somebody who
had seen neither) are read if they come apart as they are meant: sequences, and orders and later
ones, which say in many ways what comes first, into their actions, in order (a turn may be a walked
corner or a spin and a jog a run), two things at once into two, styled walks into one walk.
"""

import argparse
import json
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np

from src.shared.config_loader import parse_yaml
from src.shared.data.captions.book import packaged_book
from src.shared.evaluation.actions import same_action
from src.shared.model.clip.out_of_domain import TWINS, words_of
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.pipelines.clause import Clause
from src.shared.pipelines.sentence import RISEN, SITS
from src.shared.pipelines.text import SentenceGenerator
from src.shared.pipelines.words import STANDS

SENTENCES = Path(__file__).with_name("development.yaml")
MOODS = Path(__file__).with_name("moods.yaml")
USERS = Path(__file__).with_name("users.yaml")
OTHER_HAND = Path(__file__).with_name("other_hand.tsv")
WILL_DO = {("turn", "walk"), ("jog", "run"), ("turn", "spin")}  # what it asks for, what is read


def is_read(wanted: str, found: str | None) -> bool:
    """Whether the action that was found will do."""
    if found is None:
        return False
    alike = any({wanted, found} <= twins for twins in TWINS)
    return alike or same_action(wanted, found) or (wanted, found) == ("spin", "turn")


def is_wait(clause: Clause) -> bool:
    """Whether somebody only stands, or sits before getting up, in a clause."""
    return clause.seconds not in (None, RISEN) and clause.text in (STANDS, SITS)


def of_another_hand(sentences: SentenceGenerator) -> dict[str, float]:
    """Shares of other_hand.tsv that come apart as they are meant, by kind."""
    groups = defaultdict[str, list[bool]](list)
    for line in OTHER_HAND.read_text(encoding="utf-8").splitlines()[1:]:
        kind, _, asks, text = line.split("\t")
        if kind == "free":
            continue
        clauses = [each for each in sentences.clauses(text) if not is_wait(each)]
        readings = sentences.generator.read([clause.text for clause in clauses])
        found = [each.nearest[0] if each and each.nearest else None for each in readings]
        if kind == "two-sides":
            groups[kind].append(len(clauses) == 1 and clauses[0].meanwhile != "")
            continue
        wanted = ["walk"] if kind == "styles" else [a.split(":")[0] for a in asks.split("+")]
        each = zip(wanted, found, strict=False)
        right = all(is_read(*pair) or pair in WILL_DO for pair in each)
        groups[kind].append(right and len(wanted) == len(found))
    return {kind: sum(each) / len(each) for kind, each in groups.items()}


def rows_of(file: Path) -> list[tuple[str, str, str]]:
    """Action, language and text of users.yaml or moods.yaml."""
    entries = parse_yaml(file.read_text(encoding="utf-8"), file.name)
    return [(entry["labels"]["action"], entry["language"], text)
            for entry in entries for text in entry["text"]]  # fmt: skip


def shares(generator: TextToMotion, rows: list[tuple[str, str, str]]) -> dict[str, Any]:
    """Of rows of action, language and text."""
    readings = generator.read([text for *_, text in rows])
    groups = defaultdict[str, list[bool]](list)
    for (action, language, _), reading in zip(rows, readings, strict=True):
        known = reading is not None and reading.known
        if action == "other":
            groups["others-in-silence"].append(known)
            continue
        right = is_read(action, reading.nearest[0] if reading and reading.nearest else None)
        groups["read"].append(right)
        groups["read-" + language].append(right)
        groups["wrong-in-silence"].append(known and not right)
        if right:
            groups["warned-though-read"].append(not known)
    sizes = {"sentences": len(groups["read"]), "others": len(groups.get("others-in-silence", ()))}
    return sizes | {name: sum(each) / len(each) for name, each in groups.items()}


def looked_up() -> float:
    """Share of users.yaml that the training sentence of the same language with most words in common
    asks for: by their weights (log of how rare they are), of those of both (Jaccard)."""
    book, right = packaged_book(), list[bool]()
    for code in book.languages:
        taught = [
            (labels["action"], frozenset(words_of(text)))
            for labels in book.combinations()
            for text in book.written(labels, code)
        ]
        places = defaultdict[str, list[int]](list)
        for place, (_, words) in enumerate(taught):
            for word in words:
                places[word].append(place)
        weight = {word: np.log(len(taught) / len(at)) for word, at in places.items()}
        size = np.array([sum(weight[word] for word in words) for _, words in taught])
        for action, language, text in rows_of(USERS):
            if language != code or action == "other":
                continue
            common, own = np.zeros(len(taught)), frozenset(words_of(text))
            for word in own & places.keys():
                common[places[word]] += weight[word]
            whole = size + sum(weight.get(word, np.log(len(taught))) for word in own) - common
            right.append(is_read(action, taught[int((common / whole).argmax())][0]))
    return sum(right) / len(right)


def figures(model: str) -> dict[str, Any]:
    """Shares of sentences that are read, by language and action; and of those warned of."""
    generator = TextToMotion.from_pretrained(model, device="cpu")
    sentences = SentenceGenerator(generator)
    entries = parse_yaml(SENTENCES.read_text(encoding="utf-8"), SENTENCES.name)
    rows = [(entry, text) for entry in entries for text in entry["text"]]
    warned = [line is not None for line in sentences.scope_warnings([text for _, text in rows])]
    groups = defaultdict[str, list[bool]](list)
    doubted: dict[bool, list[bool]] = {True: [], False: []}
    for (entry, text), told in zip(rows, warned, strict=True):
        first, *others = sentences.clauses(text)
        reading = None if others else generator.read([first.text])[0]
        action = entry["labels"]["action"]
        right = is_read(action, reading.nearest[0] if reading and reading.nearest else None)
        for name in ("all", entry["language"], action):
            groups[name].append(right)
        doubted[right].append(told)
    return {
        "sentences": len(rows),
        "read": {name: sum(each) / len(each) for name, each in groups.items()},
        "warned-of": {
            name: sum(each) / max(len(each), 1)
            for name, each in (("read", doubted[True]), ("misread", doubted[False]))
        },
        "users": shares(generator, rows_of(USERS)),
        "moods": shares(generator, rows_of(MOODS)),
        "of-another-hand": of_another_hand(sentences),
    }


def main() -> None:
    """Print them, or write them."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("--model", default="starter")
    parser.add_argument("--floor", action="store_true")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    told = figures(options.model)
    if options.floor:
        told["users"]["looked-up"] = looked_up()
    found = json.dumps(told, indent=1, ensure_ascii=False)
    if options.json is not None:
        options.json.write_text(found + "\n", encoding="utf-8")
    print(found)


if __name__ == "__main__":
    main()
