"""The command line: ``scadgen``."""

from __future__ import annotations

import io
import signal
import sys
import threading
from collections.abc import Sequence

import click

from scadgen import __version__
from scadgen.cli.bill import bill
from scadgen.cli.check import check
from scadgen.cli.export import export
from scadgen.cli.frame import frame
from scadgen.cli.freecad import freecad
from scadgen.cli.interlock import interlock
from scadgen.cli.kit import kit
from scadgen.cli.plan import plan
from scadgen.cli.render import render
from scadgen.cli.tune import tune
from scadgen.errors import ScadgenError

__all__ = ["cli", "main"]

#: Exit status for a request that is wrong, and for an interrupted one.
_WRONG, _INTERRUPTED = 2, 130


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="scadgen")
def cli() -> None:
    """Turn a planar frame into 3D-printable parts that interlock without glue or screws."""


for command in (kit, frame, bill, export, render, check, plan, interlock, tune, freecad):
    cli.add_command(command)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit.

    Exit status 0 is good, 1 means that the answer is no, 2 that the request was wrong;
    then stderr has one line that says what, the value, and what works.
    """
    words = sys.argv[1:] if arguments is None else list(arguments)
    for stream in (sys.stdout, sys.stderr):
        # Names may have letters that the terminal has not; they are told by their numbers then.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        status = cli.main(words or ["--help"], prog_name="scadgen", standalone_mode=False)
    except click.UsageError as error:
        where = f" (see {error.ctx.command_path} --help)" if error.ctx else ""
        _fail(error.format_message() + where)
    except click.ClickException as error:
        _fail(error.format_message())
    except ScadgenError as error:
        _fail(str(error))
    except BrokenPipeError:
        sys.exit(_INTERRUPTED)
    except OSError as error:
        _fail(f"{error.filename or 'a file'}: {error.strerror or error}")
    except (click.Abort, KeyboardInterrupt):
        click.echo("scadgen: interrupted", err=True)
        sys.exit(_INTERRUPTED)
    sys.exit(status if isinstance(status, int) else 0)


def _fail(message: str) -> None:
    click.echo(f"scadgen: {' '.join(message.splitlines())}", err=True)
    sys.exit(_WRONG)
