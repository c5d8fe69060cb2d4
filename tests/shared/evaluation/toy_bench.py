"""A bench whose figures are known: motions are single numbers in the caption's place."""

from collections.abc import Mapping

import numpy as np

from src.shared.evaluation.engine import Bench, Row, Value
from src.shared.evaluation.samples import Clips, MotionSample
from src.shared.evaluation.suites.text import write_motion
from src.shared.evaluation.tables import Column
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import NUM_JOINTS

NUM = 12


def still(number: float) -> Motion:
    """Eight frames of a T-pose so many metres up."""
    quaternions = np.zeros((8, NUM_JOINTS, 4), np.float32)
    quaternions[..., 0] = 1
    root = np.zeros((8, 3), np.float32)
    root[:, 1] = number
    return Motion(quaternions, root, np.zeros((8, 2), np.float32), 30.0, "")


def height(motion: Motion) -> float:
    """What `still` was told."""
    return float(motion.root_position[0, 1])


def toy_sample(heights: np.ndarray) -> MotionSample:
    """Motions of these heights; the caption of motion i is `<i>`, a mark-up trap."""
    n = len(heights)
    clips = Clips(
        [still(h) for h in heights],
        [f"<b>{i}</b>" for i in range(n)],
        ["g"] * n,
        ["t"] * n,
        [{}] * n,
    )
    embedding = np.asarray(heights, np.float64)[:, None]
    return MotionSample.of(clips, embedding, embedding, np.arange(n))


class Heights:
    """The height of each motion, its mean, and the distance of means."""

    name = "heights"
    distance = False
    columns = (Column("height", "height m", 2, "low"), Column("mean", "mean m"))
    definition = "Height of the pelvis, *metres*."

    def __init__(self) -> None:
        self.calls = 0

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> Mapping[str, Value]:
        self.calls += 1
        values = np.array(sample.each("height", height))
        return {"height": values, "mean": float(values.mean())}


class Apart:
    """Distance of mean heights: 0 of a sample from itself."""

    name = "apart"
    distance = True
    columns = (Column("apart", "apart m", 3, "low"),)
    definition = "|a - b|"

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> Mapping[str, Value]:
        own, real = (np.mean(s.each("height", height)) for s in (sample, reference))
        return {"apart": float(abs(own - real))}


def toy_bench(*, lift: float = 0.5) -> Bench[MotionSample]:
    """Real heights 0 to 1.1; generated ones are `lift` higher, a tenth more each replication."""
    real = toy_sample(np.arange(NUM) / 10)
    real = real.rows(range(NUM - 1, -1, -1))  # in another order than what is generated

    def generated(replication: int) -> MotionSample:
        return toy_sample(np.arange(NUM) / 10 + lift + replication / 10)

    families = (Heights(), Apart())
    rows = [
        Row("real", lambda replication: real, fixed=True, real=True),
        Row("generated", generated),
        Row("untrained", lambda replication: toy_sample(np.zeros(NUM)), limit=1),
    ]
    return Bench("toy", "toy clips", lambda: real, rows, families, write=write_motion, worst=3)
