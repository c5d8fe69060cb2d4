"""MPMService: the memory behind a deadline (REF's asynchronous API, and a plain one).

A query is answered in time or by "nothing known", and both are counted: a sampler goes on without
memory rather than wait for a slow disk or fail with it.
"""

import asyncio
import logging
import queue
import threading
import weakref
from collections import Counter
from collections.abc import Callable, Sequence, Set
from concurrent.futures import Future, wait
from functools import partial
from typing import Self

import numpy as np
import torch
from torch import Tensor

from ..config_audio import MemoryConfig
from ..errors import UsageError
from .index import MemoryIndex, open_index
from .query import Memory, null_memory, query_bars, retrieve

log = logging.getLogger(__name__)

Array = np.ndarray | Tensor
Excluded = Set[str] | Sequence[Set[str] | None]


class MPMService:
    """Answers queries with the memory, in threads of its own, each within `config.deadline`.

    Attributes:
        counts: queries `answered`, `timed_out` and `failed`; the last two got a null memory.

    Args:
        config: the folder, and how to search.
        index: a memory that is open already.
    """

    def __init__(self, config: MemoryConfig, index: MemoryIndex | None = None) -> None:
        self.config = config
        self.index = index
        self.counts: Counter[str] = Counter(answered=0, timed_out=0, failed=0)
        self._counting = threading.Lock()
        self._workers = _Workers(config.workers)

    @classmethod
    async def from_config(cls, config: MemoryConfig) -> Self:
        """A service that has yet to open its memory, see `initialize`.

        Raises:
            UsageError: the configuration names no folder.
        """
        if not config.folder:
            raise UsageError("memory: folder is empty; name one that `memory build` wrote")
        return cls(config)

    async def initialize(self) -> None:
        """Open the memory and check its files, without holding up the event loop.

        Raises:
            UserError: see `open_index`.
        """
        if self.index is None:
            self.index = await asyncio.to_thread(self._open)

    async def query(
        self,
        audio_embedding: Array,
        beat_phase: Array | float | None,
        num_frames: int,
        *,
        exclude_songs: Excluded | None = None,
    ) -> Memory:
        """What is known for `num_frames` frames that sound like `audio_embedding`.

        Args:
            audio_embedding: [D] or [B,D], unit, of `SharedSpace.embed_audio`.
            beat_phase: bar phase of the first frame, a number or [B], or unwrapped bars of all
                frames [T] or [B,T]; see `retrieve`.
            num_frames: T.
            exclude_songs: songs that may not be found: one set for all, or one a query.

        Raises:
            ValueError: an argument of another shape.
            RuntimeError: `initialize` was not awaited.
        """
        future, batch = self._submit(audio_embedding, beat_phase, num_frames, exclude_songs)
        try:
            async with asyncio.timeout(self.config.deadline) as timer:
                memory = await asyncio.wrap_future(future)  # cancelled with the wait for it
        except Exception as error:  # whatever the index met, sampling goes on without it
            return self._nothing(None if timer.expired() else error, batch, num_frames)
        self._count("answered")
        return memory

    def query_now(
        self,
        audio_embedding: Array,
        beat_phase: Array | float | None,
        num_frames: int,
        *,
        exclude_songs: Excluded | None = None,
    ) -> Memory:
        """`query` for callers without an event loop; the memory is opened at the first call."""
        if self.index is None:
            self.index = self._open()
        future, batch = self._submit(audio_embedding, beat_phase, num_frames, exclude_songs)
        done, _ = wait([future], self.config.deadline)
        error = future.exception() if done else None
        if not done or error is not None:
            future.cancel()
            return self._nothing(error, batch, num_frames)
        self._count("answered")
        return future.result()

    def _open(self) -> MemoryIndex:
        return open_index(self.config.folder, library_above=self.config.library_above)

    def _submit(
        self,
        audio_embedding: Array,
        beat_phase: Array | float | None,
        num_frames: int,
        exclude_songs: Excluded | None,
    ) -> tuple[Future[Memory], int]:
        """The search, and B; mistakes of the caller show here, not as nulls."""
        if self.index is None:
            raise RuntimeError("await initialize() before the first query")
        index = self.index
        query = torch.atleast_2d(torch.as_tensor(audio_embedding).detach().float().cpu())  # type: ignore[no-untyped-call]
        index.check_width(query)
        phase = None if beat_phase is None else torch.as_tensor(beat_phase).detach().cpu()
        query_bars(phase, len(query), num_frames)
        excluded = [exclude_songs] * len(query) if isinstance(exclude_songs, Set) else exclude_songs
        index.banned(excluded, len(query))  # raises where it is not one entry a query
        search = partial(
            retrieve,
            index,
            query,
            self.config,
            num_frames=num_frames,
            phase=phase,
            exclude_songs=excluded,
        )
        return self._workers.submit(search), len(query)

    def _nothing(self, error: BaseException | None, batch: int, num_frames: int) -> Memory:
        """The null memory, counted: of a search that failed, or is late if there is no error."""
        reason = f"failed ({error!r})" if error else f"took longer than {self.config.deadline:g} s"
        if self._count("failed" if error else "timed_out") == 1:  # the rest are in `counts`
            log.warning("a memory query %s; going on without memory", reason)
        return null_memory(batch, num_frames)

    def _count(self, what: str) -> int:
        with self._counting:
            self.counts[what] += 1
            return self.counts[what]


_Job = tuple[Future[Memory], Callable[[], Memory]]
_Queue = queue.SimpleQueue[_Job | None]


class _Workers:
    """A few daemon threads and a queue: a search that hangs does not keep a program from ending.

    `concurrent.futures` would wait for its threads at exit. They end when this object does.
    """

    def __init__(self, count: int) -> None:
        self._count = count
        self._queue: _Queue = queue.SimpleQueue()
        self._started = 0
        self._starting = threading.Lock()
        weakref.finalize(self, _send_home, self._queue, count).atexit = False

    def submit(self, work: Callable[[], Memory]) -> Future[Memory]:
        """Do it in a thread as soon as one is free."""
        future: Future[Memory] = Future()
        self._queue.put((future, work))
        with self._starting:
            if self._started < self._count:
                self._started += 1
                threading.Thread(
                    target=_work_on, args=(self._queue,), name="memory", daemon=True
                ).start()
        return future


def _work_on(jobs: _Queue) -> None:
    while (job := jobs.get()) is not None:
        future, work = job
        if not future.set_running_or_notify_cancel():
            continue  # its deadline passed while it waited
        try:
            future.set_result(work())
        except BaseException as error:  # the thread lives on, the one who asked is told
            future.set_exception(error)
        del job, future, work  # an idle thread holds on to no memory


def _send_home(jobs: _Queue, count: int) -> None:
    for _ in range(count):
        jobs.put(None)
