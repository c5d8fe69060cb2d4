"""Constraints: what is known comes out as given, with any network, sampler and company."""

from dataclasses import replace

import pytest
import torch

from src.shared.config_schema import DiffusionConfig
from src.shared.errors import UsageError
from src.shared.model.diffusion import GaussianDiffusion
from src.shared.model.generation.constraint import Constraint, KnownBatch
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.motion.features import FORWARD, LEFT_CONTACT, ROOT_ROW, mirror_features
from src.shared.motion.skeleton import JOINT_INDEX

PROMPT = ["a person walks forward"]


def some(frames: int, generator: TextToMotion, seed: int = 0) -> Constraint:
    """A third of all entries known, at values such as data has."""
    draws = torch.Generator().manual_seed(seed)
    noise = torch.randn(frames, *generator.mean.shape, generator=draws)
    known = torch.rand(noise.shape, generator=draws) < 1 / 3
    return Constraint(noise * generator.std + generator.mean, known)


@pytest.mark.parametrize("sampler", ["ddim", "ddpm", "dpm-solver++"])
@pytest.mark.parametrize("prediction", ["sample", "epsilon", "v"])
@pytest.mark.parametrize("learned", [True, False])
def test_known_entries_come_out_exactly(make_generator, sampler, prediction, learned: bool):
    generator = make_generator(prediction_type=prediction, constraints=learned)
    constraint = some(20, generator)
    options = {"seconds": 20 / 30, "sampler": sampler, "steps": 4}
    made = generator.sample_features(PROMPT, constraints=[constraint], **options)[0]
    free = generator.sample_features(PROMPT, **options)[0]
    assert torch.equal(made[constraint.known], constraint.values[constraint.known])
    assert torch.isfinite(made).all()
    assert not torch.allclose(made[~constraint.known], free[~constraint.known], atol=1e-4)


@pytest.mark.parametrize("prediction", ["sample", "epsilon", "v"])
def test_the_sampler_is_told_the_known_values(prediction: str):
    """What `held` returns stands for the known clean values, at every step."""
    diffusion = GaussianDiffusion(DiffusionConfig(timesteps=50, prediction_type=prediction))
    values, noise = torch.randn(2, 5, 3, 2), torch.randn(2, 5, 3, 2)
    known = torch.rand(values.shape) < 0.5
    given = KnownBatch.of(
        [Constraint(row, mask) for row, mask in zip(values, known, strict=True)],
        5,
        torch.zeros(3, 2),
        torch.ones(3, 2),
        fps=30.0,
    )
    assert given is not None
    held = diffusion.held(
        lambda x, t: torch.zeros_like(x), given.known, given.values, noise, shown=given.shown
    )
    for step in (0, 7, 49):
        t = torch.full((2,), step)
        x_t = torch.randn_like(values)
        x_0 = diffusion.predict_x0(held(x_t, t), x_t, t, clip=False)
        assert torch.allclose(x_0[known], values[known], atol=1e-3)


def test_a_motion_does_not_depend_on_what_others_are_given(make_generator):
    generator = make_generator(constraints=True)
    constraint = some(15, generator)
    prompts, seconds = ["a person walks forward", "somebody jumps"], [0.5, 1.0]
    alone = generator.sample_features(prompts[1:], seconds=1.0)[0]
    both = generator.sample_features(prompts, seconds=seconds, constraints=[constraint, None])
    assert torch.allclose(both[1], alone, atol=2e-4)


def test_a_motion_led_to_beats_does_not_depend_on_its_company(make_generator):
    """Guidance looks at whole motions: padding beside a longer one would change it."""
    generator = make_generator(constraints=True)
    led = [replace(some(each, generator), beats=torch.arange(0.1, 1.0, 0.3)) for each in (15, 30)]
    prompts, seconds = ["a person walks forward", "somebody jumps"], [0.5, 1.0]
    both = generator.sample_features(prompts, seconds=seconds, constraints=led)
    alone = generator.sample_features(prompts[:1], seconds=0.5, constraints=led[:1])
    assert torch.allclose(both[0], alone[0], atol=2e-4)


def test_generate_keeps_the_known_path(generator: TextToMotion):
    constraint = Constraint.free(30)
    constraint.known[:, ROOT_ROW, :4] = True
    constraint.values[:, ROOT_ROW, FORWARD] = torch.linspace(0, 2, 30)  # smoothing would bend it
    motion = generator.generate(PROMPT, seconds=1.0, constraints=[constraint])[0]
    path = torch.linspace(0, 2, 30)[:-1].cumsum(0) / 30
    assert torch.allclose(torch.as_tensor(motion.root_position[1:, 2]), path, atol=1e-5)
    assert abs(motion.root_position[:, 0]).max() < 1e-5


def test_a_constraint_of_another_length_is_refused(generator: TextToMotion):
    with pytest.raises(UsageError, match="10 frames for a motion of 30"):
        generator.generate(PROMPT, seconds=1.0, constraints=[Constraint.free(10)])


def test_windows_shift_the_beats():
    constraint = Constraint.free(90)
    constraint = Constraint(constraint.values, constraint.known, torch.tensor([0.5, 2.0]))
    window = constraint.window(30, 75)
    assert len(window) == 45
    assert torch.allclose(window.beats, torch.tensor([-0.5, 1.0]))


def test_what_the_network_is_not_told_comes_out_all_the_same(make_generator):
    """Untold entries are known, but change what is made: the network gets them with noise."""
    generator = make_generator(constraints=True)
    shown = some(20, generator)
    hidden = Constraint(shown.values, shown.known, shown=torch.zeros_like(shown.known))
    makes = [
        generator.sample_features(["somebody jumps"], seconds=20 / 30, constraints=[each])[0]
        for each in (shown, hidden)
    ]
    for made in makes:
        assert torch.equal(made[shown.known], shown.values[shown.known])
    assert not torch.allclose(*makes, atol=1e-4)
    assert hidden.window(3, 9).shown is not None and len(hidden.window(3, 9).shown) == 6


def test_the_mirror_image_knows_the_other_side() -> None:
    given = Constraint.free(4)
    given.values.normal_()
    given.known[:, JOINT_INDEX["l_wrist"]] = given.known[2, ROOT_ROW, LEFT_CONTACT] = True
    given = replace(given, shown=given.known.clone())
    there = given.mirrored()
    assert torch.equal(there.values, mirror_features(given.values))
    for mask in (there.known, there.shown):
        assert mask is not None and mask[:, JOINT_INDEX["r_wrist"]].all()
        assert mask[2, ROOT_ROW, LEFT_CONTACT + 1] and mask.sum() == given.known.sum()
    back = there.mirrored()
    assert torch.equal(back.values, given.values) and torch.equal(back.known, given.known)
