#!/usr/bin/env python3
"""Fails where the time of an extraction grows faster with the number of faces than it may.

check_growth.py TABLE: what `./dev bench` printed. The power is 0.69 to 0.75 on the machine of docs/results.md.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

MOST = 1.0  # linear: what is slower says that a step has become worse than that


def main() -> int:
    text = Path(sys.argv[1]).read_text(encoding="utf-8")
    found = re.search(r"grows as the number of faces to the power of ([0-9.]+[0-9])", text)
    if not found:
        print("the table does not say how times grow: was it made by ./dev bench to its end?", file=sys.stderr)
        return 1
    power = float(found[1])
    print(f"time grows as the number of faces to the power of {power}; at most {MOST}")
    return 1 if power > MOST else 0


if __name__ == "__main__":
    sys.exit(main())
