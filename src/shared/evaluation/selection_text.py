"""Best of N for prompts: candidates for the captions of held-back clips, and figures of them.

Outside the judge: everything of the separate evaluator (R-precision, matching distance), whether
the labels are obeyed by forward kinematics, travel against a real clip of the caption. The judge
holds motions against prompts in the generator's own shared space; it slides and shakes by other
measures than `support_slide` and `hand_jerk`, which are therefore akin, not outside.

Letters: P prompts, C candidates of each, D embedding channels.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import UserError
from ..metrics.physical import physics
from ..metrics.retrieval import BATCH, TOP, best_ranks, pair_distances
from ..metrics.travel import travel, travel_error
from ..model.generation.motion_generator import TextToMotion
from ..motion.motion import Motion
from ..pipelines.ranking import TextJudge, load_tower, own_tower
from ..pipelines.text import PromptSampler
from .controllability import check
from .evaluator import Evaluator
from .held_out import open_held_out, real_clips
from .samples import Clips
from .selection_harness import Chosen, Figure, Pool, report_of

BATCHINGS = 20  # random batches of 32 that each prompt's R-precision is the mean of
PROMPTS_AT_ONCE = 8
FIGURES = (
    Figure("r_at_1", "R@1", 3, True, "outside"),
    Figure("r_at_3", "R@3", 3, True, "outside"),
    Figure("matching_distance", "MM-Dist", 3, False, "outside"),
    Figure("obeys", "labels obeyed", 3, True, "outside"),
    Figure("speed_error", "speed error m/s", 3, False, "outside"),
    Figure("turn_error", "turn error °", 1, False, "outside"),
    Figure("support_slide", "slide, support cm/s", 2, False, "akin"),
    Figure("hand_jerk", "hand jerk m/s³", 0, False, "akin"),
)
Progress = Callable[[str], None]


def prompt_pool(
    best_of: PromptSampler,
    evaluator: Evaluator,
    clips: Clips,
    *,
    num_candidates: int,
    seed: int,
    progress: Progress = lambda text: None,
    **sampling: Any,
) -> Pool:
    """C candidates for each of P ≥ 32 captions at their clips' lengths, measured.

    Args:
        best_of: generator and judge.
        evaluator: trained apart from both.
        clips: held-back ones.
        sampling: steps, sampler, guidance_scale; left out = the model's own.
    """
    made: list[list[Motion]] = []
    tables = []
    seconds = [frames / best_of.generator.card.fps for frames in clips.num_frames]
    for start in range(0, len(clips), PROMPTS_AT_ONCE):
        progress(f"candidates for prompt {start + 1} of {len(clips)}")
        part = slice(start, start + PROMPTS_AT_ONCE)
        found = best_of.sample(
            clips.captions[part],
            num_candidates,
            seconds=seconds[part],
            return_all=True,
            seed=seed,
            **sampling,
        )
        for result in found:
            assert result.all_candidates is not None
            made.append(result.all_candidates)
            tables.append(result.table)
    progress("measuring")
    terms = {name: np.stack([table.terms[name] for table in tables]) for name in tables[0].terms}
    embedded = evaluator.embed_motion([motion for row in made for motion in row]).numpy()
    embedded = embedded.reshape(len(clips), num_candidates, -1)
    text = evaluator.embed_text(clips.captions).numpy()
    own = [Figure(name, name, 3, True, "judge") for name in terms]
    return Pool(
        figures=[*FIGURES, *own],
        score=np.stack([table.score for table in tables]),
        values=_singles(made, clips, text, embedded) | terms,
        together=lambda chosen: _retrieval(text, _taken(embedded, chosen), clips, seed),
        floors=_floors(evaluator, clips, text, embedded[:, 0], made, seed),
    )


def _taken(embedded: np.ndarray, chosen: Chosen) -> np.ndarray:
    return np.asarray(embedded[np.arange(len(chosen)), chosen])


def _singles(
    made: Sequence[Sequence[Motion]], clips: Clips, text: np.ndarray, embedded: np.ndarray
) -> dict[str, np.ndarray]:
    """Figures [P,C] of each candidate by itself."""
    columns = [_figures(row, clips.labels[p], clips.motions[p]) for p, row in enumerate(made)]
    values = {key: np.stack([column[key] for column in columns]) for key in columns[0]}
    apart = np.linalg.norm(embedded.astype(np.float64) - text[:, None], axis=-1)
    return values | {"matching_distance": apart}


def _figures(
    motions: Sequence[Motion], labels: dict[str, str], real: Motion
) -> dict[str, np.ndarray]:
    """Figures [C] of motions made for one caption."""
    bodies = [physics(motion) for motion in motions]
    errors = travel_error([travel(m) for m in motions], [travel(real)] * len(motions))
    return {
        "obeys": np.array([_obeys(labels, motion) for motion in motions]),
        "speed_error": np.array(errors.speed),
        "turn_error": np.array(errors.turn),
        "support_slide": np.array([body.support_slide for body in bodies]),
        "hand_jerk": np.array([body.hand_jerk for body in bodies]),
    }


def _obeys(labels: dict[str, str], motion: Motion) -> float:
    answers = check(labels, motion)
    return float(all(answers.values())) if answers else float("nan")


def _retrieval(
    text: np.ndarray, motion: np.ndarray, clips: Clips, seed: int
) -> Mapping[str, np.ndarray]:
    """Each prompt's R-precision [P] at 1 and 3, the mean over random batches of 32.

    Motions of the same label group or caption are hits, as in `guo_retrieval`.
    """
    columns = [
        np.unique(column, return_inverse=True)[1] for column in (clips.groups, clips.captions)
    ]
    hits, seen = np.zeros((len(TOP), len(text))), np.zeros(len(text))
    for batching in range(BATCHINGS):
        order = np.random.default_rng([seed, batching]).permutation(len(text))
        for rows in order[: len(text) // BATCH * BATCH].reshape(-1, BATCH):
            relevant = np.any([ids[rows][:, None] == ids[rows] for ids in columns], axis=0)
            ranks = best_ranks(pair_distances(text[rows], motion[rows]), relevant)
            hits[:, rows] += [ranks.hits(k) for k in TOP]
            seen[rows] += 1
    rates = np.divide(hits, seen, out=np.full_like(hits, np.nan), where=seen > 0)
    return {"r_at_1": rates[0], "r_at_3": rates[2]}


def _floors(
    evaluator: Evaluator,
    clips: Clips,
    text: np.ndarray,
    first: np.ndarray,
    made: Sequence[Sequence[Motion]],
    seed: int,
) -> dict[str, dict[str, np.ndarray]]:
    """Rows `real` (the clips themselves) and `chance` (first candidates under other captions)."""
    real = evaluator.embed_motion(clips.motions).numpy()
    order = np.random.default_rng(seed).permutation(len(clips))
    rows = {}
    for name, embedded, motions in (
        ("real", real, [[motion] for motion in clips.motions]),
        ("chance", first[order], [[made[p][0]] for p in order]),
    ):
        single = _singles(motions, clips, text, embedded[:, None])
        rows[name] = {key: values[:, 0] for key, values in single.items()}
        rows[name] |= _retrieval(text, embedded, clips, seed)
    # a clip has no travel error against itself
    rows["real"] = {k: v for k, v in rows["real"].items() if not k.endswith("_error")}
    return rows


@dataclass(frozen=True)
class PromptSettings:
    """How much is measured; the report repeats it."""

    num_prompts: int = 64
    num_candidates: int = 8  # the largest number to choose from
    replications: int = 4
    split: str = "seen"  # label combinations: seen or unseen in training
    max_frames: int = 64
    language: str = "en"
    seed: int = 0


def evaluate_prompts(
    model: str,
    data: str = "synthetic",
    *,
    judge: str | None = None,
    evaluator: str = "evaluator",
    cache: Path = Path("runs"),
    settings: PromptSettings | None = None,
    device: str | None = None,
    progress: Progress = lambda text: None,
    **sampling: Any,
) -> dict[str, Any]:
    """Best of N for the captions of held-back clips, by names; see `selection_report`.

    Args:
        model: a shipped name or a folder.
        data: prepared folder (its test splits), or "synthetic" (fresh clips).
        judge: folder of `train_clip`; None = the model's own where one is shipped.
        evaluator: a shipped name or a folder.
        cache: where synthetic clips are kept.
        sampling: steps, sampler, guidance_scale; left out = the model's own.

    Raises:
        UserError: no such model, tower, evaluator or data, or too few clips.
    """
    settings = settings or PromptSettings()
    outside = Evaluator.from_pretrained(evaluator)
    generator = TextToMotion.from_pretrained(model, device=device)
    tower = own_tower(generator.text) if judge is None else load_tower(judge, generator.text)
    held_out = open_held_out(data, cache, outside.trained_groups)
    clips = real_clips(
        held_out.data,
        held_out.records[settings.split],
        num=settings.num_prompts,
        max_frames=settings.max_frames,
        language=settings.language,
        seed=settings.seed,
    )
    if len(clips) < BATCH:
        raise UserError(
            f"{data}: {len(clips)} clips of {settings.split} are fewer than {BATCH}"
            "; prepare more clips"
        )
    best_of = PromptSampler(generator, TextJudge(tower))
    pool = prompt_pool(
        best_of,
        outside,
        clips,
        num_candidates=settings.num_candidates * settings.replications,
        seed=settings.seed,
        progress=progress,
        **sampling,
    )
    about = {
        "model": model,
        "model_hash": generator.card.weights.sha256[:12] if generator.card.weights else "",
        "judge": judge or ("shipped" if tower else "none: feet and smoothness only"),
        "weights": best_of.judge.config.model_dump(),
        "evaluator": evaluator,
        "evaluator_hash": outside.content_hash,
        "data": held_out.source,
        "data_hash": held_out.data.manifest_hash[:12],
        "sampling": {name: value for name, value in sampling.items() if value is not None},
    }
    subjects = f"{len(clips)} prompts, {settings.split} label combinations"
    return report_of(pool, settings.num_candidates, subjects, about, asdict(settings))
