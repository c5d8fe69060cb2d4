"""Label sets that the caption tests go through."""

from src.shared.data.synthetic.clips import label_combinations

LANGUAGES = ("de", "en", "es", "fr", "ja", "zh")
STYLES = [
    "normal", "happy", "sad", "angry", "proud", "not-confident", "masculine", "feminine",
    "childish", "elderly", "tired", "active", "musical", "giant", "chimpira", "youthful",
    "mannequin",
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
        "wash", "bend", "salsa", "indian-dance", "breakdance", "jackson-dance", "charleston",
        "body-roll", "whirl", "cartwheel", "backflip", "jump-turn", "karate", "block",
        "roundhouse-kick", "soccer-kick", "direct-traffic", "referee", "laugh", "motorcycle", "jog",
        "pivot", "zigzag", "circle", "push", "crouch", "sit-floor", "stand-up", "get-up", "sleep",
        "crawl", "roll", "swim", "drive", "push-up", "sit-up", "jumping-jacks", "dodge", "die",
        "get-hit", "cheer", "meditate", "pick-up", "press-button", "pull-lever", "open-door",
        "hammer", "aim-gun", "shoot-gun", "reload", "archery", "cast-spell", "chop", "stab",
        "fight-stance", "fly", "levitate", "shiver", "dizzy", "confused", "stomp", "shake-head",
        "nod", "fist-pump", "drink", "kneel", "zombie", "dab", "talk", "taunt", "listen",
    )
]  # fmt: skip
ALL = SYNTHETIC + STYLED + OTHERS
