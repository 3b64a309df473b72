#!/usr/bin/env python3
"""Measures, and writes the tables of docs/results.md that it can measure itself, each with commit, date and machine.

results.py PROGRAM PAGE [--bodies FOLDER] [--characters FOLDER] [--sets FOLDER] [--damages FILE] [--rigs FILE] [--speed FILE]
           [--repeatability FILE] [--noise FILE]

--bodies: a folder with meshes/SET and truth/SET, as SKELGEN_BODIES names. --characters: what characters.py takes. --sets: a folder
to make all generated sets in. The others are files with what measuring programs have printed: `skelgen-damage-table`,
`skelgen-rigs`, `skelgen-bench`, `skelgen-noise`, `skelgen-repeatability` with `skelgen-generated-pairs`. What is not given stays as
it is in the page.
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import platform
import re
import statistics
import subprocess
import sys
from pathlib import Path

from characters import score as score_characters

ROOT = Path(__file__).resolve().parents[2]

# Published: Luo & Feng's own errors on four bodies, people's from their common mean, FARM's (all in LF20).
PUBLISHED = {
    "shoulder": (".0160/.0171", ".0111/.0096", ".0106/.0161"),
    "elbow": (".0066/.0080", ".0056/.0053", ".0098/.0119"),
    "wrist": (".0048/.0056", ".0043/.0038", ".0168/.0188"),
    "hand": (".0156/.0117", ".0059/.0071", ".0209/.0190"),
    "hip": (".0147/.0196", ".0103/.0124", ".0254/.0257"),
    "knee": (".0074/.0074", ".0069/.0071", ".0152/.0222"),
    "ankle": (".0102/.0094", ".0103/.0104", ".0102/.0072"),
    "foot": (".0208/.0185", ".0099/.0130", ".0082/.0107"),
    "neck": (".0118", ".0115", ".0188"),
    "crotch": (".0189", ".0144", ".0262"),
}
MEAN_PUBLISHED = (".0125", ".0088", ".0163")
REAL = {
    "faust": ("FAUST, 5 people", "18, regressed"),
    "scape": ("SCAPE, 1 person", "8, by landmarks"),
    "psb": ("PSB humans, 10 people", "8, by landmarks"),
}
SETS = {
    "scape": "poses as that set has them",
    "faust": "people as that set has them",
    "proportions": "children, very heavy, long and short limbs",
    "joined": "limbs grown onto the body or together",
    "partial": "what is cut off is said to be missing",
    "scan": "holes, noise, flipped faces",
    "pieces": "characters of many pieces",
    "dressed": "skirts, coats, hats, boots, rucksacks",
    "mouths": "wide open, down to the throat",
    "cartoon": "heads, hands, feet and limbs of all sizes, horns, tails, paws",
    "curled": "squatting, kneeling, folded, touching or grown together",
    "armed": "figures that hold a sword, an axe or a staff",
    "hands": "hands of two to five digits, gloved, holding things, grown together, missing",
    "characters": "proportions, poses, things worn and held, kinds of pieces, drawn at random",
    "not-a-body": "animals, furniture, two people: solved is what is refused",
}


def run(*command: object, statuses: tuple[int, ...] = (0,)) -> str:
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode not in statuses:
        sys.exit(f"{' '.join(map(str, command))}: {done.stderr}")
    return done.stdout


def scores(program: Path, meshes: Path, truth: Path, out: Path) -> dict:
    """What `skelgen evaluate` says of a set."""
    run(program, "batch", meshes, "-o", out, "-q", statuses=(0, 5))
    (found,) = json.loads(run(program, "evaluate", truth, out, "--meshes", meshes, "--json")).values()
    return found


def short(value: float) -> str:
    return f"{value:.4f}"


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def sides(joints: dict, name: str) -> str:
    names = [name] if name in joints else [f"left_{name}", f"right_{name}"]
    return "/".join(short(joints[each]["mean"])[1:] for each in names)


def real(program: Path, bodies: Path, work: Path) -> dict[str, str]:
    found = {name: scores(program, bodies / "meshes" / name, bodies / "truth" / name, work / name) for name in REAL}
    accuracy = table(
        ["set", "bodies", "solved, sides right", "mean error", "95 % below", "joints inside", "joints compared"],
        [
            [
                REAL[name][0],
                str(score["meshes"]),
                f"{score['solved']}, {score['sides']}",
                short(score["mean_error"]),
                short(score["p95_error"]),
                f"{100 * score['inside']:.4g} %",
                REAL[name][1],
            ]
            for name, score in found.items()
        ],
    )
    joints = found["faust"]["joints"]
    rows = [[name, sides(joints, name), *published] for name, published in PUBLISHED.items()]
    mean = [short(found["faust"]["mean_error"])[1:], *MEAN_PUBLISHED]
    by_joint = table(
        ["joint", "skelgen", "Luo & Feng", "people", "FARM"],
        [*rows, [f"**{cell}**" for cell in (f"mean of {len(joints)}", *mean)]],
    )
    return {"accuracy": accuracy, "joints": by_joint}


def sets(program: Path, work: Path) -> str:
    rows = []
    for name, what in SETS.items():
        folder = work / name
        if not folder.exists():
            run(program, "synth", "--set", name, "-o", folder)
        found = scores(program, folder / "meshes", folder / "truth", work / "skeletons" / name)
        error = "" if found["mean_error"] is None else short(found["mean_error"])
        rows.append([f"`{name}`: {what}", f"{found['solved']} of {found['meshes']}", error])
    return table(["set", "solved", "mean error"], rows)


def damages(printed: str) -> str:
    """The table of `skelgen-damage-table`, its kinds in words."""
    source = (ROOT / "tests/damage/kinds.cpp").read_text(encoding="utf-8")
    words = dict(re.findall(r'\{"([a-z0-9-]+)", "([^"]+)"', source))
    rows = []
    for line in printed[printed.index("damage  ") :].splitlines()[1:]:  # behind what a build says
        kind, meshes, solved, error, of_clean, sure = line.split()[:6]
        rows.append([words.get(kind, kind), f"{solved} of {meshes}", error, of_clean, sure])
    return table(["damage", "right", "mean error", "of that of sound ones", "wrong with confidence above 0.8"], rows)


def characters(program: Path, folder: Path) -> str:
    """What characters.py counts."""
    found = score_characters(program, folder, os.cpu_count() or 1)

    def share(name: str) -> str:
        return "{} of {}".format(*found[name])

    return table(
        ["", ""],
        [
            ["usable", share("usable")],
            ["answered at all", share("answered")],
            ["mean error of the usable", short(found["mean_error"])],
            ["usable, of those with a confidence above 0.8", share("usable_above_0.8")],
            ["no body, and refused or said to be a guess", share("refused")],
            ["wrong with a confidence above 0.8", ", ".join(f"`{name}`" for name in found["wrong_and_sure"]) or "none"],
        ],
    )


RIGS = {  # columns of `skelgen-rigs`
    "2 limbs": "vertices that follow two limbs by more than 1 % each",
    "islands": "vertices that follow most what none of their neighbours does",
    "stretch": "largest stretch of an edge, elbows and knees bent by 90 degrees",
    "volume": "volume that a forearm or calf, closed at its ends, then gains or loses",
    "gaps": "widest gap that then opens between pieces, of the height",
    "arms": "upper arms of the un-posed body beside level, extracted again, in degrees",
    "by rig": "the un-posed body posed back by its rig, as viewers do it: mean distance",
    "back": "the same, its skeleton and weights found anew",
    "seconds": "from file to rig, in seconds",
}


def rigs(printed: str) -> str:
    """Median and worst of the columns of `skelgen-rigs`."""
    head, *lines = printed[printed.index("body  ") :].splitlines()
    columns = re.split(r"\s{2,}| (?=sums|2 limbs|islands)", head.strip())
    rows = [line.split() for line in lines if "refused" not in line]
    values = {name: [float(row[i].rstrip("%")) for row in rows] for i, name in enumerate(columns) if i > 0}
    unit = {name: "%" if rows[0][i].endswith("%") else "" for i, name in enumerate(columns)}

    def say(name: str, value: float) -> str:
        return f"{value:g} {unit[name]}".strip()

    return table(
        [f"of {len(rows)} rigs", "median", "worst"],
        [[what, say(name, statistics.median(values[name])), say(name, max(values[name], key=abs))] for name, what in RIGS.items()],
    )


def speed(printed: str) -> str:
    """The table that `skelgen-bench` prints, and the sentences below it."""
    return printed[printed.index("| mesh ") :].strip() + "\n"


def verbatim(printed: str) -> str:
    """What a program printed, without what a build says before, folders, and single measures, which are hundreds."""
    left_out = re.compile(r"\[\d+/\d+\]|ninja: |== |    [a-z_]+ +\d|  measure ")
    lines = [re.sub(r"\S*/meshes/", "", line) for line in printed.splitlines() if not left_out.match(line)]
    return "```text\n" + "\n".join(lines).strip() + "\n```\n"


def machine() -> str:
    model = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    system = re.search(r'PRETTY_NAME="([^"]+)"', Path("/etc/os-release").read_text(encoding="utf-8"))
    return f"{system[1] if system else platform.system()}, {platform.machine()}, {model[1] if model else 'unknown processor'}"


def main() -> None:
    parser = argparse.ArgumentParser(description="Measures, and writes the tables of the manual's results.")
    parser.add_argument("program", type=Path)
    parser.add_argument("page", type=Path)
    parser.add_argument("--bodies", type=Path)
    parser.add_argument("--sets", type=Path)
    parser.add_argument("--characters", type=Path)
    for name in ("damages", "rigs", "speed", "repeatability", "noise"):
        parser.add_argument(f"--{name}", type=Path)
    options = parser.parse_args()
    work = ROOT / "build/results"
    blocks: dict[str, str] = {}
    if options.bodies:
        blocks |= real(options.program, options.bodies, work)
    if options.sets:
        blocks["sets"] = sets(options.program, options.sets)
    if options.characters:
        blocks["characters"] = characters(options.program, options.characters)
    printed = {"damages": damages, "rigs": rigs, "speed": speed, "repeatability": verbatim, "noise": verbatim}
    for name, block in printed.items():
        if file := getattr(options, name):
            blocks[name] = block(file.read_text(encoding="utf-8"))
    commit = run("git", "-C", ROOT, "rev-parse", "--short", "HEAD").strip()
    version = run(options.program, "--version").split()[1]
    note = f"*Measured with {version}, commit {commit}, on {datetime.date.today():%d %B %Y}: {machine()}.*\n"
    text = options.page.read_text(encoding="utf-8")
    for name, block in blocks.items():
        pattern = re.compile(rf"<!-- measured: {name} -->\n.*?<!-- end -->\n", re.DOTALL)
        if len(pattern.findall(text)) != 1:
            sys.exit(f"{options.page} has not one place for the table {name}")
        text = pattern.sub(lambda _: f"<!-- measured: {name} -->\n\n{block}\n{note}\n<!-- end -->\n", text)  # noqa: B023
    options.page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
