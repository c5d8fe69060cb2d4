"""`--style`: a list of words, a sentence that the text model knows, or an error."""

import numpy as np
import pytest

from src.shared.errors import UsageError
from src.shared.motion.style import named_style, style_values
from src.shared.pipelines.song import styled


def test_words_are_looked_up() -> None:
    assert styled(None) is None
    np.testing.assert_array_equal(styled("tired, elderly"), named_style("tired, elderly"))


def test_sentences_are_read_by_the_text_model() -> None:
    slow, fast = styled("eine Frau geht langsam"), styled("someone runs fast")
    assert style_values(fast)[0] > style_values(slow)[0] + 0.3
    assert np.linalg.norm(fast) == pytest.approx(1)


def test_what_nothing_knows_is_an_error() -> None:
    with pytest.raises(UsageError, match="'tird' is not a known style; did you mean 'tired'"):
        styled("tird")
