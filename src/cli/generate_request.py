"""What `generate` is asked: its options, and which of them go together."""

import csv
import io
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..shared import environment
from ..shared.errors import UsageError, UserError, has_words
from ..shared.io.files import read_text
from ..shared.io.storage import Place, place
from . import generate_files as files
from . import options
from .console import complain, flag_of

if TYPE_CHECKING:
    from ..shared.model.diffusion import Sampling
    from ..shared.pipelines.motion_generator import MotionGenerator

# What `generate` is told beside prompts: any of it is `controlled`, one motion at a time.
DIRECTIONS = (
    "start", "end", "keep", "edit", "joints", "begin", "until", "path", "timeline", "then", "loop"
)  # fmt: skip


SHORTEST, LONGEST = 0.3, 600.0  # seconds of a prompt


@dataclass(frozen=True)
class Request:
    """The options of `generate`, a field each; None = not given."""

    prompt: Annotated[
        list[str] | None, typer.Option(help="What the character does; repeat for several.")
    ] = None
    prompts: Annotated[
        Path | None,
        typer.Option(
            help="Prompts from a file instead: one a line, or CSV with prompt, seconds, tag."
        ),
    ] = None
    audio: Annotated[
        list[Path] | None, typer.Option(help="A song instead: wav, flac, ogg or mp3.")
    ] = None
    body: Annotated[
        bool,
        typer.Option(
            "--body", help="For a song: a whole body that dances as the music says; or --prompt."
        ),
    ] = False
    figures: Annotated[
        bool,
        typer.Option(
            "--figures/--no-figures",
            help="For a dance: recorded figures where they show it; or the model dances alone.",
        ),
    ] = True
    follow_path: Annotated[
        bool,
        typer.Option(
            "--follow-path", help="For a dance: the song makes a path, which the body follows."
        ),
    ] = False
    style: Annotated[
        str | None, typer.Option(help='How to move to the song, e.g. "tired, elderly".')
    ] = None
    meter: Annotated[
        int | None, typer.Option(help="Beats in a bar of the song; 3 or 4, as heard.")
    ] = None
    memory: Annotated[
        str | None,
        typer.Option(
            help="For a song: folder or address of `memory build`: figures to dance, or phrases"
            " that a --model of train_memory hears."
        ),
    ] = None
    then: Annotated[
        list[str] | None, typer.Option(help="What it does next, in the same motion; repeat.")
    ] = None
    timeline: Annotated[
        Path | None,
        typer.Option(help="What it does when: YAML or JSON with text, start, end, parts."),
    ] = None
    loop: Annotated[
        bool, typer.Option("--loop", help="The last frame leads into the first one.")
    ] = False
    path: Annotated[
        Path | None, typer.Option(help="Where it goes: CSV, JSON or YAML with x, z, t, heading.")
    ] = None
    start: Annotated[
        Path | None, typer.Option(help="A motion file whose first seconds it begins with.")
    ] = None
    end: Annotated[
        Path | None, typer.Option(help="A motion file whose last seconds it ends with.")
    ] = None
    keep: Annotated[
        float | None, typer.Option(help="Seconds of --start and --end that are kept; 1.")
    ] = None
    edit: Annotated[
        Path | None, typer.Option(help="A motion file of which something is made anew.")
    ] = None
    joints: Annotated[
        str | None,
        typer.Option(help="Of --edit, with commas between: left-arm, legs, upper-body, head, …"),
    ] = None
    begin: Annotated[
        float | None, typer.Option("--from", help="Of --edit: seconds at which that begins.")
    ] = None
    until: Annotated[
        float | None, typer.Option("--to", help="Of --edit: seconds at which that ends.")
    ] = None
    tag: Annotated[
        list[str] | None,
        typer.Option(help="Action label beside the prompt: one for all, or one a prompt."),
    ] = None
    seconds: Annotated[
        float | None, typer.Option(help="Length of each motion: 4 for a prompt, all of a song.")
    ] = None
    num_samples: Annotated[
        int, typer.Option(help="Candidates for each prompt or song; the best one is written.")
    ] = 1
    return_all: Annotated[
        bool, typer.Option("--return-all", help="Write all candidates, the best one first.")
    ] = False
    resume: Annotated[
        bool,
        typer.Option(
            "--resume",
            help="Of several prompts leave out those whose files are in --out, whatever the seed.",
        ),
    ] = False
    judge: Annotated[
        str | None,
        typer.Option(
            help="Folder of train_clip, to hold candidates against the prompt; starter has its own."
        ),
    ] = None
    seed: Annotated[int, typer.Option(help="Same seed, same motions (on the CPU).")] = 0
    steps: options.Steps = None
    sampler: options.Sampler = None
    guidance_scale: options.GuidanceScale = None
    foot_lock: Annotated[
        bool | None,
        typer.Option("--foot-lock/--no-foot-lock", help="Hold feet still while they stand."),
    ] = None
    post_processing: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KEY=VALUE",
            help="Of the body, or of the path of a song alone: apply-smoothing=true, …; repeat.",
        ),
    ] = None
    format: Annotated[
        str | None,
        typer.Option(
            help="With commas between: bvh, glb, npz, html (unless given), usd, usda, usdc, fbx,"
            " vrm, vrma, amass, csv, png, gif, mp4 for a body; npz, csv, glb, html, png for a path."
        ),
    ] = None
    out: Annotated[
        Path, typer.Option(envvar=environment.OUTPUT_DIR, help="Folder for the files.")
    ] = Path("outputs")
    model: Annotated[str | None, typer.Option(help=options.NAMED)] = None
    body_model: Annotated[
        str | None, typer.Option(help="The same for the body that dances to a song; starter.")
    ] = None
    runtime: Annotated[
        str | None,
        typer.Option(
            help="torch; onnx, for a model that ships or a folder of export-onnx; or auto."
        ),
    ] = None
    device: options.Device = "auto"
    threads: options.Threads = None
    json: options.Json = False

    @property
    def sampling(self) -> "Sampling":
        """Seed, steps, sampler and guidance."""
        from ..shared.model.diffusion import Sampling

        return Sampling(
            seed=self.seed,
            steps=self.steps,
            sampler=self.sampler,
            guidance_scale=self.guidance_scale,
        )

    @property
    def song(self) -> Path | None:
        """The song to move to."""
        return self.audio[0] if self.audio else None

    @property
    def memory_folder(self) -> Place | None:
        """The folder or address of --memory."""
        return None if self.memory is None else place(self.memory)

    @property
    def kept(self) -> int:
        """Candidates that are written."""
        return self.num_samples if self.return_all else 1

    @property
    def text_model(self) -> str:
        """What makes bodies; an empty name is refused where it is loaded."""
        name = self.body_model if self.audio else self.model
        return environment.TEXT_MODEL if name is None else name

    @property
    def audio_model(self) -> str:
        """What makes the paths of songs."""
        return environment.default_audio_model() if self.model is None else self.model

    def asked(self) -> tuple[list[str], list[float], list[str | None] | None]:
        """Prompts, the seconds of each, and the tags; of --prompts, or of --prompt and --tag.

        Raises:
            UsageError: none, or they do not go together.
            UserError: as `read_prompts`.
        """
        usual = 4.0 if self.seconds is None else self.seconds
        if self.prompts is None:
            prompts = checked_prompts(self.prompt)
            return prompts, [usual] * len(prompts), checked_tags(self.tag, len(prompts))
        refuse_with("--prompts", prompt=self.prompt, tag=self.tag)
        prompts, seconds, tags = read_prompts(self.prompts)
        return prompts, [usual if each is None else each for each in seconds], tags

    @property
    def path_alone(self) -> bool:
        """Whether a song is asked for, and no body."""
        return bool(self.audio) and not (self.prompt or self.body)

    @property
    def pathed(self) -> bool:
        """Whether the audio model makes a path."""
        return self.path_alone or self.follow_path

    def generator(self) -> "MotionGenerator":
        """With these models; none is loaded yet."""
        from ..shared.device import set_threads
        from ..shared.model.checkpoint import resolve_model
        from ..shared.pipelines.motion_generator import MotionGenerator

        set_threads(self.threads)
        if self.audio and self.model is not None:  # which a dance in figures would never ask
            resolve_model(self.model)
        settings = self.post_processing or []
        return MotionGenerator(
            self.text_model,
            self.model,
            device=self.device,
            runtime="onnx" if self.light else self.runtime or "auto",
            memory=self.memory_folder,
            judge=self.judge,
            post_processing=[] if self.path_alone else settings,
            path_post_processing=settings if self.path_alone else [],
        )

    @cached_property
    def light(self) -> bool:
        """Whether onnxruntime does all that is asked; dances, styles and judges are PyTorch's."""
        from ..shared.model.onnx_card import chosen_for_songs, chosen_runtime

        if self.num_samples > 1 or self.memory or self.style:
            return False
        if self.audio:
            chosen = self.runtime
            if chosen in (None, "auto"):
                chosen = chosen_for_songs(self.audio_model, self.device, quiet=True)
            return self.path_alone and chosen == "onnx"
        return chosen_runtime(self.runtime or "auto", self.text_model, self.device) == "onnx"

    def body_formats(self) -> list[str]:
        """Formats of a body's files."""
        wanted = ",".join(files.FORMATS) if self.format is None else self.format
        from ..shared.formats.registry import EXPORTERS

        return files.checked_formats(wanted, EXPORTERS)

    def given(self) -> list[str]:
        """The flags of `DIRECTIONS` that were given, as they are typed."""
        told = ((name, getattr(self, name)) for name in DIRECTIONS)
        return [flag_of(name) for name, value in told if value not in (None, False, [])]

    @property
    def kind(self) -> str:
        """edit, ends, path or timeline: what has the say."""
        if self.edit is not None:
            return "edit"
        if self.start is not None or self.end is not None:
            return "ends"
        return "timeline" if self.path is None else "path"

    def check_directions(self) -> None:
        """Refuse what does not go together, before anything slow starts.

        Raises:
            UsageError: naming the flags.
        """
        own = {
            "edit": ("--edit", "--joints", "--from", "--to"),
            "ends": ("--start", "--end", "--keep"),
            "path": ("--path", "--timeline", "--then"),
            "timeline": ("--timeline", "--then", "--loop"),
        }[self.kind]
        given = self.given()
        chief = next(flag for flag in (*own, *given) if flag in given)
        for flag in given:
            if flag in ("--joints", "--from", "--to") and self.edit is None:
                raise UsageError(f"{flag} says what of a clip is made anew: give --edit CLIP too")
            if flag == "--keep" and self.kind != "ends":
                raise UsageError("--keep says how much of a clip stays: give --start or --end too")
            if flag not in own:
                raise UsageError(f"{flag} does not go with {chief}; leave one out")
        if self.edit is not None and given == ["--edit"]:
            raise UsageError("--edit: say what is made anew, by --joints, or --from and --to")
        if self.timeline is not None and self.then:
            raise UsageError("--timeline does not go with --then; leave one out")
        if self.num_samples > 1:
            raise UsageError(
                f"--num-samples does not go with {chief}, which makes one motion; another --seed"
                " makes another one"
            )
        self._check_spans()
        self._check_prompts(len(self.prompt or ()))

    def _check_spans(self) -> None:
        if self.seconds is not None and (self.edit is not None or self.timeline is not None):
            file = "--edit" if self.edit is not None else "--timeline"
            raise UsageError(
                f"--seconds does not go with {file}, which says how long it is; leave it out"
            )
        if self.begin is not None and self.until is not None and self.until <= self.begin:
            raise UsageError(
                f"--to {self.until:g} is not after --from {self.begin:g}; give a later --to"
            )

    def _check_prompts(self, prompts: int) -> None:
        if self.timeline is not None and prompts:
            raise UsageError(
                "--prompt does not go with --timeline, which has texts of its own; leave one out"
            )
        if prompts > 1:
            raise UsageError(
                f"--prompt is given {prompts} times beside {self.given()[0]}, which makes one"
                " motion: --then TEXT says what comes next"
            )
        if not prompts and self.timeline is None and self.kind in ("path", "timeline"):
            raise UsageError('--prompt is missing; give one, e.g. --prompt "a person walks"')


def check_song(paths: list[Path]) -> None:
    """Refuse several songs, and one that is no file, before anything slow starts."""
    if len(paths) > 1:
        raise UsageError(f"--audio is given {len(paths)} times; name one song")
    path = paths[0]
    if path.is_dir():
        raise UsageError(f"--audio {path} is a folder; name a wav, flac, ogg or mp3 file in it")
    if not path.is_file():
        raise UsageError(f"--audio {path}: no such file; name a wav, flac, ogg or mp3 file")


def check_runtime(request: Request) -> None:
    """Refuse an unknown runtime, a device or memory that it has not, and what is no memory."""
    from ..shared.model.onnx_card import RUNTIMES

    runtime, device, memory = request.runtime, request.device, request.memory_folder
    if runtime not in (None, *RUNTIMES):
        raise UsageError(f"--runtime {runtime} is unknown; choose from {', '.join(RUNTIMES)}")
    if runtime == "onnx" and device not in ("auto", "cpu"):
        raise UsageError(f"--device {device}: --runtime onnx computes on the cpu; leave one out")
    if memory is not None and runtime == "onnx":
        raise UsageError("--runtime onnx hears no memory: an export leaves it out; use torch")
    if memory is not None and not memory.is_dir():
        raise UsageError(f"--memory {memory} is no folder; make one with `memory build`")


def check_figures(request: Request) -> None:
    """Refuse a memory that holds no figures to dance, and figures for a path, which are none."""
    folder = request.memory_folder
    if folder is None:
        return
    if request.path is not None:
        refuse_with("a drawn path, which figures do not keep to", memory=request.memory)
    if not request.figures and not request.pathed:
        refuse_with("--no-figures", memory=request.memory)
    from ..shared.memory.figures import is_figure_memory

    if request.pathed and is_figure_memory(folder):
        raise UsageError(
            f"--memory {folder} holds figures, which no path hears: give --body or --prompt without"
            " --follow-path, or name a memory of phrases (`memory build` without --figures)"
        )
    if not request.pathed and not is_figure_memory(folder):
        raise UsageError(
            f"--memory {folder} holds no figures; make some with `memory build --figures`,"
            " or give --follow-path for a memory of phrases"
        )


def read_prompts(path: Path) -> tuple[list[str], list[float | None], list[str | None]]:
    """Prompts of a file, the seconds and the tag of each: one prompt a line, or CSV with a line of
    names, of which prompt is one.

    Raises:
        UserError: unreadable, empty, or a column or a cell is not what it is to be; names the line.
    """
    text = read_text(path, "a text or CSV file of prompts, in UTF-8")
    if path.suffix.lower() != ".csv":
        lines = [line.strip() for line in text.splitlines() if line.strip()]
        table = [(number, {"prompt": line}) for number, line in enumerate(lines, 1)]
    else:
        head = text.partition("\n")[0]
        mark = ";" if ";" in head and "," not in head else ","  # as spreadsheets of much of Europe
        reader = csv.DictReader(
            io.StringIO(text), restkey="more", restval="", strict=True, delimiter=mark
        )
        try:
            columns = [name.strip().lower() for name in reader.fieldnames or []]
            reader.fieldnames = columns
            if columns.count("prompt") != 1 or not {*columns} <= {"prompt", "seconds", "tag"}:
                raise UserError(
                    f"--prompts {path}: its columns are {', '.join(columns) or 'none'}; give"
                    " prompt, and if you like seconds and tag"
                )
            table = [(reader.line_num, row) for row in reader if any(row.values())]
        except csv.Error as error:
            line = reader.line_num
            raise UserError(f"--prompts {path}, line {line}: {error}; mend it") from None
    if not table:
        raise UserError(f"--prompts {path}: holds no prompt; write one a line")
    seconds: list[float | None] = []
    for number, row in table:
        if not has_words(row["prompt"]) or "more" in row:
            what = "has too many cells" if "more" in row else "has no prompt of words"
            raise UserError(f"--prompts {path}, line {number}: {what}; mend it")
        try:
            long = float(row["seconds"]) if row.get("seconds", "").strip() else None
        except ValueError:
            long = 0.0
        if long is not None and not SHORTEST <= long <= LONGEST:
            raise UserError(
                f"--prompts {path}, line {number}: {row['seconds']!r} is no number of seconds; give"
                f" {SHORTEST} to {LONGEST:g}"
            )
        seconds.append(long)
    tags = [row.get("tag", "").strip() or None for _, row in table]
    return [" ".join(row["prompt"].split()) for _, row in table], seconds, tags


def checked_prompts(prompts: list[str] | None) -> list[str]:
    """The prompts without stray blanks; at least one, none without words."""
    cleaned = [" ".join(text.split()) for text in prompts or []]
    if not cleaned or not cleaned[0]:
        raise UsageError('--prompt is missing or empty; give one, e.g. --prompt "a person waves"')
    if not all(cleaned):
        number = cleaned.index("") + 1
        raise UsageError(f"text {number} of {len(cleaned)} is empty; say what is done, or leave out"
                         " its --prompt or --then")  # fmt: skip
    if wordless := [text for text in cleaned if not has_words(text)]:
        raise UsageError(f"prompt {wordless[0]!r} holds no word; say in a few what is done")
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


def refuse_music(request: Request, flag: str) -> None:
    """Refuse what only a song can use."""
    names = ("style", "meter", "memory")
    refuse_with(flag, **{name: getattr(request, name) for name in names})


def refuse_with(flag: str, **others: Any) -> None:
    """Refuse options that mean nothing beside this one."""
    for name, value in others.items():
        if value not in (None, []):
            raise UsageError(f"{flag_of(name)} does not go with {flag}; leave one out")


def warn(warnings: list[str | None]) -> list[str | None]:
    """Say those that there are."""
    for warning in filter(None, warnings):
        complain(f"warning: {warning}")
    return warnings
