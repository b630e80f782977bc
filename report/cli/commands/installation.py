"""The commands on an installation: `doctor`, `completion`, and `test` of a checkout."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

# Set by the script in which the shell asks for completions.
VARIABLE = "_ROOFSLIP_COMPLETE"


@click.command()
def doctor() -> None:
    """Check versions, native libraries, a test run and a test page; list what to install."""
    from report.cli.installation_check import check_installation

    check_installation()


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def completion(shell: str) -> None:
    """Print the shell completion script.

    For bash, run `eval "$(roofslip completion bash)"`, which also completes ./roofslip. For zsh,
    run the same with zsh, after compinit. For fish, run `roofslip completion fish | source`. In zsh
    and fish, roofslip must be on the PATH.
    """
    root = click.get_current_context().find_root().command
    script = get_completion_class(shell)
    assert script is not None  # by the choice of shells
    click.echo(script(root, {}, "roofslip", VARIABLE).source())


@click.command()
@click.option("--quick", is_flag=True, help="Run the short tests, some of each test file.")
@click.option("--nightly", is_flag=True, help="Run all tests and measure coverage.")
@click.option("--golden", is_flag=True, help="Accept changed text in the pages.")
@click.argument("paths", metavar="[PATH]...", nargs=-1)
def test(**_: object) -> None:
    """Run the linters and tests of a checkout: all tests of PATH, or the everyday suite.

    Options of pytest may follow. The first run installs the packages for the tests (1.1 GB).
    """
    raise click.UsageError("tests are run by the launcher of a checkout: ./roofslip test")
