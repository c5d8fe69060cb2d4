"""Does the character do what was asked? Success rates by forward kinematics, per language.

For each task motions are made from captions of the training templates and from paraphrases kept
out of training. Each rate stands beside the same check on real clips with those labels, on motions
made for other tasks (chance), on a pose held still, and on what an untrained network makes.

Letters: N motions of one cell.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import chain, cycle, islice, product

from pydantic import TypeAdapter

from ...data.captions.book import CaptionBook
from ...metrics.measurements import CHECKS, Check, Measurements, credible, measure
from ..manifest import Part
from ..samples import Clips, Sampler, frozen_pose
from ..stats import NOTHING, Estimate, share_of, success_rate
from ..tables import Column, Grid, GridRow

Labels = dict[str, str]
Once = Callable[[str, Callable[[], Part]], Part]
WORDINGS = {"templates": "tmpl", "paraphrases": "para"}  # with their headings
FROM_JSON = TypeAdapter(list[Measurements])
NUM_FRAMES = 120  # of each motion
NUM_TEMPLATES = 12  # captions of one label set and language that the seeds go round


def faster(fast: Measurements, slow: Measurements) -> bool:
    """Whether one motion travels at least a quarter faster than another."""
    return credible(fast) and credible(slow) and fast.speed > 1.25 * slow.speed > 0.0


@dataclass(frozen=True)
class ControlTask:
    """One thing a user may ask for, with the labels its prompts are rendered from."""

    name: str
    labels: tuple[Labels, ...]  # label sets that all ask for it; use them in turn
    check: Check  # answers for one motion
    versus: Labels | None = None  # of the motion to compare with, None if none is needed
    # answers for the pair (motion, comparison) where `versus` is given
    compare: Callable[[Measurements, Measurements], bool] | None = None


_WALK = {"action": "walk", "direction": "forward"}
_RUN = {"action": "run", "direction": "forward"}
_HAND = {side: ({"action": "wave", "side": side}, {"action": "raise", "side": side})
         for side in ("left", "right")}  # fmt: skip
_TURN = {side: ({**_WALK, "turn": side}, {"action": "turn", "direction": side, "angle": "90"})
         for side in ("left", "right")}  # fmt: skip
CONTROL_TASKS: tuple[ControlTask, ...] = (
    ControlTask("forward", (_WALK,), CHECKS["forward"]),
    ControlTask("backward", ({**_WALK, "direction": "backward"},), CHECKS["backward"]),
    ControlTask("left hand", _HAND["left"], CHECKS["left-hand"]),
    ControlTask("right hand", _HAND["right"], CHECKS["right-hand"]),
    ControlTask("run faster than walk", (_RUN,), CHECKS["run"], versus=_WALK, compare=faster),
    ControlTask("turn left", _TURN["left"], CHECKS["turn-left"]),
    ControlTask("turn right", _TURN["right"], CHECKS["turn-right"]),
)
"""The controllability that shipped weights are held to."""


@dataclass
class Cell:
    """What was made for one task, language and kind of wording."""

    task: ControlTask
    language: str
    wording: str
    prompts: list[str]
    versus: list[str]  # prompts of the motions to compare with; empty where the task needs none
    made: list[Measurements] = field(default_factory=list)
    others: list[Measurements] = field(default_factory=list)

    @property
    def rate(self) -> Estimate:
        """How much of what was made does what is asked."""
        return rate(self.task, self.made, self.others)


def prompts_of(
    book: CaptionBook, labels: Labels, language: str, wording: str, seed: int
) -> list[str]:
    """Different prompts for a label set; empty when the language has none of this kind."""
    if wording == "paraphrases":
        return book.paraphrases(labels).get(language, [])
    return book.captions(labels, num=NUM_TEMPLATES, seed=seed).get(language, [])


def plan_cells(
    book: CaptionBook,
    languages: Sequence[str],
    num_seeds: int,
    seed: int,
    tasks: Sequence[ControlTask],
) -> list[Cell]:
    """Every cell that has prompts, not yet generated."""

    def prompts(sets: Sequence[Labels], language: str, wording: str) -> list[str]:
        """`num_seeds` of them, or none: the label sets in turn, and the prompts of each in turn."""
        every = [prompts_of(book, labels, language, wording, seed) for labels in sets]
        turns = zip(*(cycle(own) for own in every if own), strict=False)
        return list(islice(chain.from_iterable(turns), num_seeds))

    cells = []
    for language, task, wording in product(languages, tasks, WORDINGS):
        asked = prompts(task.labels, language, wording)
        other = prompts([task.versus], language, wording) if task.versus else []
        if asked and (other or not task.versus):
            cells.append(Cell(task, language, wording, asked, other))
    return cells


def _measured(cells: Sequence[Cell], sampler: Sampler, seed: int) -> Part:
    """What all motions of these cells do, made in one call, so that equal prompts in several places
    get different noise, and what the first cell's do held still."""
    wanted = [prompt for cell in cells for prompt in (*cell.prompts, *cell.versus)]
    motions = sampler(wanted, [NUM_FRAMES] * len(wanted), seed)
    rest = iter(motions)
    found: Part = {"made": [], "others": []}
    for cell in cells:
        found["made"].append([asdict(measure(next(rest))) for _ in cell.prompts])
        found["others"].append([asdict(measure(next(rest))) for _ in cell.versus])
    first = motions[: len(cells[0].prompts)]
    return found | {"still": [asdict(measure(frozen_pose(motion))) for motion in first]}


def rate(
    task: ControlTask, motions: Sequence[Measurements], others: Sequence[Measurements]
) -> Estimate:
    """Share of motions that do what the task asks, against `others` row by row if it compares."""
    if task.compare is None:
        return share_of([task.check(motion) for motion in motions])
    return share_of([task.compare(*pair) for pair in zip(motions, others, strict=False)])


def control_grid(
    sampler: Sampler,
    book: CaptionBook,
    real: Clips | None,
    *,
    languages: Sequence[str],
    num_seeds: int,
    seed: int = 0,
    untrained: Sampler | None = None,
    actions: Collection[str] = (),
    progress: Callable[[str], None] = lambda text: None,
    once: Once = lambda name, compute: compute(),
) -> Grid:
    """Success rates: a row a task and their mean, a column a language and kind of wording.

    Args:
        real: clips for the real column; None = none.
        num_seeds: motions a cell.
        untrained: asked the templates of the first language; None = its column stays empty.
        actions: that the model knows, no other is asked for; empty = nobody knows.
        once: `Parts.once`.
    """
    tasks = _of_known(actions)
    if left := [each.name for each in CONTROL_TASKS if each.name not in {t.name for t in tasks}]:
        progress(f"tasks of actions that the model does not know are left out: {', '.join(left)}")
    languages = [language for language in languages if language in book.languages]
    cells = plan_cells(book, languages, num_seeds, seed, tasks)

    def fill(own: Sequence[Cell], sampler: Sampler, name: str) -> list[Measurements]:
        def compute() -> Part:
            number = len(own[0].prompts)
            progress(f"controllability: {name}, {len(own)} cells of {number} motions")
            return _measured(own, sampler, seed)

        few = "" if len(tasks) == len(CONTROL_TASKS) else f".{len(own)}"
        found = once(f"controllability.{name}{few}", compute)
        for cell, made, others in zip(own, found["made"], found["others"], strict=True):
            cell.made, cell.others = map(FROM_JSON.validate_python, (made, others))
        return FROM_JSON.validate_python(found["still"])

    still: list[Measurements] = []
    for language in languages:
        if own := [cell for cell in cells if cell.language == language]:
            first = fill(own, sampler, language)
            still = still or first
    floor: list[Cell] = []
    if untrained is not None:
        floor = [replace(c, made=[], others=[]) for c in cells
                 if c.language in languages[:1] and c.wording == "templates"]  # fmt: skip
        if floor:
            fill(floor, untrained, "untrained")
    kinds = [(language, wording) for language in languages for wording in WORDINGS]
    columns = [Column(f"{k} {word}", f"{k} {WORDINGS[word]}", 2, "high") for k, word in kinds]
    columns += [Column(name, name, 2) for name in ("real", "chance", "still", "untrained")]
    rates: dict[str, dict[str, Estimate]] = {}
    for task in tasks:
        rates[task.name] = {
            **{f"{cell.language} {cell.wording}": cell.rate for cell in cells if cell.task is task},
            "real": _real_rate(task, real),
            "chance": _chance_rate(task, cells),
            "still": rate(task, still, still[1:] + still[:1]),
            "untrained": next((cell.rate for cell in floor if cell.task is task), NOTHING),
        }
    keys = [column.key for column in columns]
    rows = {name: GridRow({key: own.get(key) for key in keys}) for name, own in rates.items()}
    if rows:
        rows["mean"] = GridRow({key: _pooled(rates.values(), key) for key in keys})
    return Grid.of("controllability", rows, {"num": num_seeds}, columns=tuple(columns))


def _of_known(actions: Collection[str]) -> list[ControlTask]:
    """The tasks that ask for, and compare with, these actions alone; of any where there is none."""
    found = []
    for task in CONTROL_TASKS:
        own = tuple(each for each in task.labels if not actions or each["action"] in actions)
        if own and (not actions or task.versus is None or task.versus["action"] in actions):
            found.append(replace(task, labels=own))
    return found


def _real_rate(task: ControlTask, real: Clips | None) -> Estimate:
    """The check on real clips that carry every label of one of the task's sets."""

    def matching(labels: Sequence[Labels]) -> list[Measurements]:
        pairs = [] if real is None else list(zip(real.motions, real.labels, strict=True))
        fits = [m for m, own in pairs if any(wanted.items() <= own.items() for wanted in labels)]
        return [measure(motion) for motion in fits]

    motions = matching(task.labels)
    if task.versus is None:
        return rate(task, motions, [])
    others = matching([task.versus])
    return rate(task, [a for a in motions for _ in others], others * len(motions))


def _chance_rate(task: ControlTask, cells: Sequence[Cell]) -> Estimate:
    """The check on motions whose prompts ask for something else; a comparison, both ways round."""
    foreign = [c.made for c in cells if c.task is not task and c.wording == "templates"]
    if task.compare is None:
        return rate(task, list(chain.from_iterable(foreign)), [])
    motions = list(chain.from_iterable(zip(*foreign, strict=False)))
    return rate(task, motions, motions[1:] + motions[:1])


def _pooled(rates: Iterable[Mapping[str, Estimate]], key: str) -> Estimate:
    """A column's rate over all tasks, every motion alike."""
    known = [own[key] for own in rates if key in own and own[key].count]
    successes = round(sum(found.value * found.count for found in known))
    return success_rate(successes, sum(found.count for found in known))
