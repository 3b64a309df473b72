#!/usr/bin/python3
"""Find all candidates of the meshes in folders: FOLDER/truth/NAME.json names the mesh in FOLDER/files or FOLDER/meshes.

usage: find_candidates.py SKELGEN_CANDIDATES OUT FOLDER... [--jobs N] [--template NAME]

Writes OUT/<folder's name>/candidates/NAME.jsonl, and a link to the truths beside it: what calibrate.py reads. Meshes
that are done are not done again. A mesh is given two minutes.
"""
import argparse
import json
import os
import subprocess
from multiprocessing.pool import ThreadPool


def mesh_of(folder, name, truth, template):
    """The mesh that a truth is of, with the animation to pose it by; none where it is not there."""
    for meshes in ("files", "meshes"):
        for file in (truth.get("file"), truth.get("mesh"), name + ".off"):
            if isinstance(file, str) and os.path.exists(f"{folder}/{meshes}/{file}"):
                animation = truth.get("animation") or {}
                return [f"{folder}/{meshes}/{file}", "exhaustive", template] + ([str(animation["name"]), str(animation["time"])] if animation else [])
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("out")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--template", default="human21")
    a = parser.parse_args()
    work = []
    for folder in map(os.path.abspath, a.folders):
        # A folder of sets has truth/SET/NAME.json and meshes/SET/NAME.off.
        sets = [d for d in sorted(os.listdir(folder + "/truth")) if os.path.isdir(f"{folder}/truth/{d}")] or [""]
        for one in sets:
            out = f"{a.out}/{os.path.basename(folder)}{'-' + one if one else ''}"
            os.makedirs(out + "/candidates", exist_ok=True)
            truths = os.path.join(folder, "truth", one)
            if not os.path.exists(out + "/truth"):
                os.symlink(truths, out + "/truth")
            for file in sorted(os.listdir(truths)):
                name, truth = file[:-5], json.load(open(f"{truths}/{file}"))
                arguments = mesh_of(folder, os.path.join(one, name), truth, a.template)
                target = f"{out}/candidates/{name}.jsonl"
                if arguments and not os.path.exists(target):
                    work.append((arguments, target))

    def run(task):
        arguments, target = task
        try:
            found = subprocess.run([a.program, *arguments], capture_output=True, text=True, timeout=120).stdout
        except subprocess.TimeoutExpired:
            found = ""
        with open(target + ".part", "w") as file:
            file.write(found)
        os.rename(target + ".part", target)

    with ThreadPool(a.jobs) as pool:
        pool.map(run, work, 1)


if __name__ == "__main__":
    main()
