"""The model zoo: which models there are, and where a name leads.

Only cards are read, and no torch is imported.
"""

from pathlib import Path
from typing import Any

from ..config_loader import nearest, profile_names
from ..environment import run_folder
from ..errors import UserError
from .checkpoint import CARD_FILE, ModelCard, read_card

PRETRAINED = Path(__file__).resolve().parents[1] / "pretrained"
RUNS = Path("runs")


def list_models(*, runs: bool = True) -> list[dict[str, Any]]:
    """The shipped models by name, then those under runs/ by folder; damaged cards are left out.

    Args:
        runs: False: the shipped ones only.

    Keys: name, kind, trained, licence, size (MB), languages, description.
    """
    shipped = [
        (path.parent.name, path.parent) for path in sorted(PRETRAINED.glob(f"*/{CARD_FILE}"))
    ]
    place = run_folder(RUNS)
    found = [*place.glob(f"*/{CARD_FILE}"), *place.glob(f"*/*/{CARD_FILE}")] if runs else []
    own = [(str(path.parent), path.parent) for path in sorted(found)]
    rows = []
    for name, folder in [*shipped, *own]:
        try:
            rows.append(_row(name, read_card(folder)))
        except UserError:
            continue
    return rows


def _row(name: str, card: ModelCard) -> dict[str, Any]:
    size = card.weights.bytes / 1e6 if card.weights else 0.0
    return {
        "name": name,
        "kind": card.kind,
        "trained": card.trained,
        "licence": card.licence,
        "size": f"{size:.1f} MB",
        "languages": ", ".join(card.languages),
        "description": card.description,
    }


def wrong_kind(
    folder: Path, found: str, wanted: str, hint: str = "name another folder"
) -> UserError:
    """What to say of a model of another kind; names what is shipped of the kind that was wanted."""
    shipped = [row["name"] for row in list_models(runs=False) if row["kind"] == wanted]
    of_it = f", or {' or '.join(shipped)}, which is shipped" if shipped else ""
    return UserError(f"{folder} holds {_a(found)}, not {_a(wanted)}; {hint}{of_it}")


def _a(noun: str) -> str:
    return f"{'an' if noun[:1] in 'aeiou' else 'a'} {noun}"


def resolve_model(name_or_folder: str | Path) -> Path:
    """The folder of a model: a folder that holds one, or a shipped name.

    Raises:
        UserError: neither; an untrained profile says how to train it.
    """
    folder = Path(name_or_folder)
    for place in (folder, run_folder(folder)):
        if (place / CARD_FILE).is_file():
            return place
    name = str(name_or_folder)
    if folder.name == name and (PRETRAINED / name / CARD_FILE).is_file():
        return PRETRAINED / name
    shipped = sorted(path.parent.name for path in PRETRAINED.glob(f"*/{CARD_FILE}"))
    if name in profile_names():
        use = f", or use --model {shipped[0]}" if shipped else ""
        raise UserError(
            f"profile {name!r} is untrained: no weights of it are shipped; train it with"
            f" `motion-tools train generation --network-profile {name}`"
            f" and name the run's folder{use}"
        )
    if folder.is_dir():
        raise UserError(
            f"{folder} is no model folder: it has no {CARD_FILE}"
            "; name a folder from training, or a name that `models` lists"
        )
    hint = f"; did you mean {nearest(name, shipped)!r}? `models` lists all" if shipped else ""
    raise UserError(f"no model named {name!r}, and no such folder{hint}")
