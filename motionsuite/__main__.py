"""`python -m motionsuite`, and the program `motion-tools`."""

from importlib import import_module

from . import _ROOT


def main() -> None:
    """Run the command line."""
    import_module(f"{_ROOT}.cli.tools").main()


if __name__ == "__main__":
    main()
