"""``python -m scadgen``: the same as ``scadgen``."""

from scadgen.cli.main import main

__all__: list[str] = []

if __name__ == "__main__":
    main()
