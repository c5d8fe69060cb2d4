"""`studio`: a page with a model inside that makes motions in a browser, and opens it."""

from pathlib import Path
from typing import Annotated

import typer

from ..shared import environment
from . import options
from .console import print_json, tell


def studio(
    out: Annotated[
        Path, typer.Option(help="The page: an .html file, or a folder for its index.html.")
    ] = Path("outputs/studio.html"),
    model: Annotated[str, typer.Option(help=options.NAMED)] = environment.TEXT_MODEL,
    no_open: Annotated[bool, typer.Option("--no-open", help="Only write it.")] = False,
    json: options.Json = False,
) -> None:
    """Write one page with the model inside, and open it in the browser; it needs no server.

    \b
    Examples:
      motion-tools studio
      motion-tools studio --out public/ --no-open
    """
    from ..shared.studio.page import page_file, write_studio

    options.check_file("--out", page_file(out))
    path = write_studio(out, model)
    if json:
        print_json({"file": str(path), "bytes": path.stat().st_size})
    else:
        print(path)
    if no_open:
        return
    import webbrowser

    if not webbrowser.open(path.resolve().as_uri()):
        tell(f"no browser here to open it with; open {path} in one")
