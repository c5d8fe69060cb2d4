"""`generate`: prompts in, motion files out."""

import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from src.cli.guard import complain
from src.shared.errors import UsageError

if TYPE_CHECKING:
    from src.shared.motion.motion import Motion

FORMATS = ("bvh", "glb", "npz", "html")


def generate(
    prompt: Annotated[
        list[str] | None, typer.Option(help="What the character does; repeat for several.")
    ] = None,
    tag: Annotated[
        list[str] | None,
        typer.Option(help="Action label beside the prompt: one for all, or one a prompt."),
    ] = None,
    seconds: Annotated[float, typer.Option(help="Length of each motion.")] = 4.0,
    num_samples: Annotated[int, typer.Option(help="Motions for each prompt.")] = 1,
    seed: Annotated[int, typer.Option(help="Same seed, same motions (on the CPU).")] = 0,
    steps: Annotated[int | None, typer.Option(help="Sampling steps; the model's own.")] = None,
    sampler: Annotated[
        str | None, typer.Option(help="ddim, ddpm or dpm-solver++; the model's own.")
    ] = None,
    guidance_scale: Annotated[
        float | None, typer.Option(help="How strictly to follow the prompt; the model's own.")
    ] = None,
    foot_lock: Annotated[
        bool | None,
        typer.Option("--foot-lock/--no-foot-lock", help="Hold feet still while they stand."),
    ] = None,
    format: Annotated[
        str, typer.Option(help="Any of bvh, glb, npz, html, with commas between.")
    ] = "bvh,glb,npz,html",
    out: Annotated[Path, typer.Option(help="Folder for the files.")] = Path("outputs"),
    model: Annotated[
        str, typer.Option(help="A name that `models` lists, or a folder from training.")
    ] = "starter",
    device: Annotated[str, typer.Option(help="auto, cpu, cuda or mps.")] = "auto",
    threads: Annotated[int | None, typer.Option(help="CPU threads to use.")] = None,
    json: Annotated[bool, typer.Option("--json", help="Result as JSON on stdout.")] = False,
) -> None:
    """Turn prompts into motion files.

    \b
    Example:
      motion-tools generate --prompt "a person walks forward" --prompt "saluda con la mano"
    """
    started = time.perf_counter()
    prompts = checked_prompts(prompt)
    tags = checked_tags(tag, len(prompts))
    formats = checked_formats(format)
    check_range("--seconds", seconds, 0.3, 60.0)
    check_range("--num-samples", num_samples, 1, 1000)
    check_range("--steps", steps, 1, 1000)
    check_range("--guidance-scale", guidance_scale, 0.0, 30.0)
    check_range("--threads", threads, 1, 1024)
    check_folder(out)

    from src.shared.device import set_threads
    from src.shared.model.generation.motion_generator import MotionGenerator

    set_threads(threads)
    generator = MotionGenerator.from_pretrained(model, device=device)
    loaded = time.perf_counter()
    warnings = generator.scope_warnings(prompts)
    for warning in filter(None, warnings):
        complain(f"warning: {warning}")
    motions = generator.generate(
        prompts,
        seconds=seconds,
        tags=tags,
        num_samples=num_samples,
        seed=seed,
        steps=steps,
        sampler=sampler,
        guidance_scale=guidance_scale,
        foot_lock=foot_lock,
    )
    sampled = time.perf_counter()
    written = write_motions(motions, num_samples, formats, out)
    done = time.perf_counter()
    timings = {  # seconds
        "load": round(loaded - started, 3),
        "sample": round(sampled - loaded, 3),
        "write": round(done - sampled, 3),
        "total": round(done - started, 3),
    }
    if json:
        print_json(model, seed, motions, num_samples, written, warnings, timings)
        return
    for paths in written:
        print(*paths.values(), sep="\n")
    complain(
        f"{len(motions)} motions of {seconds:g} s in {timings['total']:.1f} s"
        f" (load {timings['load']:.1f}, sample {timings['sample']:.1f},"
        f" write {timings['write']:.1f})"
    )


# ---------------------------------------------------------------- arguments


def checked_prompts(prompts: list[str] | None) -> list[str]:
    """The prompts without stray blanks; at least one, none empty."""
    cleaned = [" ".join(text.split()) for text in prompts or []]
    if not cleaned or not all(cleaned):
        raise UsageError('--prompt is missing or empty; give one, e.g. --prompt "a person waves"')
    return cleaned


def checked_tags(tags: list[str] | None, num_prompts: int) -> list[str | None] | None:
    """One tag a prompt, from one for all or one each."""
    if not tags:
        return None
    if len(tags) == 1:
        return list(tags * num_prompts)
    if len(tags) != num_prompts:
        raise UsageError(
            f"--tag is given {len(tags)} times for {num_prompts} prompts;"
            " give one for all or one a prompt"
        )
    return list(tags)


def checked_formats(text: str) -> list[str]:
    """The wanted formats, each once, before anything slow starts."""
    names = list(dict.fromkeys(part.strip().lower() for part in text.split(",") if part.strip()))
    unknown = [name for name in names if name not in FORMATS]
    if unknown or not names:
        raise UsageError(
            f"--format {text!r}: {', '.join(map(repr, unknown)) or 'nothing'} is not a format"
            f" written here; choose from {', '.join(FORMATS)}"
        )
    return names


def check_range(flag: str, value: float | None, low: float, high: float) -> None:
    """A number outside its range is wrong usage."""
    if value is not None and not low <= value <= high:  # also refuses NaN
        raise UsageError(f"{flag} {value:g} is out of range; choose from {low:g} to {high:g}")


def check_folder(out: Path) -> None:
    """Fail before the model loads when the folder cannot be one."""
    for folder in (out, *out.parents):
        if folder.exists():
            if not folder.is_dir():
                raise UsageError(f"--out {out}: {folder} is a file; name a folder")
            return


# ---------------------------------------------------------------- results


def slug(text: str, length: int = 40) -> str:
    """A file name from a prompt in any language: letters and digits, hyphens between."""
    words = "".join(char if char.isalnum() else " " for char in text.lower()).split()
    return "-".join(words)[:length].rstrip("-") or "motion"


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
) -> list[dict[str, str]]:
    """Write every motion in every format; paths by format, motion by motion.

    With several motions and HTML, `index.html` shows them side by side.
    """
    from src.shared.formats.registry import write_motion, write_preview

    written: list[dict[str, str]] = []
    replaced = 0
    for motion, stem in zip(
        motions, stems([motion.text for motion in motions], num_samples), strict=True
    ):
        paths = {name: out / f"{stem}.{name}" for name in formats}
        for path in paths.values():
            replaced += path.exists()
            write_motion(motion, path)
        written.append({name: str(path) for name, path in paths.items()})
    if "html" in formats and len(motions) > 1:
        write_preview(motions, out / "index.html")
        written[0]["index"] = str(out / "index.html")
    if replaced:
        complain(f"note: {replaced} files of an earlier run in {out} were replaced")
    return written


def print_json(
    model: str,
    seed: int,
    motions: "Sequence[Motion]",
    num_samples: int,
    written: list[dict[str, str]],
    warnings: Sequence[str | None],
    timings: dict[str, float],
) -> None:
    """One object: which motion lies in which files, made how, and how long it took."""
    import json

    rows: list[dict[str, Any]] = [
        {
            "prompt": motion.text,
            "sample": index % num_samples,
            "seed": seed,
            "frames": motion.num_frames,
            "fps": motion.fps,
            "files": {name: path for name, path in paths.items() if name != "index"},
            "warning": warnings[index // num_samples],
        }
        for index, (motion, paths) in enumerate(zip(motions, written, strict=True))
    ]
    result = {"model": model, "seed": seed, "motions": rows, "timings": timings}
    if "index" in written[0]:
        result["index"] = written[0]["index"]
    print(json.dumps(result, indent=1, ensure_ascii=False))
