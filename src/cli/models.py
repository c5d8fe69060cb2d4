"""`models`: what can be named in `--model`."""

from . import options

COLUMNS = ("name", "kind", "trained", "licence", "size", "languages", "description")


def models(json: options.Json = False) -> None:
    """List shipped and trained models.

    \b
    Example:
      motion-tools models
    """
    import json as json_format

    from ..shared.model.zoo import list_models

    rows = list_models()
    if json:
        print(json_format.dumps(rows, indent=1, ensure_ascii=False))
        return
    if not rows:
        print("no models: none are shipped, and runs/ holds none; train one (see README.md)")
        return
    table = [COLUMNS, *(tuple(str(row[column]) for column in COLUMNS) for row in rows)]
    widths = [max(len(line[column]) for line in table) for column in range(len(COLUMNS))]
    for line in table:
        print("  ".join(cell.ljust(w) for cell, w in zip(line, widths, strict=True)).rstrip())
