"""A pretrained XLM-R folder in the text stage: frozen and read once, or at a rate of its own."""

from pathlib import Path

import pytest
import torch
from tiny_stage import NETWORK, SETTINGS, generation_config, tiny_network, train_generation
from typer.testing import CliRunner

from src.shared.config_loader import load_train
from src.shared.config_schema import NetworkConfig, TrainTextConfig
from src.shared.data.captions.book import packaged_book
from src.shared.model.clip.core import small_text_config
from src.shared.model.clip.pretrained import ClipBundle
from src.shared.model.generation.motion_generator import TextToMotion
from src.train import text_stages
from src.train.engine import Trainer
from src.train.launch import STAGES
from src.train.text_stages import MEANS_FILE
from src.train.train_text import LabelledTower, TextTask
from tests.shared.data.captions.caption_labels import SYNTHETIC


@pytest.fixture(scope="module")
def network(tmp_path_factory: pytest.TempPathFactory) -> NetworkConfig:
    """One whose text model is a folder as transformers keeps it: a tiny XLM-R and its tokenizer."""
    from tokenizers import Tokenizer, models, pre_tokenizers, processors
    from transformers import PreTrainedTokenizerFast
    from transformers.models.xlm_roberta.modeling_xlm_roberta import XLMRobertaModel

    folder = tmp_path_factory.mktemp("hub") / "xlm-r"
    network = tiny_network()
    book = packaged_book()
    captions = [t for labels in SYNTHETIC for t in book.captions(labels, num=6, seed=0)["en"]]
    words = sorted({word for text in captions for word in text.casefold().split()})
    characters = "abcdefghijklmnopqrstuvwxyz"
    pieces = dict.fromkeys(["<s>", "<pad>", "</s>", "<unk>", *words[:900], *characters])
    tokenizer = Tokenizer(
        models.Unigram([(piece, -1.0 if piece in words else -9.0) for piece in pieces], unk_id=3)
    )
    tokenizer.pre_tokenizer = pre_tokenizers.Whitespace()
    tokenizer.post_processor = processors.TemplateProcessing(
        single="<s> $A </s>", special_tokens=[("<s>", 0), ("</s>", 2)]
    )
    PreTrainedTokenizerFast(
        tokenizer_object=tokenizer, bos_token="<s>", eos_token="</s>", pad_token="<pad>",
        unk_token="<unk>",
    ).save_pretrained(folder)  # fmt: skip
    torch.manual_seed(0)
    encoder = XLMRobertaModel(small_text_config(network.clip), add_pooling_layer=False)
    encoder.save_pretrained(folder)
    return tiny_network(f"clip.text-model='{folder}'")


def learn(data: Path, output: Path, network: NetworkConfig, *overrides: str) -> TextTask:
    settings = [*SETTINGS, f"data='{data}'", f"output='{output}'", "clip=null", "languages=[en]"]
    settings += ["captions-per-group=6", "batch-size=32", *overrides]
    config = load_train(None, TrainTextConfig, settings)
    trainer = Trainer(config, lambda c: TextTask(c, network), command="again")
    trainer.train()
    assert isinstance(trainer.task, TextTask)
    return trainer.task


def share_right(task: TextTask) -> float:
    """Of the captions that were read: how many land nearest to their place."""
    assert isinstance(task.module, LabelledTower)
    tower = task.module.tower
    owner = torch.zeros(len(task.means), dtype=torch.long)
    for (_, group, _), rows in task.rows.items():
        owner[list(rows)] = group
    with torch.no_grad():
        nearest = tower.pool(task.means.float()) @ task.module.places.T
    return (nearest / task.module.places.norm(dim=-1)).argmax(-1).eq(owner).float().mean().item()


def test_a_frozen_encoder_reads_each_caption_once_and_the_rest_learns(
    prepared: Path, tmp_path: Path, network: NetworkConfig, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = ["steps=400", "learning-rate=0.01", "encoder-learning-rate=0", "ema-decay=0.9"]
    task = learn(prepared, tmp_path / "text", network, *first)
    assert share_right(task) > 10 / len(task.groups)  # of a random encoder's means
    read = [texts for group in task.fresh + task.sentences for texts in group.values()]
    assert any(task.sentences) and len(task.means) == 2 * sum(map(len, read))
    assert (tmp_path / "text" / MEANS_FILE).is_file()
    learned = ClipBundle.from_pretrained(tmp_path / "text")
    from transformers import AutoModel

    pretrained = AutoModel.from_pretrained(network.clip.text_model).state_dict()
    for key, value in learned.clip.text.encoder.state_dict().items():
        if key in pretrained and not key.startswith("pooler"):  # is not used
            assert torch.equal(value, pretrained[key]), key

    def read_again(*_: object) -> None:
        raise AssertionError("the captions are read a second time")

    monkeypatch.setattr(text_stages, "masked_mean", read_again)
    task.to(torch.device("cpu"))  # as a resumed run does: from the file
    monkeypatch.undo()
    config = generation_config(prepared, tmp_path / "text", tmp_path / "made", "steps=2")
    train_generation(config, network)


def test_a_pretrained_encoder_learns_at_its_own_rate(
    prepared: Path, tmp_path: Path, network: NetworkConfig
) -> None:
    config = load_train(
        None,
        TrainTextConfig,
        [*SETTINGS, f"data='{prepared}'", f"output='{tmp_path / 'x'}'", "clip=null",
         "languages=[en]", "captions-per-group=2"],
    )  # fmt: skip
    trainer = Trainer(config, lambda c: TextTask(c, network), command="again")
    rates = {
        id(weight): group["initial_lr"]
        for group in trainer.optimizer.param_groups
        for weight in group["params"]
    }
    for name, weight in trainer.module.named_parameters():
        if ".pooler." in name:  # is not used
            assert not weight.requires_grad
            continue
        wanted = 1e-5 if name.startswith("tower.encoder.") else config.learning_rate
        assert rates[id(weight)] == wanted, name


@pytest.mark.parametrize("tower", ["xlm-r", "pairs"])
def test_the_recipe_of_default_from_captions_to_motions(
    prepared: Path, tmp_path: Path, network: NetworkConfig, tower: str
) -> None:
    """Its three stages as commands; sizes and lengths alone are smaller."""
    sizes = [f"network.{size}" for size in NETWORK]
    common = ["--config", "default", "--data", str(prepared), *SETTINGS, *sizes, "steps=2"]
    model = "pairs" if tower == "pairs" else network.clip.text_model
    common += [f"network.clip.text-model='{model}'", "languages=[en]"]
    for stage, name, given in (
        ("text", "text", ["captions-per-group=2"]),
        ("clip", "clip", [f"text='{tmp_path / 'text'}'"]),
        ("generation", "made", [f"clip='{tmp_path / 'clip'}'"]),
    ):
        done = CliRunner().invoke(
            STAGES[stage].app(), [*common, *given, "--output", str(tmp_path / name)]
        )
        assert done.exit_code == 0, done.output
    model = TextToMotion.from_pretrained(tmp_path / "made")
    assert model.network.generation.prediction_type == "sample"
    pretrained = ClipBundle.from_pretrained(tmp_path / "text").clip.text.encoder.state_dict()
    kept = model.text.encoder.state_dict()
    assert all(torch.equal(value, kept[key]) for key, value in pretrained.items())
