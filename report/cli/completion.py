"""The command `roofslip completion`: the shell completes commands, options and files."""

from __future__ import annotations

import click

VARIABLE = "_ROOFSLIP_COMPLETE"
"""Set by the script in which the shell asks for completions."""


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def completion(shell: str) -> None:
    """Print the script by which a shell completes commands, options and files.

    In bash: `eval "$(roofslip completion bash)"`, which also completes ./roofslip. In zsh the same
    with zsh, after compinit. In fish: `roofslip completion fish | source`. zsh and fish complete a
    roofslip that is in the PATH.
    """
    from click.shell_completion import get_completion_class

    root = click.get_current_context().find_root().command
    script = get_completion_class(shell)
    assert script is not None  # by the choice of shells
    click.echo(script(root, {}, "roofslip", VARIABLE).source())
