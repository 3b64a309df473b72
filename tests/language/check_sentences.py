#!/usr/bin/env python3
"""Names every sentence of more than 30 words that a reader meets: in the manual, messages, help, and public documentation.

check_sentences.py SOURCES [--most N] [FILE...]: of all files that readers meet, or of those. A piece of code counts as one
word. Cells of tables and items of lists are sentences of their own. Ends with 1 where there is such a sentence.
"""

from __future__ import annotations

import argparse
import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

MOST_WORDS = 30
Piece = tuple[int, str]  # line, text


def words(sentence: str) -> int:
    return sum(1 for word in sentence.split() if re.search(r"[^\W_]", word))


def sentences(text: str) -> Iterator[str]:
    text = re.sub(r"`[^`]*`", "code", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"\b(e\.g|i\.e|vs|cf|approx|et al)\.", r"\1", text)
    yield from re.split(r"(?<=[.!?])[\"')*]*\s+", text)


def of_markdown(text: str) -> Iterator[Piece]:
    block: list[str] = []
    start = 0
    fenced = False
    for number, line in enumerate([*text.splitlines(), ""], 1):
        bare = line.strip()
        if bare.startswith("```"):
            fenced = not fenced
            bare = ""
        elif fenced:
            continue
        is_row = bare.startswith("|")
        begins = re.match(r"(?:[-*+]|\d+\.|>|#+)\s", bare)
        if (not bare or is_row or begins or bare.startswith(("#", "<!--"))) and block:
            yield start, " ".join(block)
            block = []
        if is_row:
            for cell in re.split(r"(?<!\\)\|", bare):
                yield number, cell
        elif bare and not bare.startswith("<!--"):
            if not block:
                start = number
            block.append(bare)


def of_comments(text: str) -> Iterator[Piece]:
    """What stands in `///` comments: of commands (\\returns, \\throws) and lists each is a piece of its own."""
    block: list[str] = []
    start = beside = 0
    for number, line in enumerate([*text.splitlines(), ""], 1):
        comment = re.search(r"(?:^|\s)///<?(.*)", line)
        trailing = bool(comment and line[: comment.start()].strip())
        bare = comment[1].strip() if comment else ""
        # One beside code goes on below it only as another one that is indented as deep.
        if block and (not bare or trailing or bare.startswith("- ") or (beside and comment.start() != beside)):
            yield from pieces(start, " ".join(block))
            block = []
        if bare:
            if not block:
                start, beside = number, comment.start() if trailing else 0
            block.append(bare)


def pieces(start: int, text: str) -> Iterator[Piece]:
    for part in re.split(r"\\(?:returns?|throws?|param(?:\[\w+\])?|brief|note)\b", text):
        yield start, part


TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<tag>\w*)\(.*?\)(?P=tag)"|"(?P<text>(?:\\.|[^"\\\n])*)"|\'(?:\\.|[^\'\\])*\'|#[^\n]*|[^\s"\'/#]+|.',
    re.DOTALL,
)


def of_strings(text: str) -> Iterator[Piece]:
    """Literals of C++ that follow each other, or are joined by + to each other and to values, as one text."""
    found: list[str] = []
    start, depth = 0, 0
    for match in TOKEN.finditer(text):
        token = match[0]
        literal = match["text"]  # those that are raw hold what programs read: styles, scripts
        if literal is not None:
            if not found:
                start = text.count("\n", 0, match.start()) + 1
            found.append(literal)
        elif token.isspace() or token.startswith(("//", "/*")):
            continue
        elif found and re.search(r"[;,{}]|<<|\?|:$", token):
            yield start, joined(found)
            found = []
        elif found:
            found.append(" ") if token != "+" else None
    if found:
        yield start, joined(found)


def joined(found: list[str]) -> str:
    text = "".join(found).replace('\\"', '"')
    return re.sub(r"\\n\s*\\n|\\n(?=\s{2})", ". ", text).replace("\\n", " ").replace("\\t", " ")


def of_docstrings(text: str) -> Iterator[Piece]:
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if not isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            continue
        content = ast.get_docstring(node)
        if not content:
            continue
        line = node.body[0].lineno
        content = re.sub(r"^\s*>>>.*?(?:\n\s*\n|\Z)", "\n\n", content, flags=re.DOTALL | re.MULTILINE)
        content = re.sub(r"::\n\n(?:    .*\n|\n)+", ".\n\n", content)
        for part in re.split(r"\n\s*\n|\n(?=\s*\w[\w ,*]*:(?:\s|$))", content):
            yield line, " ".join(part.split())
    for node in ast.walk(tree):
        if isinstance(node, ast.Raise):
            for value in ast.walk(node):
                if isinstance(value, ast.JoinedStr):
                    yield node.lineno, "".join(v.value if isinstance(v, ast.Constant) else "x" for v in value.values)
                elif isinstance(value, ast.Constant) and isinstance(value.value, str):
                    yield node.lineno, value.value


def public_headers(root: Path) -> set[Path]:
    text = (root / "cmake/Sources.cmake").read_text(encoding="utf-8")
    listed = re.search(r"set\(skelgen_public_headers\s([^)]*)\)", text)
    return {root / name for name in listed[1].split()} if listed else set()


def readers(root: Path) -> dict[Path, list]:
    """The files that readers meet, and what of each they read."""
    found: dict[Path, list] = {}
    pages = [
        root / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md", "RELEASE_CHECKLIST.md")
    ]
    for folder in ("docs", "contrib", "apps/web/samples"):
        pages += sorted((root / folder).rglob("*.md"))
    for page in pages:
        if page.exists():
            found[page] = [of_markdown]
    for folder in ("apps/skelgen", "src", "include", "bindings/python/src"):
        for file in sorted((root / folder).rglob("*.[ch]pp")):
            found[file] = [of_strings]
    for folder in ("apps/view", "apps/web"):  # what pages say
        for file in sorted((root / folder).glob("*.mjs")):
            found[file] = [of_strings]
    for header in sorted(public_headers(root)):
        found.setdefault(header, []).append(of_comments)
    for folder in ("bindings/python/skelgen", "bindings/python/examples", "contrib"):
        for module in sorted((root / folder).rglob("*.py")):
            found[module] = [of_docstrings]
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description="Names sentences that are too long to be understood at first reading.")
    parser.add_argument("root", type=Path)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--most", type=int, default=MOST_WORDS)
    options = parser.parse_args()
    root = options.root.resolve()
    wanted = {file.resolve() for file in options.files}
    count = longest = faults = 0
    for file, ways in readers(root).items():
        if wanted and file not in wanted:
            continue
        text = file.read_text(encoding="utf-8")
        for way in ways:
            for line, piece in way(text):
                for sentence in sentences(piece):
                    length = words(sentence)
                    count += length > 0
                    longest = max(longest, length)
                    if length > options.most:
                        faults += 1
                        print(f"{file.relative_to(root)}:{line}: {length} words: {' '.join(sentence.split())}")
    print(f"{count} sentences, {faults} of more than {options.most} words, the longest of {longest}", file=sys.stderr)
    if count < 1000 and not wanted:
        print("that is too few: the lint does not find what it should look at", file=sys.stderr)
        return 1
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
