"""The exported tower and denoiser give what PyTorch's give, from the weights beside them."""

from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from src.shared.errors import UserError
from src.shared.io.files import sha256_file
from src.shared.model.checkpoint import WEIGHTS_FILE, read_card, read_tensors, resolve_model
from src.shared.model.clip.core import TextTower
from src.shared.model.generation.denoiser import MotionDenoiser
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.model.generation.onnx import (
    ADAPTED_GRAPH,
    DENOISER_GRAPH,
    TEXT_GRAPH,
    export_text,
)
from src.shared.model.layers import AdaptedLinear
from src.shared.model.onnx_card import READY, TURNED, TextOnnxCard, read_onnx_card
from src.shared.model.onnx_graphs import OnnxDenoiser, open_graph

onnx = pytest.importorskip("onnx")
onnxruntime = pytest.importorskip("onnxruntime")
pytest.importorskip("onnxscript")

PROMPTS = ["a person walks forward", "人が前に歩く", "jump"]


def with_pairs(generator: TextToMotion) -> TextToMotion:
    """With a tower of token pairs instead of the random-init transformer."""
    clip = generator.network.clip.model_copy(
        update={"text_model": "pairs", "text_pairs": 300, "text_places": 3, "text_place_keys": True}
    )
    tower = TextTower(clip, generator.network.embed_dim)
    ids, _ = generator.tokenizer(PROMPTS)
    tower.encoder.keys[:290] += 3
    tower.encoder.keys[290:] = torch.arange(10, dtype=torch.int32) + 60_000
    tower.get_buffer("places").normal_()
    tower.get_buffer("keys").normal_()
    assert int(ids.max()) > 3
    generator.text = tower.freeze()
    generator.network = generator.network.model_copy(update={"clip": clip})
    return generator


def adapter_weights(denoiser: MotionDenoiser, opened: torch.Tensor) -> np.ndarray:
    """What adapted.onnx hears for texts that open these [B, A], as docs/onnx.md says."""
    maps = [m for _, m in sorted(denoiser.named_modules()) if isinstance(m, AdaptedLinear)]
    tables = [part.table(layer) for part in maps if part.rank for layer in (0, 1)]
    own, any_open = opened.argmax(-1), opened.any(-1)[:, None]
    rows = torch.cat([table[own].flatten(1) for table in tables], 1)
    return (rows * any_open).numpy()


def opened_ready(folder: Path, graph: str, weights: tuple[str, ...]) -> Any:
    """A graph whose weights whoever opens it hands over, as the studio's page does."""
    stored = read_tensors(folder, read_card(folder))
    options = onnxruntime.SessionOptions()
    options.graph_optimization_level = onnxruntime.GraphOptimizationLevel.ORT_DISABLE_ALL
    files = {
        name: (value.T if name.endswith(TURNED) else value).float().contiguous().numpy().tobytes()
        for name in weights
        for value in [stored[name.removesuffix(TURNED)]]
    }
    options.add_external_initializers_from_files_in_memory(
        list(files), list(files.values()), [len(each) for each in files.values()]
    )
    return onnxruntime.InferenceSession((folder / (READY + graph)).read_bytes(), options)


@pytest.mark.parametrize(
    ("pairs", "settings"),
    [
        (
            True,
            {"constraints": True, "adapter_ranks": (2, 3), "num_layers": 1, "one_step_rank": 2},
        ),
        pytest.param(
            False,
            {"text_conditioning": "tokens", "provenance": True, "frames_per_token": 2},
            marks=pytest.mark.slow,
        ),
    ],
)
@torch.no_grad()
def test_graphs_compute_what_the_networks_do(
    make_generator, tmp_path: Path, monkeypatch, pairs: bool, settings: dict
) -> None:
    # Of two adapters some maps are int8, of others the larger one alone is.
    monkeypatch.setattr("src.shared.model.checkpoint.SMALLEST", 80)
    generator = make_generator(**settings)
    if pairs:
        generator = with_pairs(generator)
        for parameter in generator.denoiser.parameters():
            parameter.add_(0.05 * torch.randn_like(parameter))  # adapters start at zero
        generator.denoiser.places = torch.randn(3, 32)
        generator.denoiser.adapter_of = torch.tensor([2, 2, 1])
    generator.save_pretrained(tmp_path / "model", int8=True)
    generator = TextToMotion.from_pretrained(tmp_path / "model", device="cpu")
    export_text(tmp_path / "model", tmp_path / "onnx")

    card = read_onnx_card(tmp_path / "onnx", TextOnnxCard)
    weights = [tmp_path / folder / WEIGHTS_FILE for folder in ("model", "onnx")]
    assert sha256_file(weights[0]) == sha256_file(weights[1]) == card.model
    small = [graph.bytes for graph in card.graphs.values()]
    assert sum(small) < weights[0].stat().st_size
    again = TextToMotion.from_pretrained(tmp_path / "onnx", device="cpu")
    assert torch.equal(again.mean, generator.mean)

    ids, words = generator.tokenizer(PROMPTS)
    text = generator.text(ids, words)
    session = open_graph(tmp_path / "onnx", TEXT_GRAPH, 1)
    outputs = session.run(None, {"input_ids": ids.numpy(), "attention_mask": words.numpy()})
    np.testing.assert_allclose(outputs[0], text.pooled, atol=1e-5)
    if text.closeness is not None:
        np.testing.assert_allclose(outputs[-1], text.closeness, atol=1e-5)

    graphs = {DENOISER_GRAPH: text}
    if settings.get("adapter_ranks"):
        graphs[ADAPTED_GRAPH] = generator.denoiser.with_adapters(text)
        read = onnx.load(tmp_path / "onnx" / ADAPTED_GRAPH, load_external_data=False).graph
        assert not [each.name for each in read.initializer if "adapters" in each.name]
    assert card.graphs.keys() == {TEXT_GRAPH, *graphs, *(READY + graph for graph in graphs)}
    opened = {
        graph: (
            open_graph(tmp_path / "onnx", graph, 1),
            opened_ready(tmp_path / "onnx", graph, card.graphs[READY + graph].weights),
        )
        for graph in graphs
    }
    runs = OnnxDenoiser(tmp_path / "onnx", generator.network, card, 1)
    networks: list[tuple[Any, Any]] = [(runs, generator.denoiser)]
    assert bool(card.shifted) == (generator.denoiser.one_step is not None)
    if once := generator.denoiser.in_one_step():
        networks.append((runs.in_one_step(), once))
    for (graph, heard), frames in product(graphs.items(), (8, 61)):
        session, ready = opened[graph]
        x = torch.randn(3, frames, 23, 6)
        mask = torch.arange(frames) < torch.tensor([frames, frames, frames - 3])[:, None]
        known = torch.rand(x.shape) < 0.1
        t, tag = torch.tensor([0, 20, 49]), torch.tensor([0, 1, 2])
        feed = {"x": x, "t": t, "tag": tag, "mask": mask, "pooled": text.pooled, "known": known}
        if settings.get("text_conditioning"):
            feed |= {"tokens": torch.as_tensor(outputs[1]), "token_mask": words.bool()}
        if heard.opened is not None:
            np.testing.assert_array_equal(outputs[1], heard.opened)
            own = adapter_weights(generator.denoiser, heard.opened)
            feed["adapter"] = torch.from_numpy(own)
        assert feed.keys() == card.graphs[graph].inputs.keys()
        arrays = {name: value.numpy() for name, value in feed.items()}
        (found,) = session.run(None, arrays)
        np.testing.assert_allclose(ready.run(None, arrays)[0], found, atol=1e-5)
        told = {
            "known": known if settings.get("constraints") else None,
            "provenance": torch.zeros(3).long() if settings.get("provenance") else None,
        }
        for at, (ours, network) in enumerate(networks):
            wanted = network(x, t, heard, tag, mask, **told)
            assert wanted.abs().max() > 0.3
            for each in [ours(x, t, heard, tag, mask, **told).numpy(), *[found][at:]]:
                np.testing.assert_allclose(each[mask], wanted[mask], atol=1e-4)


def test_shipped_graphs_hold_no_weights() -> None:
    folder = resolve_model("starter")
    for name in [each.name for each in folder.glob("*.onnx") if not each.name.startswith(READY)]:
        stored = onnx.load(folder / name, load_external_data=False).graph.initializer
        held = [each for each in stored if each.data_location != onnx.TensorProto.EXTERNAL]
        assert sum(len(each.raw_data) for each in held) < 4096


def test_weights_that_no_graph_can_tell_apart_are_refused(make_generator, tmp_path: Path) -> None:
    make_generator(one_step_rank=2).save_pretrained(tmp_path / "model")  # its biases are all zero
    with pytest.raises(UserError, match="cannot tell them apart; train the model on"):
        export_text(tmp_path / "model", tmp_path / "onnx")
    assert not (tmp_path / "onnx").exists()
