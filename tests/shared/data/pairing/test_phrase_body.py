"""Bodies of phrases: the trajectory's pelvis, the clips' joints, no jumps at seams."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from src.shared.data.pairing.music import SyntheticMusic
from src.shared.data.pairing.phrase_motion import (
    SEAM_FRAMES,
    Piece,
    _told,
    phrase_body,
    plain_warp,
    read_pair,
)
from src.shared.data.pairing.prepare_audio import PairOptions, prepare_audio
from src.shared.data.phrases.layout import decode_body, parse_manifest
from src.shared.data.prepare import prepare
from src.shared.data.prepared import PreparedData
from src.shared.data.sources import SyntheticSource
from src.shared.io.files import sha256_file
from src.shared.motion.features import ROOT_ROW, decode_features

OPTIONS = PairOptions(min_seconds=3.0, max_seconds=5.0, synthetic_clips=True)
MUSIC = SyntheticMusic(3, seed=1, seconds=10.0)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> PreparedData:
    out = tmp_path_factory.mktemp("clips")
    prepare([SyntheticSource(60)], out, mirror=False, workers=1)
    return PreparedData.open(out)


@pytest.fixture(scope="module")
def pairs(data: PreparedData, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("pairs")
    prepare_audio(data, [MUSIC], out, options=OPTIONS)
    return out


def test_one_clip_at_its_own_pace_is_itself(data: PreparedData) -> None:
    record = max(data.records(), key=lambda r: r.num_frames)
    features = data.features(record)
    frames = record.num_frames - 3
    piece = Piece(record.id, 0, record.num_frames - 1, 0)
    body = phrase_body([piece], plain_warp(frames / 30 + 1), frames, lambda _: features)
    assert torch.allclose(body[:, :ROOT_ROW], features[:frames, :ROOT_ROW], atol=1e-4)
    assert torch.allclose(body[:, ROOT_ROW], features[:frames, ROOT_ROW], atol=5e-3)


def test_seams_turn_one_pose_smoothly_into_the_next(data: PreparedData) -> None:
    first, second = data.features(data.records()[0])[:60], data.features(data.records()[-1])[:60]
    clips = {"a": first, "b": second}
    pieces = [Piece("a", 0, 59, 0), Piece("b", 0, 59, 60 - SEAM_FRAMES)]
    length = 120 - SEAM_FRAMES - 2
    body = phrase_body(pieces, plain_warp(length / 30 + 1), length, lambda name: clips[name])
    assert torch.allclose(body[:40, 1:ROOT_ROW], first[:40, 1:ROOT_ROW], atol=1e-4)
    assert torch.allclose(
        body[60:, 1:ROOT_ROW], second[13:73][: length - 60, 1:ROOT_ROW], atol=1e-4
    )
    step = (body[1:, 1:ROOT_ROW] - body[:-1, 1:ROOT_ROW]).norm(dim=-1).max()
    alone = max(
        (c[1:, 1:ROOT_ROW] - c[:-1, 1:ROOT_ROW]).norm(dim=-1).max() for c in (first, second)
    )
    assert step < alone + 0.4
    contacts = body[:, ROOT_ROW, 4:]
    assert contacts.min() >= 0 and contacts.max() <= 1


def test_every_phrase_has_a_body_whose_pelvis_is_the_trajectorys(pairs: Path) -> None:
    phrases = list(parse_manifest([(pairs / "manifest.json").read_bytes()], "here"))
    assert len(phrases) >= 3
    for phrase in phrases:
        assert phrase.body is not None
        stored = (pairs / phrase.body.path).read_bytes()
        assert sha256_file(pairs / phrase.body.path) == phrase.body.sha256
        trajectory = np.load(pairs / phrase.motion.path)
        body = decode_body(stored)
        assert body.shape == (len(trajectory), 23, 6)
        shown = decode_features(torch.from_numpy(body))
        path = shown.root_position - shown.root_position[0]
        truth = trajectory[:, :3] - trajectory[0, :3]
        assert np.abs(path[:, 1] - truth[:, 1]).max() < 2e-3
        step, wanted = (
            np.linalg.norm(np.diff(p[:, [0, 2]], axis=0), axis=1) for p in (path, truth)
        )
        assert np.abs(step - wanted).max() < 1e-3, "metres a frame"


def test_what_a_phrase_shows_has_a_name(pairs: Path, data: PreparedData) -> None:
    for phrase in json.loads((pairs / "manifest.json").read_text())["phrases"]:
        pieces, _ = read_pair(phrase["pair"])
        longest = max(pieces, key=lambda piece: piece.last - piece.first)
        [record] = [r for r in data.records() if r.id == longest.clip]
        assert phrase["tag"] == record.tag
        assert phrase["clips"] == sorted({piece.clip.split("~")[0] for piece in pieces})
        assert phrase["caption"] in data.captions(record)["en"]
        assert phrase["pair"]["captions"].keys() == {piece.clip for piece in pieces}


def test_a_sentence_of_ones_own_goes_before_a_generated_one(data: PreparedData) -> None:
    record = data.records("train")[0]
    assert _told(record, data) == data.captions(record)["en"][0]
    assert _told(replace(record, captions={"de": ["sie schlendert"]}), data) == "sie schlendert"
    own = {"de": ["sie schlendert"], "en": ["she strolls"]}
    assert _told(replace(record, captions=own), data) == "she strolls"
    assert _told(replace(record, group="", captions={}), data) == ""


def test_bodies_are_added_to_an_older_folder_and_mended(pairs: Path, data: PreparedData) -> None:
    files = [p for p in sorted(pairs.rglob("*")) if p.is_file() and p.parent.name != "phrases"]
    before = {path: (path.stat().st_mtime_ns, sha256_file(path)) for path in files}
    bodies = sorted(pairs.glob("motion/*/body.npz"))
    for mark in pairs.glob("phrases/*.json"):  # as before bodies were written
        entry = json.loads(mark.read_text())
        entry.pop("body", None)
        mark.write_text(json.dumps(entry))
    bodies[0].unlink()
    bodies[1].write_bytes(b"damaged")
    prepare_audio(data, [MUSIC], pairs, options=OPTIONS)
    assert {path: sha256_file(path) for path in files} == {p: h for p, (_, h) in before.items()}
    sounds = [path for path in files if path.name in ("features.npz", "trajectory.npy")]
    assert all(path.stat().st_mtime_ns == before[path][0] for path in sounds)
