#!/usr/bin/env python3
"""Fails where a link in a folder of HTML leads to no file, or to no place in it.

check_links.py SITE: addresses elsewhere are counted and not asked for.
"""

from __future__ import annotations

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """A page's links and the places that links may name."""

    def __init__(self) -> None:
        super().__init__()
        self.links: set[str] = set()
        self.places: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if not value:
                continue
            if name in ("href", "src") and tag != "base":
                self.links.add(value)
            elif name == "id" or (name == "name" and tag == "a"):
                self.places.add(value)


def read(path: Path) -> Page:
    page = Page()
    page.feed(path.read_text(encoding="utf-8", errors="replace"))
    return page


def main() -> int:
    site = Path(sys.argv[1]).resolve()
    pages = {path: read(path) for path in site.rglob("*.html")}
    dead, checked, outside = [], 0, set()
    for path, page in pages.items():
        for link in sorted(page.links):
            parts = urlsplit(link)
            if parts.scheme in ("http", "https", "mailto"):
                outside.add(link)
                continue
            if parts.scheme or link == "#":
                continue
            if parts.path.startswith("/"):  # of the page for what is not found alone, which may be shown anywhere
                if path.name == "404.html":
                    continue
                dead.append(f"{path.relative_to(site)}: {link} is not relative")
                continue
            checked += 1
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if target.is_dir():
                target /= "index.html"
            if not target.exists():
                dead.append(f"{path.relative_to(site)}: {link} leads nowhere")
            elif (
                parts.fragment
                and target in pages
                and parts.fragment != target.stem  # as Doxygen names the page itself
                and unquote(parts.fragment) not in pages[target].places
            ):
                dead.append(f"{path.relative_to(site)}: {link} names no place in its page")
    print(f"{checked} links in {len(pages)} pages, {len(dead)} of them dead; {len(outside)} addresses elsewhere")
    for line in dead[:50]:
        print(line, file=sys.stderr)
    return 1 if dead or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
