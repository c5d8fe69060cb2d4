"""`stream`: a body that moves while sentences are typed, out to whoever listens."""

import math
import os
import queue
import socket
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack
from typing import Annotated

import typer

from ..shared.environment import TEXT_MODEL
from ..shared.errors import UsageError, UserError
from . import options
from .console import check_range, complain, tell

AFTER = 4.0  # seconds of motion after a sentence of a file: before the next one, or the end
AT_ONCE = 1.0  # seconds: lines of a pipe that come no further apart are a file's
AHEAD = 1_000  # lines that are read before their turn
VMC_PORT = 39539


def stream(
    prompt: Annotated[str, typer.Option(help="What it does at first.")] = "a person stands",
    seconds: Annotated[
        float | None,
        typer.Option(help="Of motion; without it, 4 s more than there are sentences."),
    ] = None,
    websocket: Annotated[
        int | None,
        typer.Option(help="Port on this machine: frames out, sentences in; 0 is any."),
    ] = None,
    vmc: Annotated[
        str | None,
        typer.Option(help="[HOST:]PORT of an avatar program that speaks VMC; its port is 39539."),
    ] = None,
    real_time: Annotated[
        bool, typer.Option("--real-time/--no-real-time", help="At their time, or at once.")
    ] = True,
    window: Annotated[
        float,
        typer.Option(help="Seconds after which another sentence may begin."),
    ] = 0.5,
    model: Annotated[str, typer.Option(help=options.NAMED)] = TEXT_MODEL,
    seed: Annotated[int, typer.Option(help="Same seed and sentences, same motion.")] = 0,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    foot_lock: Annotated[
        bool | None,
        typer.Option(
            "--foot-lock/--no-foot-lock", help="Hold feet still, which takes 0.9 s of foresight."
        ),
    ] = None,
    device: options.Device = "auto",
    threads: options.Threads = None,
    root: options.Root = "on",
    json: options.Json = False,
) -> None:
    """Move on and on; each line typed or piped in is what the body does next.

    Frames are lines of JSON on stdout, or go to --websocket or --vmc; with --json to stdout as
    well.

    \b
    Examples:
      motion-tools stream
      motion-tools stream --vmc 39539 --root in-place --prompt "a person walks"
      (sleep 5; echo "a person waves") | motion-tools stream --websocket 8765
    """
    check_range("seconds", seconds, 0.3, 60.0)
    if not prompt.strip():
        raise UsageError("--prompt is empty; say what the body does at first")
    if websocket is not None and not 0 <= websocket < 65536:
        raise UsageError(f"--websocket {websocket} is no port; give one from 0 to 65535")
    options.check_root(root)
    from ..shared.environment import compute_without_torch
    from ..shared.model.onnx_card import chosen_runtime

    if chosen_runtime("auto", model, device) == "onnx":
        compute_without_torch()
    from ..shared.device import set_threads
    from ..shared.model.diffusion import Sampling
    from ..shared.pipelines.live import Frame, LiveBody, json_line, parse_address, vmc_bundle
    from ..shared.pipelines.motion_generator import MotionGenerator

    set_threads(threads)
    to = None if vmc is None else parse_address(vmc, VMC_PORT)
    sampling = Sampling(seed=seed, steps=steps, sampler=sampler, guidance_scale=guidance_scale)
    generator = MotionGenerator(model, device=device)
    body = LiveBody(
        generator, prompt, sampling=sampling, window=window, foot_lock=foot_lock,
        real_time=real_time, in_place=root == "in-place",
    )  # fmt: skip

    def warn(text: str) -> None:
        for warning in filter(None, generator.sentences.scope_warnings([text])):
            complain(f"warning: {warning}")

    def say(line: str) -> None:
        text = " ".join(line.split())
        if text:
            try:
                body.say(text)
            except UsageError as error:  # of one line; the stream goes on
                complain(f"warning: {error}")
                return
            warn(text)

    def listen() -> None:
        before, began = -math.inf, time.monotonic()
        for came, line in _as_they_come():
            if 0 < before < began or (came - before < AT_ONCE and not sys.stdin.isatty()):
                body.wait(AFTER)  # so that each line of a file is seen, or typed while it loaded
            before = came
            say(line)
        if seconds is None and websocket is None:
            body.stop(AFTER)

    warn(prompt)
    with ExitStack() as held:
        sinks = []
        if websocket is not None:
            from ..shared.io.websocket import HOST, WebSocketServer

            server = held.enter_context(WebSocketServer(websocket, say))
            tell(f"listening at ws://{HOST}:{server.port}")
            sinks.append(lambda frame: server.send(json_line(frame)))
        if to is not None:
            channel = held.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))

            def send(frame: Frame) -> None:
                try:
                    channel.sendto(vmc_bundle(frame), to)
                except ConnectionRefusedError:
                    pass  # nobody listens yet
                except OSError as error:
                    raise UserError(
                        f"--vmc {vmc}: {error.strerror or error}; name an address of this network"
                    ) from error

            sinks.append(send)
        if json or not sinks:
            sinks.append(lambda frame: print(json_line(frame), flush=True))
        threading.Thread(target=listen, daemon=True).start()
        figures = body.play(sinks, seconds=seconds)
    late = figures.latencies
    heard = f", a sentence seen after {max(late):.2f} s at most" if late else ""
    tell(f"{figures.frames} frames, made {figures.speed:.1f} times as fast as they pass{heard}")


def _as_they_come() -> Iterator[tuple[float, str]]:
    """Of `_lines`, while whoever hears them may still be busy with one before."""
    come: queue.Queue[tuple[float, str] | None] = queue.Queue(AHEAD)

    def read() -> None:
        try:
            for found in _lines():
                come.put(found)
        except (OSError, ValueError):  # closed while it was read
            pass
        come.put(None)

    threading.Thread(target=read, daemon=True).start()
    while (found := come.get()) is not None:
        yield found


def _lines() -> Iterator[tuple[float, str]]:
    """Lines of standard input and when each came, past Python's buffer: an interpreter that ends
    while a thread waits in that one aborts."""
    try:
        source = None if os.name == "nt" else sys.stdin.fileno()  # a console there is no bytes
    except (AttributeError, OSError, ValueError):  # it is no file, or closed
        source = None
    if source is None:
        yield from ((time.monotonic(), line) for line in sys.stdin or ())
        return
    begun, encoding = b"", sys.stdin.encoding or "utf-8"
    while block := os.read(source, 1 << 16):
        came = time.monotonic()
        *whole, begun = (begun + block).split(b"\n")
        yield from ((came, line.decode(encoding, "replace")) for line in whole)
    if begun:
        yield time.monotonic(), begun.decode(encoding, "replace")
