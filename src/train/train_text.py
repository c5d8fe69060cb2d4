"""The text tower alone: what labels a sentence has, from many more captions than there are clips.

motion-tools train text clip=null [key=value ...]
motion-tools train text clip=runs/clip [generator=runs/generation] [key=value ...]

Each label combination has a place in the space, and the tower learns to send fresh captions of that
combination there, with words missing and made-up words put in. Without a CLIP folder (`clip=null`)
the tower starts from nothing, the places are learned with it (a cosine classifier), and every label
is read off the embedding besides; `train_clip text=…` then teaches a motion tower to meet it
(locked-tower tuning, Zhai et al. 2022, LiT). A pretrained `clip.text-model` learns at a rate of its
own (`encoder-learning-rate`); at 0 it is frozen, and each caption is read once. With one, a trained
tower is hardened: a place is the mean of its captions under the tower that was there before, so
that denoisers stay valid, and neither they nor the motion tower are touched. One that has places
goes on with these: it reads more sentences, with rows for their words, and what it read rightly is
held to what it made of it (distillation, Hinton et al. 2015).

Letters: B batch, G label combinations, P places, D shared dimensions.
"""

import copy
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch
from accelerate import PartialState
from torch import Tensor, nn
from torch.nn.functional import cross_entropy, kl_div, normalize

from ..shared.config_schema import PAIRS, NetworkConfig, TrainTextConfig
from ..shared.data.captions.book import drop_words, insert_babble, packaged_book, piece_of
from ..shared.data.captions.schema import Labels
from ..shared.data.prepared import group_of
from ..shared.errors import UsageError, UserError
from ..shared.io.files import sha256_file
from ..shared.model.checkpoint import WEIGHTS_FILE, read_card, resolve_model
from ..shared.model.clip.core import (
    PLACE_SCALE,
    MotionClip,
    TextTower,
    TokenPairEncoder,
    counted_keys,
)
from ..shared.model.clip.pretrained import (
    KIND,
    ClipBundle,
    encode_captions,
    load_text_tower,
    tower_hash,
)
from ..shared.model.clip.tokenizer import PromptTokenizer
from ..shared.model.generation.motion_generator import KIND as GENERATOR
from ..shared.model.generation.motion_generator import TextToMotion
from .launch import STAGES
from .places import (
    SAME_PLACE,
    LabelledTower,
    TextBatch,
    apart,
    fuller_sides,
    nearest_styles,
    own_places,
    with_fewer_rows,
    with_manners,
    with_pairs,
    with_rows,
    with_sentences,
    with_tower,
    with_unstyled,
)
from .task import Part, Task, numpy_generator
from .text_stages import (
    MEANS_FILE,
    ZScores,
    caption_means,
    encoder_rates,
    fit_scope,
    fit_style_map,
    motion_rows,
    new_tokenizer,
    open_training_data,
    refit_scope,
    trained_card,
    with_places,
)

VOTES = 24  # captions of each combination and language, whose place is the most frequent one
OLD_CAPTIONS = 8  # of each combination and language, whose mean is its place
PLAIN = 2.0  # how much more often combinations without a style are drawn
NOWHERE = 0.5  # cosine of the place of what asks for nothing that is known
HEADS = 0.3  # weight of the labels beside the place, from nothing
MANY = 40  # combinations of an action
SURE = 0.6  # cosine with its place; who was further away, if rightly, may come nearer
NEAR = 2.0  # weight of how far an embedding has gone beside that of the shares of places
HELD_BACK_SEED = 1  # of the captions that validation reads; training reads those of seed 2


class TextTask(Task):
    """What the trainer needs to know (src/train/task.py)."""

    def __init__(self, config: TrainTextConfig, network: NetworkConfig) -> None:
        self.config = config
        bundle = None if config.clip is None else open_tower(config.clip)
        if bundle is not None and bundle.card.kind == GENERATOR:
            config = config.model_copy(update={"generator": config.generator or config.clip})
            self.config = config
        self.data = open_training_data(config, bundle.clip.config if bundle else network)
        self.receiver = TextToMotion.from_pretrained(config.generator) if config.generator else None
        left_out = set(config.without)
        self.goes_on = (
            bundle is not None
            and config.tower == "same"
            and bundle.clip.config.clip.text_places > 0
        )
        if bundle is not None and self.goes_on:
            self._check_going_on(bundle)
        if unknown := sorted(left_out - set(self.data.tags)):
            raise UserError(
                f"without={','.join(unknown)}: {config.data} has no such action; leave it out"
            )
        records = [r for r in self.data.records("train") if r.tag not in left_out]
        self.labels = {record.group: record.labels for record in records if record.labels}
        tags = set(bundle.card.tags) if bundle is not None and self.goes_on else None
        if tags is not None:  # what it knows it goes on with, whatever the data shows of it
            told = [{"action": tag} for tag in tags if tag]
            told += [*self.labels.values(), *packaged_book().combinations()]
            self.labels = {group_of(each): each for each in told if each.get("action") in tags}
        if not self.labels:
            raise UserError(
                f"{config.data} has no labels to write fresh captions from; this stage needs them"
            )
        if config.unstyled_as_captured:
            self.labels = with_unstyled(self.labels)
        if bundle is not None and config.tower == PAIRS:
            self.labels = with_sentences(self.labels, packaged_book().combinations())
        self.plain_of: dict[str, str] = {}  # of combinations in a manner that no clip shows
        if bundle is not None and (self.goes_on or config.tower == PAIRS):
            shown = [record.labels for record in records]
            if self.goes_on:
                shown += self._known_styles(bundle)
            self.labels, self.plain_of = with_manners(self.labels, shown)
        self.groups = sorted(self.labels)
        rows = {group: row for row, group in enumerate(self.groups)}
        self.read_as = torch.tensor([rows[self.plain_of.get(g, g)] for g in self.groups])  # [G]
        book, codes = packaged_book(), config.languages
        self.sentences = [
            {
                code: _taught(book.language(code).sentences(self.labels[group]), code)
                for code in codes
            }
            if config.written
            else {}
            for group in self.groups
        ]
        known = tags or {labels.get("action", "") for labels in self.labels.values()}
        asked = codes if bundle is not None and config.outside else ()
        self.outside = {code: _taught(book.outside(known, code), code) for code in asked}
        self.shares = self._shares()
        self.fresh = self._captions(HELD_BACK_SEED + 1, config.captions_per_group)
        self.held_back = self._captions(HELD_BACK_SEED, 2)
        self.bundle = bundle or self._from_nothing(network)
        self.tokenizer = self.bundle.tokenizer
        self.places = torch.zeros(0)  # learned with the tower
        self.answers: Tensor | None = None  # of the receiver's denoiser, where it is not of `clip`
        if bundle is not None:
            if self.receiver is not None and self._reads_anew(self.receiver):
                self.answers = self._answers(self.receiver)[self.read_as]
            self.places = self._places()
            if config.tower == PAIRS:
                self._replace_tower(bundle)
        self.place_of = torch.arange(len(self.groups) + 1)  # [G + 1], the last one none of them
        if self.plain_of and not self.goes_on:  # each place once
            own, self.place_of[:-1] = torch.unique(self.read_as, return_inverse=True)
            self.place_of[-1] = len(own)
            self.places = self.places[own]
            self.answers = None if self.answers is None else self.answers[own]
        self.teacher: TextTower | None = None
        self.whole: dict[str, list[str]] = {}  # captions to be read in pieces, by language
        if bundle is not None and self.goes_on:
            self.place_of = torch.cat([self._own_places(bundle), torch.tensor([len(self.places)])])
            self._go_on(bundle)
        tower = copy.deepcopy(self.bundle.clip.text).train().requires_grad_(True)
        self.module: nn.Module = tower
        if bundle is None:
            self.module = LabelledTower(tower, [self.labels[group] for group in self.groups])
        prefix = "tower." if bundle is None else ""
        self.learning_rates = encoder_rates(tower, prefix, config.encoder_learning_rate)
        self.read_once = bundle is None and 0.0 in self.learning_rates.values()
        self.rows: dict[tuple[bool, int, str], range] = {}  # of `means`: hand-written, group, code
        self.means = torch.zeros(0)  # z-scored
        self.z_scores: ZScores | None = None
        self.identity = {
            "data-hash": self.data.manifest_hash,
            "clip-hash": config.clip and sha256_file(resolve_model(config.clip) / WEIGHTS_FILE),
        }

    def _check_going_on(self, bundle: ClipBundle) -> None:
        """Of a tower with places: that all it knows is gone on with, for its own denoiser."""
        config = self.config
        if config.without:
            raise UsageError(
                f"without={','.join(config.without)}: {config.clip} goes on with all that it knows"
                "; leave it out"
            )
        if lost := set(bundle.card.languages) - set(config.languages):
            raise UsageError(
                f"languages={','.join(config.languages)} leaves out {', '.join(sorted(lost))},"
                f" which {config.clip} would forget; name them, too"
            )
        if self.receiver and tower_hash(self.receiver.text) != tower_hash(bundle.clip.text):
            raise UserError(
                f"generator {config.generator} does not know the places of {config.clip}; leave it"
                " out, or let it be read anew with tower=pairs"
            )

    def _from_nothing(self, network: NetworkConfig) -> ClipBundle:
        """Two towers that know nothing, and a tokenizer of these captions."""
        tokenizer = new_tokenizer(network.clip, self._texts)
        keys = torch.zeros(0)
        if network.clip.text_model == PAIRS:
            keys = self._shared_keys(tokenizer)
            network = with_pairs(network, len(keys))
        mean, std = (motion_rows(v, network) for v in (self.data.mean, self.data.std))
        card = trained_card(KIND, self.config, network, self.data)
        clip = MotionClip(network)
        if isinstance(clip.text.encoder, TokenPairEncoder):
            clip.text.encoder.keys = keys
        return ClipBundle(clip, tokenizer, mean, std, card)

    def _texts(self) -> list[str]:
        """Every fresh caption, and what asks for something else."""
        groups = (*self.fresh, self.outside)
        return [text for group in groups for some in group.values() for text in some]

    def _shared_keys(self, tokenizer: PromptTokenizer) -> Tensor:
        """Tokens and pairs of them that enough captions share [N], ascending."""
        keys, counts = self._counted_keys(tokenizer, self._texts())
        return keys[counts >= self.config.least_captions]

    @staticmethod
    def _counted_keys(tokenizer: PromptTokenizer, texts: list[str]) -> tuple[Tensor, Tensor]:
        """Tokens and pairs of them [N], and how many different texts each stands in [N]."""
        texts = sorted(set(texts))
        batches = (tokenizer(texts[at : at + 1024])[0] for at in range(0, len(texts), 1024))
        return counted_keys(batches)

    def _own_places(self, bundle: ClipBundle) -> Tensor:
        """Which of the tower's own places each combination has [G]."""
        shown = [group for group in self.groups if group not in self.plain_of]
        found = self._places_of(bundle, shown)
        return torch.tensor([found[self.plain_of.get(group, group)] for group in self.groups])

    def _known_styles(self, bundle: ClipBundle) -> list[Labels]:
        """Combinations in a style that the tower sends to other places than those without it."""
        places = self._places_of(bundle, sorted(self.labels))
        styled = (each for each in self.labels.values() if "style" in each)
        plain = ((e, group_of({key: e[key] for key in e if key != "style"})) for e in styled)
        return [each for each, group in plain if places[group_of(each)] != places.get(group)]

    def _places_of(self, bundle: ClipBundle, groups: list[str]) -> dict[str, int]:
        """Of each combination that clips or the tower show, which of its places it has."""
        captions = self._captions(0, VOTES, whole=False, groups=groups)
        said = [[text for texts in each.values() for text in texts] for each in captions]
        labels = [self.labels[group] for group in groups]
        found = own_places(bundle.clip.text.eval(), bundle.tokenizer, said, labels)
        return dict(zip(groups, found.tolist(), strict=True))

    def _go_on(self, bundle: ClipBundle) -> None:
        """A tower with rows for the words of more sentences; the one that was there teaches it."""
        self.teacher = copy.deepcopy(bundle.clip.text).requires_grad_(False).train()
        self.teacher.encoder.eval()  # whole sentences, as they are before they are sent to places
        if self.config.pieces:
            for group, each in zip(self.groups, self._captions(0, VOTES, whole=False), strict=True):
                if group in self.plain_of:  # it may misread these
                    continue
                self.whole = {code: self.whole.get(code, []) + each[code] for code in each}
        written = [text for each in self.sentences for texts in each.values() for text in texts]
        keys, counts = self._counted_keys(bundle.tokenizer, self._texts() + written)
        self.met = dict(zip(keys.tolist(), counts.tolist(), strict=True))
        more = with_rows(bundle.clip.text, keys[counts >= self.config.least_captions])
        _give(bundle, more)

    def _replace_tower(self, bundle: ClipBundle) -> None:
        """A tower of token pairs that knows nothing yet, in place of the one that is there."""
        keys = self._shared_keys(bundle.tokenizer)
        network = with_pairs(bundle.clip.config, len(keys))
        tower = TextTower(network.clip, network.embed_dim)
        assert isinstance(tower.encoder, TokenPairEncoder)
        tower.encoder.keys = keys
        _give(bundle, tower)

    def _shares(self) -> np.ndarray:
        """How often a combination is drawn [G], of what one without a style weighs a share in the
        manners that no clip shows: an action of n combinations weighs n^0.75 (of more than MANY no
        more where a tower goes on, which knows them), and in it one of m hand-written
        sentences sqrt(1 + m), PLAIN times that without a style: the words of plain ones stand in
        all others, too, and would ask for the middle of the styles."""
        actions = [
            None if group in self.plain_of else self.labels[group].get("action", "")
            for group in self.groups
        ]
        written = np.array([1 + sum(map(len, each.values())) for each in self.sentences]) ** 0.5
        written *= [1.0 if "style" in self.labels[group] else PLAIN for group in self.groups]
        weights = np.zeros(len(actions))
        for action, number in Counter(each for each in actions if each is not None).items():
            own = np.array([each == action for each in actions])
            number = min(number, MANY) if self.goes_on else number
            weights[own] = number**0.75 * written[own] / written[own].sum()
        rows, share = self.read_as.numpy(), self.config.manners
        manners = np.bincount(rows, minlength=len(rows)) - 1  # of each; -1 of one
        said_so = share * weights[rows] / np.maximum(manners[rows], 1)
        plain = np.where(manners > 0, 1 - share, 1) * weights
        weights = np.where(manners < 0, said_so, plain)
        return np.asarray(weights / weights.sum())

    def _captions(
        self, seed: int, num: int, *, whole: bool = True, groups: Sequence[str] | None = None
    ) -> list[dict[str, list[str]]]:
        """For each combination and language, of all manners of one as many as of one; without
        `whole`, of the grammar alone."""
        book, kept = packaged_book(), self.config.languages
        manners = Counter(self.plain_of.values())
        groups = self.groups if groups is None else groups
        shares = [manners[self.plain_of.get(group, "")] or 1 for group in groups]
        found = (
            book.captions(self.labels[g], num=-(-num // share), seed=seed, whole_sentences=whole)
            for g, share in zip(groups, shares, strict=True)
        )
        return [
            {k: _taught(v, k) if whole else v for k, v in captions.items() if k in kept}
            for captions in found
        ]

    def _places(self) -> Tensor:
        """Unit mean [G,D] of each combination's captions under the old tower, or the places [P,D]
        that it has.

        Those of the grammar: it may not know what whole sentences ask for.
        """
        if self.goes_on:
            return self.bundle.clip.text.place_keys()
        captions = self._captions(0, OLD_CAPTIONS, whole=False)
        texts = [text for group in captions for texts in group.values() for text in texts]
        owner = [i for i, group in enumerate(captions) for texts in group.values() for _ in texts]
        embeddings = encode_captions(self.bundle.clip.text.eval(), self.tokenizer, texts)
        places = torch.zeros(len(self.groups), embeddings.shape[1])
        places = normalize(places.index_add_(0, torch.tensor(owner), embeddings), dim=-1)
        if self.bundle.card.kind == GENERATOR:
            labels = [self.labels[group] for group in self.groups]
            places = apart(places, labels, self.bundle.card.tags)
        if self.config.unstyled_as_captured:
            index = {group: row for row, group in enumerate(self.groups)}
            found = nearest_styles(self.data, self.labels) | fuller_sides(self.data, self.labels)
            rows, taken = ([index[g] for g in each] for each in (found, found.values()))
            places[rows] = places[taken]
        return places[self.read_as]

    def _reads_anew(self, receiver: TextToMotion) -> bool:
        """Whether the receiver has places that are not those of `clip`: these are what texts are
        read by, and those what it is asked for."""
        new = self.config.tower == PAIRS and receiver.text.config.text_places > 0
        return new and tower_hash(receiver.text) != tower_hash(self.bundle.clip.text)

    def _answers(self, receiver: TextToMotion) -> Tensor:
        """For each combination the place [G,D] of the receiver's own tower to which most of the
        combination's captions go there: what its denoiser has learned to answer."""
        places = receiver.text.get_buffer("places").float()
        found = []
        for captions in self._captions(0, VOTES, whole=False):
            texts = [text for some in captions.values() for text in some]
            nearest = encode_captions(receiver.text, receiver.tokenizer, texts) @ places.T
            found.append(nearest.argmax(-1).mode().values)
        return places[torch.stack(found)]

    def to(self, device: torch.device) -> None:
        """The places and a teacher follow the module, and the frozen encoder, there now, reads the
        captions."""
        self.places = self.places.to(device)
        if self.teacher is not None:
            self.teacher.to(device)
        if isinstance(self.module, LabelledTower) and self.read_once:
            captions = self._captions_to_read()
            file = Path(self.config.output) / MEANS_FILE
            with PartialState().main_process_first():
                self.means = caption_means(self.module.tower, self.tokenizer, captions, file)
            self.z_scores = ZScores.of(self.means)
            self.means = self.z_scores(self.means).half()

    def _captions_to_read(self) -> list[str]:
        """Each fresh caption and hand-written sentence, as it is and damaged; fills `rows`."""
        rng = numpy_generator("text", self.config.seed, 0, 0)
        captions: list[str] = []
        for written, groups in enumerate((self.fresh, self.sentences)):
            for index, group in enumerate(groups):
                for language, texts in group.items():
                    first = len(captions)
                    captions += texts
                    captions += [self._damaged(text, language, rng) for text in texts]
                    self.rows[bool(written), index, language] = range(first, len(captions))
        return captions

    def batch(self, part: Part) -> TextBatch:
        """Fresh captions, half of them damaged in some way; languages alike."""
        config = self.config
        rng = numpy_generator("text", config.seed, part.step, part.index)
        chosen = rng.choice(len(self.groups), size=config.batch_size, p=self.shares)
        captions, rows, held = [], [], []
        for row, group in enumerate(chosen):
            language = config.languages[rng.integers(len(config.languages))]
            if (whole := self.whole.get(language)) and rng.random() < config.pieces:
                held.append(row)
                first, second = rng.integers(len(whole), size=2)
                captions.append(piece_of(whole[first], whole[second], rng))
                continue
            if self.outside.get(language) and rng.random() < config.outside:
                chosen[row] = len(self.groups)
                texts = self.outside[language]
                captions.append(self._damaged(texts[rng.integers(len(texts))], language, rng))
                continue
            written = rng.random() < config.written and bool(self.sentences[group].get(language))
            by_language = (self.sentences if written else self.fresh)[group]
            if not by_language.get(language):
                language = next(iter(by_language))
            if self.read_once:
                known = self.rows[written, int(group), language]
                rows.append(known[rng.integers(len(known))])
            else:
                texts = by_language[language]
                captions.append(self._damaged(texts[rng.integers(len(texts))], language, rng))
        groups = self.place_of[torch.from_numpy(chosen)]
        groups[held] = -1
        if self.read_once:
            none = torch.zeros(len(groups), 0, dtype=torch.long)
            return TextBatch(none, none, groups, self.means[rows].float())
        return TextBatch(*self.tokenizer(captions), groups)

    def _damaged(self, text: str, language: str, rng: np.random.Generator) -> str:
        """In half of the cases with words missing, in some with made-up words in it."""
        if rng.random() < 0.5:
            text = drop_words(text, self.config.word_dropout, rng)
        if rng.random() < self.config.babble:
            other = self.fresh[rng.integers(len(self.fresh))].get(language, [text])
            text = insert_babble(text, other[rng.integers(len(other))], rng)
        return text

    def training_step(self, module: nn.Module, batch: TextBatch) -> dict[str, Tensor]:
        """Distance to the right place, and its probability among all places; from nothing, that
        of the place and of each label."""
        scale = self.config.scale
        if self.config.clip is None:
            choice, label = module(batch, scale)
            return {"loss": choice + HEADS * label, "choice": choice, "labels": label}
        pooled = module(batch.input_ids, batch.attention_mask).pooled  # [B, D]
        cosines = pooled @ self.places.T  # [B, P]
        told = batch.group >= 0
        inside = told & (batch.group < len(self.places))
        nowhere = torch.full_like(cosines[:, :1], NOWHERE if self.outside else -torch.inf)
        chances = scale * torch.cat((cosines, nowhere), -1)
        choice = cross_entropy(chances[told], batch.group[told])
        own = cosines[inside].gather(-1, batch.group[inside, None])
        cosine = 1 - own.mean()
        loss = cosine + self.config.choice_weight * choice
        if self.teacher is None:
            return {"loss": loss, "cosine": cosine, "choice": choice}
        kept = self._kept(batch, pooled, cosines)
        return {"loss": loss + self.config.keeping * kept, "cosine": cosine, "choice": choice,
                "kept": kept}  # fmt: skip

    def _kept(self, batch: TextBatch, pooled: Tensor, cosines: Tensor) -> Tensor:
        """How far what the teacher read rightly and surely, and pieces of captions, have gone from
        where they were, and from the shares of the places [B,P] that they had."""
        assert self.teacher is not None
        with torch.no_grad():
            taught = self.teacher(batch.input_ids, batch.attention_mask).pooled  # [B, D]
            shares = PLACE_SCALE * taught @ self.places.T
        sure, at = (shares / PLACE_SCALE).max(-1)
        right = (at == batch.group) & (sure >= SURE) | (batch.group < 0)
        if not right.any():
            return cosines.new_zeros(())
        spread = kl_div(
            (PLACE_SCALE * cosines[right]).log_softmax(-1),
            shares[right].softmax(-1),
            reduction="batchmean",
        )
        kept: Tensor = spread + NEAR * (1 - (pooled[right] * taught[right]).sum(-1)).mean()
        return kept

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Of captions that training did not read: how many land nearest to the right place."""
        module.eval()
        tower, places = self._trained(module)
        figures = {}
        for language in self.config.languages:
            held_back = enumerate(self.held_back)
            pairs = [(text, i) for i, group in held_back for text in group.get(language, [])]
            if not pairs:
                continue
            embeddings = encode_captions(tower, self.tokenizer, [text for text, _ in pairs])
            nearest = places[(embeddings @ places.T).argmax(-1)]
            wanted = places[self.place_of[[index for _, index in pairs]]]
            right = (nearest * wanted).sum(-1) > SAME_PLACE  # places may be one
            figures[f"right-{language}"] = right.float().mean().item()
        figures["right"] = sum(figures.values()) / max(len(figures), 1)
        module.train()
        return figures

    def _trained(self, module: nn.Module) -> tuple[TextTower, Tensor]:
        """The tower, and on the CPU the places [P,D] that it sends texts to."""
        if isinstance(module, LabelledTower):
            tower = self.z_scores.folded(module.tower) if self.z_scores else module.tower
            return tower, normalize(module.places.detach(), dim=-1).cpu()
        assert isinstance(module, TextTower)
        if self.goes_on:
            return module, normalize(module.get_buffer("places").float(), dim=-1).cpu()
        return module, self.places.cpu()

    def _placed(self, tower: TextTower) -> TextTower:
        """With the places of the combinations, each once."""
        if self.answers is None:
            return with_places(tower, torch.unique(self.places.cpu(), dim=0))
        both = torch.cat((self.places.cpu(), self.answers), dim=1)
        keys, answers = torch.unique(both, dim=0).split(self.places.shape[1], dim=1)
        return with_places(tower, answers, keys)

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """The CLIP folder with the new tower; or the generator with it and a new scope."""
        tower = self._trained(module)[0].cpu().freeze()
        if self.config.tower == PAIRS:
            tower = self._placed(tower)
        elif self.goes_on:
            most = self.config.most_rows or tower.config.text_pairs
            tower = with_fewer_rows(tower, self.met, most).freeze()
        _give(self.bundle, tower)
        hardened = {"steps": self.config.steps, "validation": self.figures}
        if self.config.generator is None:
            self.bundle.card = _noted(self.bundle.card, hardened)
            self.bundle.save_pretrained(folder)
            return
        generator = TextToMotion.from_pretrained(self.config.generator, device="cpu")
        generator.text, generator.tokenizer = tower, self.tokenizer
        languages, without = self.config.languages, self.config.without
        generator.network = generator.network.model_copy(update={"clip": tower.config})
        generator.card = _noted(generator.card, hardened)
        if self.goes_on:  # its places stay
            if generator.scope is not None:
                generator.scope = refit_scope(generator.scope, languages, tower, self.tokenizer)
            generator.save_pretrained(folder)
            return
        generator.scope = fit_scope(self.data, languages, tower, self.tokenizer, without)
        generator.style_map = fit_style_map(self.data, languages, tower, self.tokenizer)
        if generator.network.generation.adapter_ranks:
            kept = [tag for tag in generator.card.tags if tag not in without]
            generator.denoiser = with_tower(generator, kept)
            generator.card = generator.card.model_copy(update={"tags": tuple(kept)})
        generator.save_pretrained(folder)


def _taught(texts: list[str], lang: str) -> list[str]:
    """Those that training reads; all of them, where none were left."""
    return [text for text in texts if not packaged_book().kept_to_calibrate(text, lang)] or texts


def open_tower(name_or_folder: str) -> ClipBundle:
    """A CLIP folder, or a generator's text tower with its tokenizer, beside an empty motion tower.

    Raises:
        UserError: neither.
    """
    folder = resolve_model(name_or_folder)
    card = read_card(folder)
    if card.kind != GENERATOR:
        return ClipBundle.from_pretrained(folder)
    clip = MotionClip(card.network, encoder_config=card.text_encoder)
    clip.text, tokenizer = load_text_tower(folder, card.network.embed_dim)
    statistics = torch.zeros(0), torch.zeros(0)  # of the motion tower, which is not written
    return ClipBundle(clip, tokenizer, *statistics, card)


def _give(bundle: ClipBundle, tower: TextTower) -> None:
    """Put another text tower, of sizes of its own, into a bundle."""
    bundle.clip.text = tower
    bundle.clip.config = bundle.clip.config.model_copy(update={"clip": tower.config})


def _noted(card: Any, hardened: dict[str, Any]) -> Any:
    return card.model_copy(update={"training": {**card.training, "text-hardening": hardened}})


if __name__ == "__main__":
    STAGES["text"].app()()
