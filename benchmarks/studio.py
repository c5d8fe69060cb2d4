"""What the studio's page takes in headless Chromium, from a disk: loading, first and next motion.

    python -m benchmarks.studio --runs 3
    python -m benchmarks.studio --runs 3 --live --steps 2
    python -m benchmarks.studio --runs 3 --frames

Seconds from the start of loading until the model is there and until the first motion (4 s) is
shown; *next*, from the wish for another seed until that motion is made. Nothing is drawn, for want
of WebGL. With `--live`, seconds from each of eight sentences, 2.4 s apart, until a frame shows it,
and how many times as fast as it passes the motion is made: *changing* with these sentences, all
that is opened for the first time among it; *steady* with one. With `--frames`, pictures a second of
one body and of four, drawn by the processor. Each run is a browser of its own with an empty
profile.
"""

import argparse
import statistics
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from src.shared.studio.page import write_studio
from tests.shared.formats.chromium_pipe import Browser

SEEDS = 5
SENTENCES = ("walks forward", "waves", "jumps", "stands", "bows", "runs", "claps", "turns around")
APART = 2.4  # seconds
PULLS = 60  # of half a second
STEADY = f"""(async () => {{
    const pull = (begin) => studio.client.call("live", {{ text: "she walks", seed: 0, begin }});
    await pull(true);
    const start = performance.now();
    for (let number = 0; number < {PULLS}; number++) await pull(false);
    return {PULLS} * 500 / (performance.now() - start);
}})()"""


DRAWN = """new Promise((resolve) => {
    let number = 0;
    const start = performance.now();
    const next = () => {
        const spent = performance.now() - start;
        if (spent > 5000) resolve((1000 * number) / spent);
        else { number++; requestAnimationFrame(next); }
    };
    requestAnimationFrame(next);
})"""


@contextmanager
def opened(page: Path, *, webgl: bool = False) -> Iterator[Browser]:
    """The page in a browser of its own, its first motion made."""
    ready = "typeof studio === 'object'"
    with (
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile,
        Browser(page.as_uri(), Path(profile), (1280, 800), ready, webgl=webgl) as browser,
    ):
        browser.wait("studio.timings?.first !== undefined", 180)
        browser.evaluate("studio.history.change({ takes: 1 })")
        browser.wait("!studio.making")
        yield browser


def frames(page: Path) -> list[float]:
    """Pictures a second of one body and of four that walk."""
    found = []
    with opened(page, webgl=True) as browser:
        for takes in (1, 4):
            scene = f"{{ takes: {takes}, blocks: [{{ text: 'a person walks', seconds: 4 }}] }}"
            browser.evaluate(f"studio.history.change({scene}); studio.make()")
            browser.wait("!studio.making && studio.playing")
            found.append(browser.evaluate(DRAWN))
    return found


def live(page: Path) -> list[float]:
    """Least, median and most seconds until a sentence is seen; twice times real time."""
    with opened(page) as browser:
        browser.evaluate("document.getElementById('live').click()")
        browser.wait("studio.live?.made > 0")
        for number, text in enumerate(SENTENCES):
            time.sleep(APART)
            browser.wait(f"studio.live.delays.length === {number}")
            browser.evaluate(f"studio.editBlock({{ text: 'a person {text}' }}); studio.make()")
        browser.wait(f"studio.live.delays.length === {len(SENTENCES)}")
        delays = browser.evaluate("studio.live.delays")
        changing = browser.evaluate("studio.live.made / 30 / studio.live.busy")
        browser.evaluate("studio.stop()")
        browser.wait("!studio.making")
        steady = browser.evaluate(STEADY)
    return [min(delays), statistics.median(delays), max(delays), changing, steady]


def measured(page: Path) -> list[float]:
    """Loaded, first and median next of one browser, in seconds."""
    with opened(page) as browser:
        following = []
        for seed in range(1, SEEDS + 1):
            browser.evaluate(f"studio.history.change({{ seed: {seed} }}); studio.make()")
            browser.wait("!studio.making")
            following.append(browser.evaluate("studio.timings.motion"))
        loaded, first = (browser.evaluate(f"studio.timings.{name}") for name in ("loaded", "first"))
    return [each / 1000 for each in (loaded, first, statistics.median(following))]


def main() -> None:
    """Print a line for each run."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--steps", type=int, help="of the page; without it, the model's own")
    parser.add_argument("--live", action="store_true")
    parser.add_argument("--frames", action="store_true")
    options = parser.parse_args()
    measure, heads = measured, ("loaded", "first", "next")
    if options.live:
        measure, heads = live, ("least", "median", "most", "changing", "steady")
    elif options.frames:
        measure, heads = frames, ("one", "four")
    with tempfile.TemporaryDirectory() as folder:
        page = write_studio(Path(folder), steps=options.steps)
        print(f"{page.stat().st_size / 1e6:.1f} MB")
        print("".join(f"{head:>9}" for head in heads))
        for _ in range(options.runs):
            print("".join(f"{each:9.2f}" for each in measure(page)))


if __name__ == "__main__":
    main()
