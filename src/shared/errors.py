"""The two errors a user can cause; the command line turns them into exit codes."""


class UserError(Exception):
    """Something the user gave cannot be worked with (exit code 1).

    The message is one line: what is wrong, the value, the file or key, what to do.
    """

    exit_code = 1


class UsageError(UserError):
    """The command or its configuration is wrong, so nothing was started (exit code 2)."""

    exit_code = 2
