#!/usr/bin/env python3
"""The parts of a program that was built, with their licences, as SPDX 2.3 in JSON.

sbom.py BUILD TARGET [-o FILE]: what Ninja says was compiled and linked, and which Debian packages those files are of.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
from datetime import datetime, timezone
from pathlib import Path

# Names that Debian's copyright files use, and SPDX' for the same.
SPDX = {
    "expat": "MIT",
    "mit": "MIT",
    "apache-2.0": "Apache-2.0",
    "apache-2": "Apache-2.0",
    "apache": "Apache-2.0",
    "unlicense": "Unlicense",
    "bsl-1": "BSL-1.0",
    "bsd-2-clause": "BSD-2-Clause",
    "bsd-2": "BSD-2-Clause",
    "bsd-3-clause": "BSD-3-Clause",
    "bsd-3": "BSD-3-Clause",
    "bsd": "BSD-3-Clause",
    "bsl-1.0": "BSL-1.0",
    "boost-1.0": "BSL-1.0",
    "gpl-2+": "GPL-2.0-or-later",
    "gpl-2": "GPL-2.0-only",
    "gpl-3": "GPL-3.0-only",
    "gpl-3+": "GPL-3.0-or-later",
    "lgpl-2": "LGPL-2.0-only",
    "lgpl-2+": "LGPL-2.0-or-later",
    "lgpl-2.1": "LGPL-2.1-only",
    "lgpl-2.1+": "LGPL-2.1-or-later",
    "lgpl-3": "LGPL-3.0-only",
    "lgpl-3+": "LGPL-3.0-or-later",
    "libpng": "Libpng",
    "mpl-2": "MPL-2.0",
    "mpl-2.0": "MPL-2.0",
    "zlib": "Zlib",
}

# Packages whose copyright file is not made for programs to read; as that file says.
UNNAMED = {
    "libc6": "LGPL-2.1-or-later",
    "libcgal": "LGPL-3.0-or-later AND GPL-3.0-or-later",
    "libgcc": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "libmpfr": "LGPL-3.0-or-later",
    "libstdc++": "GPL-3.0-or-later WITH GCC-exception-3.1",
}


def output(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def objects_of(build: Path, target: str) -> set[str]:
    return {name for name in output("ninja", "-C", str(build), "-t", "inputs", target).split() if name.endswith(".o")}


def bundled(root: Path) -> list[tuple[str, str, str]]:
    """Name, version and licence of each npm package that the page of `skelgen view` has in it."""
    view = root / "apps/view"
    named = json.loads((view / "package.json").read_text(encoding="utf-8")).get("dependencies", {})
    found = []
    for name in sorted(named):
        package = json.loads((view / "node_modules" / name / "package.json").read_text(encoding="utf-8"))
        found.append((name, package["version"], package.get("license", "NOASSERTION")))
    return found


def files_of(build: Path, target: str) -> set[str]:
    """Headers that the target's objects include, and libraries that it is linked from, outside of the project."""
    ninja = ["ninja", "-C", str(build), "-t"]
    objects = objects_of(build, target)
    files: set[str] = set()
    at = ""
    for line in output(*ninja, "deps").splitlines():
        if line and not line[0].isspace():
            at = line.split(":")[0]
        elif line.strip() and at in objects:
            files.add(line.strip())
    last = output(*ninja, "commands", target).rstrip().splitlines()[-1]
    files.update(word for word in last.split() if re.search(r"\.(a|so)(\.[0-9.]+)?$", word))
    return {os.path.realpath(build / file) for file in files}


def packages_of(files: set[str]) -> set[str]:
    outside = sorted(file for file in files if file.startswith("/usr/"))
    found: set[str] = set()
    for start in range(0, len(outside), 500):
        done = subprocess.run(["dpkg", "-S", *outside[start : start + 500]], capture_output=True, text=True)
        found.update(line.split(": ")[0] for line in done.stdout.splitlines())
    return found


def licences_of(package: str) -> list[str]:
    """Those that the package's copyright file names, as SPDX does where it has a name for them."""
    path = Path("/usr/share/doc") / package.split(":")[0] / "copyright"
    text = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
    # The first paragraph is that of most files; those of debian/ and of tests are none of what is compiled.
    named: list[str] = []
    for paragraph in re.split(r"\n\s*\n", text):
        files = re.search(r"^Files:\s*(.*(?:\n\s+.*)*)", paragraph, re.MULTILINE)
        licence = re.search(r"^License:\s*(\S[^\n]*)", paragraph, re.MULTILINE)
        if files and licence and not all(re.match(r"debian/|test|doc", name) for name in files[1].split()):
            named.append(licence[1].strip())
    return list(dict.fromkeys(named))


def choice(name: str) -> str:
    """SPDX' expression for one of Debian's names, which may hold several; nothing where it has none."""
    alternatives = [SPDX.get(part.strip().lower(), "") for part in re.split(r"\s+or\s+", name, flags=re.IGNORECASE)]
    if not all(alternatives):
        return ""
    return alternatives[0] if len(alternatives) == 1 else "(" + " OR ".join(alternatives) + ")"


def expression(package: str, named: list[str]) -> str:
    if not named:
        return next((licence for start, licence in UNNAMED.items() if package.startswith(start)), "NOASSERTION")
    known = [choice(part) for name in named for part in re.split(r"\s+and\s+|,\s*", name)]
    return " AND ".join(dict.fromkeys(known)) if all(known) else "NOASSERTION"


def main() -> int:
    parser = argparse.ArgumentParser(description="Lists the parts of a program, with their licences.")
    parser.add_argument("build", type=Path)
    parser.add_argument("target")
    parser.add_argument("-o", "--output", type=Path)
    options = parser.parse_args()
    root = Path(__file__).resolve().parents[2]
    header = (root / "include/skelgen/version.hpp").read_text(encoding="utf-8")
    version = ".".join(re.findall(r"#define SKELGEN_VERSION_\w+ (\d+)", header))
    packages = sorted(packages_of(files_of(options.build.resolve(), options.target)))
    if not packages:
        sys.exit(f"{options.build} has nothing built of {options.target}: build it first")
    parts = [
        {
            "SPDXID": "SPDXRef-skelgen",
            "name": "skelgen",
            "versionInfo": version,
            "downloadLocation": "NOASSERTION",
            "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION",
            "licenseDeclared": "MIT",
            "copyrightText": "Copyright (c) 2026 skelgen contributors",
        }
    ]
    relations = [("SPDXRef-DOCUMENT", "DESCRIBES", "SPDXRef-skelgen")]
    for package in packages:
        name = package.split(":")[0]
        number = output("dpkg-query", "--show", "--showformat=${Version}", package).strip()
        named = licences_of(package)
        identifier = "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name)
        parts.append(
            {
                "SPDXID": identifier,
                "name": name,
                "versionInfo": number,
                "supplier": "Organization: Debian",
                "downloadLocation": "NOASSERTION",
                "filesAnalyzed": False,
                "licenseConcluded": "NOASSERTION",
                "licenseDeclared": expression(name, named),
                "licenseComments": "Debian names: " + "; ".join(named)
                if named
                else "Debian's copyright file names none",
                "copyrightText": "NOASSERTION",
                "externalRefs": [
                    {
                        "referenceCategory": "PACKAGE-MANAGER",
                        "referenceType": "purl",
                        "referenceLocator": f"pkg:deb/debian/{name}@{number}",
                    }
                ],
            }
        )
        relations.append(("SPDXRef-skelgen", "DEPENDS_ON", identifier))
    if any("view_objects" in name for name in objects_of(options.build.resolve(), options.target)):
        for name, number, licence in bundled(root):
            identifier = "SPDXRef-npm-" + re.sub(r"[^A-Za-z0-9.-]", "-", name)
            parts.append(
                {
                    "SPDXID": identifier,
                    "name": name,
                    "versionInfo": number,
                    "downloadLocation": "NOASSERTION",
                    "filesAnalyzed": False,
                    "licenseConcluded": "NOASSERTION",
                    "licenseDeclared": licence,
                    "copyrightText": "NOASSERTION",
                    "externalRefs": [
                        {
                            "referenceCategory": "PACKAGE-MANAGER",
                            "referenceType": "purl",
                            "referenceLocator": f"pkg:npm/{name.replace('@', '%40')}@{number}",
                        }
                    ],
                }
            )
            relations.append(("SPDXRef-skelgen", "DEPENDS_ON", identifier))
    text = json.dumps(parts, sort_keys=True).encode()
    moment = datetime.fromtimestamp(
        int(os.environ.get("SOURCE_DATE_EPOCH", datetime.now(timezone.utc).timestamp())), timezone.utc
    )
    document = {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"skelgen-{version}",
        "documentNamespace": f"urn:skelgen:{version}:{hashlib.sha256(text).hexdigest()[:32]}",
        "creationInfo": {
            "created": moment.strftime("%Y-%m-%dT%H:%M:%SZ"),
            "creators": ["Tool: contrib/packaging/sbom.py"],
        },
        "packages": parts,
        "relationships": [
            {"spdxElementId": first, "relationshipType": kind, "relatedSpdxElement": second}
            for first, kind, second in relations
        ],
    }
    content = json.dumps(document, indent=2) + "\n"
    if options.output:
        options.output.write_text(content, encoding="utf-8")
    else:
        sys.stdout.write(content)
    return 0


if __name__ == "__main__":
    sys.exit(main())
