"""Does the character do what was asked? Success rates by forward kinematics, per language.

For each task motions are made from captions of the training templates and from paraphrases kept
out of training. Each rate stands beside the same check on real clips with those labels, on motions
made for other tasks (chance), on a pose held still, and on what an untrained network makes.

Letters: N motions of one cell.
"""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from itertools import chain
from typing import Any

from ..data.captions.book import CaptionBook
from ..motion.features import decode_features, encode_features
from ..motion.motion import Motion
from .clips import Clips, Sampler, frozen
from .controllability import CONTROL_TASKS, ControlTask
from .intervals import Estimate, success_rate
from .measurements import Measurements, measure
from .parts import Part

Labels = dict[str, str]
Once = Callable[[str, Callable[[], Part]], Part]
WORDINGS = ("templates", "paraphrases")
FLOORS = ("real", "chance", "still", "untrained")
NUM_TEMPLATES = 12  # captions of one label set and language that the seeds go round


@dataclass
class Cell:
    """What was made for one task, language and kind of wording; `made[i]` has seed i."""

    task: ControlTask
    language: str
    wording: str
    prompts: list[str]
    versus: list[str]  # prompts of the motions to compare with; empty where the task needs none
    made: list[Measurements] = field(default_factory=list)
    others: list[Measurements] = field(default_factory=list)


def prompts_of(
    book: CaptionBook, labels: Labels, language: str, wording: str, seed: int
) -> list[str]:
    """Different prompts for a label set; empty when the language has none of this kind."""
    if wording == "paraphrases":
        return book.paraphrases(labels).get(language, [])
    return book.captions(labels, num=NUM_TEMPLATES, seed=seed).get(language, [])


def _in_turn(choices: Sequence[Sequence[str]], num: int) -> list[str]:
    """`num` prompts: the label sets in turn, and the prompts of each in turn."""
    sets = [prompts for prompts in choices if prompts]
    if not sets:
        return []
    return [sets[i % len(sets)][(i // len(sets)) % len(sets[i % len(sets)])] for i in range(num)]


def plan_cells(
    book: CaptionBook, languages: Sequence[str], num_seeds: int, seed: int
) -> list[Cell]:
    """Every cell that has prompts, not yet generated."""
    cells = []
    for language in languages:
        for task in CONTROL_TASKS:
            for wording in WORDINGS:
                choices = [prompts_of(book, s, language, wording, seed) for s in task.labels]
                versus = prompts_of(book, task.versus or {}, language, wording, seed)
                prompts = _in_turn(choices, num_seeds)
                other = _in_turn([versus], num_seeds) if task.compare else []
                if prompts and (other or not task.compare):
                    cells.append(Cell(task, language, wording, prompts, other))
    return cells


def fill_cells(
    cells: Sequence[Cell], sampler: Sampler, *, num_frames: int, seed: int
) -> list[Motion]:
    """Generate all cells of one language in one call; returns the motions of the first one.

    Equal prompts in several places get different noise from the sampler.
    """
    wanted = [prompt for cell in cells for prompt in (*cell.prompts, *cell.versus)]
    motions = sampler(wanted, [num_frames] * len(wanted), seed)
    rest = iter(motions)
    for cell in cells:
        cell.made = [measure(next(rest)) for _ in cell.prompts]
        cell.others = [measure(next(rest)) for _ in cell.versus]
    return motions[: len(cells[0].prompts)]


def _filled(
    cells: Sequence[Cell],
    sampler: Sampler,
    num_frames: int,
    seed: int,
    name: str,
    progress: Callable[[str], None],
) -> Part:
    """`fill_cells` as plain data: what was measured, and the first cell's motions held still."""
    progress(f"controllability: {name}, {len(cells)} cells of {len(cells[0].prompts)} motions")
    first = fill_cells(cells, sampler, num_frames=num_frames, seed=seed)
    return {
        "made": [[asdict(one) for one in cell.made] for cell in cells],
        "others": [[asdict(one) for one in cell.others] for cell in cells],
        "still": [asdict(one) for one in _stand_still(first)],
    }


def _take(cells: Sequence[Cell], found: Part) -> None:
    """Fill the cells with what `_filled` found."""
    for cell, made, others in zip(cells, found["made"], found["others"], strict=True):
        cell.made, cell.others = _measured(made), _measured(others)


def _measured(rows: Sequence[dict[str, Any]]) -> list[Measurements]:
    """Measurements again; JSON has no tuples."""

    def whole(row: dict[str, Any]) -> dict[str, Any]:
        return {key: tuple(v) if isinstance(v, list) else v for key, v in row.items()}

    return [Measurements(**whole(row)) for row in rows]


def rate(
    task: ControlTask, motions: Sequence[Measurements], others: Sequence[Measurements]
) -> Estimate:
    """Share of motions that do what the task asks, against `others` row by row if it compares."""
    if task.compare is None:
        return success_rate(sum(map(task.check, motions)), len(motions))
    pairs = list(zip(motions, others, strict=False))
    return success_rate(sum(task.compare(a, b) for a, b in pairs), len(pairs))


def _matching(clips: Clips, labels: Sequence[Labels]) -> list[Measurements]:
    """Measurements of real clips that carry every label of one of these sets."""
    return [
        measure(motion)
        for motion, own in zip(clips.motions, clips.labels, strict=True)
        if any(wanted.items() <= own.items() for wanted in labels)
    ]


def _stand_still(motions: Sequence[Motion]) -> list[Measurements]:
    return [measure(decode_features(frozen(encode_features(motion)))) for motion in motions]


def control_table(
    sampler: Sampler,
    book: CaptionBook,
    real: Clips | None,
    *,
    languages: Sequence[str],
    num_seeds: int,
    num_frames: int = 120,
    seed: int = 0,
    untrained: Sampler | None = None,
    progress: Callable[[str], None] = lambda text: None,
    once: Once = lambda name, compute: compute(),
) -> dict[str, Any]:
    """Success rates as plain data: `tasks`, `means`, `languages`, `wordings`, `num_seeds`.

    Args:
        sampler: makes motions from prompts.
        book: templates and held-out paraphrases.
        real: clips for the real row, None for none.
        num_seeds: motions a cell.
        num_frames: length of each.
        untrained: asked the templates of the first language; None = its column stays empty.
        once: `Parts.once`: what is finished is not made again.
    """
    languages = [language for language in languages if language in book.languages]
    cells = plan_cells(book, languages, num_seeds, seed)
    still: list[Measurements] = []
    for language in languages:
        own = [cell for cell in cells if cell.language == language]
        if own:
            compute = partial(_filled, own, sampler, num_frames, seed, language, progress)
            found = once(f"controllability.{language}", compute)
            _take(own, found)
            still = still or _measured(found["still"])
    floor = [] if untrained is None else _templates_of(cells, languages[:1])
    if untrained is not None and floor:
        compute = partial(_filled, floor, untrained, num_frames, seed, "untrained", progress)
        _take(floor, once("controllability.untrained", compute))
    tasks = {
        task.name: {
            "generated": _rates([cell for cell in cells if cell.task is task]),
            "real": _real_rate(task, real).as_dict(),
            "chance": _chance_rate(task, cells).as_dict(),
            "still": rate(task, still, still[1:] + still[:1]).as_dict(),
            "untrained": _own_rate(task, floor).as_dict(),
        }
        for task in CONTROL_TASKS
    }
    return {
        "tasks": tasks,
        "means": _means(tasks, languages),
        "languages": languages,
        "wordings": list(WORDINGS),
        "num_seeds": num_seeds,
    }


def _rates(cells: Sequence[Cell]) -> dict[str, dict[str, dict[str, float | int]]]:
    result: dict[str, dict[str, dict[str, float | int]]] = {}
    for cell in cells:
        value = rate(cell.task, cell.made, cell.others).as_dict()
        result.setdefault(cell.language, {})[cell.wording] = value
    return result


def _real_rate(task: ControlTask, real: Clips | None) -> Estimate:
    if real is None:
        return success_rate(0, 0)
    motions = _matching(real, task.labels)
    if task.versus is None:
        return rate(task, motions, [])
    others = _matching(real, [task.versus])
    pairs = [(a, b) for a in motions for b in others]
    return rate(task, [a for a, _ in pairs], [b for _, b in pairs])


def _templates_of(cells: Sequence[Cell], languages: Sequence[str]) -> list[Cell]:
    """The same questions with nothing made for them yet."""
    return [
        replace(cell, made=[], others=[])
        for cell in cells
        if cell.language in languages and cell.wording == "templates"
    ]


def _own_rate(task: ControlTask, cells: Sequence[Cell]) -> Estimate:
    """The check on the motions of the one cell that asks for it; of none, if there is none."""
    own = [cell for cell in cells if cell.task is task]
    return rate(task, own[0].made, own[0].others) if own else success_rate(0, 0)


def _chance_rate(task: ControlTask, cells: Sequence[Cell]) -> Estimate:
    """The check on motions whose prompts ask for something else; a comparison, both ways round."""
    foreign = [cell for cell in cells if cell.task is not task and cell.wording == "templates"]
    if task.compare is None:
        return rate(task, list(chain.from_iterable(cell.made for cell in foreign)), [])
    motions = list(chain.from_iterable(zip(*(cell.made for cell in foreign), strict=False)))
    return rate(task, motions, motions[1:] + motions[:1])


def _means(tasks: dict[str, Any], languages: Sequence[str]) -> dict[str, Any]:
    """Rates pooled over tasks, every motion alike."""

    def pooled(found: Sequence[dict[str, float]]) -> dict[str, float | int]:
        known = [cell for cell in found if cell and cell["count"]]
        trials = sum(int(cell["count"]) for cell in known)
        return success_rate(
            round(sum(cell["value"] * cell["count"] for cell in known)), trials
        ).as_dict()

    means: dict[str, Any] = {
        language: {
            wording: pooled(
                [t["generated"].get(language, {}).get(wording, {}) for t in tasks.values()]
            )
            for wording in WORDINGS
        }
        for language in languages
    }
    return means | {row: pooled([t[row] for t in tasks.values()]) for row in FLOORS}
