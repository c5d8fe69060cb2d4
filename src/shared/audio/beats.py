"""Beats, downbeats and tempo of a song.

Onset strengths at 100 frames a second → likely tempi per window → the best chain of
beats by dynamic programming over beat time and beat length together (a semi-Markov form of the
bar pointer of Whiteley et al. 2006 and the score of Ellis 2007) → refined below a frame →
downbeats. Tempo may drift and jump.

A linear score of the five beats around a beat says how much it sounds like a downbeat; the best
numbering of all beats follows by dynamic programming, where counting on costs nothing and starting
a bar at the wrong beat (the tracker lost or added one) costs SLIP_COST. The weights were fitted
by softmax regression on the bar's offset over 300 songs of the training split, meters 2 to 4, and
200 patterns in which the strokes alone tell the bar.

A window's autocorrelation peaks at the beat, but also at its halves and multiples. Which one
people tap is decided by a linear model (multinomial logistic regression) that looks at the
multiples of a candidate period within and between three bands (a kick answered by a snare), with
a mild preference for 120 BPM; it was fitted on 800 songs of the training split, none of whose
tempi the tests use, on 200 such patterns and 200 songs with dotted basses.

Where nothing sounds for a while there are no beats, but they are counted on through it: the bars
after a gap are those before it.

Letters: S samples, T frames, P pitch frames, N beats or windows (of pitch: semitones), M downbeats
(of filters: mel bands), L beat lengths in frames, F features, B pairs of bands, G candidate tempi.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from .features import spectra
from .sound import loud_part

# ---------------------------------------------------------------- onsets

ONSET_FPS, PITCH_FPS = 100, 20  # nominal; exact only where the sample rate divides by them
ONSET_WINDOW, PITCH_WINDOW = 0.04, 0.18  # seconds, to the nearest power of two in samples
MEL_BANDS = 36
LOWEST, LOW, HIGH, HIGHEST = 30.0, 180.0, 2500.0, 16_000.0  # Hz: edges of the three bands
LOWEST_PITCH, SEMITONES = 33, 60  # MIDI numbers from 55 Hz on
FLOOR_DB = 60.0  # below the loudest band
SILENCE_POWER = 1e-9  # power of the loudest frame; about -80 dB full scale
LAG = 2  # frames over which a rise is measured


@dataclass(frozen=True)
class Onsets:
    """Onset strengths, levels and pitches; frame t of T is centred on t / fps seconds.

    Attributes:
        bands: [3, T] mean rise of the low, middle and high bands, dB in 20 ms.
        blows: [2, T] rise of amplitude in the low and the middle band in 20 ms, by the loudest.
        loudness: [T] level of the loudest band in dB above the floor.
        pitch: [N, P] levels of the semitones, compressed, at `pitch_fps`.
        silent: nothing can be heard.
    """

    bands: np.ndarray
    blows: np.ndarray
    loudness: np.ndarray
    pitch: np.ndarray
    fps: float
    pitch_fps: float
    silent: bool

    @property
    def strength(self) -> np.ndarray:
        """Rise of all bands [T]."""
        return np.asarray(self.bands.mean(axis=0))


def detect_onsets(samples: np.ndarray, sample_rate: int) -> Onsets:
    """Onsets of mono sound [S]: spectra of 46 ms for their moment, of 186 ms for pitch."""
    hop, bins = _framing(sample_rate, ONSET_FPS, ONSET_WINDOW)
    centres, filters = mel_filters(bins)
    power = _powers(samples, hop, filters)
    peak = float(power.max(initial=0.0))
    level = np.maximum(10 * np.log10(np.maximum(power, 1e-20) / max(peak, 1e-20)) + FLOOR_DB, 0.0)
    edges = np.searchsorted(centres, [LOW, HIGH])
    drums = np.sqrt([part.mean(axis=0) for part in np.split(power, edges)[:2]])
    rises = np.maximum(drums - np.pad(drums, ((0, 0), (LAG, 0)), mode="edge")[:, :-LAG], 0.0)
    pitch_hop, bins = _framing(sample_rate, PITCH_FPS, PITCH_WINDOW)
    pitch = np.sqrt(_powers(samples, pitch_hop, pitch_filters(bins)))  # amplitudes
    return Onsets(
        bands=np.stack([part.mean(axis=0) for part in np.split(_rise(level), edges)]),
        blows=rises / np.maximum(drums.max(axis=1, keepdims=True, initial=0.0), 1e-10),
        loudness=level.max(axis=0),
        pitch=np.log1p(100 * pitch / max(float(pitch.max(initial=0.0)), 1e-10)),
        fps=sample_rate / hop,
        pitch_fps=sample_rate / pitch_hop,
        silent=peak < SILENCE_POWER,
    )


def _framing(sample_rate: int, fps: float, seconds: float) -> tuple[int, np.ndarray]:
    """Samples from frame to frame, and the frequencies [bins] of a window's spectrum in Hz."""
    size = int(2 ** round(np.log2(seconds * sample_rate)))
    return max(round(sample_rate / fps), 1), np.arange(size // 2 + 1) * sample_rate / size


def _powers(samples: np.ndarray, hop: int, filters: np.ndarray) -> np.ndarray:
    """Powers [bands, T = 1 + S // hop] of samples [S] through filters [bands, bins]."""
    samples, size = samples.astype(np.float32, copy=False), 2 * (filters.shape[1] - 1)
    window = np.hanning(size + 1)[:-1].astype(np.float32)
    window = window * np.float32(2 / window.sum())
    return np.concatenate([power @ filters.T for *_, power in spectra(samples, hop, window)]).T


def mel_filters(bins: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centres [M] in Hz and triangles [M, bins] of unit sum, at equal steps on the mel scale.

    Triangles narrower than a bin are widened to one, so that none is empty.
    """
    first, last = 1127 * np.log1p(np.array([LOWEST, min(HIGHEST, bins[-1])]) / 700)
    edges = 700 * np.expm1(np.linspace(first, last, MEL_BANDS + 2) / 1127)
    centres = edges[1:-1]
    below = np.minimum(edges[:-2], centres - bins[1])[:, None]
    above = np.maximum(edges[2:], centres + bins[1])[:, None]
    rise = (bins - below) / (centres[:, None] - below)
    fall = (above - bins) / (above - centres[:, None])
    filters = np.maximum(0.0, np.minimum(rise, fall))
    return centres, (filters / filters.sum(axis=1, keepdims=True)).astype(np.float32)


def pitch_filters(bins: np.ndarray) -> np.ndarray:
    """Triangles [N, bins], a semitone or at least a bin to each side."""
    centres = 440.0 * 2 ** ((LOWEST_PITCH + np.arange(SEMITONES)[:, None] - 69) / 12)
    width = np.maximum(centres * (2 ** (1 / 12) - 1), bins[1])
    return np.asarray(np.maximum(0.0, 1 - np.abs(bins - centres) / width).astype(np.float32))


def _rise(level: np.ndarray) -> np.ndarray:
    """Rise [M, T] in dB over LAG frames, above the loudest neighbour band before (vibrato)."""
    before = np.pad(level, ((1, 1), (LAG, 0)))[:, : level.shape[1]]
    before = np.maximum(np.maximum(before[:-2], before[1:-1]), before[2:])
    return np.asarray(np.maximum(level - before, 0.0))


# ---------------------------------------------------------------- tempo

SLOWEST, PER_OCTAVE, CANDIDATES = 44.0, 24, 57  # BPM, candidates per octave, G: up to 223 BPM
PERIODS = 60 / (SLOWEST * 2 ** (np.arange(CANDIDATES) / PER_OCTAVE))  # [G] seconds
DISTANCE = np.log2(PERIODS / 0.5)  # [G] octaves below 120 BPM
WINDOW, STEP = 8.0, 2.0  # seconds
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # of the low, middle and high band
MULTIPLES = (1 / 4, 1 / 3, 1 / 2, 2 / 3, 1, 3 / 2, 2, 3, 4)
MULTIPLE_WEIGHTS = np.array(  # [B, multiples]
    [
        [-2.7, -2.9, -2.4, -2.7, -3.3, 0.3, 0.3, 1.3, 2.2],
        [-1.9, -1.3, -2.2, 1.5, 0.7, -0.2, 0.0, 1.7, 1.3],
        [0.7, -0.5, -0.8, -0.4, 1.8, 0.4, 2.3, 0.4, -0.4],
        [-2.4, -0.3, -1.3, -1.2, 2.6, 1.0, 1.9, -1.9, -1.4],
        [-2.0, -0.7, 0.7, -0.6, 4.1, 0.0, -0.6, -0.3, -1.7],
        [-1.4, -2.0, -0.3, -0.7, 0.7, 0.1, -1.9, -0.6, 2.1],
    ]
)
PRIOR = -0.88  # of the squared DISTANCE: log-normal with a spread of 0.75 octaves
LEAP_COST, OCTAVE_COST = 6.0, 12.0  # of a change of tempo between windows
NEARBY = 5  # candidates to each side of the path that a beat may still have
BLUR = np.bartlett(15)[1:-1] / 7  # players are not exact: onsets are spread over 13 frames


def correlate_windows(novelty: np.ndarray, fps: float) -> tuple[np.ndarray, np.ndarray]:
    """Normalised correlations [N, B, lags] of windows, and the windows' centres [N] (s).

    Args:
        novelty: onset strengths [3, T] of the low, middle and high bands at `fps`.
    """
    novelty = np.stack([np.convolve(row, BLUR, "same") for row in novelty])
    frames = novelty.shape[1]
    window, step = round(WINDOW * fps), round(STEP * fps)
    lags = round(PERIODS[0] * MULTIPLES[-1] * fps) + 2
    taper = np.hanning(min(window, frames) + 2)[1:-1]
    size = int(2 ** np.ceil(np.log2(window + lags)))
    first, second = np.array(PAIRS).T
    overlap = np.fft.irfft(np.abs(np.fft.rfft(taper, size)) ** 2)[:lags]
    overlap = np.maximum(overlap / overlap[0], 0.05)  # fewer frames meet at long lags: undo that
    starts = np.arange(0, max(frames - window, 0) + 1, step)
    result = np.empty((len(starts), len(PAIRS), lags))
    for index, start in enumerate(starts):
        part = novelty[:, start : start + window]
        mean = (part * taper).sum(axis=1, keepdims=True) / taper.sum()
        spectrum = np.fft.rfft((part - mean) * taper, size)
        crossed = np.fft.irfft((spectrum[first] * spectrum[second].conj()).real)[:, :lags]
        energy = crossed[:3, 0] + 1e-6
        result[index] = crossed / np.sqrt(energy[first] * energy[second])[:, None] / overlap
    return result, (starts + taper.size / 2) / fps


def tempo_features(correlations: np.ndarray, fps: float) -> np.ndarray:
    """Correlations [N, B, lags] read at the multiples of each candidate: [N, B, multiples, G]."""
    lags = np.outer(MULTIPLES, PERIODS) * fps
    return read_at(correlations, lags)


def tempo_scores(correlations: np.ndarray, fps: float) -> np.ndarray:
    """Log-probability [N, G] of each candidate period, from correlations [N, B, lags]."""
    scores = np.einsum("bm,nbmg->ng", MULTIPLE_WEIGHTS, tempo_features(correlations, fps))
    scores += PRIOR * DISTANCE**2
    top = scores.max(axis=1, keepdims=True)
    return np.asarray(scores - top - np.log(np.exp(scores - top).sum(axis=1, keepdims=True)))


def tempo_path(scores: np.ndarray) -> np.ndarray:
    """The likeliest candidate of each window, [N] numbers: drifts are free, jumps cost, and a
    leap to the double or half is taken for an illusion (Viterbi)."""
    steps = np.abs(np.subtract.outer(np.arange(CANDIDATES), np.arange(CANDIDATES)))
    cost = np.minimum(0.5 * np.maximum(steps - 1, 0), LEAP_COST)
    cost += np.where(np.abs(steps - PER_OCTAVE) <= 1, OCTAVE_COST, 0.0)
    value, before = scores[0], np.zeros(scores.shape, dtype=int)
    for window in range(1, len(scores)):
        options = value[:, None] - cost
        before[window] = options.argmax(axis=0)
        value = options.max(axis=0) + scores[window]
    path = [int(value.argmax())]
    for window in range(len(scores) - 1, 0, -1):
        path.append(int(before[window, path[-1]]))
    return np.array(path[::-1])


ALIKE = 0.6  # correlation after two fifths of a beat: at most .23 in 56 other songs
FEWER = 0.7  # of a mistaken beat; longer ones are ruled out
FAST, ALONE, KICKS = 0.34, 2.7, 1.8  # seconds: half is as far from 125 BPM; times as strong
EDGE = 0.3  # seconds: a beat as short as the shortest is half of one that no candidate doubles


def without_illusions(scores: np.ndarray, correlations: np.ndarray, fps: float) -> np.ndarray:
    """Log-probabilities [N, G] in which two beats that cannot be are ruled out.

    Where kicks on the beat and hats between them are alike, all of them come again after two and a
    half beats, and none after two fifths of a beat that is one; and with a stroke on every half
    beat the fastest candidate of all, which need not be half of the beat, comes nearest to it.

    Args:
        scores: see `tempo_scores`; the very same come back where nothing is ruled out.
        correlations: [N, B, lags].
    """
    beat = float(np.median(PERIODS[tempo_path(scores)]))
    after = read_at(correlations[:, :3], np.array([0.4 * beat * fps])).max(axis=(1, 2))
    if float(np.median(after)) > ALIKE:
        ruled_out = beat * FEWER < PERIODS
    elif beat < EDGE:
        ruled_out = PERIODS < EDGE
    else:
        return scores
    left = np.where(ruled_out, -np.inf, scores).max(axis=1, keepdims=True)
    scores = np.where(ruled_out, left + TEMPO_FLOOR, scores)
    top = scores.max(axis=1, keepdims=True)
    return np.asarray(scores - top - np.log(np.exp(scores - top).sum(axis=1, keepdims=True)))


def _on_kicks(chain: np.ndarray, onsets: Onsets, strength: np.ndarray) -> np.ndarray:
    """Beat frames [N] as drums tell them, for hats, however loud, tell no beat of their own: every
    second one of a fast chain whose drums strike there alone, with nothing between its beats; or
    those halfway between, where the kicks are. `strength` [T] is of onsets."""

    def stroke(rows: np.ndarray, frames: np.ndarray) -> np.ndarray:
        near = np.clip(frames[:, None] + np.arange(-3, 4), 0, len(strength) - 1)
        return np.asarray(rows[..., near].max(axis=-1).mean(axis=-1))

    def halfway(chain: np.ndarray) -> np.ndarray:
        half = np.diff(chain, append=2 * chain[-1] - chain[-2]) // 2
        frames = np.concatenate((chain[:1] - half[:1], chain + half))
        return frames[(frames >= 0) & (frames < len(strength))]

    parts, fast = (chain[::2], chain[1::2]), np.median(np.diff(chain)) < FAST * onsets.fps
    if fast and len(parts[1]) > 2:
        empty = KICKS * stroke(strength, halfway(chain)) < min(stroke(strength, p) for p in parts)
        blows = [stroke(onsets.blows, part) for part in parts]
        for some, other in ((0, 1), (1, 0)):
            if empty and (blows[some] > ALONE * blows[other]).all():
                chain = parts[some]
    on, off = stroke(onsets.blows, chain), stroke(onsets.blows, between := halfway(chain))
    return between if (off > on).all() and off.sum() > KICKS * on.sum() else chain


def certainty(scores: np.ndarray, path: np.ndarray) -> float:
    """Mean probability [0, 1] that the scores [N, G] give to the tempi (±6%) of the path [N]."""
    near = np.abs(np.arange(CANDIDATES) - path[:, None]) <= 2
    return float((np.exp(scores) * near).sum(axis=1).mean())


def read_at(correlations: np.ndarray, lags: np.ndarray) -> np.ndarray:
    """Correlations [..., lags] at fractional lags of any shape, linearly interpolated."""
    index = lags.astype(int)
    share = lags - index
    return np.asarray(correlations[..., index] * (1 - share) + correlations[..., index + 1] * share)


def periodicity(correlations: np.ndarray, lengths: np.ndarray) -> float:
    """How alike the onsets are one or two beats later, 0 to 1: mean over windows, best band.

    Args:
        correlations: [N, B, lags].
        lengths: [N] beat length of each window in frames.
    """
    best = [
        read_at(window[:3], np.array([1.0, 2.0]) * length).max()
        for window, length in zip(correlations, lengths, strict=True)
    ]
    return float(np.clip(np.mean(best), 0.0, 1.0))


# ---------------------------------------------------------------- downbeats


METERS = (3, 4)  # tried when the meter is not given
SLIP_COST = 4.0  # about three bars of clear downbeats
BASS_SEMITONES = 20  # of Onsets.pitch, up to 165 Hz
CONTEXT = (-2, -1, 0, 1, 2)  # beats
WEIGHTS = np.array(  # [features, CONTEXT]
    [
        [-0.11, -0.10, 0.24, 0.00, -0.07],  # onset, low band
        [0.03, 0.12, -0.01, -0.01, 0.06],  # onset, middle band
        [-0.18, 0.13, 0.21, -0.01, -0.17],  # onset, high band
        [0.06, -0.09, -0.18, -0.05, -0.08],  # new bass notes since the last beat
        [0.02, -0.17, 0.04, -0.16, 0.06],  # new harmony since the last beat
        [-0.09, 0.03, -0.07, -0.12, -0.06],  # new bass notes, two beats against two
        [-0.23, -0.13, 0.18, -0.02, -0.06],  # new harmony, two beats against two
        [-0.20, -0.05, 0.31, -0.10, 0.03],  # loudness of the bass
    ]
)


def find_downbeats(onsets: Onsets, times: np.ndarray, meter: int | None) -> tuple[int, np.ndarray]:
    """The meter, and which of the beats at `times` [N] (N >= 2) open a bar: numbers, ascending.

    Args:
        meter: beats a bar; None takes the likelier of METERS.
    """
    # How much each beat sounds like a downbeat [N]: about 1 for downbeats, -0.3 for others.
    scores = np.einsum("fc,fcn->n", WEIGHTS, downbeat_features(onsets, times))
    if meter is None:
        meter = max(METERS, key=lambda bar: _evidence(scores, bar))
    return meter, np.flatnonzero(_numbers(scores, meter) == 0)


def downbeat_features(onsets: Onsets, times: np.ndarray) -> np.ndarray:
    """Features of the beats around each beat, standardised over the song: [F, CONTEXT, N]."""
    features = _beat_features(onsets, times)
    spread = features.std(axis=1, keepdims=True) + 1e-3 * np.abs(features).max(axis=1)[:, None]
    features = (features - features.mean(axis=1, keepdims=True)) / (spread + 1e-6)
    around = np.arange(len(times)) + np.array(CONTEXT)[:, None]
    return np.asarray(np.take(features, around, axis=1, mode="clip"))


def _evidence(scores: np.ndarray, meter: int) -> float:
    """Best mean score of every meter-th beat, in standard errors."""
    parts = [scores[offset::meter] for offset in range(min(meter, len(scores)))]
    return float(max(float(part.sum()) / np.sqrt(len(part)) for part in parts))


def _numbers(scores: np.ndarray, meter: int) -> np.ndarray:
    """Number in the bar, 0 to meter - 1, of each beat [N]: the best path (Viterbi)."""
    value = np.zeros(meter)
    before = np.zeros((len(scores), meter), dtype=int)
    for beat, score in enumerate(scores):
        counted, slipped = np.roll(value, 1), int(value.argmax())
        slips = value[slipped] - SLIP_COST > counted
        before[beat] = np.where(slips, slipped, (np.arange(meter) - 1) % meter)
        value = np.where(slips, value[slipped] - SLIP_COST, counted)
        value[0] += score
    numbers = np.empty(len(scores), dtype=int)
    number = int(value.argmax())
    for beat in range(len(scores) - 1, -1, -1):
        numbers[beat] = number
        number = int(before[beat, number])
    return numbers


def _beat_features(onsets: Onsets, times: np.ndarray) -> np.ndarray:
    """[F, N]: see WEIGHTS."""
    reach, last = 3, onsets.bands.shape[1] - 1
    frames = np.round(times * onsets.fps).astype(int)
    near = np.clip(frames[:, None] + np.arange(-reach, reach + 1), 0, last)
    accents = onsets.bands[:, near].max(axis=2)
    pitch = _pitch_by_beat(onsets, times)
    bass, harmony = pitch[:BASS_SEMITONES], pitch[BASS_SEMITONES:]
    changes = [_change(part, span) for span in (1, 2) for part in (bass, harmony)]
    return np.concatenate([accents, np.stack([*changes, bass.mean(axis=0)])])


def _pitch_by_beat(onsets: Onsets, times: np.ndarray) -> np.ndarray:
    """Mean pitch levels [semitones, N] from each beat to the next, without the attack."""
    count = onsets.pitch.shape[1]
    ends = np.append(times[1:], 2 * times[-1] - times[-2])
    start = np.ceil((times + 0.06) * onsets.pitch_fps).astype(int)
    start = np.minimum(start, count - 1)
    stop = np.ceil((ends - 0.03) * onsets.pitch_fps).astype(int)
    stop = np.clip(stop, start + 1, count)
    sums = np.pad(np.cumsum(onsets.pitch, axis=1, dtype=np.float64), ((0, 0), (1, 0)))
    return np.asarray((sums[:, stop] - sums[:, start]) / (stop - start))


def _change(levels: np.ndarray, span: int) -> np.ndarray:
    """One minus the cosine [N] of the `span` beats from each beat on and those before it."""
    beats = np.arange(levels.shape[1])
    steps = np.arange(span)[:, None]
    after = np.take(levels, beats + steps, axis=1, mode="clip").sum(axis=1)
    past = np.take(levels, beats - steps - 1, axis=1, mode="clip").sum(axis=1)
    norms = np.linalg.norm(after, axis=0) * np.linalg.norm(past, axis=0)
    return np.asarray(1 - (after * past).sum(axis=0) / (norms + 1e-3))


# ---------------------------------------------------------------- beats

LENGTHS = np.arange(28, 137)  # frames: 214 to 44 BPM
TEMPO_WEIGHT = 3.0  # of a tempo's log-probability against onset strength, both per second
TEMPO_FLOOR = -8.0
DRIFT_COST, JUMP_COST = 300.0, 4.0  # of log-ratio² from beat to beat, at most the second
# Of 60 noises, glides and strokes at random 58 stay below, of 489 held-out songs all above.
MIN_CONFIDENCE = 0.35
AUDIBLE, GAP = 10.0, 1.5  # dB above the floor; seconds between two audible beats
CHANCE = 0.8  # confidence that a second of noise reaches; falls with the length
NEIGHBOURS = np.array([0.25, 0.5, 0.75, 1.0, 0.75, 0.5, 0.25]) / 2


@dataclass(frozen=True, eq=False)
class Beats:
    """Beats of a song: tempo (median, BPM; 0.0 = none found) and times in seconds, ascending.

    `confidence` in [0, 1] is the mean of how well the onsets repeat after a beat or two and how
    certain the tempo is; 0.0 without beats.
    """

    tempo: float
    beat_times: np.ndarray = field(repr=False)  # [N] float64
    downbeat_times: np.ndarray = field(repr=False)  # [M] float64, a subset of beat_times
    meter: int = 4
    confidence: float = 0.0


def track_beats(sound: np.ndarray, sample_rate: int = 44_100, *, meter: int | None = 4) -> Beats:
    """Find beats and downbeats.

    Args:
        sound: mono samples [S].
        sample_rate: Hz.
        meter: beats a bar; None chooses between 3 and 4.

    Returns:
        Beats; with tempo 0.0 and empty times where nothing periodic is heard.
    """
    start, stop = loud_part(sound, sample_rate)
    if start or stop < len(sound):  # what nobody hears is no reason to doubt the rest
        found, later = track_beats(sound[start:stop], sample_rate, meter=meter), start / sample_rate
        beats, downbeats = found.beat_times + later, found.downbeat_times + later
        return replace(found, beat_times=beats, downbeat_times=downbeats)
    onsets = detect_onsets(sound, sample_rate)
    nothing = Beats(0.0, np.zeros(0), np.zeros(0), meter or 4)
    if onsets.silent or onsets.strength.size < 2 * LENGTHS[0]:
        return nothing
    novelty = _novelty(onsets.bands, onsets.fps)
    correlations, centres = correlate_windows(novelty, onsets.fps)
    scores = without_illusions(tempo_scores(correlations, onsets.fps), correlations, onsets.fps)
    strength = novelty.mean(axis=0)
    path = tempo_path(scores)
    chain = _best_chain(strength, scores, path, centres * onsets.fps, onsets.fps)
    chain = chain[_sounding(onsets, chain)]
    if len(chain) < 3:
        return nothing
    chain = _on_kicks(chain, onsets, strength)
    times = _refined(chain, strength) / onsets.fps
    lengths = np.interp(centres, times[:-1], np.diff(times)) * onsets.fps
    confidence = (periodicity(correlations, lengths) + certainty(scores, path)) / 2
    confidence = max(confidence - CHANCE * onsets.fps / strength.size, 0.0)
    if confidence < MIN_CONFIDENCE:
        return nothing
    meter, downbeats = find_downbeats(onsets, times, meter)
    heard = _heard(onsets, times)
    return Beats(
        tempo=_median_tempo(times),
        beat_times=times[heard],
        downbeat_times=times[downbeats][heard[downbeats]],
        meter=meter,
        confidence=confidence,
    )


def _novelty(strength: np.ndarray, fps: float) -> np.ndarray:
    """Onset strengths [B, T] above their mean of a second, in standard deviations."""
    reach = round(fps / 2)
    sums = np.cumsum(np.pad(strength, ((0, 0), (reach + 1, reach)), mode="edge"), axis=1)
    mean = (sums[:, 2 * reach + 1 :] - sums[:, : -2 * reach - 1]) / (2 * reach + 1)
    above = np.maximum(strength - mean, 0.0)
    return np.asarray(above / (above.std(axis=1, keepdims=True) + 1e-6))


def _best_chain(
    strength: np.ndarray, scores: np.ndarray, path: np.ndarray, centres: np.ndarray, fps: float
) -> np.ndarray:
    """Beat frames [N] of the chain with the highest sum of onset strength and tempo scores.

    A beat of length L ending at frame t earns, per second of its length, the strength at t above
    its mean since the previous beat, and the score of its tempo there.

    Args:
        strength: [T] onset strength in standard deviations.
        scores: [N, G] log-probabilities of `PERIODS` at the frames `centres` [N].
        path: [N] the candidate to stay near, in each window.
    """
    frames, count = strength.size, LENGTHS.size
    columns = np.arange(count)
    ratio = np.log(LENGTHS[None, :] / LENGTHS[:, None])
    change = -np.minimum(DRIFT_COST * ratio**2, JUMP_COST).astype(np.float32)  # [from, to]
    near = np.abs(np.arange(CANDIDATES) - path[:, None]) <= NEARBY
    relative = scores - np.take_along_axis(scores, path[:, None], 1)
    relative = np.clip(np.where(near, relative, TEMPO_FLOOR), TEMPO_FLOOR, 0.0)
    by_length = np.stack([np.interp(LENGTHS / fps, PERIODS[::-1], row[::-1]) for row in relative])
    smooth = np.convolve(strength, NEIGHBOURS, "same")
    sums = np.concatenate([[0.0], np.cumsum(strength)])
    value = np.zeros((frames, count), dtype=np.float32)  # of the best chain that ends here
    onward = np.zeros((frames, count), dtype=np.float32)  # and goes on with a length
    before = np.zeros((frames, count), dtype=np.int16)
    for start in range(0, frames, LENGTHS[0]):  # a block never needs itself
        now = np.arange(start, min(start + LENGTHS[0], frames))
        previous = now[:, None] - LENGTHS
        inside = previous >= 0
        previous = np.maximum(previous, 0)
        mean = (sums[now + 1, None] - sums[previous + 1]) / LENGTHS
        local = _interpolate_rows(by_length, centres, now)
        earned = smooth[now, None] - mean + TEMPO_WEIGHT * local
        first = smooth[now, None]
        value[now] = np.where(
            inside, onward[previous, columns] + LENGTHS / fps * earned, LENGTHS / fps * first
        )
        options = value[now][:, :, None] + change
        before[now] = options.argmax(axis=1)
        onward[now] = np.take_along_axis(options, before[now][:, None, :].astype(int), 1)[:, 0]
    return _trace_back(value, before)


def _interpolate_rows(rows: np.ndarray, at: np.ndarray, now: np.ndarray) -> np.ndarray:
    """Rows [N, L] given at frames `at` [N], interpolated to frames `now` [K]: [K, L]."""
    position = np.interp(now, at, np.arange(len(at)))
    index = np.minimum(position.astype(int), max(len(at) - 2, 0))
    share = (position - index)[:, None]
    return np.asarray(rows[index] * (1 - share) + rows[np.minimum(index + 1, len(at) - 1)] * share)


def _trace_back(value: np.ndarray, before: np.ndarray) -> np.ndarray:
    tail = max(len(value) - int(LENGTHS[-1]), 0)
    last, column = divmod(int(value[tail:].argmax()), value.shape[1])
    frame = last + tail
    chain = [frame]
    while frame - LENGTHS[column] >= 0:
        frame -= int(LENGTHS[column])
        chain.append(frame)
        column = int(before[frame, column])
    return np.array(chain[::-1])


def _audible(onsets: Onsets, frames: np.ndarray) -> np.ndarray:
    """Whether anything sounds near each of the frames [N]."""
    reach = round(0.07 * onsets.fps)
    loudest = onsets.loudness
    return np.array(
        [loudest[max(frame - reach, 0) : frame + reach + 1].max() > AUDIBLE for frame in frames]
    )


def _sounding(onsets: Onsets, chain: np.ndarray) -> slice:
    """The part of the chain between the first and the last beat at which something sounds."""
    alive = np.flatnonzero(_audible(onsets, chain))
    return slice(alive[0], alive[-1] + 1) if alive.size else slice(0, 0)


def _heard(onsets: Onsets, times: np.ndarray) -> np.ndarray:
    """Which of the beats at `times` [N] are in no gap of `GAP` or more; single rests are kept."""
    heard = _audible(onsets, np.rint(times * onsets.fps).astype(int))
    alive = np.flatnonzero(heard)
    short = np.diff(times[alive]) < GAP
    for first, last in zip(alive[:-1][short], alive[1:][short], strict=True):
        heard[first:last] = True
    return heard


def _refined(chain: np.ndarray, strength: np.ndarray, reach: int = 3) -> np.ndarray:
    """Beat frames [N] moved to the centre of the onset around them, below a frame."""
    padded = np.pad(strength, reach)
    near = padded[chain[:, None] + np.arange(2 * reach + 1)]
    weight = near.sum(axis=1)
    shift = (near * np.arange(-reach, reach + 1)).sum(axis=1) / np.maximum(weight, 1e-6)
    moved = chain + shift * np.minimum(weight, 1.0)
    return np.maximum(np.maximum.accumulate(moved), 0.0)


def _median_tempo(times: np.ndarray, span: int = 8) -> float:
    """BPM, from the median time of `span` beats: finer than from single ones."""
    span = min(span, len(times) - 1)
    return float(60 * span / np.median(times[span:] - times[:-span]))
