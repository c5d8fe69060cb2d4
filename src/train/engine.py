"""The one training loop: accelerate on CPU, MPS, one GPU or several, for every stage.

Design: a `Task` says what is learned from which batch; the `Trainer` does the rest. Everything
random is a function of (seed, step, part), so that `--resume` continues bit-exactly on the CPU
from tensors and a step number alone. A step consumes one global batch, cut into
`processes × gradient-accumulation` parts: two processes equal one with twice the batch.
"""

import copy
import json
import math
import os
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, Generic, TypeVar

import torch
from accelerate import Accelerator, DistributedDataParallelKwargs
from accelerate.state import AcceleratorState
from torch import Tensor, nn

from ..shared.config_schema import TrainConfig
from ..shared.device import ComputeChoice, choose_compute, set_threads
from ..shared.errors import UsageError, UserError
from ..shared.io.concurrency import prefetch
from ..shared.io.files import write_json
from .checkpoint import (
    Checkpoint,
    asks_for_shards,
    latest_checkpoint,
    load_optimizer,
    local,
    optimizer_tensors,
    placed_as,
    refuse_to_overwrite,
    require_same_run,
    run_identity,
    save_checkpoint,
    shard,
    whole,
)
from .graphs import GraphedPasses
from .processes import Interrupted, InterruptGuard, answering
from .run_log import VALIDATION, RunLog, announce
from .task import Part, Task, mix_seed, to_device


def learning_rate_factor(step: int, *, steps: int, warmup: int, schedule: str) -> float:
    """Factor on the base learning rate at a step that counts from 0; resuming needs no state.

    Linear warm-up from 1/warmup to 1, then cosine or linear decay that reaches 0 just after the
    last step, or a constant 1.
    """
    if step < warmup:
        return (step + 1) / warmup
    progress = min(1.0, (step - warmup) / max(1, steps - warmup))
    if schedule == "cosine":
        return 0.5 * (1 + math.cos(math.pi * progress))
    return 1.0 - progress if schedule == "linear" else 1.0


class ExponentialMovingAverage:
    """A frozen copy of a module that trails it: e ← d·e + (1 − d)·w.

    The decay d warms up as min(decay, (1 + n) / (10 + n)) over the number n of updates, so that
    a short training is not averaged with its random start. Buffers are copied.

    Args:
        module: that it trails; may be in shards, and then the average is.
        decay: d.
        start: a copy of the module before it was sharded, which becomes the average.
    """

    def __init__(self, module: nn.Module, decay: float, start: nn.Module | None = None) -> None:
        self.decay = decay
        self.module = (start or copy.deepcopy(module)).eval().requires_grad_(False)
        self._trained = [name for name, weight in module.named_parameters() if weight.requires_grad]
        self._current: list[Tensor] = [module.get_parameter(name) for name in self._trained]
        self._buffers = list(zip(self.module.buffers(), module.buffers(), strict=True))
        self.scatter()

    def scatter(self) -> None:
        """Take up what the frozen copy holds."""
        wholes = [self.module.get_parameter(name) for name in self._trained]
        pairs = zip(wholes, self._current, strict=True)
        self._average = [placed_as(average, current) for average, current in pairs]

    @torch.no_grad()
    def gather(self) -> None:
        """Bring the frozen copy up to date where the average is in shards; every process must."""
        for name, average in zip(self._trained, self._average, strict=True):
            if (kept := self.module.get_parameter(name)) is not average:
                kept.copy_(whole(average).reshape(kept.shape))

    @torch.no_grad()
    def update(self, updates: int) -> None:
        """Move towards the module's present weights; `updates` counts the calls before this."""
        decay = min(self.decay, (1 + updates) / (10 + updates))
        average, current = map(local, self._average), map(local, self._current)
        torch._foreach_lerp_(list(average), list(current), 1 - decay)
        for old, new in self._buffers:
            old.copy_(new)


def make_accelerator(config: TrainConfig, compute: ComputeChoice) -> Accelerator:
    """An Accelerator on the chosen device; raises UsageError on a wrong number of processes."""
    alone = int(os.environ.get("WORLD_SIZE", "1")) == 1
    # accelerate keeps one state a process, yet a second stage may want another precision;
    # what connects several processes must stay
    AcceleratorState._reset_state(reset_partial_state=alone)
    accelerator = Accelerator(
        cpu=compute.device == "cpu",
        mixed_precision=compute.precision,
        gradient_accumulation_steps=config.gradient_accumulation,
        kwargs_handlers=[DistributedDataParallelKwargs(find_unused_parameters=True)],
    )
    expected = config.processes or int(os.environ.get("WORLD_SIZE", "1"))
    if accelerator.num_processes != expected:
        raise UsageError(
            f"{accelerator.num_processes} process(es) are running, {expected} were asked for;"
            f" let `motion-tools train STAGE --num-processes {expected}` start them, or leave"
            " `processes` out"
        )
    return accelerator


def make_optimizer(
    module: nn.Module,
    config: TrainConfig,
    device: str,
    rates: Mapping[str, float] | None = None,
) -> torch.optim.AdamW:
    """AdamW that leaves biases, norms and other vectors undecayed.

    Args:
        module: what is trained.
        config: of the stage.
        device: its type.
        rates: learning rates of parts of the module, by the beginning of their weights' names;
            the rest learns at the configuration's.
    """
    weights: dict[tuple[float, bool], list[nn.Parameter]] = {}
    for name, weight in module.named_parameters():
        if weight.requires_grad:
            matching = [rate for start, rate in (rates or {}).items() if name.startswith(start)]
            key = ([*matching, config.learning_rate][0], weight.ndim >= 2)
            weights.setdefault(key, []).append(weight)
    groups = [
        {
            "params": members,
            "lr": rate,
            "initial_lr": rate,  # before warm-up and decay
            "weight_decay": config.weight_decay if decays else 0.0,
        }
        for (rate, decays), members in sorted(weights.items(), key=lambda item: item[0])[::-1]
    ]
    return torch.optim.AdamW(
        groups,
        betas=config.adam_betas,
        fused=device != "mps",
        foreach=True if device == "mps" else None,
    )


_STOP_CHECK_EVERY = 10  # steps between agreeing on a stop, with several processes


ConfigT = TypeVar("ConfigT", bound=TrainConfig)


class Trainer(Generic[ConfigT]):
    """Runs one task to its end, or from where it was stopped.

    Args:
        config: the stage's settings.
        build: makes the task; called on the main process first, so that it may fill a cache.
        command: the command line that continues this run, printed on Ctrl-C.
        resume: continue the run in the output folder.

    Raises:
        UsageError: a device, precision or number of processes that does not exist here; the
            output folder holds a run, and `resume` is off or its settings are others.
        UserError: all its checkpoints are damaged.
    """

    def __init__(
        self,
        config: ConfigT,
        build: Callable[[ConfigT], Task],
        *,
        command: str,
        resume: bool = False,
    ) -> None:
        self.config = config
        self.command = command
        self.resume = resume
        self.output = Path(config.output)
        refuse_to_overwrite(self.output, resume=resume)
        compute = choose_compute(config.device, config.precision)
        threads = set_threads(config.threads)
        sharded = asks_for_shards(config.fsdp_version)
        self.accelerator = make_accelerator(config, compute)
        processes = self.accelerator.num_processes
        announce(f"computing on {compute}; {threads} CPU threads; {processes} process(es)")
        announce(f"writing to {self.output}")
        self._last = latest_checkpoint(self.output / "checkpoints")
        self._settings = run_identity(config, {}, processes)
        if self._last is not None and (before := self._last.state.get("settings")):
            # told before what the task prepares; of what the task calls so too it tells itself
            require_same_run(self._last, self._settings, before)
        with self.accelerator.main_process_first():
            torch.manual_seed(mix_seed("weights", config.seed))
            self.task = build(config)
        self.task.figures = {}
        self.module = self.task.module.to(self.accelerator.device)
        self.task.to(self.accelerator.device)
        start = copy.deepcopy(self.module)
        if sharded and processes > 1:
            announce(f"FSDP2: weights, gradients and optimizer in {processes} shards")
            shard(self.module, self.accelerator.device)
        self.ema = ExponentialMovingAverage(self.module, config.ema_decay, start)
        rates = self.task.learning_rates
        optimizer = make_optimizer(self.module, config, self.accelerator.device.type, rates)
        # shards need no DDP around them; both get the precision
        self.wrapped = self.accelerator.prepare_model(
            self.module, evaluation_mode=sharded and processes > 1
        )
        self.optimizer = self.accelerator.prepare_optimizer(optimizer)
        self.graphed = self._graphs()
        self._sums: dict[str, Tensor] = {}

    # ------------------------------------------------------------ the loop

    def train(self) -> None:
        """Train to the last step and write the pretrained folder.

        Raises:
            UsageError: the run in the output folder had other settings.
            UserError: the loss is not finite.
            Interrupted: stopped by a signal, after saving.
        """
        config = self.config
        start = self._restore()
        if start is None:
            return
        main, guard = self.accelerator.is_main_process, InterruptGuard()
        with (
            answering(guard),
            RunLog(
                self.output,
                start=start,
                steps=config.steps,
                main=main,
                tensorboard=config.tensorboard,
                validate=self._is_validated(start),
            ) as log,
        ):
            # that of `start` again: a kill may have come between its checkpoint and its samples
            step, enough = start, self._look(start, log)
            batches = prefetch(self.task.batch, self._parts(start), config.num_workers)
            since, since_step = time.perf_counter(), start
            while step < config.steps and not enough:
                step += 1
                self._optimize(step, batches)
                log.advance(step)
                last = step == config.steps
                if step % config.log_every == 0 or last:
                    seconds = time.perf_counter() - since
                    log.write(step, self._averages(step, (step - since_step) / seconds))
                    since, since_step = time.perf_counter(), step
                stop = self._stop_requested(guard, step)
                finished = time.perf_counter()
                if step % config.save_every == 0 or last or stop:
                    self._save(step)
                if stop:
                    told = f"stopped and saved at step {step}; continue with: {self.command}"
                    raise Interrupted(told, guard.signal_number or 2)
                enough = self._look(step, log)
                since += time.perf_counter() - finished  # speed is that of the steps alone
            self._finish(step)

    def _parts(self, start: int) -> Iterator[Part]:
        """The parts this process works on, from the step after `start` on."""
        world, rank = self.accelerator.num_processes, self.accelerator.process_index
        count = world * self.config.gradient_accumulation
        for step in range(start + 1, self.config.steps + 1):
            for index in range(rank, count, world):
                yield Part(step, index, count)

    def _optimize(self, step: int, batches: Iterator[Any]) -> None:
        """One optimizer step."""
        config, accelerator = self.config, self.accelerator
        factor = learning_rate_factor(
            step - 1, steps=config.steps, warmup=config.warmup_steps, schedule=config.lr_schedule
        )
        for group in self.optimizer.param_groups:
            group["lr"] = group["initial_lr"] * factor
        for number in range(config.gradient_accumulation):
            # dropout draws from torch's own generator: start it anew for each part of a step
            part = accelerator.process_index + number * accelerator.num_processes
            torch.manual_seed(mix_seed("step", config.seed, step, part))
            batch = to_device(next(batches), accelerator.device)
            with accelerator.accumulate(self.wrapped):
                metrics = self._passes(batch)
                if accelerator.sync_gradients:
                    weights = self.module.parameters()
                    norm = accelerator.clip_grad_norm_(weights, config.gradient_clip)
                self.optimizer.step()
                self.optimizer.zero_grad()
            self._add(metrics)
        self._add({"grad-norm": whole(norm)})
        self.ema.update(step - 1)

    def _graphs(self) -> GraphedPasses | None:
        """On one GPU, for tasks whose steps can be captured, and unless `cuda-graphs` is off."""
        config, accelerator = self.config, self.accelerator
        alone = accelerator.num_processes == 1 and config.gradient_accumulation == 1
        captured = self.task.can_be_captured and accelerator.scaler is None
        if not (config.cuda_graphs and captured and alone and accelerator.device.type == "cuda"):
            return None
        return GraphedPasses(
            self.module,
            lambda batch: self.task.training_step(self.wrapped, batch),
            accelerator.backward,
        )

    def _passes(self, batch: Any) -> dict[str, Tensor]:
        """Figures of a batch on the device; its gradients are added to the weights'."""
        if self.graphed is not None:
            return self.graphed(batch.padded())
        metrics = self.task.training_step(self.wrapped, batch)
        self.accelerator.backward(metrics["loss"])
        return metrics

    # ------------------------------------------------------------ figures

    def _add(self, metrics: dict[str, Tensor]) -> None:
        """Sum figures on the device: reading one would make the CPU wait for a GPU."""
        with torch.no_grad():
            for key, value in metrics.items():
                figure = value.detach().float().reshape(())  # [1] where it is a weight in shards
                pair = torch.stack([figure, torch.ones_like(figure)])
                self._sums[key] = self._sums[key] + pair if key in self._sums else pair

    def _totals(self) -> dict[str, list[float]]:
        """Sum and number of each figure since the last log line, over processes."""
        if not self._sums:
            return {}
        keys = list(self._sums)
        sums = self.accelerator.reduce(torch.stack([self._sums[key] for key in keys]), "sum")
        return dict(zip(keys, sums.tolist(), strict=True))

    def _averages(self, step: int, speed: float) -> dict[str, float]:
        """Means since the last call, over processes; a loss that is not finite is a UserError."""
        result = {key: total / count for key, (total, count) in self._totals().items()}
        self._sums.clear()
        self._require_finite(result["loss"], step)
        result["learning-rate"] = self.optimizer.param_groups[0]["lr"]
        result["steps-per-second"] = speed
        return result

    def _require_finite(self, loss: float, step: int) -> None:
        if math.isfinite(loss):
            return
        newest = latest_checkpoint(self.output / "checkpoints")
        kept = f"the last good checkpoint is {newest.folder}" if newest else "nothing was saved yet"
        raise UserError(
            f"the loss is {loss} at or before step {step}; {kept}: lower learning-rate"
            f" {self.config.learning_rate:g}, raise warmup-steps, or use precision=no"
        )

    def _is_validated(self, step: int) -> bool:
        """Whether figures and samples of a step are wanted; 0 is before training."""
        if step == 0:
            return self.config.validate_first
        return step % self.config.validate_every == 0 or step == self.config.steps

    def _look(self, step: int, log: RunLog) -> bool:
        """Validate where that is wanted; whether the task wants no more steps."""
        if not self._is_validated(step):
            return False
        self._validate(step, log)
        converged = self.accelerator.is_main_process and self.task.has_converged()
        if step == self.config.steps or not self._any(converged):
            return False
        announce(f"no better for long: stopping early at step {step}")
        self._save(step)
        return True

    def _validate(self, step: int, log: RunLog) -> None:
        """Figures and samples of the averaged weights, on the main process."""
        self.ema.gather()
        if self.accelerator.is_main_process:
            torch.manual_seed(mix_seed("validation", self.config.seed))
            with torch.no_grad():
                self.task.figures = figures = self.task.validation(self.ema.module)
                log.write(step, {VALIDATION + key: value for key, value in figures.items()})
                self._export(self.output / "samples" / f"{step:08d}")
        self.accelerator.wait_for_everyone()

    def _export(self, folder: Path) -> None:
        """Samples are a by-product: what goes wrong with them is told, and training goes on."""
        try:
            self.task.export_samples(self.ema.module, folder)
        except Exception as error:
            announce(f"warning: no samples in {folder}: {type(error).__name__}: {error}")

    # ------------------------------------------------------------ saving and resuming

    def _identity(self) -> dict[str, Any]:
        return run_identity(self.config, self.task.identity, self.accelerator.num_processes)

    def _save(self, step: int) -> None:
        """Write a checkpoint, unless the loss since the last log line is not finite."""
        sums = self._totals()
        if "loss" in sums:
            self._require_finite(sums["loss"][0], step)
        self.ema.gather()
        model = {name: whole(value) for name, value in self.module.state_dict().items()}
        optimizer = optimizer_tensors(self.optimizer.optimizer)
        if self.accelerator.is_main_process:
            state: dict[str, Any] = {"step": step, "identity": self._identity()}
            state["settings"] = self._settings
            state["sums"] = list(sums.items())  # in their order, which JSON objects here lose
            if self.accelerator.scaler is not None:
                state["scaler"] = self.accelerator.scaler.state_dict()
            tensors = {"model": model, "ema": self.ema.module.state_dict(), "optimizer": optimizer}
            keep = self.config.keep_checkpoints
            save_checkpoint(self.output / "checkpoints", tensors, state=state, keep=keep)
        self.accelerator.wait_for_everyone()

    def _restore(self) -> int | None:
        """The step to continue after, or None when there is nothing left to do."""
        checkpoint = self._last
        if checkpoint is None:
            if self.resume:
                announce(f"nothing to resume in {self.output}: starting at step 0")
            if self.accelerator.is_main_process:
                self.output.mkdir(parents=True, exist_ok=True)
                write_json(self.output / "run.json", self._identity())
            self.accelerator.wait_for_everyone()
            return 0
        require_same_run(checkpoint, self._identity())
        if self._is_finished(checkpoint.step):
            announce(f"{self.output} is finished ({checkpoint.step} steps): nothing to do")
            return None
        if checkpoint.step > self.config.steps:
            raise UsageError(
                f"steps {self.config.steps} is below step {checkpoint.step}, where {self.output}"
                " already is; raise steps"
            )
        self._load(checkpoint)
        announce(f"resuming {self.output} after step {checkpoint.step}")
        return checkpoint.step

    def _is_finished(self, step: int) -> bool:
        """Whether as many steps as are asked for were finished, with `step` as the last one."""
        marker = self.output / "finished.json"
        if not marker.exists():
            return False
        done = json.loads(marker.read_text(encoding="utf-8"))
        return bool(done["steps"] == step and done.get("planned", step) == self.config.steps)

    def _load(self, checkpoint: Checkpoint) -> None:
        own, saved = self.module.state_dict(), checkpoint.tensors("model")
        self.module.load_state_dict({n: placed_as(saved[n], own[n]) for n in saved})
        self.ema.module.load_state_dict(checkpoint.tensors("ema"))
        self.ema.scatter()
        load_optimizer(self.optimizer.optimizer, checkpoint.tensors("optimizer"))
        share = float(self.accelerator.is_main_process)  # it goes on with what all have summed
        self._sums = {
            key: share * torch.tensor(pair, device=self.accelerator.device)
            for key, pair in checkpoint.state.get("sums", [])
        }
        if self.accelerator.scaler is not None and "scaler" in checkpoint.state:
            self.accelerator.scaler.load_state_dict(checkpoint.state["scaler"])

    def _any(self, flag: bool) -> bool:
        """Whether it holds in any process; every process must ask."""
        value = torch.tensor(float(flag), device=self.accelerator.device)
        return bool(self.accelerator.reduce(value, "sum").item())

    def _finish(self, step: int) -> None:
        """Write the pretrained folder and mark the run as finished."""
        self.ema.gather()
        if self.accelerator.is_main_process:
            self.task.save_pretrained(self.ema.module, self.output)
            done = {"steps": step, "planned": self.config.steps}
            write_json(self.output / "finished.json", done)
            announce(f"finished: {self.output} is ready to use")
        self.accelerator.wait_for_everyone()

    # ------------------------------------------------------------ stopping

    def _stop_requested(self, guard: InterruptGuard, step: int) -> bool:
        """Whether any process was told to stop; all must agree, or the others would hang."""
        if self.accelerator.num_processes == 1:
            return guard.signal_number is not None
        return step % _STOP_CHECK_EVERY == 0 and self._any(guard.signal_number is not None)
