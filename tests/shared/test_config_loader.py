"""YAML and overrides become typed configurations, and each mistake is one helpful line."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.config_audio import DecoderConfig, UNetConfig
from src.shared.config_loader import (
    config_keys,
    dump_config,
    load_config,
    load_network,
    load_train,
    load_yaml,
    parse_overrides,
    profile_names,
    recipe_network,
    split_network_overrides,
)
from src.shared.config_schema import (
    Config,
    DiffusionConfig,
    NetworkConfig,
    TrainClipConfig,
    TrainConfig,
    TrainGenerationConfig,
)
from src.shared.errors import UsageError


def test_default_profile_is_the_document_to_the_letter() -> None:
    network = load_network("default")
    assert (network.embed_dim, network.root_track) == (128, True)
    generation = network.generation
    assert (generation.num_heads, generation.num_layers, generation.num_bones) == (4, 3, 22)
    assert generation.diffusion_steps == 100
    assert (generation.prediction_type, generation.text_conditioning) == ("epsilon", "pooled")
    assert (network.clip.motion_num_heads, network.clip.motion_num_layers) == (4, 2)
    assert generation.post_processing.smoothing_kernel == 3


@pytest.mark.parametrize("profile", ["default", "spark", "lightweight"])
def test_every_profile_round_trips(profile: str) -> None:
    network = load_network(profile)
    assert profile in profile_names()
    assert load_config(NetworkConfig, dump_config(network), "copy") == network


@pytest.mark.parametrize("profile", ["default", "spark", "lightweight"])
def test_what_is_predicted_as_it_is_has_no_limit(profile: str) -> None:
    """Ruling 105: a pelvis that lies is 20 deviations from those that stand."""
    generation = load_network(profile).generation
    assert (generation.clip_sigma is None) == (generation.prediction_type == "sample")


@pytest.mark.parametrize("model_class", [TrainClipConfig, TrainGenerationConfig])
def test_training_files_load_and_round_trip(model_class: type[TrainConfig]) -> None:
    config = load_train(None, model_class)
    assert load_config(model_class, dump_config(config), "copy") == config


@pytest.mark.parametrize("name", ["default", "spark"])
def test_a_recipe_names_what_it_changes_of_its_profile(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = load_train(name, TrainGenerationConfig, ["steps=7"])
    assert (config.profile, config.steps, config.losses.velocity) == (name, 7, 1.0)
    assert load_train(name, TrainClipConfig).encoder_learning_rate == 0
    changes = [
        line.removeprefix("network.") for line in recipe_network(name, TrainGenerationConfig)
    ]
    network = load_network(name, overrides=changes)
    assert network.generation.prediction_type == "sample"
    before = load_network(name).generation
    told = {name: getattr(before, name) for name in ("prediction_type", "clip_sigma")}
    generation = network.generation.model_copy(update=told)
    assert network.model_copy(update={"generation": generation}) == load_network(name)

    class TrainOtherConfig(TrainConfig):
        pass

    with pytest.raises(UsageError, match=f"recipe {name} says nothing for train_other; leave"):
        load_train(name, TrainOtherConfig)

    monkeypatch.chdir(tmp_path)
    Path(name).write_text("steps: 9\n")  # a file of that name is what was meant
    assert load_train(name, TrainGenerationConfig).profile == "lightweight"
    assert not recipe_network(name, TrainGenerationConfig)


@pytest.mark.parametrize(
    ("override", "parts"),
    [
        ("generation.num-head=5", ["generation.num-head", "5", "generation.num-heads"]),
        ("num-heads=4", ["num-heads", "4", "generation.num-heads"]),
        ("generation.num-heads=5", ["num-heads 5", "divide", "128"]),
        ("generation.num-heads=128", ["num-heads 128", "even"]),
        ("clip.motion-num-heads=3", ["clip.motion-num-heads 3", "divide"]),
        ("clip.text-num-heads=5", ["text-num-heads 5", "text-hidden-size"]),
        ("generation.num-heads=true", ["generation.num-heads", "true", "integer"]),
        ("embed-dim=wide", ["embed-dim", '"wide"', "integer"]),
        ("root-track=1", ["root-track", "1", "boolean"]),
        ("generation.dropout=1.5", ["generation.dropout", "1.5", "less than 1"]),
        ("generation.dropout=.nan", ["generation.dropout", "finite"]),
        ("generation.beta-schedule=cosin", ["beta-schedule", "cosin", "cosine"]),
        ("generation.post-processing.smoothing-kernel=2", ["smoothing-kernel 2", "odd"]),
        ("generation=5", ["generation", "5", "section"]),
        ("embed-dim", ["embed-dim", "key=value"]),
        ("embed-dim=[", ["embed-dim", "YAML"]),
    ],
)
def test_a_wrong_override_is_one_line_with_key_value_and_remedy(
    override: str, parts: list[str]
) -> None:
    with pytest.raises(UsageError) as caught:
        load_network("default", overrides=[override])
    message = str(caught.value)
    assert "\n" not in message
    for part in ["command line", *parts]:
        assert part in message


def test_a_wrong_file_is_named(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text("steps: 10\nbatch-sise: 4\n")
    with pytest.raises(UsageError, match=r"mine\.yaml: unknown key batch-sise .*4.* batch-size$"):
        load_train(path, TrainClipConfig)
    path.write_text("steps: ten\n")
    with pytest.raises(UsageError, match=r'mine\.yaml: steps = "ten" should be a valid integer'):
        load_train(path, TrainClipConfig)
    path.write_text("min-frames: 64\nmax-frames: 32\n")
    with pytest.raises(UsageError, match=r"mine\.yaml: max-frames 32 is below min-frames 64"):
        load_train(path, TrainClipConfig)
    with pytest.raises(UsageError, match="command line: max-frames 32 is below min-frames 64"):
        path.write_text("min-frames: 64\n")
        load_train(path, TrainClipConfig, ["max-frames=32"])


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("steps: [", ["line", "YAML"]),
        ("steps: 1\nsteps: 2", ["line 2", "'steps'", "twice"]),
        ("batch-size: 1\nbatch_size: 2", ["batch-size", "twice"]),
        ("- 1", ["mine.yaml", "list"]),
    ],
)
def test_broken_yaml(tmp_path: Path, text: str, parts: list[str]) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(text)
    with pytest.raises(UsageError) as caught:
        load_train(path, TrainClipConfig)
    assert all(part in str(caught.value) for part in parts)


def test_missing_and_binary_files(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="nowhere"):
        load_yaml(tmp_path / "nowhere.yaml")
    binary = tmp_path / "binary.yaml"
    binary.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(UsageError, match="UTF-8"):
        load_yaml(binary)
    empty = tmp_path / "empty.yaml"
    empty.write_text("# nothing\n")
    assert load_yaml(empty) == {}


def test_unknown_profile_names_the_nearest() -> None:
    with pytest.raises(UsageError, match=r"'lightwait'.*'lightweight'"):
        load_network("lightwait")


def test_a_users_own_profile(tmp_path: Path) -> None:
    path = tmp_path / "network.yaml"
    path.write_text("profiles:\n  mine:\n    embedDim: 64\n    generation: {num_heads: 2}\n")
    network = load_network("mine", path)
    assert (network.embed_dim, network.generation.num_heads) == (64, 2)


def test_both_spellings_of_the_documents() -> None:
    values = {"num_timesteps": 50, "predict_epsilon": False, "sampling-steps": 5}
    config = load_config(DiffusionConfig, values, "test")
    assert (config.timesteps, config.prediction_type) == (50, "sample")
    assert load_config(DiffusionConfig, {"timesteps": 50}, "test").timesteps == 50
    named = load_config(DiffusionConfig, {"prediction_type": "x0"}, "test")
    assert named.prediction_type == "sample"


@pytest.mark.parametrize(
    ("model_class", "printed", "ours"),
    [
        (DiffusionConfig, {"use_ddim": False, "ddim_eta": 0.5}, {"sampler": "ddpm", "eta": 0.5}),
        (
            DiffusionConfig,
            {"clip_denoised": False, "rescale_timesteps": False},
            {"clip_sigma": None},
        ),
        (UNetConfig, {"audio_cond_dim": 163, "time_embed_dim": 64}, {"time_embed_dim": 64}),
        (
            DecoderConfig,
            {"input_dim": 25, "activation": "gelu", "num_layers": 2},
            {"num_layers": 2},
        ),
        (TrainClipConfig, {"betas": [0.9, 0.999], "mixed_precision": False}, {"precision": "no"}),
        (TrainClipConfig, {"output_dir": "there", "eps": 1e-8}, {"output": "there"}),
    ],
)
def test_settings_as_the_documents_print_them(
    model_class: type[Config], printed: dict[str, Any], ours: dict[str, Any]
) -> None:
    found = load_config(model_class, printed, "test")
    assert {name: getattr(found, name) for name in ours} == ours


@pytest.mark.parametrize(
    ("model_class", "override", "message"),
    [
        (DiffusionConfig, "clip_range=1.0", "give clip-sigma"),
        (DecoderConfig, "activation=relu", "activation can only be gelu here"),
        (UNetConfig, "audio_cond_dim=80", "can only be 163 here"),
        (TrainClipConfig, "num_epochs=100", "give steps"),
        (TrainClipConfig, "ema-update-every=10", "can only be 1 here"),
    ],
)
def test_printed_settings_that_cannot_be_chosen_say_what_can(
    model_class: type[Config], override: str, message: str
) -> None:
    with pytest.raises(UsageError, match=f"command line: .*{message}"):
        load_config(model_class, {}, "test", [override])


def test_the_later_of_two_names_of_one_setting_counts() -> None:
    assert load_train(None, TrainClipConfig, ["output-dir=mine"]).output == "mine"


def test_scalars_are_yaml_1_2() -> None:
    flat = parse_overrides(["a=no", "b=1e-3", "c=null", "d=", "e=[1, x]", "f=true", "g=-2.5E+3"])
    values = {"a": "no", "b": 1e-3, "c": None, "d": None, "e": [1, "x"], "f": True, "g": -2500.0}
    assert flat == values
    assert load_train(None, TrainClipConfig, ["precision=no"]).precision == "no"


def test_overrides_reach_lists_and_sections() -> None:
    config = load_train(None, TrainGenerationConfig, ["languages=[en, ja]", "losses={velocity: 3}"])
    assert config.languages == ("en", "ja")
    assert config.losses.velocity == 3.0
    shipped = load_train(None, TrainGenerationConfig)
    assert config.losses.reconstruction == shipped.losses.reconstruction  # merged, not replaced


def test_network_overrides_are_parted() -> None:
    own, network = split_network_overrides(["steps=3", "network.embed-dim=64"])
    assert (own, network) == (["steps=3"], ["network.embed-dim=64"])
    assert load_network("default", overrides=network).embed_dim == 64


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("network.generation.num-heds", "4",
         r"unknown key network\.generation\.num-heds \(value 4\);"
         r" the nearest valid key is network\.generation\.num-heads$"),
        ("network.generation.num-heads", "-4", r"^command line: network\.generation\.num-heads"),
        ("network.generaton.num-heads", "4", r"key network\.generaton\.num-heads .* network\.gen"),
        ("generation.num-heads", "4",
         r"^command line: unknown key generation\.num-heads \(value 4\);"
         r" the nearest valid key is network\.generation\.num-heads$"),
    ],
)  # fmt: skip
def test_keys_are_named_as_they_were_written(key: str, value: str, message: str) -> None:
    own, network = split_network_overrides([f"{key}={value}"])
    with pytest.raises(UsageError, match=message):
        load_train(None, TrainGenerationConfig, own)
        load_network("default", overrides=network)


@given(st.sampled_from(sorted(config_keys(NetworkConfig))), st.integers(0, 30), st.data())
def test_a_misspelt_key_never_passes(key: str, position: int, data: st.DataObject) -> None:
    position = min(position, len(key))
    letter = data.draw(st.sampled_from("abcxyz"))
    wrong = key[:position] + letter + key[position:]
    with pytest.raises(UsageError) as caught:
        load_network("default", overrides=[f"{wrong}=1"])
    assert "nearest valid key is" in str(caught.value)


@given(st.text(max_size=40))
def test_any_override_text_gives_a_config_or_a_usage_error(text: str) -> None:
    try:
        assert isinstance(load_network("default", overrides=[text]), Config)
    except UsageError as error:
        assert "\n" not in str(error)


def test_no_heavy_import() -> None:
    code = "import sys, src.shared.config_loader; sys.exit('torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
