"""What the studio's page takes in headless Chromium, from a disk: loading, first and next motion.

    python -m benchmarks.studio --runs 3

Seconds from the start of loading until the model is there and until the first motion (4 s) is
shown; *next*, from the wish for another seed until that motion is made. Nothing is drawn, for want
of WebGL. Each run is a browser of its own with an empty profile.
"""

import argparse
import statistics
import tempfile
from pathlib import Path

from src.shared.studio.page import write_studio
from tests.shared.formats.chromium_pipe import Browser

SEEDS = 5


def measured(page: Path) -> list[float]:
    """Loaded, first and median next of one browser, in seconds."""
    with (
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile,
        Browser(page.as_uri(), Path(profile), ready="typeof studio === 'object'") as browser,
    ):
        browser.wait("studio.timings?.first !== undefined", 180)
        browser.evaluate("studio.history.change({ takes: 1 })")
        browser.wait("!studio.making")
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
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        page = write_studio(Path(folder))
        print(f"{page.stat().st_size / 1e6:.1f} MB")
        print(f"{'loaded':>8}{'first':>8}{'next':>8}")
        for _ in range(options.runs):
            print("".join(f"{each:8.2f}" for each in measured(page)))


if __name__ == "__main__":
    main()
