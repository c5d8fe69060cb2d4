"""Sentences in, motions out: what a sentence says of order and measure is done, too.

A sentence is read as clauses (sentence.py). One plain clause no longer than the model's training
clips is one sample of the network, claps aside; all else a stream of passages, one a clause, with
what it measures as a constraint: a path of so many metres, a heading that turns by so many degrees,
in full circles, by a right angle. What kinematics do not see is sampled again.
"""

import logging
import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache, cached_property, partial
from itertools import accumulate, chain, pairwise

from ..device import idle_threads
from ..errors import UserError
from ..metrics.measurements import (
    ACTIONS,
    REPETITIONS,
    Check,
    ends_at_rest,
    measure,
    repetitions,
    side_check,
)
from ..model.clip.out_of_domain import TWINS, ScopeResult
from ..model.diffusion import Sampling
from ..model.generation.constraint import Constraint
from ..model.generation.motion_generator import Progress, TextToMotion
from ..model.noise import TRIES, derived_seed, retry_seeds
from ..motion.features import (
    FORWARD,
    LATERAL,
    ROOT_ROW,
    YAW_RATE,
    decode_features,
    hastened,
    without_drift,
)
from ..motion.motion import Motion
from ..motion.postprocess.whole import hands_meet, head_bowed, rest_to_rest, until_landed
from ..tensors import Tensor, torch
from .clause import (
    GOING,
    REPEATED,
    STEPPING,
    UNDEAD,
    Clause,
    Reading,
    without_subject,
)
from .edit import ControlledMotion, beside, chosen_joints, held
from .path import TURN_REST, on_the_spot, time_of_steps
from .sentence import HALT, RISEN, clauses, whole
from .stream import OVERLAP, WINDOW, Miss, Passage, spanned_features
from .timeline import SHORTEST, Part, Timeline, add_parts, in_a_loop
from .ways import Ways, unwound
from .words import STANDS, all_words, bows_head, says_number, side_of, turns_head, unlearned

CLAP, TO_LAND, CLAP_PACE = 2.0, 1.3, 2  # seconds of a clap, and to land; times as fast as made
CLAPS = "claps three times"  # what these are sampled of: where no number is, hands hardly meet
INSISTING = 3.0  # times the model's guidance, of what is sampled again
LEAST, STOP, UNEASY = 1.0, 1.0, 0.5  # seconds: to see an action, to stop; no rest, by a miss
REPEATED_OVERLAP = 10  # frames: a repetition begins as the one before it ended, at rest

log = logging.getLogger(__name__)


class SentenceGenerator:
    """A trained `TextToMotion` that does what sentences say of order, number, angle, length."""

    def __init__(self, generator: TextToMotion) -> None:
        self.generator = generator
        self.card, self.text, self.scope = generator.card, generator.text, generator.scope
        self.encode_prompts = generator.encode_prompts
        self._read = dict[str, list[Clause]]()
        self._whole, self._lines = dict[str, str](), dict[str, list[str | None]]()
        self._told, self._strange = set[str](), partial(unlearned, scope=self.scope)
        self._reading, self._scope_result = cache(self._asked_for), cache(self._scope_of)

    @cached_property
    def ways(self) -> Ways:
        """Those that clauses lead."""
        return Ways(self.generator, self._nearest)

    def clauses(self, prompt: str) -> list[Clause]:
        """What a prompt asks for, in order."""
        if prompt not in self._read:
            found = clauses(prompt, self._reading, self._strange)
            self._read[prompt] = [replace(each, text=self._ahead(each.text)) for each in found]
        return self._read[prompt]

    def _ahead(self, text: str) -> str:
        """A text without who does it, where he alone makes a walk or a run go backwards."""
        if self._nearest(text) not in GOING or all_words().subject.match(text):
            return text
        rest = without_subject(text, self._reading)
        return self.ways.ahead(text, rest) if rest != text else text

    def whole(self, prompt: str) -> str:
        """A prompt as one sample hears it."""
        if prompt not in self._whole:
            self._whole[prompt] = whole(prompt, self.clauses(prompt))
        return self._whole[prompt]

    def generate(
        self,
        prompts: Sequence[str],
        *,
        seconds: float | Sequence[float] = 4.0,
        tags: Sequence[str | None] | None = None,
        num_samples: int = 1,
        seed: int = 0,
        steps: int | None = None,
        sampler: str | None = None,
        guidance_scale: float | None = None,
        foot_lock: bool | None = None,
        progress: Progress | None = None,
    ) -> list[Motion]:
        """Motions for the prompts, prompt-major; as `TextToMotion.generate` but for the length.

        Args:
            seconds: of each clause that names none, any; of several, three of what is done once.

        Raises:
            UserError: as `TextToMotion.generate`.
        """
        asked, prompts = prompts, [self.whole(prompt) for prompt in prompts]
        sampling = partial(Sampling, steps=steps, sampler=sampler, guidance_scale=guidance_scale)
        lengths = list(seconds) if isinstance(seconds, Sequence) else [seconds] * len(prompts)
        labels = list(tags) if tags is not None else [None] * len(prompts)
        fit = [self._is_whole(*each) for each in zip(prompts, lengths, strict=True)]
        for prompt in (one for one in dict.fromkeys(asked) if one not in self._told):
            for warning in filter(None, self._warnings(prompt, again=False)):
                log.warning("%s", warning)
        plain = [index for index, one in enumerate(fit) if one]
        made: dict[int, list[Motion]] = {}

        def told(done: int) -> None:
            if progress is not None:
                progress(done, len(prompts) * num_samples)

        def sampled(rows: list[int], seed: int, scale: float | None) -> dict[int, list[Motion]]:
            found = self.generator.generate(
                [prompts[index] for index in rows],
                seconds=[lengths[index] for index in rows],
                tags=[labels[index] for index in rows],
                num_samples=num_samples,
                seed=seed,
                steps=steps,
                sampler=sampler,
                guidance_scale=scale,
                foot_lock=foot_lock,
                steady=[self._steady(prompts[index]) for index in rows],
                progress=lambda done, total: told(max(done, sum(map(len, made.values())))),
            )
            one = iter(found)
            return {i: [self._bowed(self._rested(next(one), prompts[i]), prompts[i])
                        for _ in range(num_samples)] for i in rows}  # fmt: skip

        scale, seeds = guidance_scale, retry_seeds(seed)
        while plain and (again := next(seeds, None)) is not None:
            for index, others in sampled(plain, again, scale).items():
                does, old = partial(self._does, prompts[index]), made.get(index)
                made[index] = others if old is None else [
                    was if does(was) or not does(new) else new
                    for was, new in zip(old, others, strict=True)]  # fmt: skip
            plain = [i for i in plain if not all(self._does(prompts[i], m) for m in made[i])]
            if plain and guidance_scale is None and not self.generator.learned_step(steps):
                scale = INSISTING * self.generator.network.generation.guidance_scale
        for index in (index for index, one in enumerate(fit) if not one):
            made[index] = []
            for sample in range(num_samples):
                own = sampling(seed=derived_seed(seed, 1000 * sample))
                motion = self._one(prompts[index], lengths[index], labels[index], own, foot_lock)
                made[index].append(motion)
                told(sum(map(len, made.values())))
        for index in plain:  # what no sample helped, unless it is warned of already
            lines = [self.missed(asked[index], motion) for motion in made[index]]
            found = self._scope_result(prompts[index])
            if all(lines) and found and found.known and not any(self._warnings(asked[index])):
                log.warning("%s", lines[0])
        return [replace(m, text=text) for index, text in enumerate(asked) for m in made[index]]

    def scope_warnings(self, prompts: Sequence[str]) -> list[str | None]:
        """For each prompt, what is to be said of those of its clauses that are hardly known."""
        lines = (dict.fromkeys(filter(None, self._warnings(prompt))) for prompt in prompts)
        return ["; ".join(each) or None for each in lines]

    def missed(self, prompt: str, motion: Motion) -> str | None:
        """A line if a motion does not show its one plain clause, where kinematics see that."""
        (first, *others), scope = self.clauses(prompt), self.scope
        action = self._nearest(first.text)
        missed = scope and action in scope.checked and not self._does(first.text, motion)
        if others or not missed or not first.plain or self._turns(first):
            return None
        return (
            f"prompt {prompt!r}, read as {action!r}: none of {TRIES} samples shows that, by how"
            " joints move; look at the motion, and try another seed or other words"
        )

    def unless_shown(self, prompt: str, motion: Motion) -> str | None:
        """A line if what was made of a clip does not show the action of its prompt."""
        first, *others = self.clauses(prompt)
        if others or self._does(first.text, motion):
            return None
        return (
            f"prompt {prompt!r}: what was made anew does not show {self._nearest(first.text)!r}, by"
            " how joints move; look at it, try a longer span, another seed, or a clip that stands"
        )

    def unseen(self, prompt: str) -> Miss | None:
        """1 for frames that do not show what a prompt asks for, else 0; None: nobody can say."""
        first, *others = self.clauses(prompt)
        return None if others else self._miss(Clause(first.text), math.inf)

    def _warnings(self, prompt: str, *, again: bool = True) -> list[str | None]:
        if again and prompt in self._lines:
            return self._lines[prompt]
        self._told.add(prompt)
        parts, lines = self.clauses(prompt), list[str | None]()
        texts = [text for part in parts for text in (part.text, part.meanwhile) if text]
        same, said = True, self.whole(prompt)
        if not (apart := len(texts) > 1):  # known without its measures, or as the same with them
            lines = self._doubts([said], again=again)
            asked, made = self._nearest(said), self._nearest(texts[0])
            same = parts[0].degrees is not None or {asked, made} in [{made}, *TWINS]
            same |= asked == UNDEAD  # who does it, and no other thing
            apart = (lines != [None] or not same) and not parts[0].plain
        if apart:
            lines = self._doubts(texts, again=again)
        surer = self._reading(said).certainty >= self._reading(texts[0]).certainty
        if not same and surer and lines == [None] and parts[0].count > 1:
            lines = [f"prompt {said!r} is {asked!r} by its number alone, and {made!r} without it;"
                     " say it in other words"]  # fmt: skip
        angled = {part.text for part in parts if part.degrees is not None}  # which says it
        for at, text in enumerate(texts):
            sure = text in angled and self._reading(text).surely in ("turn", "spin")
            lines[at] = self._strange(text) or (None if sure else lines[at])
        unheard = filter(None, (part.unheard for part in parts))
        lines += [self._strange(text) or f"nothing is made of {text!r}" for text in unheard]
        return self._lines.setdefault(prompt, lines) if again else lines

    def _doubts(self, texts: Sequence[str], *, again: bool) -> list[str | None]:
        """A line for each text that is hardly known, as it stands and said of a person."""

        def known(text: str) -> bool:
            what, rest = self._reading(text).surely, without_subject(unwound(text), self._reading)
            said = [self._reading(other) for other in (rest, f"a person {rest}") if what]
            return any(each.known and each.surely == what for each in said)

        lines = self.generator.scope_warnings(texts, again=again)
        return [None if line is None or known(text) else line
                for text, line in zip(texts, lines, strict=True)]  # fmt: skip

    def _by_arms(self, text: str) -> bool:
        """Whether a text asks for what arms do while the feet stand: its motion faces one way."""
        return self.scope is not None and self._nearest(text) in self.scope.arms

    def _steady(self, text: str, *, alone: bool = True) -> tuple[int, ...]:
        """The columns of the root row that have no mean in a text's motion: who does not leave his
        place faces one way, and ends where he began, unless something comes before."""
        if self.scope is None or self._nearest(text) not in self.scope.still:
            undead = self._nearest(text) == UNDEAD and side_of(text) == "both"  # all of them curl
            return (YAW_RATE,) if undead or self._by_arms(text) else ()
        return (FORWARD, LATERAL, YAW_RATE) if alone else (YAW_RATE,)

    def _rested(self, motion: Motion, *texts: str, held: bool = False) -> Motion:
        """The motion from hanging arms to hanging arms, if one of the texts asks for a gesture, its
        end as it is where that is `held`; with hands that meet, if the only one asks for claps."""
        actions = [self._nearest(text) for text in texts]
        if self.scope is not None and {*actions} & {*self.scope.gestures}:
            motion = rest_to_rest(motion, held=held)
        return hands_meet(motion, 0, motion.num_frames) if actions == ["clap"] else motion

    @staticmethod
    def _bowed(motion: Motion, text: str, start: int = 0, stop: int | None = None) -> Motion:
        """The motion with its head down in some frames, if a text says so of them."""
        if not bows_head(text):
            return motion
        return head_bowed(motion, start, motion.num_frames if stop is None else stop)

    def _wanted(self, text: str) -> Check | None:
        """Whether a motion shows a text's nearest action, on its side; None: it cannot be seen."""
        action, scope, side = self._nearest(text), self.scope, side_of(text)
        if scope is None or action is None:
            return None
        seen = [ACTIONS[action]] if action in scope.checked else []
        if side != "both" and (check := side_check(action, side, by_hand=action in scope.arms)):
            seen.append(check)
        return (lambda m: all(check(m) for check in seen)) if seen else None

    def _does(self, prompt: str, motion: Motion) -> bool:
        """Whether a motion shows the action of its prompt; True where nobody can say."""
        wanted = self._wanted(prompt)
        return wanted is None or motion.seconds < LEAST or wanted(measure(motion))

    def _miss(self, clause: Clause, frames: float) -> Miss | None:
        """How far a passage of so many frames is from showing its clause and ending at rest."""
        wanted, fps, scope = self._wanted(clause.text), self.card.fps, self.scope
        action, side, latest = self._nearest(clause.text), side_of(clause.text), self._window()
        # Edits are shown as they are made; what is shown fast or slowly is looked at as it is made.
        pace = self._pace(replace(clause, tempo=1.0)) if frames < math.inf else 1
        rests = scope is not None and action in scope.gestures
        if action is None or frames < LEAST * fps or not (rests or wanted):
            return None

        def miss(features: Tensor) -> float:
            motion = decode_features(features, fps=fps)
            if pace > 1:  # as hands meet that are smoothed
                motion = self.generator.post_processor(hastened(features, pace), None)
                motion = hands_meet(motion, 0, motion.num_frames)
            seen = measure(motion)
            found = float(wanted is not None and not wanted(seen))
            if found and wanted and len(features) > latest:
                # one bad window is none of those that follow; cleaned up: who drifts seems to fly
                window = self.generator.post_processor(features[-latest:], None)
                found = float(not wanted(measure(window)))
            several = clause.count > 1 or (frames <= REPEATED[1] * fps and self._is_single(clause))
            if several and (count := repetitions(action, seen, side)) is not None:
                found = abs(count - round(clause.count * len(features) / frames))
            return found + UNEASY * (rests and len(features) >= frames and not ends_at_rest(motion))

        return miss

    def _asked_for(self, text: str) -> Reading:
        """What a text alone asks for, even where it seldom comes out."""
        found, scope = self._scope_result(text), self.scope
        if found is None or scope is None or not found.nearest:
            return Reading()
        action = found.nearest[0]
        one = next((min(twins) for twins in TWINS if action in twins), action)
        arms, hand = action in scope.arms, scope.handed.get(action, "")
        return Reading(one, found.certainty, arms, found.known, hand)

    def _nearest(self, text: str) -> str | None:
        """The action that is nearest to a text, whether or not it is what the text tells of."""
        return found.nearest[0] if (found := self._scope_result(text)) and found.nearest else None

    def _scope_of(self, text: str) -> ScopeResult | None:
        return self.generator.read([text])[0]

    def _is_whole(self, prompt: str, seconds: float) -> bool:
        """Whether one sample of the network is all there is to it, or the prompt is faulty."""
        fit = isinstance(seconds, int | float) and math.isfinite(seconds) and seconds > 0
        if not fit or not prompt.strip():
            return True  # refused there, with a clear line
        first, *others = self.clauses(prompt)
        one = self.generator.length_warning(seconds) is None and not others and first.plain
        return one and not (self._applauds(first) or self._turns(first) or self._cycle(first))

    def _is_single(self, clause: Clause) -> bool:
        """Whether a clause asks for something that is seen once, and for no more of it."""
        seen = self._nearest(clause.text) in REPETITIONS.keys() - {"clap"}
        return seen and not clause.held and all_words().many.search(clause.text) is None

    def _applauds(self, clause: Clause) -> bool:
        """Whether a clause asks for claps and does not say how many."""
        if self._nearest(clause.text) != "clap" or clause.count > 1 or clause.metres is not None:
            return False
        return self._reading(CLAPS).surely == "clap" and not says_number(clause.text)

    def _cycle(self, clause: Clause) -> tuple[float, float] | None:
        """Seconds of rest and from one to the next, of what is done in cycles, if a clause says how
        often; else None."""
        said = clause.count > 1 or clause.once
        action = self._nearest(clause.text) or ""
        return self.scope.cycles.get(action) if said and self.scope is not None else None

    def _pace(self, clause: Clause) -> float:
        """How many times as fast a clause is shown as the network makes it."""
        claps = self._nearest(clause.text) == "clap" and clause.metres is clause.degrees is None
        hastens = claps and (clause.count > 1 or self._applauds(clause))
        return clause.tempo * (CLAP_PACE if hastens else 1)

    def _turns(self, clause: Clause) -> bool:
        """Whether the heading of a clause is led: it names an angle, spins, or bends its way."""
        if clause.degrees is not None or self._nearest(clause.text) == "spin":
            return True
        if self._nearest(clause.text) == "turn" and side_of(clause.text) != "both":
            return not turns_head(clause.text)
        goes = clause.metres is None and clause.count == 1 and self._nearest(clause.text) in GOING
        return goes and self.ways.bends(clause.text) != ()

    def _one(
        self, text: str, seconds: float, tag: str | None, sampling: Sampling, lock: bool | None
    ) -> Motion:
        parts, rest = self.clauses(text), (text, seconds, tag, sampling, lock)
        motion, missed = self._made(parts, *rest)
        left = [parts[at].text for at in missed]
        for stop in (RISEN, HALT):  # who stops before it begins as who is at rest does
            stands = [at for at in missed if self._nearest(parts[at - 1].text) != "stand"]
            if not stands:
                break
            halt = Clause(STANDS, seconds=stop)
            slow = [*chain(*([halt, part] if at in stands else [part]
                             for at, part in enumerate(parts)))]  # fmt: skip
            again, still = self._made(slow, *rest)
            if len(still) < len(missed):
                motion, left = again, [slow[at].text for at in still]
                break
        for said in left:
            line = "%r: %r does not show behind what comes before it; try another seed, other words"
            log.warning(line, text, said)
        return motion

    def _made(
        self,
        parts: Sequence[Clause],
        text: str,
        seconds: float,
        tag: str | None,
        sampling: Sampling,
        lock: bool | None,
    ) -> tuple[Motion, list[int]]:
        """The motion of clauses, and which gestures behind others do not show in it."""
        once = min(seconds, REPEATED[1]) if len(parts) > 1 else seconds  # each is done once
        times = [once if self._is_single(part) else seconds for part in parts]
        stretches = [self._stretch(p, s, tag, sampling) for p, s in zip(parts, times, strict=True)]
        (passage, given), action = stretches[-1], self._nearest(parts[-1].text)
        free = given is None and parts[-1].seconds is None and action in STEPPING
        steps = round(free * (parts[-1].steps or 0)) * (1 + (action == "side-step"))  # both feet
        if steps:
            more = round(TO_LAND * self.card.fps + 0.15 * passage.frames)
            stretches[-1] = replace(passage, frames=passage.frames + more), None
        motion, spans = self._motion(parts, stretches, text, sampling, lock)
        gestures = {*(self.scope.gestures if self.scope else ())} - {"stand"}
        missed = [
            at for at, (part, (_, known)) in enumerate(zip(parts, stretches, strict=True))
            if at and known is None and not (part.meanwhile or part.seat)
            and self._nearest(part.text) in gestures
            and not self._does(part.text, motion.frames(*spans[at]))
        ]  # fmt: skip
        return until_landed(motion, steps, stretches[-1][0].frames, passage.frames), missed

    def timeline(
        self, timeline: Timeline, sampling: Sampling, *, foot_lock: bool | None = None
    ) -> Motion:
        """One motion of several texts, each read as a sentence is. Where the timeline has times,
        they hold: the clauses of a text share them, and what one names of its length gives way.

        Raises:
            UserError: a text asks for more than its time can hold, or as `stream_features`.
        """
        parts, fps = list[Clause](), self.card.fps
        stretches = list[tuple[Passage, Constraint | None]]()
        for text, frames, tag in ((each.text, each.frames, each.tag) for each in timeline.passages):
            own = self.clauses(text)
            if timeline.timed and len(own) > 1 and frames < len(own) * SHORTEST * fps:
                raise UserError(
                    f"{text!r} asks for {len(own)} things in {frames / fps:g} s; give it"
                    f" {len(own) * SHORTEST:g} s or more"
                )
            stops = [round(frames * number / len(own)) for number in range(len(own) + 1)]
            for part, (start, stop) in zip(own, pairwise(stops), strict=True):
                exactly = stop - start if timeline.timed else None
                stretches.append(self._stretch(part, frames / fps, tag, sampling, exactly))
            parts += own
        rest = timeline.text, sampling, foot_lock, timeline.parts
        return self._motion(parts, stretches, *rest)[0]

    def loop(
        self, timeline: Timeline, sampling: Sampling, *, foot_lock: bool | None = None
    ) -> ControlledMotion:
        """See `in_a_loop`; where it is one text whose action is not seen, it is sampled again."""
        found: list[ControlledMotion] = []
        for seed in retry_seeds(sampling.seed):
            own = replace(sampling, seed=seed)
            found.append(in_a_loop(self.generator, timeline, own, foot_lock=foot_lock))
            several = len(timeline.passages) > 1
            line = None if several else self.missed(timeline.text, found[-1].motion)
            if line is None:
                return found[-1]
        log.warning("%s", line)
        return replace(found[0], warning=line)

    @idle_threads()
    def _motion(
        self,
        parts: Sequence[Clause],
        stretches: Sequence[tuple[Passage, Constraint | None]],
        text: str,
        sampling: Sampling,
        foot_lock: bool | None,
        limbs: Sequence[Part] = (),
    ) -> tuple[Motion, list[tuple[int, int]]]:
        """What clauses became, one after the other, and what single limbs do meanwhile; and which
        frames are those of each."""
        starts = [0, *accumulate(passage.frames for passage, _ in stretches)]
        given, fps, led = Constraint.free(starts[-1]), self.card.fps, False
        for part, start, (passage, constraint) in zip(parts, starts, stretches, strict=False):
            stop, stands = start + passage.frames, start > 0 and constraint is None
            if stands := stands and self._nearest(part.text) == "stand":
                constraint = on_the_spot(Constraint.free(passage.frames))
            if constraint is not None:
                given.values[start:stop], led = constraint.values, True
                given.known[start:stop] = constraint.known
            first = STOP if stands else TURN_REST * (start > 0 and part.metres == 0)
            until = start + round(first * fps)  # who went comes to a stop first
            given.known[start:until, ROOT_ROW, [FORWARD, LATERAL]] = False
        if parts[0].held:  # nothing comes before
            given.known[: starts[1]] = True
        low = [self._nearest(part.seat or part.text) == "sit" for part in parts]
        passages = [  # who sits gets up by a way of his own, too
            replace(each.under(part.seat), low=sits or was)
            for (each, _), part, sits, was in zip(
                stretches, parts, low, [False, *low], strict=False
            )
        ]
        features, spans = spanned_features(
            self.generator,
            passages,
            constraint=(lambda start, stop: given.window(start, stop, fps=fps)) if led else None,
            window=self._window(),
            overlap=REPEATED_OVERLAP if any(part.count > 1 for part in parts) else OVERLAP,
            sampling=sampling,
        )
        for (start, stop), part, (own, _) in zip(spans, parts, stretches, strict=True):
            if part.meanwhile or part.seat:
                joints = chosen_joints(["arms" if part.side == "both" else f"{part.side}-arm"])
                arms = own if part.seat else Passage(part.meanwhile, 1, mirrored=part.mirrored)
                rest = features, start, joints, sampling, part.seat
                features = beside(self.generator, replace(arms, frames=stop - start), *rest)
        shown, end = list[Tensor](), 0
        for (start, stop), part, (passage, way) in zip(spans, parts, stretches, strict=True):
            does, free = features[start:stop], part.degrees is None and part.metres is None
            steady = self._steady(part.text, alone=len(parts) == 1) if free else ()
            does = without_drift(does, steady)
            does = does if way is not None else self.ways.straight(part.text, does)
            does = hastened(does, self._pace(part), passage.timed)
            shown, end = [*shown, hastened(features[end:start], part.tempo), does], stop
        ends = [*accumulate(map(len, shown))]
        features, spans = torch.cat(shown), [*zip(ends[::2], ends[1::2], strict=True)]
        features = add_parts(self.generator, features, limbs, sampling)
        motion = self.generator.post_processor(features, None, foot_lock=foot_lock)
        motion = self._rested(motion, parts[0].text, parts[-1].text, held=parts[-1].held)
        for (start, stop), part in zip(spans, parts, strict=True):
            action = self._nearest(part.meanwhile or part.text)
            if action == "clap" and not limbs:
                motion = hands_meet(motion, start, stop)
            elif part.count > 1 and self._by_arms(part.text) and action not in REPETITIONS:
                # nothing but arms that hang in between tells one wave from the next
                joins = [start + (stop - start) * k // part.count for k in range(1, part.count)]
                motion = rest_to_rest(motion, joins)
            motion = self._bowed(motion, part.text, start, stop)
        return replace(motion, text=text), spans

    def _window(self) -> int:
        """Frames of a window: no more than the model has seen, where two overlaps fit in that."""
        longest = self.card.max_seconds or WINDOW / self.card.fps
        return min(WINDOW, max(2 * OVERLAP, round(longest * self.card.fps)))

    def _stretch(
        self,
        clause: Clause,
        seconds: float,
        tag: str | None,
        sampling: Sampling,
        exactly: int | None = None,
    ) -> tuple[Passage, Constraint | None]:
        """What one clause becomes, and what is known of its frames; they are `exactly` so many."""
        fps = self.card.fps
        if exactly is not None:
            clause = replace(clause, seconds=exactly / fps)
        steps = self._nearest(clause.text) in STEPPING and clause.seconds is None and clause.steps
        if steps:
            gait = self.ways.gait(clause.text, sampling, tag)
            clause = replace(clause, seconds=time_of_steps(steps, gait.speed))
        given, pace, action = None, self._pace(clause), self._nearest(clause.text)
        if clause.seconds is not None:
            seconds, clause = clause.seconds, replace(clause, seconds=clause.seconds * pace)
        elif action not in GOING:
            seconds = clause.lasting(seconds)
        frames, seconds = max(1, round(max(1, round(seconds * fps)) * pace)), seconds * pace
        mirrored, low = clause.mirrored and not clause.meanwhile, action == "sit"
        passage = Passage(clause.text, frames, tag, timed=exactly, low=low, mirrored=mirrored)
        exactly = exactly and frames
        if self._applauds(clause):
            passage, exactly = replace(passage, text=CLAPS), passage.frames
            clause = replace(clause, count=max(1, round(seconds / CLAP)))
        if self._turns(clause):
            given = self.ways.turn(clause, seconds, sampling)
        elif clause.metres is not None:
            given = self.ways.led(passage, clause, sampling, timed=exactly is not None)
        elif clause.count > 1 or (self._cycle(clause) and not exactly):
            cycle = None if exactly else self._cycle(clause)
            frames, once = clause.repeated(seconds, fps, cycle)
            if exactly is not None:
                frames, once = exactly, math.ceil(exactly / clause.count)
                if once < LEAST * fps:
                    said = clause.text, clause.count, exactly / fps, LEAST * clause.count
                    log.warning("%r: %d times in %.1f s is not seen; give it %g s or more", *said)
            passage = replace(passage, frames=frames, window=once + REPEATED_OVERLAP)
        elif clause.held:
            given = held(self.generator, passage, partial(self._miss, clause), sampling)
        if given is not None:
            return replace(passage, frames=len(given)), given
        return replace(passage, miss=self._miss(clause, passage.frames)), None
