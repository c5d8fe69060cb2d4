"""Data tables in YAML (skeletons, label rules): read, validate, and say what is wrong."""

from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from ..config_loader import load_yaml, packaged_config
from ..errors import UsageError

Table = TypeVar("Table", bound=BaseModel)


def load_table(path: str | Path, table_class: type[Table]) -> Table:
    """A file of the user's, or, by bare name, one of src/configs.

    Raises:
        UsageError: unreadable, no YAML, or a key or value the table does not know.
    """
    path = packaged_config(path) if isinstance(path, str) else path
    try:
        return table_class.model_validate(load_yaml(path))
    except ValidationError as error:
        first = error.errors()[0]
        key = ".".join(str(part) for part in first["loc"])
        message = first["msg"].removeprefix("Value error, ")
        message = message.replace("Input should be a valid tuple", "should be a list")
        message = message.replace("Input should be", "should be")
        raise UsageError(f"{path}: {key}: {message}; mend the file") from None
