"""For the manual's Python reference: sessions in docstrings (`>>> ...`), and what follows `::`, are shown as code."""

from __future__ import annotations

from typing import Any

import griffe


def with_fences(text: str) -> str:
    """The text with a fence around each session, which ends at an empty line."""
    lines: list[str] = []
    inside = False
    for line in text.splitlines():
        bare = line.lstrip()
        line = line[:-1] if line.endswith("::") else line  # code follows, which its indent says, too
        if not inside and bare.startswith(">>> "):
            lines += ["", line[: len(line) - len(bare)] + "```pycon"]
            inside = True
        elif inside and not bare:
            lines.append("```")
            inside = False
        lines.append(line)
    return "\n".join([*lines, "```"] if inside else lines)


class Doctests(griffe.Extension):
    """Rewrites each docstring once."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        if obj.docstring and "```" not in obj.docstring.value:
            obj.docstring.value = with_fences(obj.docstring.value)
