# SPDX-License-Identifier: MIT
"""What goes wrong, as exceptions."""
from typing import Optional


class MangataError(Exception):
    """Anything that the libraries refuse. `status`: the name of the library's status, such as "unavailable"."""

    def __init__(self, message: str, status: str = "") -> None:
        super().__init__(message)
        self.status = status


class SceneError(MangataError, ValueError):
    """A scene, a change of one or a picture is not a legal one.

    `file`, `line`, `column`: where, from 1; None where there is no place. `reason`: what is wrong and what is allowed, without the place.
    """

    def __init__(self, reason: str, file: Optional[str] = None, line: Optional[int] = None, column: Optional[int] = None) -> None:
        place = f"{file}:{line}:{column}: " if line else f"{file}: " if file else ""
        super().__init__(place + reason, "scene")
        self.reason, self.file, self.line, self.column = reason, file, line, column


class Cancelled(MangataError):
    """The progress function asked to stop."""
