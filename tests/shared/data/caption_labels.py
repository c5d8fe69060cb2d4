"""Label sets that the caption tests go through."""

from src.shared.data.synthetic.labels import label_combinations

LANGUAGES = ("de", "en", "es", "fr", "ja", "zh")
STYLES = [
    "normal", "happy", "sad", "angry", "proud", "not-confident", "masculine", "feminine",
    "childish", "elderly", "tired", "active", "musical", "giant", "chimpira", "youthful",
]  # fmt: skip
SYNTHETIC = label_combinations()
STYLED = [
    {"action": action, "style": style} | more
    for style in STYLES
    for action, more in [
        ("walk", {"direction": "forward"}),
        ("run", {"direction": "forward", "speed": "fast"}),
        ("walk", {"direction": "backward"}),
        ("walk", {"direction": "forward", "turn": "left"}),
        ("wave", {"side": "left"}),
        ("raise", {"side": "both"}),
        ("guide", {}),
        ("bye", {}),
    ]
]
OTHERS = [
    {"action": action}
    for action in (
        "call", "respond", "slash", "dance", "climb", "balance", "dribble", "shoot", "swordplay",
        "wash", "bend",
    )
]  # fmt: skip
ALL = SYNTHETIC + STYLED + OTHERS
