"""What is raised where no body is found."""

from __future__ import annotations

import json
from typing import Any


class NoSkeletonError(Exception):
    """A sound mesh in which no human skeleton could be found.

    Bad arguments and files are `ValueError`, files that are not there `FileNotFoundError`, results that cannot be
    stored `OSError`.

    Attributes:
        code: why, as a word for programs.
        trail: what was tried, one dictionary each: surface, opened, held, lacking, curve, outcome, probability,
            seconds.
    """

    def __init__(self, message: str, code: str = "no_skeleton", trail: list[dict[str, Any]] | None = None) -> None:
        super().__init__(message)
        self.code = code
        self.trail = [] if trail is None else trail

    @classmethod
    def _of(cls, message: str, code: str, trail: str) -> NoSkeletonError:
        """From the text of a trail's file."""
        return cls(message, code, json.loads(trail)["tried"])

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled with all that it says."""
        return type(self), (str(self), self.code, self.trail)
