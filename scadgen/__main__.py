"""``python -m scadgen``: the same as ``scadgen``."""

from scadgen.cli.main import main

main()
