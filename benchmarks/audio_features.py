"""How fast are a song's features? The document's literal function and ours, in turns.

python -m benchmarks.audio_features [SONG] [--seconds 180] [--repeat 3] [--json OUT]

Without SONG it is a synthetic one. Each turn reads the file from the disk again and ends with
features and beats; nothing is cached. The first turn of each pays for imports and compiling and
is told apart. On a busy machine processor seconds are the fairer ones. The literal function is
TECH section 4.2's, with `float(tempo)` repaired.
"""

import argparse
import json
import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np


def literal(path: Path) -> dict[str, Any]:
    """TECH section 4.2, its calls one by one."""
    import librosa

    sr, hop = 44_100, 1470
    y, _ = librosa.load(path, sr=sr, mono=True)
    mel = librosa.feature.melspectrogram(
        y=y, sr=sr, n_mels=128, hop_length=hop, fmin=20.0, fmax=8000.0
    )
    mel = librosa.power_to_db(mel, ref=np.max)
    chroma = librosa.feature.chroma_cqt(y=y, sr=sr, hop_length=hop, n_chroma=12)
    mfcc = librosa.feature.mfcc(y=y, sr=sr, n_mfcc=20, hop_length=hop)
    rms = librosa.feature.rms(y=y, hop_length=hop)[0]
    centroid = librosa.feature.spectral_centroid(y=y, sr=sr, hop_length=hop)[0]
    onset = librosa.onset.onset_strength(y=y, sr=sr, hop_length=hop)
    tempo, beats = librosa.beat.beat_track(y=y, sr=sr, hop_length=hop)
    return {
        "mel": (mel - mel.min()) / (mel.max() - mel.min() + 1e-8),
        "chroma": chroma,
        "mfcc": (mfcc - mfcc.mean(axis=1, keepdims=True))
        / (mfcc.std(axis=1, keepdims=True) + 1e-8),
        "rms": rms / (rms.max() + 1e-8),
        "spectral_centroid": (centroid - centroid.min()) / (centroid.max() - centroid.min() + 1e-8),
        "onset_strength": onset / (onset.max() + 1e-8),
        "tempo": float(np.atleast_1d(tempo)[0]),
        "beat_times": librosa.frames_to_time(beats, sr=sr, hop_length=hop),
    }


def ours(path: Path) -> dict[str, Any]:
    """The default path, cache off."""
    from src.shared.audio.song import analyse

    return analyse(path, cache=False).arrays()


FUNCTIONS = {"ours": ours, "literal": literal}


def timed(
    function: Callable[[Path], dict[str, Any]], path: Path
) -> tuple[np.ndarray, dict[str, Any]]:
    """Seconds on the clock and of processor time [2], and the result."""
    start = time.perf_counter(), time.process_time()
    result = function(path)
    return np.array([time.perf_counter() - start[0], time.process_time() - start[1]]), result


def peak_gib() -> float:
    """Largest memory of this process so far."""
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20


def agreement(expected: dict[str, Any], found: dict[str, Any]) -> dict[str, float]:
    """Largest difference of each feature; of chroma the median cosine of frames."""
    frames = found["mel"].shape[1]
    names = ("mel", "mfcc", "rms", "spectral_centroid", "onset_strength")
    result = {
        name: float(np.abs(expected[name][..., :frames] - found[name]).max()) for name in names
    }
    a, b = expected["chroma"][:, :frames], found["chroma"]
    lengths = np.linalg.norm(a, axis=0) * np.linalg.norm(b, axis=0)
    heard = lengths > 0
    cosines = (a * b).sum(axis=0)[heard] / lengths[heard]
    return result | {"chroma median cosine": float(np.median(cosines))}


def measure(path: Path, repeat: int) -> dict[str, Any]:
    """Both functions in turns, after a first turn each that also compiles and imports."""
    import soundfile

    firsts, peaks, results = {}, {}, {}
    for name, function in FUNCTIONS.items():  # ours first: its peak memory is then its own
        firsts[name], results[name] = timed(function, path)
        peaks[name] = peak_gib()
    turns = [
        {name: timed(function, path)[0] for name, function in FUNCTIONS.items()}
        for _ in range(repeat)
    ]
    medians = {name: np.median([turn[name] for turn in turns], axis=0) for name in FUNCTIONS}
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return {
        "song": path.name,
        "seconds": soundfile.info(path).duration,
        "cores": cores,
        "threads": os.environ.get("OMP_NUM_THREADS", "unset"),
        "repeat": repeat,
        "first": {name: value.tolist() for name, value in firsts.items()},
        "median": {name: value.tolist() for name, value in medians.items()},
        "ratio": (medians["literal"] / medians["ours"]).tolist(),
        "ratio_first": (firsts["literal"] / firsts["ours"]).tolist(),
        "peak_gib": peaks,
        "agreement": agreement(results["literal"], results["ours"]),
    }


def show(result: dict[str, Any]) -> None:
    """The result as lines."""
    print(f"{result['song']}: {result['seconds']:.1f} s of sound,", end=" ")
    print(f"{result['cores']} cores, OMP_NUM_THREADS {result['threads']}; seconds are")
    print(f"wall clock (processor), medians of {result['repeat']} turns each")
    for name, label in (("literal", "literal"), ("ours", "ours")):
        wall, processor = result["median"][name]
        first = "{:.2f} ({:.2f})".format(*result["first"][name])
        peak = f"process peak {result['peak_gib'][name]:.2f} GiB"
        print(f"{label:8}{wall:8.2f} ({processor:.2f}) s; first turn {first} s; {peak}")
    ratio, first = result["ratio"], result["ratio_first"]
    print(f"ratio   {ratio[0]:8.1f} ({ratio[1]:.1f}); first turn {first[0]:.1f} ({first[1]:.1f})")
    for name, value in result["agreement"].items():
        print(f"  {name} {value:.6f}" if "cosine" in name else f"  {name} differs by {value:.1e}")


def main() -> None:
    """Parse, measure, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("song", type=Path, nargs="?", help="a sound file; else a synthetic song")
    parser.add_argument("--seconds", type=float, default=180.0, help="of the synthetic song")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--json", type=Path, help="write the result here")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = arguments.song
        if path is None:
            import soundfile

            from src.shared.audio.synthetic import SongSpec, render_song

            song = render_song(SongSpec(tempo=116.0, seconds=arguments.seconds, seed=1))
            path = Path(folder) / "synthetic.wav"
            soundfile.write(path, song.samples, song.sample_rate)
        result = measure(path, arguments.repeat)
    show(result)
    if arguments.json:
        arguments.json.write_text(json.dumps(result, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
