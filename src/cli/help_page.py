"""The help page of a command."""

import re
from typing import Any

import typer
from typer.core import TyperCommand

from ..shared.errors import UsageError
from .console import complain

OWN_SUITE = "text"  # of `evaluate` itself
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


class SuiteCommand(Command):
    """`evaluate`, whose `--suite NAME` has the options of the command `evaluate-NAME`."""

    def make_context(
        self, info_name: str | None, args: list[str], parent: Any = None, **extra: Any
    ) -> Any:
        """Parse as the suite's own command does, where another suite than that of text is named.

        Raises:
            typer.Exit: there is none of that name.
        """
        name, rest = _suite(args)
        if parent is None or name in (None, OWN_SUITE):
            return super().make_context(info_name, args, parent, **extra)
        command = parent.command.get_command(parent, f"evaluate-{name}")
        if command is None:
            known = [each.removeprefix("evaluate-") for each in parent.command.list_commands(parent)
                     if each.startswith("evaluate-")]  # fmt: skip
            names = ", ".join([OWN_SUITE, *known])
            complain(f"error: --suite {name} is unknown; choose from {names}")
            raise typer.Exit(UsageError.exit_code)
        return command.make_context(f"{info_name} --suite {name}", rest, parent, **extra)


def _suite(args: list[str]) -> tuple[str | None, list[str]]:
    """The suite that is named, the last if several are, and the other arguments."""
    name, rest = None, []
    words = iter(args)
    for word in words:
        if word == "--suite":
            name = next(words, None)
        elif word.startswith("--suite="):
            name = word.removeprefix("--suite=")
        else:
            rest.append(word)
    return name, rest
