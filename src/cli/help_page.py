"""The help page of a command."""

import re
from typing import Any

from typer.core import TyperCommand

LIST = re.compile(r"<list\[(\w+)\]>")  # as typer tells of what may be repeated


class Command(TyperCommand):
    """A command whose help says what each value is, where typer tells of a Python list."""

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments and options."""
        write = formatter.write_dl
        formatter.write_dl = lambda rows: write(
            [(LIST.sub(lambda found: f"<{found[1].lower()}>", name), text) for name, text in rows]
        )
        super().format_options(ctx, formatter)
