"""Runs every command plainly, with --json, --quiet and --verbose, and compares what it prints where with the page on JSON.
Usage: each_command.py PROGRAM SOURCES answers | reports | movie | pictures | failures | advice | help, in a folder with run42.isochron, run42, walk.jsonl, cave.pvx and pictures."""
import json
import re
import shlex
import subprocess
import sys

program, sources, part = sys.argv[1:]
wrong = []


def run(line, *more):
    done = subprocess.run([program, *shlex.split(line), *more], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


def expect(what, good, *said):
    if not good:
        wrong.append(f"{what}: {' '.join(str(one) for one in said)[:600]}")


# ---- the page: its keys by command, whether each is always there, and its type
TYPES = {"text": str, "count": int, "number": (int, float), "boolean": bool, "list": list, "object": dict}
KEYS = {}
command = None
for text in open(sources + "/docs/guide/json.md"):
    if text.startswith("## "):
        command = text[3:].strip()
        KEYS[command] = {}
    row = re.match(r"\| (`.*`) \| (\w+)( or null)? \| (.*)\|$", text)
    if row and command:
        for key in re.findall("`([^`]*)`", row[1]):
            KEYS[command][key] = TYPES[row[2]], bool(row[3]), row[4].startswith("only ")
ALWAYS_ABSENT = {"info run42": "low high value_unit nan_values histogram file_bytes volume_bytes bricks_bytes tree_bytes "
                 "detail_bytes unused_bytes staying_chunks staying_percent detail raw_bytes percent_of_raw tiers plan levels "
                 "lossless refers_to lattice max_variation content_hash between".split()}


def expect_object(line, text, failed=False):
    try:
        told = json.loads(text)
    except ValueError as error:
        return expect(line, False, error, text)
    if not isinstance(told, dict):
        return expect(line, line.startswith("table ") and isinstance(told, list), "not an object")
    expect(line, failed == ("failure" in told), "failure", told)
    told.pop("failure", None)
    keys = KEYS[line.split()[0]]
    if line.startswith("config schema"):
        return None
    for key, value in told.items():
        kind, may_be_null, _ = keys.get(key, (None, False, False))
        expect(f"{line}: {key}", kind and ((may_be_null and value is None) or isinstance(value, kind) and
                                           (kind is bool or not isinstance(value, bool))), value, "is not what the page says")
    for key, (_, _, sometimes) in keys.items():
        if not failed and not sometimes and key not in ALWAYS_ABSENT.get(line, []):
            expect(line, key in told, key, "is missing")


def told_apart(line, answers, json_first):
    """Of a command that succeeds. answers: it prints what it was asked for; else reports what it has done."""
    status, out, err = run(line)
    expect(line, status == 0, err)
    for said in err.splitlines():
        expect(line, said.startswith("isochron: ") or said.endswith(" ..."), "on stderr", said)
    expect(line, not any(said.startswith(("note", "isochron: ")) for said in out.splitlines()) or line.startswith("info"),
           "a note on stdout", out)
    status, out, err = run(line, "--quiet")
    expect(line + " --quiet", (status, err) == (0, ""), status, err)
    expect(line + " --quiet", bool(out) == answers, out)
    # An object with all that --verbose adds beside it.
    status, out, err = run("--verbose --json " + line if json_first else line, *([] if json_first else ["--json", "--verbose"]))
    expect(line + " --verbose", "isochron: version " in err and "isochron: took " in err, status, err)
    expect(line + " --json", status == 0, err)
    expect_object(line, out)


def fails(line, status, quietly):
    for option in [["--json"]] + [["--quiet"]] * quietly:
        got, out, err = run(line, *option)
        expect(line, got == status, "status", got, err)
        said = [one for one in err.splitlines() if not one.endswith(" ...")]
        expect(line, said and said[-1].startswith("isochron: "), err)
        if option == ["--quiet"]:
            expect(line, len(said) == len(err.splitlines()) == 1, "not one line", err)
        if option == ["--json"]:
            expect_object(line, out, failed=True)
            expect(line, json.loads(out)["failure"] == said[-1][len("isochron: "):], out, err)


ANSWERS = """info run42.isochron
info run42
query run42.isochron --isovalue 100 --step 0 --repeat 1
query run42.isochron --isovalue 100 --step 0 --repeat 1 -o ids.bin
change run42.isochron --isovalue 100 --step 0 --to-step 1 --repeat 1
table walk.jsonl
measure run42.isochron --isovalue 100
explore --check-config cave4
explore --list-devices --config cave4
config import cave.pvx
config schema
completion bash
help
help generate sphere"""
REPORTS = """build run42 -o again.isochron --steps 1
build run42 -o run42.isochron --append
verify run42.isochron
export run42.isochron --isovalue 100 --step 0 -o s.ply --force
export run42.isochron --isovalue 100 --steps 0:1 -o s.ply --force --simplify 0.5cells
table walk.jsonl -o table.csv --force
serve run42.isochron --write-site site
generate sphere -o again --step-count 1 --force
config import cave.pvx -o cave.toml --force
manual -o pages"""
MOVIE = "movie walk.jsonl -o frames/ --force\nfigure figure.toml -o figure.pdf"
PICTURES = """replay walk.jsonl --stamps -o pictures
reproduce pictures/stamp_00012_stamp-1.png"""


def commands(lines):
    for number, line in enumerate(lines.split("\n")):
        told_apart(line, lines is ANSWERS, number % 2)


def failures():
    with open("run42.isochron", "rb") as whole, open("damaged.isochron", "wb") as damaged:
        content = bytearray(whole.read())
        content[9000] ^= 4
        damaged.write(content)
    with open("wrong.toml", "w") as out:
        out.write("version = 1\n[viewer]\neye_separation = 70\n")
    for line, status in [("verify damaged.isochron", 1), ("verify none.isochron", 1), ("info none.isochron", 1),
                         ("build none.vti -o x.isochron", 1), ("query run42.isochron --isovalue 1 --step 99", 1),
                         ("query run42.isochron --isovalue x --step 1", 2), ("export run42.isochron -o s.ply", 2),
                         ("explore --check-config none", 1), ("explore --check-config wrong.toml", 1),
                         ("replay none.jsonl", 1), ("reproduce run42.isochron", 1), ("table run42.isochron", 1),
                         ("measure run42.isochron --isovalue 1 --steps 99", 2), ("serve none.isochron", 1),
                         ("movie walk.jsonl -o x.avi", 2), ("tell state --socket none", 1), ("help bild", 2),
                         ("generate sphere", 2), ("config import none.pvx", 1), ("completion tcsh", 2), ("manual", 2),
                         ("change run42.isochron --isovalue 1 --step 1", 2)]:
        fails(line, status, line.startswith(("verify", "build", "explore", "tell")))


# Commands that messages propose keep what was typed: options before, between and behind the files.
def advice():
    TYPED = ["--crop=0:3,0:3,0:3", "--stride 2", "--steps 0", "--spacing 1 2 3", "--origin 0 0 '-1'", "--time-step 0.5",
             "--length-unit 'mm or so'", "--time-unit s", "--value-unit K", "--patience 9", "--type f32", "--keep-first",
             "--allow-surplus", "--color v --color-unit m", "--tiers none", "--codec zstd", "--refer", "--threads 1",
             "--lattice 8", "--max-variation 3", "--timeout 9", "--force", "--quiet", "--verbose", "--json", "--allow .",
             "--extra-axis-is-time", "--resample 5 5 5", "--member 0", "--header-bytes=0", "--color-by w"]
    name = "two arrays.vtk"
    with open(name, "w") as out:
        out.write("# vtk DataFile Version 3.0\nvtk output\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 5 5 5\nORIGIN 0 0 0\n"
                  "SPACING 1 1 1\nPOINT_DATA 125\n" + "".join(f"SCALARS {array} float 1\nLOOKUP_TABLE default\n" + "1 2 3 4 5 " * 25
                                                              + "\n" for array in "vw"))
    for first in range(0, len(TYPED), 8):
        some = TYPED[first:first + 8]
        options = [shlex.split(one) for one in some]
        words = ["build"] + sum(options[::2], []) + [name, "-o", "it's.isochron"] + sum(options[1::2], [])
        done = subprocess.run([program, *words], capture_output=True, text=True)
        said = [shlex.split(line) for line in done.stderr.splitlines() if line.startswith("isochron build")]
        expect(words, said and all([word for word in one[1:] if word not in ("--all-arrays", "--array", "v", "w")] ==
                                   [word for word in words if word not in ("v", "w")] for one in said), said, done.stderr)
        expect(words, [one[-2:] for one in said[:2]] == [["--array", "v"], ["--array", "w"]] and
               (len(said) == 2 if "--value-unit" in words else said[-1][-1] == "--all-arrays"), said)
    for line, kept in [("query 'two arrays.vtk' --isovalue 1 --step 0 --array w", ["--array", "w"]),
                       ("export 'two arrays.vtk' --isovalue 1 -o s.ply --array w --color-by v", ["--array", "w", "--array", "v"]),
                       ("change 'two arrays.vtk' --isovalue 1 --step 0 --to-isovalue 2 --array v", ["--array", "v"]),
                       ("verify 'two arrays.vtk'", [])]:
        advice = re.search("`isochron (.*?)` makes an index of data", run(line)[2])
        expect(line, advice and shlex.split(advice[1])[4:] == kept, advice)
        if advice and kept:
            status, out, err = run(advice[1], "--force", "--quiet")
            expect(line, status == 0, err)
            expect(line, run(line.replace(".vtk", ".isochron") + " --force" * line.startswith("export"))[0] == 0, "after the build")


# The table of commands has no other commands, no option without a word for its value, and no line of help too wide.
def all_help():
    reference = json.loads(run("help --json")[1])
    leaves = []

    def walk(command, words):
        below = command["commands"]
        for one in below:
            walk(one, words + [one["name"]])
        if not below:
            leaves.append(" ".join(words))
        names = [name for option in command["options"] for name in option["names"]]
        expect(" ".join(words), {"--json", "--quiet", "--verbose", "--help"} <= set(names), names)
        for option in command["options"]:
            if option["value"]:
                expect(" ".join(words), not re.search(r"\b(TEXT|U?INT|FLOAT|PATH)\b", option["value"]), option["names"], option["value"])
        shown = run("help " + " ".join(words))[1]
        expect(" ".join(words), run(" ".join(words), "--help")[1] == shown, "--help and help differ")
        lines = shown.splitlines()
        for words_of_ours in ("65536ths", "stays", "ranks", "Say commands", "so many", "made again", "The same", "else "):
            expect(" ".join(words), words_of_ours not in shown, words_of_ours)
        for said in lines:
            expect(" ".join(words), len(said) <= 80, "too wide", said)
        if words:
            expect(" ".join(words), "Examples:" in lines and not any(one.endswith(":") and one[0] != " " for one in
                                                                     lines[lines.index("Examples:") + 1:] if one), "examples")

    walk(reference, [])
    ran = ANSWERS + "\n" + REPORTS + "\n" + MOVIE + "\n" + PICTURES + "\ntell \n"
    for leaf in leaves:
        expect(leaf, any(line.startswith(leaf + " ") or line == leaf for line in ran.split("\n")) or leaf.split()[0] == "generate",
               "no line of this test runs it")


PARTS = {"answers": lambda: commands(ANSWERS), "reports": lambda: commands(REPORTS), "movie": lambda: commands(MOVIE),
         "pictures": lambda: commands(PICTURES), "failures": failures, "advice": advice, "help": all_help}
PARTS[part]()
print("\n".join(wrong))
sys.exit(bool(wrong))
