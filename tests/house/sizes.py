#!/usr/bin/env python3
"""Says what has grown large: files, units, folders, classes, pages, and figures of pages without a source.

Nothing fails for it: a limit is a sign that two ideas may live in one place. Tests have no limits.
"""

import re
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FLOORS = ("index", "interaction", "render", "stereo", "app")
NOTED = 0.8  # from this part of a limit on


def read(path):
    return (ROOT / path).read_text(encoding="utf-8")


FILES = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8", errors="replace") for floor in FLOORS
         for path in sorted((ROOT / floor).rglob("*")) if path.is_file() and "__pycache__" not in path.parts}
SOURCES = {path: text for path, text in FILES.items() if path.endswith((".h", ".cpp"))}
GUIDE = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8") for path in (ROOT / "docs/guide").glob("*.md")}


def lines_of(texts, name=lambda path: path):
    counts = Counter()
    for path, text in texts.items():
        counts[name(path)] += text.count("\n")
    return counts


def bytes_of(texts):
    return {path: len(text.encode()) for path, text in texts.items()}


def innermost_out(pattern, by, text):
    """Replaces what a pattern finds until it finds nothing more: brackets within brackets."""
    while (shorter := re.sub(pattern, by, text)) != text:
        text = shorter
    return text


def without_words(text):
    """A source without comments and without the insides of literals."""
    return re.sub(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', '""', text,
                  flags=re.S)


def members_in(body):
    """The numbers of data members and of functions that the body of a class declares."""
    body = innermost_out(r"\{[^{}]*\}", "\0", body)
    body = innermost_out(r"<[^<>]*>", "", body)
    body = innermost_out(r"\([^()\1]*\)", "\1", body).replace("\1", "()")
    members = functions = 0
    # A function with a body ends without a semicolon.
    for declaration in re.split(r";|(?<=\0)(?=\s*[^\s;,\0])", body):
        declaration = re.sub(r"\b(public|private|protected)\s*:(?!:)", "", declaration).strip()
        if "(" in re.split(" = |\0", declaration)[0]:
            functions += 1
        elif declaration and not re.match(
                r"(using|friend|enum|class|struct|union|typedef|template|static_assert|#|(inline\s+)?static)\b",
                declaration):
            members += 1 + re.sub(r"\(\)", "", declaration).count(",")
    return members, functions


def members_of_classes():
    """The data members of classes that have functions; a record that can only be compared is plain."""
    counts = {}
    for path, text in SOURCES.items():
        text = without_words(text)
        for match in re.finditer(r"(?<!enum )\b(?:class|struct)\s+(\w+)(?:\s+final)?\s*(?::[^{};()]*)?\{", text):
            depth, end = 1, match.end()
            while depth and end < len(text):
                depth += {"{": 1, "}": -1}.get(text[end], 0)
                end += 1
            members, functions = members_in(text[match.end():end - 1])
            if functions > 1:
                counts[f"{path} {match[1]}"] = members
    return counts


def sources_of_classes():
    places = {}
    for path, text in SOURCES.items():
        if path.endswith(".cpp"):
            text = innermost_out(r"<[^<>]*>", "", without_words(text))
            for name in re.findall(r'^(?:[A-Za-z_][^=;"\n]*?\b)?([A-Z]\w*)::~?\w+\(', text, re.M):
                places.setdefault(f"{path.split('/')[0]} {name}", set()).add(path)
    return {f"{name}, in {', '.join(sorted(paths))}": len(paths) for name, paths in places.items()}


def words_of_architecture():
    table = read("docs/ARCHITECTURE.md").split("\n## Words\n")[1].split("\n## ")[0]
    return {"docs/ARCHITECTURE.md": len(re.findall(r"^\| (?!word )[^|]+ \| [^|]+ \| [^|]+ \|$", table, re.M))}


LIMITS = [
    ("lines in a file", 400, lines_of(SOURCES)),
    ("lines in a header and its source", 600, lines_of(SOURCES, lambda path: path.rpartition(".")[0])),
    ("files in a folder", 40, Counter(path.rpartition("/")[0] for path in FILES)),
    ("members in a class with functions", 30, members_of_classes()),
    ("sources of a class", 1, sources_of_classes()),
    ("lines in a page of the guide", 150, lines_of(GUIDE)),
    ("bytes in a page of the guide", 7500, bytes_of(GUIDE)),
    ("lines in the front page", 150, lines_of({"README.md": read("README.md")})),
    ("bytes in the front page", 9000, bytes_of({"README.md": read("README.md")})),
    ("words of the project", 40, words_of_architecture()),
]

# Figures that are no measurements: a limit or a setting, which a file of the program holds.
CONSTANTS = {
    ("docs/guide/exploring.md", "10 s"): ("interaction/step_track.h", "kRoundSeconds = 10.0"),
    ("docs/guide/exploring.md", "1 %"): ("interaction/controls/controls.cpp", "kCoarse = 0.01"),
    ("docs/guide/export.md", "16 MiB"): ("index/export/exported_mesh.cpp", "kMostHeld = std::uint64_t{16} << 20"),
    ("docs/guide/export.md", "128 MiB"): ("app/commands/command_export.cpp", "kMostKept = std::uint64_t{128} << 20"),
    ("docs/guide/headsets.md", "100 ms"): ("app/quality/frame_quality.h", "kStillAfter{0.1}"),
    ("docs/guide/tracking.md", "2 %"): ("interaction/trackers/calibration.cpp", "kNearlyOrthogonal = 0.02"),
    ("docs/guide/walls.md", "2 %"): ("app/config/check/check_screens.cpp", "kSquare = 0.02f"),
}


def figures_in(page):
    """The figures in the words of a page: of `6 / 21 ms` `6 ms` and `21 ms`. Numbers without a unit count if they have
    three decimals or more."""
    words = re.sub(r"```[^`]*```|`[^`\n]*`|(?<=\])\([^)]*\)|doi 10\.[^\s\]]*", "", page)
    for numbers, unit, bare in re.findall(
            r"((?:\d[\d,.]*(?: %)?(?: / | to ))*\d[\d,.]*) ?(ms|us|s|fps|MiB|GiB|Hz|%)(?!\w)|(\d+\.\d{3,})", words):
        for number in re.findall(r"\d[\d,]*(?:\.\d+)?", numbers or bare):
            yield f"{number} {unit}".strip()


def figures_without_a_source():
    """Figures that stand neither in the words and results of docs/results nor in the constants of the program."""
    results = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "docs/results").iterdir())
    results += read("tests/bench/results_page.md")
    for page, text in {"README.md": read("README.md"), "docs/README.md": read("docs/README.md"), **GUIDE}.items():
        for figure in figures_in(text):
            number, _, unit = figure.replace(",", "").partition(" ")
            pattern = r"(?<![\d.])" + re.escape(number) + ("" if "." in number else r"(?:\.0)?")
            pattern += rf"(?: of \d+)? {unit}" if unit else r"(?!\d)"
            file, constant = CONSTANTS.get((page, figure), (None, None))
            if not (constant in read(file) if file else re.search(pattern, results)):
                yield f"{page}: {figure}: neither measured (docs/results) nor a constant of the program"


def main():
    for what, limit, counts in LIMITS:
        noted = sorted(((count, name) for name, count in counts.items() if count >= NOTED * limit), reverse=True)
        for count, name in noted:
            if count > limit:
                print(f"large: {name}: {count} {what}, at most {limit}")
        near = [f"{name} ({count})" for count, name in noted if count <= limit]
        if near and limit > 1:
            more = f", and {len(near) - 3} more" if len(near) > 3 else ""
            print(f"nearly: {what}, at most {limit}: {', '.join(near[:3])}{more}")
    for finding in figures_without_a_source():
        print(f"no source: {finding}")


if __name__ == "__main__":
    main()
