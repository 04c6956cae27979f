#!/usr/bin/env python3
"""Says how many packages apt would install on a minimal Debian, and their size, from the package lists of this machine.

    packaging/closure.py                     what `./run build` and `./run build --everything` install
    packaging/closure.py FILE.deb...         what these packages install, without and with what they recommend
    packaging/closure.py PACKAGE...          likewise, of the archive

Minimal is what is essential or required, and apt; that is not counted. Packages of the files themselves are not counted either.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def output(*words):
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout


def field(text, name):
    found = re.search(rf"^{name}: (.*)$", text, re.M)
    return found[1] if found else ""


AVAILABLE = {}
for stanza in output("apt-cache", "dumpavail").split("\n\n"):
    AVAILABLE.setdefault(field(stanza, "Package"), stanza)
MINIMAL = [name for name, stanza in AVAILABLE.items()
           if field(stanza, "Priority") == "required" or field(stanza, "Essential") == "yes"] + ["apt"]


def closure(packages, recommended=False):
    told = output("apt-get", "-o", "Dir::State::status=/dev/null", "-s", "install", *MINIMAL,
                  *([] if recommended else ["--no-install-recommends"]), *packages)
    return set(re.findall(r"^Inst (\S+)", told, re.M))


def tell(what, packages, recommended=False):
    added = closure(packages, recommended) - closure([])
    download = sum(int(field(AVAILABLE[name], "Size")) for name in added)
    disk = sum(int(field(AVAILABLE[name], "Installed-Size")) * 1024 for name in added)
    print(f"{what}: {len(added)} packages, {download / 1e6:.0f} MB to download, {disk / 1e6:.0f} MB on the disk")


def names_in(deb, kind):
    """What a package depends on: of alternatives the first; packages of this project are left to the caller."""
    words = output("dpkg-deb", "-f", deb, kind).split(",")
    names = [re.split(r"[ (|]", word.strip())[0] for word in words if word.strip()]
    return [name for name in names if not name.startswith("isochron")]


if not sys.argv[1:]:
    for words in ["./run build"], ["./run build", "--everything"]:
        line = output(ROOT / "run", "packages", "debian", *words[1:])
        tell(" ".join(words), line.split("--no-install-recommends")[1].split())
elif all(word.endswith(".deb") for word in sys.argv[1:]):
    needed = [name for deb in sys.argv[1:] for name in names_in(deb, "Depends")]
    wanted = [name for deb in sys.argv[1:] for name in names_in(deb, "Recommends")]
    tell("what they depend on", needed)
    tell("and what they recommend", needed + wanted)
else:
    tell(" ".join(sys.argv[1:]), sys.argv[1:])
    tell("with all that is recommended", sys.argv[1:], True)
