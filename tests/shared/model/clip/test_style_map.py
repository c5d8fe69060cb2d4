"""The map from the shared space to styles: a known map found again, files, too little data."""

from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.model.clip.style_map import STYLE_FILE, StyleMap
from src.shared.motion.style import style_values


def samples(num: int = 400, noise: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Unit embeddings [N, 8] and pair values [N, 4] that follow from their first four channels."""
    rng = np.random.default_rng(0)
    embeddings = rng.normal(size=(num, 8))
    embeddings /= np.linalg.norm(embeddings, axis=1, keepdims=True)
    logits = 3 * embeddings[:, :4] + noise * rng.normal(size=(num, 4))
    return embeddings.astype(np.float32), 1 / (1 + np.exp(-logits))


def test_a_linear_map_is_found_again() -> None:
    embeddings, values = samples()
    found = StyleMap.fit(embeddings, values)
    assert (found.correlations > 0.99).all()
    styles = found(embeddings)
    np.testing.assert_allclose(np.linalg.norm(styles, axis=1), 1, atol=1e-6)
    np.testing.assert_allclose(style_values(styles), values, atol=0.05)


def test_noise_correlates_with_nothing() -> None:
    embeddings, values = samples(noise=100.0)
    assert (np.abs(StyleMap.fit(embeddings, values).correlations) < 0.3).all()


def test_what_does_not_vary_is_said(tmp_path: Path) -> None:
    embeddings, values = samples(20)
    values[:, 2] = 0.5
    found = StyleMap.fit(embeddings, values)
    assert np.isnan(found.correlations[2]) and np.isfinite(found(embeddings)).all()
    with pytest.raises(ValueError, match="too few"):
        StyleMap.fit(embeddings[:9], values[:9])


def test_files(tmp_path: Path) -> None:
    assert StyleMap.from_pretrained(tmp_path) is None
    made = StyleMap.fit(*samples(50))
    made.save_pretrained(tmp_path)
    read = StyleMap.from_pretrained(tmp_path)
    assert read is not None
    embedding = np.ones(8, dtype=np.float32)
    np.testing.assert_array_equal(read(embedding), made(embedding))
    (tmp_path / STYLE_FILE).write_bytes(b"cut")
    with pytest.raises(UserError, match="damaged"):
        StyleMap.from_pretrained(tmp_path)


@pytest.mark.filterwarnings("error")
def test_a_map_far_beyond_its_data_saturates() -> None:
    style = StyleMap.fit(*samples(50))(np.full(8, -1e6, dtype=np.float32))
    assert np.isfinite(style).all() and np.linalg.norm(style) == pytest.approx(1)
