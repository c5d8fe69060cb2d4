"""TextToMotion: reproducible sampling in any company, guidance, folders, refusals."""

import json
import logging

import numpy as np
import pytest
import torch
from safetensors.torch import load_file, save_file

from src.shared.config_schema import PROVENANCES
from src.shared.errors import UsageError, UserError
from src.shared.io.files import sha256_file, write_json
from src.shared.model.checkpoint import CARD_FILE, WEIGHTS_FILE
from src.shared.model.clip.core import TextTower
from src.shared.model.generation.motion_generator import PROJECTED, TextToMotion
from src.shared.model.generation.onnx import export_text

PROMPTS = ["a person walks forward", "somebody jumps twice", "人が前に歩く"]


def test_motions_come_prompt_major_with_their_text(generator: TextToMotion):
    motions = generator.generate(PROMPTS, seconds=[0.5, 1.0, 1.5], num_samples=2)
    assert [motion.num_frames for motion in motions] == [15, 15, 30, 30, 45, 45]
    assert [motion.text for motion in motions] == [p for p in PROMPTS for _ in range(2)]
    for motion in motions:
        assert motion.quaternions.dtype == np.float32
        norms = np.linalg.norm(motion.quaternions, axis=-1)
        assert np.allclose(norms, 1, atol=1e-5)


@pytest.mark.parametrize("sampler", ["ddim", "ddpm", "dpm-solver++"])
@pytest.mark.parametrize("conditioning", ["pooled", "tokens"])
def test_a_motion_does_not_depend_on_its_company(make_generator, sampler: str, conditioning: str):
    generator = make_generator(text_conditioning=conditioning)
    seconds = [0.5, 0.9, 0.7]
    together = generator.sample_features(PROMPTS, seconds=seconds, sampler=sampler, num_samples=2)
    for index, prompt in enumerate(PROMPTS):
        alone = generator.sample_features([prompt], seconds=seconds[index], sampler=sampler)
        assert torch.allclose(alone[0], together[2 * index], atol=2e-4)
    assert (together[0] - together[1]).abs().max() > 0.01


def test_seeds(generator: TextToMotion):
    first, again, other = (
        generator.sample_features(PROMPTS[:1], seconds=0.5, seed=seed)[0] for seed in (1, 1, 2)
    )
    assert torch.equal(first, again)
    assert not torch.allclose(first, other)


def test_samples_leave_z_scores(generator: TextToMotion):
    """With an output of zero the predicted clean motion is the mean of the data."""
    weight = generator.denoiser.output_proj.weight
    kept = weight.detach().clone()
    try:
        torch.nn.init.zeros_(weight)
        sample = generator.sample_features(PROMPTS[:1], seconds=0.5)[0]
    finally:
        with torch.no_grad():
            weight.copy_(kept)
    assert torch.allclose(sample, generator.mean.expand_as(sample), atol=1e-5)


def test_guidance_pushes_away_from_the_null(generator: TextToMotion):
    """One step from the same noise: null + scale * (conditional - null)."""
    options = {"seconds": 0.5, "steps": 1, "sampler": "ddim"}
    null, plain, double = (
        generator.sample_features(PROMPTS[:1], guidance_scale=scale, **options)[0]
        for scale in (0.0, 1.0, 2.0)
    )
    assert torch.allclose(double, null + 2 * (plain - null), atol=1e-3)
    assert (plain - null).abs().max() > 1e-4


def test_scale_one_runs_the_denoiser_on_single_batches(generator: TextToMotion):
    sizes: list[int] = []
    handle = generator.denoiser.register_forward_pre_hook(
        lambda _, args: sizes.append(len(args[0]))
    )
    generator.sample_features(PROMPTS, seconds=0.5, steps=3, guidance_scale=1.0)
    generator.sample_features(PROMPTS, seconds=0.5, steps=3, guidance_scale=2.0)
    handle.remove()
    assert sizes == [3] * 3 + [6] * 3


def test_tags_matter(generator: TextToMotion):
    torch.nn.init.normal_(generator.denoiser.blocks[0].film.modulation.weight, std=0.5)
    plain, tagged = (
        generator.sample_features(PROMPTS[:1], seconds=0.5, tags=tags)[0]
        for tags in (None, ["jump"])
    )
    assert not torch.allclose(plain, tagged)


def test_unknown_settings_are_user_errors(generator: TextToMotion):
    with pytest.raises(UsageError, match="sampler 'euler' is unknown"):
        generator.generate(PROMPTS, sampler="euler")
    with pytest.raises(UsageError, match="steps 99"):
        generator.generate(PROMPTS, steps=99)
    with pytest.raises(UserError, match="prompt 2 is empty"):
        generator.generate(["a", ""])


def test_an_untrained_model_refuses(generator: TextToMotion):
    card = generator.card
    generator.card = card.model_copy(update={"trained": False})
    try:
        with pytest.raises(UserError, match=r"untrained.*train generation"):
            generator.generate(PROMPTS)
    finally:
        generator.card = card


def test_warnings_of_length_and_scope(generator: TextToMotion, caplog):
    far = "purple quarterly tax report"
    with caplog.at_level(logging.WARNING):
        generator.generate([*PROMPTS, far], seconds=3.0)
        first = caplog.text
        caplog.clear()
        generator.generate([far], seconds=1.0)
    assert "3.0 s is longer than the 2.0 s" in first
    assert f"{far!r} is far from anything" in first and "walk" in first
    assert "far from" not in caplog.text  # once is enough
    warnings = generator.scope_warnings([*PROMPTS, far])
    assert [warning is None for warning in warnings] == [True, True, True, False]


@pytest.mark.parametrize("half", [False, True])
def test_round_trip(generator: TextToMotion, tmp_path, half: bool):
    generator.save_pretrained(tmp_path, half=half)
    loaded = TextToMotion.from_pretrained(tmp_path, device="cpu")
    assert all(p.dtype == torch.float32 for p in loaded.denoiser.parameters())
    assert loaded.card.tags == generator.card.tags
    assert loaded.scope is not None
    ours, theirs = (g.sample_features(PROMPTS, seconds=0.5) for g in (generator, loaded))
    for a, b in zip(ours, theirs, strict=True):
        assert torch.allclose(a, b, atol=0.05 if half else 1e-6)
    card = json.loads((tmp_path / CARD_FILE).read_text())
    assert card["network"]["embed-dim"] == 32
    assert card["weights"]["dtype"] == ("float16" if half else "float32")
    assert not list(tmp_path.rglob("*.bin")) and not list(tmp_path.rglob("*.pt"))


def test_without_root_track_the_character_stays_in_place(make_generator, generator):
    from src.shared.model.generation.denoiser import MotionDenoiser

    network = generator.network.model_copy(update={"root_track": False})
    stays = TextToMotion(
        MotionDenoiser(network, 2),
        generator.text,
        generator.tokenizer,
        mean=generator.mean[:22],
        std=generator.std[:22],
        card=generator.card,
        device="cpu",
    )
    motion = stays.generate(PROMPTS[:1], seconds=0.5)[0]
    assert motion.quaternions.shape == (15, 22, 4)
    assert np.ptp(motion.root_position, axis=0).max() == 0


def test_foot_lock_can_be_asked_for(generator: TextToMotion):
    free, locked = (
        generator.generate(PROMPTS[:1], seconds=0.5, foot_lock=lock)[0] for lock in (False, True)
    )
    assert np.allclose(free.root_position, locked.root_position)


# Damaged and unfitting folders


@pytest.fixture
def folder(generator: TextToMotion, tmp_path):
    generator.save_pretrained(tmp_path)
    return tmp_path


def rewrite(folder, change) -> None:
    """Change the tensors and let the card vouch for them."""
    tensors = load_file(folder / WEIGHTS_FILE)
    change(tensors)
    save_file(tensors, folder / WEIGHTS_FILE)
    card = json.loads((folder / CARD_FILE).read_text())
    card["weights"]["sha256"] = sha256_file(folder / WEIGHTS_FILE)
    card["weights"]["bytes"] = (folder / WEIGHTS_FILE).stat().st_size
    write_json(folder / CARD_FILE, card)


def test_adapters_of_before_leave_the_output_projection_as_it_is(make_generator, tmp_path):
    generator = make_generator(adapter_ranks=(2, 3))
    generator.save_pretrained(tmp_path)
    with torch.no_grad():
        wanted = {
            name: torch.zeros_like(weight) if PROJECTED in name else weight
            for name, weight in generator.denoiser.state_dict().items()
        }
    own = [f"denoiser.{name}" for name in wanted if PROJECTED in name]
    first, *others = own
    rewrite(tmp_path, lambda tensors: [tensors.pop(name) for name in own])
    found = TextToMotion.from_pretrained(tmp_path, device="cpu").denoiser.state_dict()
    assert others and all(torch.equal(found[name], weight) for name, weight in wanted.items())
    with pytest.raises(UserError, match="write it anew"):
        export_text(tmp_path, tmp_path / "onnx")

    generator.save_pretrained(tmp_path)
    rewrite(tmp_path, lambda tensors: tensors.pop(first))
    with pytest.raises(UserError, match="lack"):
        TextToMotion.from_pretrained(tmp_path)


def test_a_truncated_file(folder):
    data = (folder / WEIGHTS_FILE).read_bytes()
    (folder / WEIGHTS_FILE).write_bytes(data[:-100])
    with pytest.raises(UserError, match=r"bytes.*cut off"):
        TextToMotion.from_pretrained(folder)


def test_a_flipped_bit(folder):
    data = bytearray((folder / WEIGHTS_FILE).read_bytes())
    data[-1] ^= 1
    (folder / WEIGHTS_FILE).write_bytes(data)
    with pytest.raises(UserError, match="SHA-256"):
        TextToMotion.from_pretrained(folder)


def test_a_missing_an_extra_and_a_misshapen_tensor(folder):
    rewrite(folder, lambda tensors: tensors.update({"denoiser.more": torch.zeros(1)}))
    with pytest.raises(UserError, match=r"denoiser.more, which the configuration has no place"):
        TextToMotion.from_pretrained(folder)
    rewrite(folder, lambda tensors: tensors.pop("denoiser.more"))
    rewrite(folder, lambda tensors: tensors.update({"denoiser.null_pooled": torch.zeros(3)}))
    with pytest.raises(UserError, match=r"null_pooled has shape \(3,\).*asks for \(32,\)"):
        TextToMotion.from_pretrained(folder)
    rewrite(folder, lambda tensors: tensors.pop("denoiser.null_pooled"))
    with pytest.raises(UserError, match=r"lack denoiser.null_pooled"):
        TextToMotion.from_pretrained(folder)


def test_a_text_tower_of_another_width(folder, generator: TextToMotion):
    def widen(tensors: dict[str, torch.Tensor]) -> None:
        tensors["text.text_proj.weight"] = torch.zeros(48, 32)

    rewrite(folder, widen)
    with pytest.raises(UserError, match=r"embed-dim mismatch.*48.*32"):
        TextToMotion.from_pretrained(folder)
    with pytest.raises(UserError, match=r"embed-dim mismatch.*48.*32"):
        TextToMotion(
            generator.denoiser,
            TextTower(generator.network.clip, 48),
            generator.tokenizer,
            mean=generator.mean,
            std=generator.std,
            card=generator.card,
        )


def test_another_kind_of_model(folder):
    card = json.loads((folder / CARD_FILE).read_text())
    write_json(folder / CARD_FILE, {**card, "kind": "motion-clip"})
    with pytest.raises(UserError, match="motion-clip, not a motion-generator"):
        TextToMotion.from_pretrained(folder)


def test_a_broken_card(folder):
    card = json.loads((folder / CARD_FILE).read_text())
    write_json(folder / CARD_FILE, {**card, "surprise": 1})
    with pytest.raises(UserError, match="surprise"):
        TextToMotion.from_pretrained(folder)
    (folder / CARD_FILE).write_text("{")
    with pytest.raises(UserError, match="cannot be read"):
        TextToMotion.from_pretrained(folder)


def test_sampled_motion_is_asked_to_look_captured(make_generator):
    generator = make_generator(provenance=True)
    vectors = generator.denoiser.provenance_embed.embedding.weight

    def sample() -> torch.Tensor:
        return generator.sample_features(PROMPTS[:1], seconds=0.5)[0]

    for modulation in (p for n, p in generator.denoiser.named_parameters() if "modulation" in n):
        torch.nn.init.normal_(modulation, std=0.2)
    before = sample()
    with torch.no_grad():
        vectors[1:] += 1.0  # procedural, hand-made, unknown
    assert torch.equal(sample(), before)
    with torch.no_grad():
        vectors[PROVENANCES.index("captured")] += 1.0
    assert not torch.allclose(sample(), before, atol=1e-3)


def test_one_and_two_steps_begin_with_the_learned_one(make_generator):
    generator = make_generator(one_step_rank=2)
    with torch.no_grad():
        for name, parameter in generator.denoiser.named_parameters():
            if name.startswith("one_step."):
                parameter.normal_(std=0.3)

    calls = []
    networks = {"learned": generator._one_step, "own": generator.denoiser}
    for name, network in networks.items():
        network.register_forward_pre_hook(
            lambda _, given, name=name: calls.append((name, int(given[1][0]), len(given[0])))
        )

    def asked(**settings) -> list[tuple[str, int, int]]:
        calls.clear()
        generator.sample_features(["a person walks"], seconds=1.0, **settings)
        return [*calls]

    last = generator.diffusion.config.timesteps - 1
    assert asked(steps=1) == [("learned", last, 1)]
    assert [call[::2] for call in asked(steps=2)] == [("learned", 1), ("own", 1)]
    assert {call[::2] for call in asked(steps=3)} == {("own", 2)}  # guided: a doubled batch
    assert asked(steps=1, guidance_scale=2.0) == [("own", last, 2)]
    assert asked(steps=1, guidance_scale=0.0) == [("learned", last, 1)]  # no text is heard
    generator.diffusion.config = generator.diffusion.config.model_copy(
        update={"timestep_spacing": "leading"}
    )
    assert {name for name, *_ in asked(steps=2)} == {"own"}  # which does not begin at noise
