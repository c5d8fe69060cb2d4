"""What text stages share: the data, a pretrained encoder, and what is fitted in the end.

The encoder learns at a rate of its own, or is frozen and asked only once. To a finished text tower
are fitted the scope, which prompts the training captions are near (`OutOfDomainDetector`), and the
style that the motions of a caption have (`StyleMap`, ruling 11).

Letters: N prompts or captions, D embed dim, H width of the encoder.
"""

import copy
import hashlib
import json
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

import numpy as np
import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import load_file, save_file
from torch import Tensor

from ..shared.config_schema import ClipConfig, NetworkConfig, TrainConfig
from ..shared.data.captions.book import insert_babble, packaged_book
from ..shared.data.prepare import open_data
from ..shared.data.prepared import ClipRecord, PreparedData
from ..shared.data.streamed import StreamedData, StreamedSet
from ..shared.data.text_motion import (
    CaptionedWindows,
    TextMotionDataset,
    WindowOptions,
    arm_actions,
    gestures,
    still_actions,
)
from ..shared.errors import UsageError, UserError
from ..shared.formats.registry import write_motion, write_preview
from ..shared.io.files import atomic_write
from ..shared.metrics.retrieval import BATCH
from ..shared.model.checkpoint import ModelCard, read_card, resolve_model
from ..shared.model.clip.core import OWN, TextTower
from ..shared.model.clip.features import TextFeatures
from ..shared.model.clip.out_of_domain import OutOfDomainDetector, words_of
from ..shared.model.clip.pretrained import encode_captions, place_captions, tower_hash
from ..shared.model.clip.style_map import StyleMap
from ..shared.model.clip.tokenizer import PromptTokenizer
from ..shared.model.generation.motion_generator import KIND, TextToMotion
from ..shared.model.layers import masked_mean
from ..shared.motion.features import decode_features
from ..shared.motion.motion import Motion
from ..shared.motion.skeleton import NUM_JOINTS
from ..shared.motion.style import measure_style, style_values
from ..shared.motion.trajectory import from_motion
from .run_log import announce
from .task import mix_seed


def open_training_data(
    config: TrainConfig, network: NetworkConfig, *, stream: bool = False
) -> PreparedData:
    """The data of a stage; synthetic data is made once beside the run's folder.

    Args:
        stream: leave the shards where they are (`StreamedData`).

    Raises:
        UsageError: the network has another number of bones than the data.
        UserError: no prepared data there.
    """
    if network.generation.num_bones != NUM_JOINTS:
        raise UsageError(
            f"generation.num-bones {network.generation.num_bones} does not fit the data, which"
            f" has {NUM_JOINTS}; set it to {NUM_JOINTS}"
        )
    kind = StreamedData if stream else PreparedData
    return open_data(config.data, Path(config.output).parent, kind=kind)


@contextmanager
def _enough() -> Iterator[None]:
    try:
        yield
    except ValueError as error:
        raise UserError(f"{error}; lower min-frames or prepare more data") from error


def training_set(
    config: TrainConfig, data: PreparedData, only: Callable[[ClipRecord], bool] | None = None
) -> TextMotionDataset:
    """The clips of the train split (that `only` admits); raises UserError when none can be used."""
    with _enough():
        return split_set(config, data, "train", only)


def training_clips(
    config: TrainConfig, data: PreparedData, only: Callable[[ClipRecord], bool] | None = None
) -> CaptionedWindows:
    """`training_set`, streamed where the data is; raises UserError when none can be used."""
    if not isinstance(data, StreamedData):
        return training_set(config, data, only)
    with _enough():
        return StreamedSet(data, **_windows(config, only))


def _windows(config: TrainConfig, only: Callable[[ClipRecord], bool] | None) -> WindowOptions:
    return {
        "min_frames": config.min_frames,
        "max_frames": config.max_frames,
        "whole": config.whole,
        "languages": config.languages,
        "only": only,
        "seed": mix_seed("data", config.seed),
    }


def with_labels(data: PreparedData) -> Callable[[ClipRecord], bool] | None:
    """Which clips a text tower of places has a place for: those with labels, where any has.

    Sentences without come out at the place of something else. Those of CMU's playground were
    nearest to plain walks, which then stood still (docs/experiments.md).
    """
    bare = sum(not record.labels for record in data.records("train"))
    if not 0 < bare < len(data.records("train")):
        return None
    announce("clips without labels are left out: this text tower knows only combinations of labels")
    return lambda record: bool(record.labels)


def validation_set(config: TrainConfig, data: PreparedData) -> TextMotionDataset | None:
    """The val split; None, with a word on stderr, where little data left nothing in it."""
    try:
        return split_set(config, data, "val")
    except ValueError:
        announce(
            "no validation: no clip is in the split `val`, for little data; figures are those of"
            " training clips alone"
        )
        return None


def can_retrieve(number: int) -> bool:
    """Whether R@k, which goes by batches of 32, can be told of so many held-back clips.

    Of two clips anyone finds the right one; where there are too few a word on stderr says so.
    """
    if number < BATCH:
        announce(
            f"{number} clips are held back and R@k needs {BATCH}: validation is the loss alone"
        )
    return number >= BATCH


def split_set(
    config: TrainConfig,
    data: PreparedData,
    split: str,
    only: Callable[[ClipRecord], bool] | None = None,
) -> TextMotionDataset:
    """One split as the configuration wants it; raises ValueError when nothing in it fits."""
    return TextMotionDataset(
        data,
        split,
        balance=config.balance,
        captured_share=config.captured_share,
        **_windows(config, only),
    )


def trained_card(
    kind: str, config: TrainConfig, network: NetworkConfig, data: PreparedData, **noted: Any
) -> ModelCard:
    """The card of what a run learned from these clips."""
    clips = data.records("train")
    some = clips[:: -(-len(clips) // SCOPE_CAPTIONS) or 1]
    spoken = {code for record in some for code in data.captions(record)}
    return ModelCard(
        kind=kind,
        name=Path(config.output).name,
        trained=True,
        network=network,
        tags=data.tags,
        languages=tuple(code for code in config.languages if code in spoken) or config.languages,
        data=data.manifest_hash,
        **noted,
    )


def write_samples(motions: Sequence[Motion], names: Iterable[str], folder: Path) -> None:
    """As BVH of these names, and side by side as HTML."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, motion in zip(names, motions, strict=True):
        write_motion(motion, folder / f"{name}.bvh")
    write_preview(motions, folder / "index.html")


def motion_rows(motion: torch.Tensor, network: NetworkConfig) -> torch.Tensor:
    """Features [..., 23, 6] without the root track where the profile has none."""
    return motion[..., : network.motion_rows, :]


def z_scored_for(model: TextToMotion, motion: Tensor, data: PreparedData) -> Tensor:
    """Motion [...,23,6] in the z-scores of `data`, in those of a trained model, on the CPU."""
    raw = motion_rows(motion * data.std + data.mean, model.network)
    return (raw - model.mean.cpu()) / model.std.cpu()


def as_features(places: Tensor) -> TextFeatures:
    """What a tower would give for texts that lie at these places [B,D]."""
    mask = torch.ones(len(places), 1, dtype=torch.bool, device=places.device)
    return TextFeatures(places, torch.zeros_like(places)[:, None], mask)


def with_places(tower: TextTower, places: Tensor, keys: Tensor | None = None) -> TextTower:
    """The tower, frozen, sending every text to places [P,D] that are all different, or, where they
    have keys [P,D], that those tell apart."""
    state = {name: value for name, value in tower.state_dict().items() if name != "keys"}
    own = {"places": places} if keys is None else {"places": places, "keys": keys}
    return tower_of(tower, state | own).freeze()


def tower_of(like: TextTower, state: Mapping[str, Tensor]) -> TextTower:
    """A tower like another one, with as many pairs and places as these weights of it have."""
    sizes = {"text_places": len(state.get("places", ())), "text_place_keys": "keys" in state}
    if "encoder.keys" in state:
        sizes["text_pairs"] = len(state["encoder.keys"])
    tower = TextTower(like.config.model_copy(update=sizes), like.embed_dim)
    tower.load_state_dict(state)
    return tower


def network_of_model(init: str, overrides: Sequence[str] = ()) -> NetworkConfig:
    """The network of a trained text model that a stage goes on from.

    Raises:
        UserError: there is no such model.
        UsageError: there are overrides, which change nothing of it.
    """
    if overrides:
        raise UsageError(f"{overrides[0]}: the network is that of init; leave it out")
    card = read_card(resolve_model(init))
    if card.kind != KIND:
        raise UserError(
            f"init {init} is a {card.kind}; name a text model, see `motion-tools models`"
        )
    return card.network


MOST_NAMED = 300  # captions that stand for actions
SCOPE_CAPTIONS = 20_000  # at most so many captions teach OutOfDomainDetector
CALIBRATING = 3_000  # at most, each also with words that nobody knows, and without its key words
HEARD = 3  # sentences that have to have a word, for it to be one that is known
SAID = 60  # captions of the grammar, of each action and language, whose words are known
IDEOGRAPHS = (0x4E00, 0x9FFF)
LETTERS = "abcdefghijklmnopqrstuvwxyz"


def fit_scope(
    data: PreparedData,
    languages: tuple[str, ...],
    tower: TextTower,
    tokenizer: PromptTokenizer,
    without: Collection[str] = (),
) -> OutOfDomainDetector:
    """The scope of a tower that was trained on the captions of `data`, calibrated on them too.

    Sentences of known actions kept out of training make a worse calibration: the detector then
    trusts words that nobody knows (docs/experiments.md, section 23). Actions `without` are unknown.
    Where no clip has labels, the first captions of the clips, those of most clips before others,
    stand for actions.
    """
    action_of: dict[str, str] = {}
    # of a label group every clip that has words of its own
    distinct = {record.group + str(record.captions): record for record in data.records("train")}
    name_of = _names(data, distinct.values())
    for record in distinct.values():
        if record.tag in without:
            continue
        captions = data.captions(record)
        for language in languages:
            for text in captions.get(language, []):
                action_of.setdefault(text, name_of.get(record.id, record.tag))
    texts = sorted(action_of)
    texts = texts[:: -(-len(texts) // SCOPE_CAPTIONS)]
    embeddings = encode_captions(tower, tokenizer, texts).numpy()
    actions = [action_of[text] for text in texts]
    pretrained = tower.config.text_model not in OWN
    scope = OutOfDomainDetector.fit(texts, actions, embeddings, pretrained_tower=pretrained)
    scope = replace(
        scope, gestures=gestures(data), arms=arm_actions(data), still=still_actions(data)
    )
    if len(set(scope.actions) - {""}) < 2:  # nothing to take one for another
        return scope
    return _calibrated(scope, texts, actions, languages, tower, tokenizer)


def refit_scope(
    scope: OutOfDomainDetector,
    languages: tuple[str, ...],
    tower: TextTower,
    tokenizer: PromptTokenizer,
) -> OutOfDomainDetector:
    """The scope of a tower that went on with more sentences of the same actions: it knows their
    words, too, and its warnings are fitted anew. Its key words, where actions lie, and how sure one
    has to be to part a sentence, stay: calibrated anew it parted a tenth of the sentences that are
    one (docs/experiments.md, section 72)."""
    book = packaged_book()
    told = {t for code in languages if code in book.languages
            for t in book.written_of(scope.actions, code)}  # fmt: skip
    heard = Counter(word for text in told for word in {*words_of(text)})
    grammar = (
        book.captions({"action": action}, num=SAID, seed=0, whole_sentences=False)
        for action in scope.actions
        if action
    )
    said = (texts for each in grammar for code, texts in each.items() if code in languages)
    words = {word for texts in said for text in texts for word in words_of(text)}
    words |= {word for word in heard if heard[word] >= HEARD}
    scope = replace(scope, words=scope.words | words)
    return fit_warnings(scope, languages, tower, tokenizer)


def _names(data: PreparedData, records: Iterable[ClipRecord]) -> dict[str, str]:
    """What stands for the action of clips, by their ids, where none has labels."""
    if any(record.tag for record in data.records("train")):
        return {}
    first = {
        record.id: next((text for texts in data.captions(record).values() for text in texts), "")
        for record in records
    }
    named = {text for text, _ in Counter(first.values()).most_common(MOST_NAMED)}
    return {clip: text for clip, text in first.items() if text in named}


def _calibrated(
    scope: OutOfDomainDetector,
    texts: list[str],
    actions: list[str],
    languages: tuple[str, ...],
    tower: TextTower,
    tokenizer: PromptTokenizer,
) -> OutOfDomainDetector:
    """Texts as they are, with made-up words in them, and with made-up words for what tells."""
    rng = np.random.default_rng(0)
    labelled = np.flatnonzero(np.array(actions) != "")
    chosen = rng.permutation(labelled)[:CALIBRATING]
    asked = [texts[row] for row in chosen]
    strange = [insert_babble(text, text, rng) for text in asked]
    empty = [_without_key_words(text, scope, rng) for text in asked]
    prompts = [*asked, *strange, *empty]
    embeddings = encode_captions(tower, tokenizer, prompts).numpy()
    nearest = [scope.actions[scope.ranked(row)[0]] for row in embeddings @ scope.means.T]
    wanted = [actions[row] for row in chosen] * 2
    right = [is_near == wish for is_near, wish in zip(nearest, wanted, strict=False)]
    scope = scope.calibrated(prompts, embeddings, right + [False] * len(empty))
    return fit_warnings(scope, languages, tower, tokenizer)


def fit_warnings(
    scope: OutOfDomainDetector,
    languages: tuple[str, ...],
    tower: TextTower,
    tokenizer: PromptTokenizer,
) -> OutOfDomainDetector:
    """The scope, warning by the hand-written sentences that no tower trains on, of known actions
    and of others; as it is behind a tower without places."""
    if not tower.config.text_places:
        return scope
    book = packaged_book()
    wanted: dict[str, str] = {}
    for code in languages:
        if code not in book.languages:
            continue
        language, told = book.language(code), dict[str, str]()
        for labels in book.combinations():
            if (action := labels.get("action", "")) in scope.actions:
                told |= dict.fromkeys(language.sentences(labels), action)
        told |= dict.fromkeys(book.outside(scope.actions, code), "")
        wanted |= {text: told[text] for text in told if book.kept_to_calibrate(text, code)}
    texts = list(wanted)
    embeddings, closeness = place_captions(tower, tokenizer, texts)
    if closeness is None or not any(wanted.values()) or all(wanted.values()):
        return scope
    nearest = [scope.actions[scope.ranked(row)[0]] for row in embeddings.numpy() @ scope.means.T]
    right = [near == action for near, action in zip(nearest, wanted.values(), strict=True)]
    return scope.with_warnings(texts, embeddings.numpy(), closeness.numpy(), right)


def _without_key_words(text: str, scope: OutOfDomainDetector, rng: np.random.Generator) -> str:
    """The text with made-up words for all that tell of an action."""
    found = text.casefold()
    told = set(words_of(text)) & scope.key_words.keys()
    for word in sorted(sorted(told), key=len, reverse=True):  # not in the order of their hashes
        if ord(word[0]) >= 0x3000:
            other = "".join(map(chr, rng.integers(*IDEOGRAPHS, size=len(word))))
        else:
            other = "".join(rng.choice(list(LETTERS), size=max(3, len(word))))
        found = found.replace(word, other)
    return found


MAX_CLIPS = 1500  # of the style map
MIN_FRAMES = 40  # shorter paths say little about energy or rhythm


def fit_style_map(
    data: PreparedData,
    languages: tuple[str, ...],
    tower: TextTower,
    tokenizer: PromptTokenizer,
) -> StyleMap | None:
    """The map of this tower; None where the data is too little for one.

    Styles are those of the pelvis path, which is what the audio branch moves.
    """
    records = [clip for clip in data.records("train") if clip.num_frames >= MIN_FRAMES]
    order = np.random.default_rng(0).permutation(len(records))
    texts: list[str] = []
    values: list[np.ndarray] = []
    for number in order[:MAX_CLIPS]:
        captions = data.captions(records[number])
        spoken = [captions[language][0] for language in languages if captions.get(language)]
        motion = decode_features(data.features(records[number]))
        measured = style_values(measure_style(from_motion(motion))).mean(axis=0)
        texts += spoken
        values += [measured] * len(spoken)
    try:
        return StyleMap.fit(encode_captions(tower, tokenizer, texts).numpy(), np.array(values))
    except ValueError:
        return None


MEANS_FILE = "caption-means.safetensors"  # in the output folder: a resumed run reads it
CHUNK = 128  # captions of one call


def new_tokenizer(clip: ClipConfig, captions: Callable[[], Sequence[str]]) -> PromptTokenizer:
    """A pretrained encoder's own, or, for an encoder of ours, one trained on `captions`."""
    if clip.text_model not in OWN:
        return PromptTokenizer.from_pretrained(clip.text_model, max_tokens=clip.max_tokens)
    return PromptTokenizer.train(captions(), clip.text_vocab_size, max_tokens=clip.max_tokens)


def encoder_rates(tower: TextTower, prefix: str, rate: float) -> dict[str, float]:
    """Learning rates for the task protocol: a pretrained encoder learns at `rate`, 0 freezes it."""
    if tower.config.text_model in OWN:
        return {}
    for name, weight in tower.encoder.named_parameters():
        weight.requires_grad_(rate > 0 and not name.startswith("pooler."))  # which is not used
    return {f"{prefix}encoder.": rate}


@torch.no_grad()
def caption_means(
    tower: TextTower, tokenizer: PromptTokenizer, captions: Sequence[str], file: Path
) -> Tensor:
    """The encoder's mean over the tokens of each caption [N,H], float16 on the CPU.

    They are read from the file if it holds those of these captions and this encoder, else
    computed and written there.

    Raises:
        UserError: the file cannot be written.
    """
    texts = hashlib.sha256("\n".join(captions).encode()).hexdigest()
    made_of = {"captions": texts, "encoder": tower_hash(tower.encoder)}
    if file.is_file():
        with safe_open(file, "pt") as stored:
            if stored.metadata() == made_of:
                found: Tensor = stored.get_tensor("means")
                return found
    announce(f"reading {len(captions)} captions with the frozen encoder, once")
    device, rows = next(tower.parameters()).device, torch.zeros(len(captions), 0)
    by_length = sorted(range(len(captions)), key=lambda row: len(captions[row]))
    tower.eval()
    for start in range(0, len(captions), CHUNK):
        chosen = by_length[start : start + CHUNK]
        ids, mask = (each.to(device) for each in tokenizer([captions[row] for row in chosen]))
        hidden = tower.encoder(input_ids=ids, attention_mask=mask).last_hidden_state
        mean = masked_mean(hidden, mask.bool()).half().cpu()
        if start == 0:
            rows = torch.zeros(len(captions), mean.shape[1], dtype=torch.float16)
        rows[chosen] = mean
        if start // CHUNK % 50 == 49:
            announce(f"{start + len(chosen)} of {len(captions)} captions read")
    with atomic_write(file) as temporary:
        save_file({"means": rows}, temporary, metadata=made_of)
    return rows


def taught_once(
    folder: Path, made_of: Sequence[object], like: TextTower, teach: Callable[[], TextTower]
) -> TextTower:
    """What `teach` makes of a tower of token pairs: read from the folder if it holds what was made
    of the same plain data, else made and written there, beside what was made of other data.

    Raises:
        UserError: the file cannot be written.
    """
    key = hashlib.sha256(json.dumps(made_of).encode()).hexdigest()
    file = folder / f"taught-tower-{key[:12]}.safetensors"
    if file.is_file():
        with suppress(SafetensorError, OSError):  # a damaged one is made anew
            return tower_of(like, load_file(file)).freeze()
        announce(f"{file} is damaged")
    tower = teach()
    with atomic_write(file) as temporary:
        save_file(tower.state_dict(), temporary)
    return tower


@dataclass(frozen=True)
class ZScores:
    """Mean and spread [H] of an encoder's caption means.

    Those of a pretrained encoder have most in common with one another, and a few channels far
    larger than the rest (Ethayarajh 2019): without this, what differs between captions is lost.
    """

    shift: Tensor
    scale: Tensor

    @classmethod
    def of(cls, means: Tensor) -> Self:
        """Of [N,H]."""
        return cls(means.float().mean(0), means.float().std(0).clamp(min=1e-4))

    def __call__(self, means: Tensor) -> Tensor:
        """[N,H] -> z-scores [N,H]."""
        return (means.float() - self.shift) / self.scale

    @torch.no_grad()
    def folded(self, tower: TextTower) -> TextTower:
        """A copy on the CPU, its projection of z-scores made one of what the encoder gives."""
        tower = copy.deepcopy(tower).cpu()
        tower.text_proj.weight.div_(self.scale)
        tower.text_proj.bias.sub_(tower.text_proj.weight @ self.shift)
        return tower
