"""YAML files and command-line overrides become frozen, typed configurations.

The only file of the project that reads YAML. Every mistake is one line that names the file (or
the command line), the key, its value and, for an unknown key, the nearest valid one.
"""

import difflib
import json
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, ClassVar, TypeVar, get_args

import yaml
from pydantic import ValidationError
from pydantic_core import ErrorDetails

from .config_audio import AudioNetworkConfig
from .config_schema import Config, NetworkConfig, TrainConfig
from .environment import run_folder, variable
from .errors import UsageError

COMMAND_LINE = "command line"
NETWORK_PREFIX = "network."
MAX_YAML = 16 << 20  # characters
MAX_NODES, MAX_DEPTH = 1_000_000, 50  # of what a YAML text may say

ConfigT = TypeVar("ConfigT", bound=Config)
TrainConfigT = TypeVar("TrainConfigT", bound=TrainConfig)


# ---------------------------------------------------------------- YAML

_Base: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class _Loader(_Base):  # type: ignore[misc]  # one of two classes
    """YAML 1.2 scalars: `no` stays a word, `1e-3` is a number; a repeated key is an error."""

    # a copy per class: the resolvers of yaml.SafeLoader stay as they are
    yaml_implicit_resolvers: ClassVar[dict[str, Any]] = {
        first: [(tag, regexp) for tag, regexp in pairs if not tag.endswith((":bool", ":float"))]
        for first, pairs in _Base.yaml_implicit_resolvers.items()
    }

    def construct_mapping(self, node: Any, deep: bool = False) -> dict[Any, Any]:
        seen: set[Any] = set()
        for key_node, _ in node.value:
            key = self.construct_object(key_node, deep=True)
            if isinstance(key, dict | list):
                raise yaml.constructor.ConstructorError(
                    None, None, "a key is a list or a mapping", key_node.start_mark
                )
            if key in seen and key != "<<":
                raise yaml.constructor.ConstructorError(
                    None, None, f"key {key!r} appears twice", key_node.start_mark
                )
            seen.add(key)
        return dict(super().construct_mapping(node, deep=deep))


_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:bool", re.compile(r"^(?:true|True|TRUE|false|False|FALSE)$"), list("tTfF")
)
_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(
        r"^(?:[-+]?(?:[0-9]+\.[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?|[-+]?[0-9]+[eE][-+]?[0-9]+"
        r"|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))$"
    ),
    list("-+0123456789."),
)


def parse_yaml(text: str, source: str) -> Any:
    """Parse one YAML document; `source` names it in the error.

    Raises:
        UsageError: the text is not YAML, too long or too deep, or grows beyond measure by aliases.
    """
    if len(text) > MAX_YAML:
        raise UsageError(f"{source}: longer than {MAX_YAML >> 20} MB; split the file")
    try:
        _check_depth(text)
        value = yaml.load(text, Loader=_Loader)
        _weigh(value, {})
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f" line {mark.line + 1}" if mark else ""
        what = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise UsageError(f"{source}{where}: not valid YAML: {what}; mend the file") from error
    except (ValueError, OverflowError, RecursionError) as error:  # a date or number that is none
        raise UsageError(f"{source}: not valid YAML: {error!s:.200}; mend the file") from error
    return value


def _check_depth(text: str) -> None:
    """Refuse nesting that would overflow libyaml's stack, which ends the process.

    Raises:
        ValueError: nested too deeply.
    """
    depth = 0
    for event in yaml.parse(text, Loader=_Loader):
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        if depth > MAX_DEPTH:
            raise ValueError("nested too deeply")


def _weigh(value: Any, known: dict[int, int]) -> int:
    """Values in a tree, those behind an alias once for every use.

    Raises:
        ValueError: too many, or a value that holds itself.
    """
    if not isinstance(value, dict | list):
        return 1
    if id(value) not in known:
        known[id(value)] = 0  # being weighed
        inner = value.values() if isinstance(value, dict) else value
        known[id(value)] = 1 + sum(_weigh(item, known) for item in inner)
    weight = known[id(value)]
    if not 0 < weight <= MAX_NODES:
        raise ValueError("a value holds itself" if not weight else "aliases make it grow too large")
    return weight


def load_yaml(path: Path | str) -> dict[str, Any]:
    """Read a YAML file whose top level is a mapping (an empty file is an empty mapping).

    Raises:
        UsageError: the file is missing, unreadable, no YAML, or no mapping.
    """
    try:
        with Path(path).open(encoding="utf-8") as stream:
            text = stream.read(MAX_YAML + 1)
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "not UTF-8 text"
        raise UsageError(f"{path}: cannot read it ({reason}); give a YAML file in UTF-8") from error
    value = parse_yaml(text, str(path))
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise UsageError(f"{path}: expected `key: value` lines, found {type(value).__name__}")
    return value


def packaged_config(name: str) -> Path:
    """Path of a file in src/configs, installed or in the source tree."""
    return Path(__file__).parent.parent / "configs" / name


# ---------------------------------------------------------------- overrides


def parse_overrides(overrides: Sequence[str]) -> dict[str, Any]:
    """`key.sub-key=value` strings as a flat mapping from dotted key to parsed value.

    Raises:
        UsageError: no `=`, or an empty key.
    """
    flat: dict[str, Any] = {}
    for text in overrides:
        key, equals, value = text.partition("=")
        if not equals or not key.strip():
            raise UsageError(f"{COMMAND_LINE}: {text!r} is not of the form key=value; write it so")
        flat[key.strip()] = parse_yaml(value, f"{COMMAND_LINE}: {key.strip()}={value}")
    return flat


def split_network_overrides(overrides: Sequence[str]) -> tuple[list[str], list[str]]:
    """Part a training command's overrides into its own and those of the network (`network.…`).

    Those of the network keep their prefix, so that `load_network` names keys as they were written.
    """
    network = [text for text in overrides if text.startswith(NETWORK_PREFIX)]
    return [text for text in overrides if not text.startswith(NETWORK_PREFIX)], network


def _kebab(key: Any) -> str:
    """`numHeads` and `num_heads` are other spellings of `num-heads` (TEXT uses two of them)."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "-", str(key)).replace("_", "-").lower()


def _normalise(values: dict[Any, Any], source: str, prefix: str = "") -> dict[str, Any]:
    """Kebab-case keys on every level; the same key in two spellings is an error."""
    result: dict[str, Any] = {}
    for key, value in values.items():
        name = _kebab(key)
        if name in result:
            raise UsageError(
                f"{source}: {prefix}{name} is given twice, in two spellings; leave one out"
            )
        nested = isinstance(value, dict)
        result[name] = _normalise(value, source, f"{prefix}{name}.") if nested else value
    return result


def _apply(values: dict[str, Any], dotted: str, value: Any) -> None:
    """Set one dotted key, making the sections on the way."""
    *sections, last = [_kebab(part) for part in dotted.split(".")]
    for section in sections:
        inner = values.get(section)
        if not isinstance(inner, dict):
            inner = values[section] = {}
        values = inner
    if isinstance(value, dict) and isinstance(values.get(last), dict):
        for key, inner_value in value.items():
            _apply(values[last], str(key), inner_value)
    else:
        values[last] = value


def _as_ours(model_class: type[Config], values: dict[str, Any]) -> dict[str, Any]:
    """Values as the documents print them -> ours, on every level; the later name counts."""
    found = model_class.as_ours(values)
    for name, each in model_class.model_fields.items():
        section, inner = _section_class(each.annotation), found.get(_kebab(name))
        if section is not None and isinstance(inner, dict):
            found[_kebab(name)] = _as_ours(section, inner)
    return found


# ---------------------------------------------------------------- errors


def _section_class(annotation: Any) -> type[Config] | None:
    """The Config inside an annotation such as `Config` or `Config | None`."""
    for candidate in (annotation, *get_args(annotation)):
        if isinstance(candidate, type) and issubclass(candidate, Config):
            return candidate
    return None


def config_keys(model_class: type[Config], prefix: str = "") -> Iterator[str]:
    """Every key of a configuration, dotted, in kebab-case."""
    for name, field in model_class.model_fields.items():
        key = prefix + _kebab(name)
        yield key
        if section := _section_class(field.annotation):
            yield from config_keys(section, key + ".")


def nearest(word: str, candidates: Sequence[str]) -> str:
    """The candidate most like `word`; candidates must not be empty."""
    return difflib.get_close_matches(word, candidates, n=1, cutoff=0.0)[0]


def did_you_mean(word: str, candidates: Sequence[str]) -> str:
    """A question for a message, "did you mean 'walk'? ", where a candidate is like `word`."""
    close = difflib.get_close_matches(word, candidates, n=1)
    return f"did you mean {close[0]!r}? " if close else ""


def _nearest_key(model_class: type[Config], key: str) -> str:
    """The valid key most like `key`; the right name in the wrong section comes first."""
    keys = list(config_keys(model_class))
    same_name = [k for k in keys if k.rpartition(".")[2] == key.rpartition(".")[2]]
    return nearest(key, same_name or keys)


def _describe(
    error: ErrorDetails, model_class: type[Config], source: str, written: str, prefix: str
) -> str:
    """One pydantic error as one line; `written` is the override's key, `prefix` stands before."""
    key = prefix + ".".join(_kebab(part) for part in error["loc"])
    value = json.dumps(error["input"], ensure_ascii=False, default=str)
    if error["type"] == "extra_forbidden":
        key = written or key
        bare = key.removeprefix(prefix)
        inner = error["input"]
        for part in bare.split(".")[len(error["loc"]) :]:
            inner = inner.get(_kebab(part), inner) if isinstance(inner, dict) else inner
        value = json.dumps(inner, ensure_ascii=False, default=str)
        nearest_key = prefix + _nearest_key(model_class, bare)
        if issubclass(model_class, TrainConfig) and bare in config_keys(NetworkConfig):
            nearest_key = NETWORK_PREFIX + bare
        return (
            f"{source}: unknown key {key} (value {value}); the nearest valid key is {nearest_key}"
        )
    message = error["msg"].removeprefix("Value error, ").replace("Input should be", "should be")
    message = message.replace("an object", "a section of keys")
    if error["type"] == "missing":
        return f"{source}: {key} is missing"
    if isinstance(error["input"], dict) and error["type"] == "value_error":
        return f"{source}: {key + ': ' if key else ''}{message}"
    return f"{source}: {key} = {value} {message}"


def load_config(
    model_class: type[ConfigT],
    values: dict[str, Any],
    source: str,
    overrides: Sequence[str] = (),
    *,
    prefix: str = "",
) -> ConfigT:
    """Validate `values` with `overrides` on top.

    Args:
        model_class: the configuration to make.
        values: what a YAML file says; kebab-case, snake_case and camelCase keys are the same.
        source: names the file in errors.
        overrides: `key.sub-key=value`, values in YAML.
        prefix: what overrides may begin with, and then do in errors.

    Raises:
        UsageError: an unknown key, a wrong type or range, settings that do not fit together.
    """
    merged = _normalise(values, source)
    flat = parse_overrides(overrides)
    prefix = prefix if any(key.startswith(prefix) for key in flat) else ""
    flat = {key.removeprefix(prefix): value for key, value in flat.items()}
    for key, value in flat.items():
        _apply(merged, key, value)
    try:
        merged = _as_ours(model_class, merged)
    except ValueError as error:
        told = any(_kebab(key).rpartition(".")[2] in str(error) for key in flat)
        raise UsageError(f"{COMMAND_LINE if told else source}: {error}") from None
    try:
        # strict, so that `true` is no number; through JSON, so that a list may be a tuple
        return model_class.model_validate_json(json.dumps(merged, default=str), strict=True)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        key = ".".join(_kebab(part) for part in first["loc"])
        given = [_kebab(k) for k in flat]
        overridden = any(k == key or key.startswith(k + ".") for k in given) or (
            # a clash of two keys names its section only: blame the override that names a key in it
            isinstance(first["input"], dict)
            and any(k.rpartition(".")[2] in first["msg"] for k in given)
        )
        # an unknown section is named whole, as it was written
        unknown = first["type"] == "extra_forbidden"
        inner = [k for k, own in zip(flat, given, strict=True) if own.startswith(key + ".")]
        written = prefix + inner[0] if unknown and inner else ""
        overridden |= bool(written)
        where, prefix = (COMMAND_LINE, prefix) if overridden else (source, "")
        raise UsageError(_describe(first, model_class, where, written, prefix)) from None


# ---------------------------------------------------------------- the project's own files


def profile_names() -> list[str]:
    """Names of the profiles of network.yaml."""
    return list(_profiles(packaged_config("network.yaml")))


def _profiles(path: Path | str) -> dict[str, Any]:
    profiles = load_yaml(path).get("profiles")
    if not isinstance(profiles, dict) or not profiles:
        raise UsageError(f"{path}: expected a `profiles:` section with one entry a profile")
    return profiles


def load_network(
    profile: str = "default", path: Path | str | None = None, overrides: Sequence[str] = ()
) -> NetworkConfig:
    """One profile of network.yaml.

    Args:
        profile: default, spark, lightweight, or one of the user's own file.
        path: another network file; None is the one that ships.
        overrides: `generation.num-heads=8` and the like, with `network.` before or without.

    Raises:
        UsageError: unknown profile or key, wrong type, range or head count.
    """
    path = path or packaged_config("network.yaml")
    return _load_profile(NetworkConfig, profile, path, overrides)


def load_audio_network(
    profile: str = "default", path: Path | str | None = None, overrides: Sequence[str] = ()
) -> AudioNetworkConfig:
    """One profile of audio_network.yaml; arguments and errors as `load_network`."""
    path = path or packaged_config("audio_network.yaml")
    return _load_profile(AudioNetworkConfig, profile, path, overrides)


def _load_profile(
    model_class: type[ConfigT], profile: str, path: Path | str, overrides: Sequence[str]
) -> ConfigT:
    profiles = _profiles(path)
    if profile not in profiles:
        raise UsageError(
            f"{path}: unknown profile {profile!r}; the nearest is"
            f" {nearest(profile, list(profiles))!r} (there are: {', '.join(profiles)})"
        )
    values = profiles[profile] or {}
    source = f"{path} profile {profile}"
    if not isinstance(values, dict):
        raise UsageError(f"{source}: expected a mapping, found {values!r}")
    return load_config(model_class, values, source, overrides, prefix=NETWORK_PREFIX)


def load_train(
    path: Path | str | None, model_class: type[TrainConfigT], overrides: Sequence[str] = ()
) -> TrainConfigT:
    """A training configuration; path None is the file that ships for this class.

    What neither the user's file nor an override says, a MOTIONGEN_* variable may.

    Args:
        path: a file of settings, or the name of a recipe, which lies on top of what ships.
        model_class: the configuration to make.
        overrides: `key=value`.

    Raises:
        UsageError: as `load_config`; a recipe that says nothing for this stage.
    """
    source, given = str(path), {} if path is None else _recipe(path, model_class)
    if given is None:
        given = values = _normalise(load_yaml(source), source)
    else:
        source = str(packaged_config(f"{_stage(model_class)}.yaml")) if path is None else source
        given.pop("network", None)
        values = load_yaml(packaged_config(f"{_stage(model_class)}.yaml")) | given
    for key, name in model_class.variables.items():
        if key not in given and (value := variable(name)):
            values[key] = value
    if "output" in values and "output" not in given:
        values["output"] = str(run_folder(values["output"]))
    return load_config(model_class, values, source, overrides)


def recipe_network(path: Path | str | None, model_class: type[TrainConfig]) -> list[str]:
    """Overrides `network.key=value` of the recipe of that name, if `path` is one."""
    recipe = {} if path is None else _recipe(path, model_class) or {}
    changes: dict[str, Any] = recipe.get("network", {})
    return [f"{NETWORK_PREFIX}{key}={json.dumps(value)}" for key, value in changes.items()]


def _recipe(path: Path | str, model_class: type[TrainConfig]) -> dict[str, Any] | None:
    """What the recipe of that profile says for a stage; None where `path` names a file."""
    recipes = load_yaml(packaged_config("recipes.yaml"))
    recipe, stage = recipes.get(str(path)), _stage(model_class)
    if recipe is None or Path(path).is_file():
        return None
    if stage not in recipe:
        known = ", ".join(recipe)
        raise UsageError(f"recipe {path} says nothing for {stage}; leave it out, it is for {known}")
    return {"profile": str(path), **_normalise(recipe[stage], f"recipe {path}")}


def _stage(model_class: type[TrainConfig]) -> str:
    """Name of the packaged file of a stage's settings."""
    return _kebab(model_class.__name__.removesuffix("Config")).replace("-", "_")


def dump_config(config: Config) -> dict[str, Any]:
    """A configuration as plain data with kebab-case keys: what checkpoints and models carry."""
    return config.model_dump(mode="json", by_alias=True)
