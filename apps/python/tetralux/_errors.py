# SPDX-License-Identifier: Apache-2.0
"""What can go wrong, in one line that says what would mend it."""

from __future__ import annotations


class Error(RuntimeError):
    """Every error of the library itself.

    ``code`` is one of "bad input", "unsupported", "out of memory", "device lost" and "cancelled".
    """

    code = "error"


class InputError(Error, ValueError):
    """An argument, an array or a file is not what it must be; a ValueError too."""

    code = "bad input"


class FieldError(InputError, KeyError):
    """The mesh has no such field; a KeyError too. The text names the nearest one that there is."""

    def __str__(self) -> str:  # KeyError's own puts quotes about it
        return RuntimeError.__str__(self)


class UnsupportedError(Error):
    """Asked for rightly, but this build or machine cannot do it."""

    code = "unsupported"


class CancelledError(Error):
    """Stopped by `Renderer.cancel`."""

    code = "cancelled"


def error_of(code: str, text: str) -> Error:
    """What the compiled part raises."""
    for kind in (InputError, UnsupportedError, CancelledError):
        if kind.code == code:
            return kind(text)
    error = MemoryFull(text) if code == "out of memory" else Error(text)
    error.code = code
    return error


class MemoryFull(Error, MemoryError):
    """No memory was left; a MemoryError too."""

    code = "out of memory"
