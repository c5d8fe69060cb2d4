"""A new action for a trained text model, from a few clips of it, while the old ones stay.

motion-tools train action --data FOLDER init=starter [key=value ...]

A text tower of token pairs sends each sentence to one of its places. A new action gets a place of
its own, and the tower learns to send the clips' captions there and all other sentences where it
sent them before. Then low-rank adapters (Hu et al. 2022, LoRA) learn what is at the new place. They
are open for texts that come out there and closed for all others: of what the model knew, nothing
changes. No clip that it was trained on is needed. With `actions=` it is known actions that are
learned better, in adapters at the places that they have; with `styles=` those of their clips in
these styles, at places where nothing else comes out, or, `styles=plain`, in none. A style that was
given the very place of plain clips (places.py) moves aside. With
`captured-share=1` the captured clips of an action that has some are all that is learned of it.

Letters: B batch, T frames, R rows of a frame, P places, D shared dimensions.
"""

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn
from torch.nn.functional import normalize

from ..shared.config_schema import PAIRS, NetworkConfig, TrainActionConfig
from ..shared.data.captions.book import packaged_book
from ..shared.data.prepared import ClipRecord
from ..shared.data.text_motion import arm_actions, gestures, still_actions
from ..shared.errors import UsageError, UserError
from ..shared.model.clip.core import TextTower
from ..shared.model.clip.out_of_domain import OutOfDomainDetector
from ..shared.model.clip.pretrained import encode_captions, tower_hash
from ..shared.model.diffusion import GaussianDiffusion
from ..shared.model.generation.denoiser import TAG_WEIGHT, MotionDenoiser
from ..shared.model.generation.losses import GenerationLoss
from ..shared.model.generation.motion_generator import TextToMotion
from ..shared.motion.features import HEIGHT, ROOT_ROW, encode_features, heading_joints
from ..shared.motion.rotations import rotation_6d_to_matrix
from ..shared.motion.skeleton import NUM_JOINTS
from .launch import STAGES
from .places import apart, old_captions, pooled, with_new_places, within_reach
from .run_log import announce
from .task import Part, Task, generator, numpy_generator
from .text_stages import (
    as_features,
    fit_warnings,
    motion_rows,
    network_of_model,
    open_training_data,
    taught_once,
    training_set,
    with_places,
    write_samples,
    z_scored_for,
)
from .train_generation import (
    GuidedDenoiser,
    LearnedStep,
    NoisedBatch,
    denoising_losses,
    draw_known,
    spread_timesteps,
)

KEPT = 0.15  # of where the tower sent new captions, which is near everything that it knew
LEAST_CLIPS = 2
PLAIN = "plain"  # clips without a style
SHARED = 0.1  # share of another combination's captions that makes a place theirs, too
MOST = 0.5  # share of captions that have to agree on a place, and of places on an adapter
TIMESTEPS = 1  # their place among what MotionDenoiser.forward is given
LEAST = 1e-6  # of the largest singular value, that counts
SAME = 1e-6  # in cosine, of two places that are one
TOLD, MOST_TOLD, MOST_CLIPS, LONGEST = 4, 12, 40, 4.0  # motions, actions, clips, seconds
ASIDE = 0.3  # how far a style moves from where plain clips are, too


@dataclass(frozen=True)
class ActionBatch(NoisedBatch):
    """With what the text tower gives: place [B,D]."""

    place: Tensor


class ActionTask(Task):
    """What the trainer needs to know (task.py)."""

    can_be_captured = True

    def __init__(self, config: TrainActionConfig, network: NetworkConfig) -> None:
        self.config = config
        self.before = TextToMotion.from_pretrained(config.init, device="cpu")
        self.data = open_training_data(config, network)
        known = set(self.before.card.tags)
        self.actions = config.actions or tuple(sorted(set(self.data.tags) - known))
        self._check()
        records = self.data.records("train")
        captured = {r.tag for r in records if r.provenance == "captured"}
        self.captured = captured if config.captured_share == 1 else set[str]()
        self.clips = Counter(r.group for r in records if self._admits(r))
        self.train = training_set(config, self.data, self._learns)
        shown = {record.tag for record in self.train.records}
        if lacking := sorted(set(self.actions) - shown - known):
            raise UserError(
                f"min-clips={config.min_clips} leaves no clip of {', '.join(lacking)}, which is"
                " new; lower it, or prepare more clips of a kind"
            )
        self.tags = (
            self.before.card.tags if config.actions else (*self.before.card.tags, *self.actions)
        )
        self.tower, place_of = self._known_tower() if config.actions else self._places()
        self.places = torch.stack([place_of[record.group] for record in self.train.records])
        self.row_of = {record.id: row for row, record in enumerate(self.train.records)}
        self.network = self._adapted_network(network)
        denoiser = self._denoiser()
        few = config.first_share > 0 and denoiser.one_step is not None
        self.module: nn.Module = (OftenInOneStep if few else GuidedDenoiser)(denoiser)
        self.diffusion = GaussianDiffusion(network.generation.diffusion())
        self.loss = GenerationLoss(
            config.losses, self.diffusion, self.before.mean.cpu(), self.before.std.cpu()
        )
        self.shares = config.constraints if network.generation.constraints else None
        self.frozen = (self.loss,)
        self.identity = {
            "network": self.network.model_dump(mode="json", by_alias=True),
            "data-hash": self.data.manifest_hash,
            "tower-hash": tower_hash(self.before.text),
        }

    def _learns(self, record: ClipRecord) -> bool:
        """Whether this clip is to be learned."""
        if record.tag not in self.actions or not self._admits(record):
            return False
        if self.clips[record.group] < self.config.min_clips:
            return False
        return not self.config.styles or record.labels.get("style", PLAIN) in self.config.styles

    def _admits(self, record: ClipRecord) -> bool:
        """Whether it was recorded, where recorded clips are all that is to be learned."""
        return record.provenance == "captured" or record.tag not in self.captured

    def _check(self) -> None:
        styles = self.config.styles
        if styles and not self.config.actions:
            raise UsageError(
                f"styles={','.join(styles)} are styles of actions that are known: name them, as in"
                f" actions=walk styles={styles[0]}"
            )
        if unknown := sorted(set(self.config.actions) - set(self.before.card.tags)):
            raise UserError(
                f"actions={','.join(unknown)}: {self.config.init} does not know that action; leave"
                " `actions` out, and it learns what is new in the data"
            )
        if not self.actions:
            there = ", ".join(self.data.tags) or "none"
            raise UserError(
                f"{self.config.data} has no action that {self.config.init} does not know (it has:"
                f" {there}); give the clips a new one (`action` in docs/quickstart.md)"
            )
        for action in self.actions:
            if (number := sum(r.tag == action for r in self.data.records("train"))) < LEAST_CLIPS:
                raise UserError(
                    f"{self.config.data} has {number} clip of {action!r} to train on; prepare at"
                    f" least {LEAST_CLIPS}, better 20"
                )
        clips = [r for r in self.data.records("train") if r.tag in self.actions]
        shown = {r.labels.get("style", PLAIN) for r in clips}
        if unknown := sorted(set(styles) - shown):
            raise UserError(
                f"styles={','.join(unknown)}: {self.config.data} has no clip of"
                f" {', '.join(self.actions)} in that style; name one of"
                f" {', '.join(sorted(shown)) or 'none'}"
            )

    # ------------------------------------------------------------ the text tower

    def _places(self) -> tuple[TextTower, dict[str, Tensor]]:
        """The tower with a place for each new combination; and the place [D] of every group."""
        groups: dict[str, ClipRecord] = {r.group: r for r in self.train.records}
        captions = self._asked_of_groups()
        before = self.before.text
        means = torch.stack(
            [
                normalize(encode_captions(before, self.before.tokenizer, texts).mean(0), dim=-1)
                for texts in captions.values()
            ]
        )
        labels = [record.labels for record in groups.values()]
        places = apart(means, labels, self.before.card.tags, kept=KEPT)
        places = within_reach(before, places)
        known, (steps, seed) = self._known_captions, (self.config.tower_steps, self.config.seed)
        outside = [
            text
            for code in self.config.languages
            for text in packaged_book().outside({*self.before.card.tags, *self.actions}, code)
        ]

        kept = sorted(self.before.scope.key_words) if self.before.scope else []

        def taught() -> TextTower:
            announce(f"teaching the text tower {', '.join(self.actions)}")
            said, tokenizer = list(captions.values()), self.before.tokenizer
            return with_new_places(
                before, tokenizer, places, said, known, outside, fixed=kept, steps=steps, seed=seed
            )

        made_of = [tower_hash(before), captions, known, outside, kept, steps, seed]
        tower = taught_once(Path(self.config.output), made_of, before, taught)
        return tower, dict(zip(groups, places, strict=True))

    def _known_tower(self) -> tuple[TextTower, dict[str, Tensor]]:
        """The tower as it is; and for every group the place [D] that most of its captions go to, or
        else most of its action's. With `styles` groups in a style that share theirs with others
        are left out.

        Raises:
            UserError: none is left.
        """
        before, keys = self.before.text, self.before.text.place_keys()
        places = before.get_buffer("places").float()

        @torch.no_grad()
        def nearest(records: Iterable[ClipRecord]) -> dict[str, Tensor]:
            groups = {record.group: record for record in records}
            return {
                group: (
                    pooled(before, self.before.tokenizer, self._captions(record)) @ keys.T
                ).argmax(-1)
                for group, record in groups.items()
            }

        mine = nearest(self.train.records)
        tags = {record.group: record.tag for record in self.train.records}
        found = {}
        for group, own in mine.items():
            if (own == own.mode().values).float().mean() < MOST:
                own = torch.cat([mine[g] for g, tag in tags.items() if tag == tags[group]])
            found[group] = int(own.mode().values)
        if self.config.styles:
            records = self.data.records("train")
            plain = {r.group for r in self.train.records if "style" not in r.labels}
            others = (r for r in records if r.labels and r.group not in found.keys() - plain)
            alone = unshared(found, nearest(others).values())
            found = {group: at for group, at in found.items() if group in plain or group in alone}
            if not found:
                raise UserError(
                    f"styles={','.join(self.config.styles)}: no clip of {', '.join(self.actions)}"
                    f" in {self.config.data} has them at a place of its own; name other styles"
                )
            announce(f"learning {', '.join(sorted(found))}")
            self.train = training_set(
                self.config, self.data, lambda r: r.group in found and self._learns(r)
            )
            places = aside(places, {at for group, at in found.items() if group not in plain})
            keyed = before.config.text_place_keys
            before = with_places(before, places, keys if keyed else None)
        return before, {group: places[place] for group, place in found.items()}

    @cached_property
    def _known_captions(self) -> list[str]:
        return old_captions(self.before.card.tags, self.config.languages)

    def _captions(self, record: ClipRecord) -> list[str]:
        """Of every clip of its group, in every language."""
        records = self.data.records("train")
        return sorted({*self._said(r for r in records if r.group == record.group)})

    def _asked(self, record: ClipRecord) -> list[str]:
        """Those, and what else is written by hand of the same labels."""
        written = (packaged_book().written(record.labels, c) for c in self.config.languages)
        return sorted({*self._captions(record), *(text for texts in written for text in texts)})

    def _asked_of_groups(self) -> dict[str, list[str]]:
        """Those of all clips of each group, whose own words differ."""
        found: dict[str, set[str]] = {}
        for record in {r.group + str(r.captions): r for r in self.train.records}.values():
            found.setdefault(record.group, set()).update(self._asked(record))
        return {group: sorted(texts) for group, texts in found.items()}

    def _said(self, records: Iterable[ClipRecord]) -> list[str]:
        """The captions of these clips, one after another."""
        spoken = (self.data.captions(record).values() for record in records)
        return [text for languages in spoken for texts in languages for text in texts]

    # ------------------------------------------------------------ the denoiser

    def _adapted_network(self, network: NetworkConfig) -> NetworkConfig:
        ranks = (*network.generation.adapter_ranks, self.config.rank)
        update = {"adapter_ranks": ranks, "clip_sigma": self._clip_sigma(network)}
        generation = network.generation.model_copy(update=update)
        return network.model_copy(update={"generation": generation, "clip": self.tower.config})

    def _clip_sigma(self, network: NetworkConfig) -> float | None:
        """That of the old network, which needs none if it predicts x0 (ruling 105): a body that
        lies is far beyond it, and none is kept where the clips to be learned are."""
        limit = network.generation.clip_sigma
        if limit is None or network.generation.prediction_type != "sample":
            return limit
        mean, std = self.before.mean.cpu(), self.before.std.cpu()
        for record in self.train.records:
            rows = motion_rows(self.data.features(record), network)
            if float(((rows - mean) / std).abs().max()) > limit:
                announce(f"clip-sigma {limit:g} goes: {record.id} is further from the mean")
                return None
        return limit

    def _denoiser(self) -> MotionDenoiser:
        """A copy of the old one in which nothing but the new adapters can learn. They begin as
        those that most of what is to be learned opens already, if it does."""
        denoiser, old = MotionDenoiser(self.network, len(self.tags)), self.before.denoiser
        before, every = old.state_dict(), self.tower.get_buffer("places")
        ranks, tags = self.network.generation.adapter_ranks, before[TAG_WEIGHT]
        number = len(self.tags) - len(self.before.card.tags)
        added = tags[-1:].expand(number, -1)  # a new tag tells no more than none
        adapter_of = torch.zeros(len(every)).long()
        known = len(self.before.text.get_buffer("places"))
        adapter_of[:known] = before.get("adapter_of", adapter_of[:known])
        near = every.float() @ torch.unique(self.places, dim=0).T  # [P, places learned]
        learned = (near > near.amax(0) - SAME).any(1)
        most = int(adapter_of[learned].mode().values)
        shared = float((adapter_of[learned] == most).float().mean()) > MOST
        adapter_of[learned] = len(ranks)
        begun = begun_as(most - 1, len(ranks) - 1, before, self.config.rank) if shared else {}
        if begun:
            announce(f"going on with adapter {most}, which most of what is learned opens")
        denoiser.load_state_dict(
            {
                **denoiser.state_dict(),
                **before,
                **begun,
                TAG_WEIGHT: torch.cat([tags[:-1], added, tags[-1:]]),
                "places": every,
                "adapter_of": adapter_of,
            }
        )
        for name, weight in denoiser.named_parameters():
            weight.requires_grad_(f".adapters.{len(ranks) - 1}." in name)
        return denoiser

    # ------------------------------------------------------------ batches

    def batch(self, part: Part) -> ActionBatch:
        """Clips of the new actions; everything random is drawn here, on the CPU."""
        config, size = self.config, self.config.batch_size
        clips = self.train.batch(part.step, size, rank=part.index)
        clean = z_scored_for(self.before, clips.motion, self.data)
        draws = generator("noise", config.seed, part.step, part.index)
        rng = numpy_generator("known", config.seed, part.step, part.index)
        return ActionBatch(
            clean=clean,
            noise=torch.randn(clean.shape, generator=draws),
            mask=clips.mask,
            known=draw_known(clips.mask, clean.shape[2], self.shares, rng),
            timesteps=self._timesteps(size, draws),
            tag=torch.full((size,), len(self.tags)),
            provenance=clips.provenance,
            drop=torch.rand(size, generator=draws) < config.condition_dropout,
            place=self.places[[self.row_of[record.id] for record in clips.records]],
        )

    def _timesteps(self, size: int, draws: torch.Generator) -> Tensor:
        """[B], of which `first_share` is the last: hardly any is by chance, and with few steps much
        is decided there."""
        last = self.diffusion.config.timesteps - 1
        drawn = spread_timesteps(size, last + 1, draws)
        if not self.config.first_share:
            return drawn
        return drawn.where(torch.rand(size, generator=draws) >= self.config.first_share, last)

    # ------------------------------------------------------------ learning

    def training_step(self, module: nn.Module, batch: ActionBatch) -> dict[str, Tensor]:
        """The weighted losses of one noised batch."""
        return denoising_losses(module, as_features(batch.place), batch, self.loss)

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Of four motions of each action: how far a joint is from where it is in the nearest frame
        of the action's clips, in cm, and how fast joints move by how fast they do there, both in
        the heading frame. Who holds a pose of a clip has 0 and 0.
        """
        maker, figures = self._generator(module), dict[str, float]()
        for action in self.actions[:MOST_TOLD]:
            clips = [record for record in self.train.records if record.tag == action]
            if not clips:  # all left out, by min-clips or styles
                continue
            texts = [self._captions(record)[0] for record in clips[:: -(-len(clips) // TOLD)]]
            prompts = [texts[i % len(texts)] for i in range(TOLD)]
            seconds = min(sum(r.num_frames for r in clips) / len(clips) / 30.0, LONGEST)
            made = maker.generate(prompts, seconds=max(seconds, 1.0), seed=self.config.seed)
            shown = [_joints(encode_features(motion)) for motion in made]
            real = [_joints(self.data.features(record)) for record in clips[:MOST_CLIPS]]
            apart = torch.cdist(torch.cat(shown).flatten(1), torch.cat(real).flatten(1)).amin(1)
            figures[f"{action}-cm"] = 100 * float(apart.mean()) / math.sqrt(real[0].shape[1])
            figures[f"{action}-speed"] = _speed(shown) / max(_speed(real), 1e-6)
        return figures

    # ------------------------------------------------------------ results

    def _generator(self, module: nn.Module) -> TextToMotion:
        assert isinstance(module, GuidedDenoiser)
        before = self.before
        learned = {"from": before.card.name, "actions": list(self.actions),
                   "styles": list(self.config.styles), "steps": self.config.steps,
                   "data": self.data.manifest_hash}  # fmt: skip
        history = [*before.card.training.get("actions", []), learned]
        update = {
            "name": Path(self.config.output).name,
            "tags": self.tags,
            "description": before.card.description
            + ("" if self.config.actions else f"; and {', '.join(self.actions)}"),
            "training": {**before.card.training, "actions": history},
        }
        return before.with_denoiser(
            module.denoiser,
            text=self.tower,
            card=before.card.model_copy(update=update),
            scope=self._scope,
            device=next(module.parameters()).device.type,
        )

    @cached_property
    def _scope(self) -> OutOfDomainDetector | None:
        """What was known, with the new actions and how what was learned is done."""
        scope, data, learned = self.before.scope, self.data, set(self.actions)
        if scope is None:
            return None

        def done(known: Sequence[str], shown: Sequence[str]) -> tuple[str, ...]:
            return tuple(sorted({*known} - learned | {*shown} & learned))

        cycles = {name: how for name, how in scope.cycles.items() if name not in learned}
        handed = {name: how for name, how in scope.handed.items() if name not in learned}

        scope = replace(scope, still=done(scope.still, still_actions(data)))
        scope = replace(scope, cycles=cycles, handed=handed)
        if self.config.actions:
            return scope
        taken = scope.key_words.keys()
        tags = {record.group: record.tag for record in self.train.records}
        said = {action: set[str]() for action in self.actions}
        for group, asked in self._asked_of_groups().items():
            said[tags[group]].update(asked)
        for action, own in said.items():
            texts = sorted(own)
            others = [text for each, of in said.items() if each != action for text in of]
            rows = [row for row, r in enumerate(self.train.records) if r.tag == action]
            others += self._known_captions
            scope = scope.with_action(action, texts, self.places[rows].numpy(), others, taken)
        arms, gesturing = done(scope.arms, arm_actions(data)), done(scope.gestures, gestures(data))
        scope = replace(scope, arms=arms, gestures=gesturing)
        before = self.before
        return fit_warnings(scope, before.card.languages, self.tower, before.tokenizer)

    def export_samples(self, module: nn.Module, folder: Path) -> None:
        """One motion of each new action, as BVH and HTML."""
        maker = self._generator(module)
        prompts = [
            self._captions(next(r for r in self.train.records if r.tag == action))[0]
            for action in self.actions
        ]
        write_samples(maker.generate(prompts, seconds=3.0), self.actions, folder)

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """A folder that `generate --model` reads."""
        self._generator(module).save_pretrained(folder)


class OftenInOneStep(LearnedStep):
    """A denoiser in which every other clip of those that are noise alone takes its learned step,
    which stays as it is: what an adapter learns is to be right in that one as well."""

    def predicted(self, *heard: Any, **told: Any) -> Tensor:
        """As MotionDenoiser.forward."""
        slow: Tensor = self.denoiser(*heard, **told)
        every_other = slice(None, None, 2)
        heard = tuple(None if value is None else value[every_other] for value in heard)
        told = {k: None if value is None else value[every_other] for k, value in told.items()}
        last = self.denoiser.config.generation.diffusion_steps - 1
        at_once = (heard[TIMESTEPS] == last).view(-1, 1, 1, 1)
        result = slow.clone()
        result[every_other] = super().predicted(*heard, **told).where(at_once, slow[every_other])
        return result


def begun_as(old: int, new: int, state: Mapping[str, Tensor], rank: int) -> dict[str, Tensor]:
    """Weights of adapter `new` of a denoiser, which does as adapter `old` of `state` does, as well
    as its rank allows: by singular values, the spare ones zero."""
    begun = dict[str, Tensor]()
    for name, down in state.items():
        if f".adapters.{old}.0." not in name:
            continue
        up = state[name.replace(f".adapters.{old}.0.", f".adapters.{old}.1.")]
        left, sizes, right = torch.linalg.svd(up @ down, full_matrices=False)
        own = name.replace(f".adapters.{old}.", f".adapters.{new}.")
        roots = sizes[: min(rank, len(down))].sqrt()
        kept = int((sizes[: len(roots)] > LEAST * sizes[0]).sum())  # both maps zero learn nothing
        roots = roots[:kept]
        first = nn.Linear(down.shape[1], rank, bias=False).weight.detach()
        second = torch.zeros(len(up), rank)
        first[:kept], second[:, :kept] = roots[:, None] * right[:kept], left[:, :kept] * roots
        begun |= {own: first, own.replace(".0.weight", ".1.weight"): second}
    return begun


def _joints(features: Tensor) -> Tensor:
    """Joints [T,K,3] in the heading frame of features [T,R,6], metres."""
    rotations = rotation_6d_to_matrix(features[:, :NUM_JOINTS])
    return heading_joints(rotations, features[:, ROOT_ROW, HEIGHT])


def _speed(motions: Sequence[Tensor]) -> float:
    """Mean speed of the joints [T,K,3] of some motions, metres a frame."""
    return float(torch.cat([each.diff(dim=0).norm(dim=-1) for each in motions]).mean())


def unshared(places: dict[str, int], others: Iterable[Tensor]) -> dict[str, int]:
    """The groups to whose place few captions of each of `others` (nearest places [N]) go."""
    others = list(others)
    return {
        group: place
        for group, place in places.items()
        if all((each == place).float().mean() < SHARED for each in others)
    }


def aside(places: Tensor, rows: Iterable[int]) -> Tensor:
    """Unit places [P,D] where each of `rows` that another row equals has moved by ASIDE."""
    moved = places.clone()
    for row in rows:
        if int((places == places[row]).all(-1).sum()) > 1:
            way = normalize(torch.randn(places.shape[1], generator=generator("aside", row)), dim=0)
            moved[row] = normalize(places[row] + ASIDE * way, dim=0)
    return moved


def network_of(init: str, overrides: Sequence[str] = ()) -> NetworkConfig:
    """The network of a model that a new action can be added to.

    Raises:
        UserError: no such model, or of another kind.
        UsageError: its text tower has no places.
    """
    network = network_of_model(init, overrides)
    clip = network.clip
    if clip.text_model != PAIRS or not clip.text_places:
        raise UsageError(
            f"init {init} has a text tower without places; give it one with"
            " `motion-tools train text clip=... tower=pairs`, or name another model"
        )
    return network


if __name__ == "__main__":
    STAGES["action"].app()()
