"""same_results.py A B: fails where two output folders of a batch hold different files, or files that differ in more than times."""

import json
import sys
from pathlib import Path


def without_times(file):
    if file.name == "summary.jsonl":
        lines = [json.loads(line) for line in file.read_text().splitlines()]
        for line in lines:
            del line["seconds"]
        return lines
    content = json.loads(file.read_text())
    del content["timings_ms"]
    return content


def contents(folder):
    return {file.relative_to(folder): without_times(file) for file in Path(folder).rglob("*") if file.is_file()}


one, other = map(contents, sys.argv[1:3])
different = sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))
for name in different:
    print(f"differs, or is in one folder alone: {name}")
lines = other[Path("summary.jsonl")]
solved = sum(line["status"] == "ok" for line in lines)
print(f"{len(lines)} meshes, {solved} skeletons, {len(different)} differences")
sys.exit(0 if not different and lines and len({line["file"] for line in lines}) == len(lines) else 1)
