"""Where sentences go that a trained denoiser has no place for: plain words, and new actions.

A denoiser that learned plain captions mostly from procedural clips gives procedural motion for
them, and captured motion for one word of style. Among the styles that captured clips show of a
combination, the one nearest to its unstyled captured clips (or, without such, to the middle of all
styles) is nearest to no style at all. An action that it never learned would share the places of
those whose captions sound alike: it gets a direction of its own. A tower that
starts from nothing learns its places (`LabelledTower`).
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor, nn
from torch.nn.functional import cross_entropy, kl_div, normalize, pad

from ..shared.config_schema import PAIRS, NetworkConfig
from ..shared.data.captions.book import insert_babble, insert_word, packaged_book
from ..shared.data.captions.language import spoken_labels
from ..shared.data.captions.schema import Labels
from ..shared.data.prepared import PreparedData, group_of
from ..shared.model.clip.core import (
    PLACE_SCALE,
    TextTower,
    TokenPairEncoder,
    counted_keys,
    keys_of,
)
from ..shared.model.clip.out_of_domain import MANY, OFTENER
from ..shared.model.clip.tokenizer import PromptTokenizer
from ..shared.model.generation.denoiser import TAG_WEIGHT, MotionDenoiser
from ..shared.model.generation.motion_generator import TextToMotion
from .run_log import announce
from .task import generator, numpy_generator
from .text_stages import tower_of, with_places

Combination = tuple[tuple[str, str], ...]


def with_unstyled(labels: dict[str, Labels]) -> dict[str, Labels]:
    """`labels` of each group, and the unstyled combination of each that is only there in styles."""
    known = {_combination(each) for each in labels.values() if "style" not in each}
    found = dict(labels)
    for each in labels.values():
        if "style" in each and _combination(each) not in known:
            plain = {key: value for key, value in each.items() if key != "style"}
            found.setdefault(group_of(plain), plain)
    return found


def with_sentences(labels: dict[str, Labels], combinations: Iterable[Labels]) -> dict[str, Labels]:
    """`labels` of each group, and those `combinations` of known actions and values that no clip
    shows: who has seen walks, and runs to the left, has a place for a walk to the left."""
    known = {pair for each in labels.values() for pair in each.items()}
    spoken = [spoken_labels(each) for each in labels.values()]
    new = (each for each in combinations if each not in spoken and known >= each.items())
    return labels | {group_of(each): each for each in new}


def with_manners(
    labels: dict[str, Labels], shown: Iterable[Labels]
) -> tuple[dict[str, Labels], dict[str, str]]:
    """`labels` of each group and of each unstyled one in every style that is `shown` of others and
    not of its action; and for each of these the group without its style.

    An action in a manner that nobody has shown is the action: else "jumps happily" is nearest to
    the happy walks that were shown.
    """
    styled = {(each.get("action"), each["style"]) for each in shown if "style" in each}
    styles = sorted({style for _, style in styled})
    found, plain_of = dict(labels), dict[str, str]()
    for each in labels.values():
        plain = {key: value for key, value in each.items() if key != "style"}
        for style in [each["style"]] if "style" in each else styles:
            if (each.get("action"), style) not in styled:
                manner = plain | {"style": style}
                found |= {group_of(plain): plain, group_of(manner): manner}
                plain_of[group_of(manner)] = group_of(plain)
    return found, plain_of


def nearest_styles(data: PreparedData, labels: dict[str, Labels]) -> dict[str, str]:
    """For each unstyled group of `labels` that captured clips show in styles: such a group.

    It is that of the same combination in the style nearest to none, by means and spreads over time
    of the z-scored features.
    """
    shown: dict[str, list[Tensor]] = defaultdict(list)  # captured clips
    for record in data.records("train"):
        if record.group in labels and record.provenance == "captured":
            values = ((data.features(record) - data.mean) / data.std).flatten(1)  # [T,138]
            shown[record.group].append(torch.cat((values.mean(0), values.std(0))))
    means = {group: torch.stack(clips).mean(0) for group, clips in shown.items()}
    styled: dict[Combination, list[str]] = defaultdict(list)
    plain: dict[Combination, Tensor] = {}
    for group, mean in means.items():
        key = _combination(labels[group])
        if "style" in labels[group]:
            styled[key].append(group)
        else:
            plain[key] = mean
    found = {}
    for group, of_group in labels.items():
        if "style" in of_group or not (groups := styled.get(key := _combination(of_group))):
            continue
        target = plain.get(key, torch.stack([means[each] for each in groups]).mean(0))
        found[group] = min(groups, key=lambda each: float((means[each] - target).norm()))
    return found


def fuller_sides(data: PreparedData, labels: dict[str, Labels]) -> dict[str, str]:
    """For each group of `labels` that names no side and that few takes show: the group of the same
    combination on the right, if more takes show that one.

    One take of kicks with whatever foot was captured, and a denoiser kicks once in eight samples
    for it; with a foot that is named it kicks nearly always.
    """
    takes: dict[str, set[str]] = defaultdict(set)
    for record in data.records("train"):
        takes[record.group].add(record.take)
    rights = {
        _combination(each): group for group, each in labels.items() if each.get("side") == "right"
    }
    found = {}
    for group, each in labels.items():
        right = rights.get(_combination({**each, "side": "right"}))
        if right is None or "style" in each or "side" in each:
            continue
        if 0 < len(takes[group]) < len(takes[right]):
            found[group] = right
    return found


def apart(
    places: Tensor, labels: Sequence[Labels], known: Collection[str], *, kept: float = 1.0
) -> Tensor:
    """Unit places [G,D] where each action outside `known` has moved in a direction of its own.

    Args:
        kept: how much of where its places lay together stays in them, 0 to 1.
    """
    moved = places.clone()
    for action in sorted({each["action"] for each in labels if "action" in each} - set(known)):
        rows = [index for index, each in enumerate(labels) if each.get("action") == action]
        way = torch.randn(places.shape[1], generator=generator("place", action))
        left = places[rows] - (1 - kept) * places[rows].mean(0)
        moved[rows] = normalize(left + normalize(way, dim=0), dim=-1)
    return moved


def _combination(labels: Labels) -> Combination:
    return tuple(sorted((k, v) for k, v in spoken_labels(labels).items() if k != "style"))


class LabelledTower(nn.Module):
    """A text tower with the places that it learns and a classifier for each label.

    Args:
        tower: to be trained.
        labels: of each combination; a label that it does not have is a class of its own.
    """

    def __init__(self, tower: TextTower, labels: Sequence[Labels]) -> None:
        super().__init__()
        self.tower = tower
        self.places = nn.Parameter(torch.randn(len(labels), tower.embed_dim))
        keys = sorted({key for each in labels for key in each})
        values = {key: sorted({each.get(key, "") for each in labels}) for key in keys}
        self.heads = nn.ModuleList(nn.Linear(tower.embed_dim, len(values[key])) for key in keys)
        rows = [[values[key].index(each.get(key, "")) for key in keys] for each in labels]
        self.register_buffer("classes", torch.tensor(rows), persistent=False)  # [G, keys]

    def forward(self, batch: "TextBatch", scale: float) -> tuple[Tensor, Tensor]:
        """Cross-entropies of the right place, of `scale` times the cosines, and of all labels."""
        if batch.mean is None:
            pooled = self.tower(batch.input_ids, batch.attention_mask).pooled  # [B, D]
        else:
            pooled = self.tower.pool(batch.mean)  # [B, D]
        choice = cross_entropy(scale * pooled @ normalize(self.places, dim=-1).T, batch.group)
        spread = pooled * pooled.shape[-1] ** 0.5
        wanted = self.get_buffer("classes")[batch.group].unbind(-1)  # [B] a label
        terms = [cross_entropy(h(spread), c) for h, c in zip(self.heads, wanted, strict=True)]
        return choice, torch.stack(terms).sum()


@dataclass(frozen=True)
class TextBatch:
    """input_ids, attention_mask [B,L]; group [B] index of the right place, P = none of them, -1 =
    as it was read before; mean [B,H] where a frozen encoder has read the captions already, which
    then have no ids."""

    input_ids: Tensor
    attention_mask: Tensor
    group: Tensor
    mean: Tensor | None = None


AGREED = 0.55  # share of a combination's captions that one place takes
ALIKE = 0.4  # cosine of the keys of two places of one action


@torch.no_grad()
def own_places(
    tower: TextTower,
    tokenizer: PromptTokenizer,
    captions: Sequence[Sequence[str]],
    labels: Sequence[Labels],
) -> Tensor:
    """Which of a tower's places each combination of labels has [G], by where most of its captions
    [G lists] go.

    Of bare actions no two have the same, those that are surest of theirs first, unless all that
    one's captions go to is another action's. Where the captions
    of others do not agree, it is one of those they go to that is like that of the bare action and
    no other combination has, the one with most of them first; or else that of the bare action. A
    count does not change a place.
    """
    keys = tower.place_keys()
    nearest = [(pooled(tower, tokenizer, texts) @ keys.T).argmax(-1) for texts in captions]
    votes = torch.stack([torch.bincount(e, minlength=len(keys)) / len(e) for e in nearest])  # [G,P]
    shares, best = votes.max(-1)
    names = [group_of(each) for each in labels]
    kinds = [group_of({key: each[key] for key in each if key != "count"}) for each in labels]
    kinds = [kind if kind in names else name for kind, name in zip(kinds, names, strict=True)]
    bare = [group_of({"action": each.get("action", "")}) for each in labels]
    owners = [bare[row] for row in votes.argmax(0).tolist()]  # [P]: whose captions go there most
    homes: dict[str, int] = {}  # of the bare actions: no two of them have one place
    bids = [
        (vote, name, place)
        for name, home, own in zip(names, bare, votes.tolist(), strict=True)
        for place, vote in enumerate(own)
        if vote and name == home == owners[place]
    ]
    for _, name, place in sorted(bids, key=lambda each: -each[0]):
        if name not in homes and place not in homes.values():
            homes[name] = place
    at = [homes.get(name, place) for name, place in zip(names, best.tolist(), strict=True)]
    taken = {place: name for name, place in homes.items()}
    found = {
        name: place
        for name, kind, home, place, share in zip(names, kinds, bare, at, shares, strict=True)
        if name == kind
        and (name == home
             or (share >= AGREED and owners[place] == home == taken.get(place, home)))
    }  # fmt: skip
    split = {name: row for row, name in enumerate(names) if kinds[row] == name not in found}
    wanted = [
        (float(votes[row, place]), name, place)
        for name, row in split.items()
        if bare[row] in found
        for place in votes[row].nonzero().flatten().tolist()
        if keys[place] @ keys[found[bare[row]]] > ALIKE
    ]
    for _, name, place in sorted(wanted, key=lambda each: -each[0]):
        if name not in found and place not in found.values():
            found[name] = place
    for name, row in split.items():
        found.setdefault(name, found.get(bare[row], int(best[row])))
    return torch.tensor([found[kind] for kind in kinds])


# ---------------------------------------------------------------- taught to a tower


OLD_CAPTIONS = 16  # of each known action and language
TOLD_EVERY = 100  # steps of the tower
TOWER_BATCH = 320  # sentences: two fifths new, as many of what it knew, a fifth of neither
TOWER_RATE = 5e-2  # falls to nothing, in a line
PULL = 2e-3  # of what a row has learned goes with each step: a word of one caption says little;
PULLED = 3500  # less of more captions than these, as each is then seen less often
KEEPING = 3.0  # weight of what the old sentences asked for beside what the new ones ask for
NEARNESS = 20.0  # weight of the cosines beside the choice: warnings go by how near a place lies
INTRUDED = 0.15  # share of old sentences with a word of a new caption in them, to be overheard
BABBLE = 0.3  # share of new captions with made-up words in them


def old_captions(actions: Sequence[str], languages: Sequence[str]) -> list[str]:
    """Sentences that a tower is to send where it sent them before, whatever it makes of them."""
    book = packaged_book()
    combinations = [{"action": action} for action in actions]
    known = [*book.control_tasks(), *book.combinations()]
    combinations += [labels for labels in known if labels.get("action") in actions]
    return sorted(
        {
            text
            for labels in combinations
            for code, texts in book.captions(labels, num=OLD_CAPTIONS, seed=0).items()
            if code in languages
            for text in texts
        }.union(*(book.written_of(actions, code) for code in languages))
    )


def within_reach(tower: TextTower, places: Tensor) -> Tensor:
    """The unit vectors [N,D] nearest to places that the projection of a narrow tower can give."""
    basis = torch.linalg.qr(tower.text_proj.weight.detach().float())[0]  # [D, H], or [D, D]
    return normalize(places @ basis @ basis.T, dim=-1)


def with_new_places(
    tower: TextTower,
    tokenizer: PromptTokenizer,
    places: Tensor,
    captions: Sequence[Sequence[str]],
    old: Sequence[str],
    outside: Sequence[str],
    *,
    fixed: Collection[str] = (),
    steps: int,
    seed: int,
) -> TextTower:
    """A tower of token pairs that sends `captions[i]` to `places[i]`, and all others as before.

    The projection stays, and so do the rows of all tokens and pairs but those that tell the new
    captions: a sentence without one of them keeps its embedding.

    Args:
        tower: the old one; not changed.
        places: unit [N,D].
        captions: N lists.
        old: sentences whose embeddings and shares of the old places it keeps (distillation, Hinton
            et al. 2015).
        outside: sentences of what neither knows, which it keeps away from all places likewise.
        fixed: words whose rows stay, too: those that tell of what it knew.
        steps: of TOWER_BATCH sentences.
    """
    own = [text for texts in captions for text in texts]
    row = torch.tensor([i for i, texts in enumerate(captions) for _ in texts])
    mine = set(own)
    old = [text for text in old if text not in mine]
    every = torch.cat([tower.place_keys(), places])  # [P + N, D]
    others = [text for text in outside if text not in mine]
    said = [tokenizer(list(texts))[0] for texts in captions]
    telling = _telling(said, tokenizer(old + others)[0])
    stay = keys_of(tokenizer(list(fixed))[0]) if fixed else telling[:0]
    telling = telling[~torch.isin(telling, stay)]
    pull = PULL * min(1.0, PULLED / len(own))
    student = with_rows(tower, telling).requires_grad_(False).train()
    assert isinstance(student.encoder, TokenPairEncoder)
    learning = pad(torch.isin(student.encoder.keys, telling).float(), (0, 1))  # [rows]
    fade = (1 - (1 - pull) * learning)[:, None]
    rows = student.encoder.rows.weight.requires_grad_(True)
    start = rows.detach().clone()

    def touched(texts: list[str]) -> list[str]:
        """Those of whose rows any learns: all others keep their embeddings whatever is learned."""
        if not texts:
            return []
        hit = torch.isin(keys_of(tokenizer(texts)[0]), telling).flatten(1).any(1)
        return [text for text, each in zip(texts, hit.tolist(), strict=True) if each]

    old, others = touched(old) or old, touched(others) or others
    near, far = range(len(old)), range(len(old), len(old) + len(others))
    pools = [(range(len(own)), 2), (near or far, 2), (far or near, 1)]
    old += others
    with torch.no_grad():
        taught = torch.cat(
            [pooled(tower, tokenizer, old[at : at + 512]) for at in range(0, len(old), 512)]
        )  # [M, D]
    shares = (PLACE_SCALE * taught @ every[: -len(places)].T).softmax(-1)
    shares = pad(shares, (0, len(places)))  # [M, P + N]
    learner = torch.optim.Adam([rows], lr=TOWER_RATE)
    rng = numpy_generator("tower", seed)
    draws = generator("tower", seed)
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        for step in range(steps):
            if step and step % TOLD_EVERY == 0:
                announce(f"text tower: step {step} of {steps}")
            news, olds, texts = _batch(own, old, pools, draws, rng)
            found = pooled(student, tokenizer, texts)
            scores = PLACE_SCALE * found @ every.T  # [TOWER_BATCH, P + N]
            wanted = row[news] + len(every) - len(places)
            loss = cross_entropy(scores[: len(news)], wanted)
            loss = loss + KEEPING * kl_div(
                scores[len(news) :].log_softmax(-1), shares[olds], reduction="batchmean"
            )
            aims = torch.cat([places[row[news]], taught[olds]])
            loss = loss + NEARNESS * (1 - (found * aims).sum(-1)).mean()
            learner.param_groups[0]["lr"] = TOWER_RATE * (1 - step / steps)
            learner.zero_grad()
            loss.backward()  # type: ignore[no-untyped-call]
            learner.step()
            with torch.no_grad():
                rows.lerp_(start, fade)
    answers = torch.cat([tower.get_buffer("places").float(), places])  # [P + N, D]
    return with_places(student, answers, every if tower.config.text_place_keys else None)


def pooled(tower: TextTower, tokenizer: PromptTokenizer, texts: Sequence[str]) -> Tensor:
    """Unit embeddings [B,D] before they are sent to places."""
    ids, mask = tokenizer(list(texts))
    hidden = tower.encoder(input_ids=ids, attention_mask=mask).last_hidden_state  # [B,L,H]
    real = mask[..., None].to(hidden.dtype)
    mean = (hidden * real).sum(1) / real.sum(1)
    return normalize(tower.text_proj(mean), dim=-1)


def _batch(
    own: Sequence[str],
    old: Sequence[str],
    pools: Sequence[tuple[range, int]],
    draws: torch.Generator,
    rng: np.random.Generator,
) -> tuple[Tensor, Tensor, list[str]]:
    """Which of the new captions, which of the others, and the sentences of both: some with made-up
    words in them, or of the others with a word of a new caption.

    Args:
        pools: of the new ones, then of two kinds of others, where each begins and ends, and how
            many fifths of the batch it is.
    """
    news, *kept = (
        torch.randint(pool.start, pool.stop, (fifths * (TOWER_BATCH // 5),), generator=draws)
        for pool, fifths in pools
    )
    olds = torch.cat(kept)
    texts = [own[i] for i in news]
    texts = [insert_babble(t, t, rng) if rng.random() < BABBLE else t for t in texts]
    told = torch.randint(len(own), (len(olds),), generator=draws)
    texts += [
        insert_word(old[i], own[j], rng) if rng.random() < INTRUDED else old[i]
        for i, j in zip(olds, told, strict=True)
    ]
    return news, olds, texts


def _telling(captions: Sequence[Tensor], old: Tensor) -> Tensor:
    """Keys that are OFTENER times as frequent in the new captions (N of ids [M,L]) of one place as
    in other sentences [M,L], and stand in more than one of MANY: what one tells a story of is no
    action."""
    known, others = counted_keys([old])
    found: list[Tensor] = []
    for own in captions:
        keys, counts = counted_keys([own])
        at = torch.searchsorted(known, keys).clamp(max=len(known) - 1)
        elsewhere = torch.where(known[at] == keys, others[at], 0) / len(old)
        often = counts / len(own) >= OFTENER * elsewhere
        found.append(keys[often & (counts > len(own) / MANY)])
    every: Tensor = torch.cat(found).unique()  # type: ignore[no-untyped-call]
    return every


def with_rows(tower: TextTower, keys: Tensor) -> TextTower:
    """A copy of the tower with a row for each of these keys that it has none for."""
    assert isinstance(tower.encoder, TokenPairEncoder)
    before = tower.encoder.keys
    fresh = keys[~torch.isin(keys, before)]
    every, order = torch.cat([before, fresh]).sort()
    rows = tower.encoder.rows.weight.detach()  # [N + 1, H], the last one unknown
    more = torch.cat([rows[:-1], torch.zeros(len(fresh), rows.shape[1])])[order]
    own = {"encoder.keys": every, "encoder.rows.weight": torch.cat([more, rows[-1:]])}
    return tower_of(tower, tower.state_dict() | own)


def with_fewer_rows(tower: TextTower, counts: Mapping[int, int], most: int) -> TextTower:
    """The tower with at most so many rows: those that are longest where they are met most often.

    Args:
        counts: in how many captions each key stands.
    """
    assert isinstance(tower.encoder, TokenPairEncoder)
    keys, rows = tower.encoder.keys, tower.encoder.rows.weight.detach()
    met = torch.tensor([counts.get(key, 0) for key in keys.tolist()])
    weight = rows[:-1].norm(dim=-1) * (1 + met).sqrt()
    kept = weight.argsort(descending=True, stable=True)[:most].sort().values
    own = {
        "encoder.keys": keys[kept],
        "encoder.rows.weight": torch.cat([rows[kept], rows[-1:]]),
    }
    return tower_of(tower, tower.state_dict() | own)


# ---------------------------------------------------------------- another tower

SAME_PLACE = 0.9999  # cosine of two unit places that are one
PAIR_WIDTH = 64  # of the hidden states of a tower of token pairs


def with_tower(generator: TextToMotion, tags: Sequence[str]) -> MotionDenoiser:
    """Its denoiser with these of its tags, opening its adapters at the places of its text tower
    [P,D] where it did before it had that tower."""
    state = generator.denoiser.state_dict()
    places = generator.text.get_buffer("places").float()
    known = normalize(state["places"].float(), dim=-1)  # weights in int8 are no longer unit
    alike = normalize(places, dim=-1) @ known.T  # [P, P of before]
    moved = torch.where(alike.amax(-1) > SAME_PLACE, state["adapter_of"][alike.argmax(-1)], 0)
    rows = [generator.card.tags.index(tag) for tag in tags] + [-1]  # the last stands for none
    changed = MotionDenoiser(generator.network, len(tags))
    changed.load_state_dict(
        {**state, "places": places, "adapter_of": moved, TAG_WEIGHT: state[TAG_WEIGHT][rows]}
    )
    return changed.eval()


def with_pairs(network: NetworkConfig, number: int) -> NetworkConfig:
    """The network with a text tower of so many tokens and pairs."""
    sizes = {"text_model": PAIRS, "text_pairs": number, "text_hidden_size": PAIR_WIDTH}
    return network.model_copy(update={"clip": network.clip.model_copy(update=sizes)})
