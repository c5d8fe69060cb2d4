"""`generate --prompt`: prompts in, motion files out."""

import unicodedata
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .guard import complain
from .progress import progress_bar
from .score_table import scored
from .stopwatch import Stopwatch
from .wording import note_replaced

if TYPE_CHECKING:
    from ..shared.motion.motion import Motion

FORMATS = ("bvh", "glb", "npz", "html")  # written where nothing else is asked for
ALL_FORMATS = (*FORMATS, "usd", "amass", "csv", "png", "gif", "mp4")
MODEL = "starter"


def produce(
    wanted: dict[str, Any],
    formats: list[str],
    out: Path,
    *,
    model: str,
    device: str,
    threads: int | None,
    return_all: bool = False,
    judge: str | None = None,
) -> dict[str, Any]:
    """Load, sample, choose, write; says which motion lies in which files and what took how long.

    Args:
        wanted: what `PromptSampler.sample` takes.
        formats: any of `ALL_FORMATS`.
        out: folder for the files.
        model: name or folder.
        device: auto, cpu, cuda or mps.
        threads: CPU threads; None = torch's choice.
        return_all: write all candidates by rank, not only the best of each prompt.
        judge: folder of `train_clip`; None = the model's own where one is shipped.
    """
    clock = Stopwatch()
    from ..shared.device import set_threads
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.ranking import TextJudge, load_tower, own_tower
    from ..shared.pipelines.text import PromptSampler

    clock.lap("import")
    set_threads(threads)
    generator = TextToMotion.from_pretrained(model, device=device)
    number = wanted["num_samples"]
    tower = None
    if number > 1:
        text = generator.text
        tower = own_tower(text) if judge is None else load_tower(judge, text)
    clock.lap("load")
    sampler = PromptSampler(generator, TextJudge(tower))
    warnings = sampler.generator.scope_warnings(wanted["prompts"])
    for warning in filter(None, warnings):
        complain(f"warning: {warning}")
    with progress_bar("motions") as progress:
        found = sampler.sample(**wanted, return_all=return_all, progress=progress)
    clock.lap("sample")
    kept = number if return_all else 1
    motions = [motion for result in found for motion in result.ranked()]
    rows = write_motions(motions, kept, formats, out)
    places = [int(place) for result in found for place in result.table.order[:kept]]
    for at, (row, place) in enumerate(zip(rows, places, strict=True)):
        row |= {"sample": place, "rank": at % kept + 1}
        row |= {"seed": wanted["seed"], "warning": warnings[at // kept]}
    index = write_index(motions, out) if "html" in formats and len(motions) > 1 else None
    clock.lap("write")
    about = {"model": model, "device": str(generator.device), "seed": wanted["seed"]}
    judged = zip(wanted["prompts"], found, strict=True) if number > 1 else ()
    scores = [scored(prompt, result.table) for prompt, result in judged]
    results = {"motions": rows, "selection": scores, "index": index}
    return about | results | {"timings": clock.seconds()}


def slug(text: str, length: int = 40) -> str:
    """A file name from text in any language: letters and digits, hyphens between.

    At most `length` characters, and twice as many bytes: a file's whole name may have 255.
    """
    text = unicodedata.normalize("NFC", text.lower())  # as composed letters, which file names part
    words = "".join(char if char.isalnum() else " " for char in text).split()
    cut = "-".join(words)[:length].encode()[: 2 * length].decode(errors="ignore")
    return cut.rstrip("-") or "motion"


def stems(prompts: Sequence[str], num_samples: int) -> list[str]:
    """One file name without ending a motion: `01-a-person-waves`, `01-a-person-waves-2`, …"""
    names = []
    for index, text in enumerate(prompts):
        base = f"{index // num_samples + 1:02d}-{slug(text)}"
        sample = index % num_samples
        names.append(f"{base}-{sample + 1}" if sample else base)
    return names


def write_motions(
    motions: "Sequence[Motion]", num_samples: int, formats: list[str], out: Path
) -> list[dict[str, Any]]:
    """Write every motion in every format; a row of facts and paths for each."""
    from ..shared.formats.registry import ending, write_motion

    rows: list[dict[str, Any]] = []
    names = stems([motion.text for motion in motions], num_samples)
    files = [{name: out / f"{stem}.{ending(name)}" for name in formats} for stem in names]
    note_replaced((path for paths in files for path in paths.values()), out)
    with progress_bar("motions written") as progress:
        for motion, paths in zip(motions, files, strict=True):
            for path in paths.values():
                write_motion(motion, path)
            rows.append(
                {
                    "prompt": motion.text,
                    "frames": motion.num_frames,
                    "fps": motion.fps,
                    "files": {name: str(path) for name, path in paths.items()},
                }
            )
            progress(len(rows), len(motions))
    return rows


def write_index(motions: "Sequence[Motion]", out: Path) -> str:
    """One page with all motions side by side; returns its path."""
    from ..shared.formats.registry import write_preview

    write_preview(motions, out / "index.html")
    return str(out / "index.html")
