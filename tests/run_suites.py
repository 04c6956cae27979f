#!/usr/bin/env python3
"""Runs the test programs of a build, with one process for each suite, and says what each suite cost.

`./run test` calls it, in build/release for instance as

    tests/run_suites.py build/release landing --only 'Session.*egl'

A selection (SELECTIONS below) says which tests run. What a test did, processor time included, is read from what its
program prints (tests/support/test_main.cpp). The cost of each suite is kept in tests/costs.tsv (`--keep-costs`).
"""
import argparse
import hashlib
import json
import os
import random
import re
import select
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COSTS = ROOT / "tests/costs.tsv"

# A test that prints nothing new for so long hangs [s]; `--patience` says otherwise.
PATIENCE = 300
# What a test may cost: on average, and at most [s of processor time at the speed that tests/costs.tsv notes].
BUDGET_MEAN, BUDGET_CLAIM = 0.5, 5.0

# Suites about the state of a process (its fence, limits, signals, current folder, what it leaves behind): each test has a
# process of its own.
SINGLY = r"^(Fence\w*|ForeignFile|IdleLoop|LeftFiles|MemoryLimit|ProgramFolder|Readers|Wake)$"

# OSMesa draws with llvmpipe, as EGL does here: what is left of it in a landing are contexts, the golden pictures, one
# session and one replay.
OSMESA = r"/osmesa$"
OSMESA_KEPT = (
    r"^(WindowlessContext|OffscreenWindows|LeastDriver|Golden\w*)\."
    r"|SessionTest\.(ShowsTheCellsThatWereAskedFor|AReplayGivesTheSamePicturesAndTheSameCells)/"
)

# What no driver changes: faults of files, packages, pages, outputs, and how jobs are refused and end. Left out as well
# is what a driver does without memory: zink ends by itself with status 127 or waits for good. SteeredSession counts frames
# by a clock that runs on while zink is slow. OSMesa has no choice of drivers.
UNDRAWN = (
    r"/osmesa$|^(Bench|(Explore)?Faults\.|PowerLoss|Kills|Installed|Soak|MemoryShortage|HelpExamples|Pages/"
    r"|\w*/EachOutput|\w*/SteeredSession|Python|ReproduceTest\.(Every|WhatAnEmulated|Windows)"
    r"|ClusterJobTest\.(AJob|AKilled|AStopped|AProcessThat|ProcessesThat))"
)
# Of what is drawn, besides the first test of each suite of passes: the golden pictures, every shader, one window.
SMOKE = r"Golden\w*\.\w+/egl|^Shaders\.\w+/egl|SurfacePasses\.\w+/egl|^Window\w*\.\w*Shows"
SMOKE_PROGRAMS = {"render_gl_tests", "look_tests", "surface_tests"}
# What takes long under the address sanitizer though it handles no bytes from elsewhere: claims of sizes and of advice,
# and what is made and searched in memory alone.
LONG_OF_BYTES = (
    r"IndexAppendTest\.WritesLittleMore|StayingChunks\.TakeHardlyAnyBytes|BlendAdvice\.IsRightForForty|^ThiTree\."
    r"|KeptExtraction\.IsTheSameWithArrays|WideIds\.OfASurfaceAreColored"
)

# Tests that do less in a landing than they can: of random input a third of the rounds, of faults every fourth call.
LONG = r"^(Explore)?Faults\.|FootprintGeometry.*egl|ThiTree|RandomWalks|Recompute|RandomDamage"


@dataclass
class Selection:
    """Tests of programs that have one of `labels` (empty: all programs) and none of `without`."""

    labels: tuple = ()
    without: tuple = ()
    unless: str = ""  # names that are left out,
    kept: str = ""  # but for these
    only: str = ""  # names that are chosen
    firsts: bool = False  # of other suites of SMOKE_PROGRAMS the first test


SELECTIONS = {
    "all": Selection(),
    "landing": Selection(without=("bench",), unless=OSMESA, kept=OSMESA_KEPT),
    "osmesa": Selection(without=("bench",), only=OSMESA, unless=OSMESA_KEPT),
    "bench": Selection(labels=("bench",)),
    "long": Selection(without=("bench",), only=LONG),
    "drawn": Selection(labels=("gl",), without=("bench",), unless=UNDRAWN),
    "smoke": Selection(labels=("gl",), without=("bench",), unless=UNDRAWN, only=SMOKE, firsts=True),
    "bytes": Selection(labels=("bytes",), unless=LONG_OF_BYTES),
    "bytes-long": Selection(labels=("bytes",), only=LONG_OF_BYTES),
    "logic": Selection(labels=("cpu",), without=("bytes",)),
    "cpu": Selection(labels=("cpu",)),
    "threads": Selection(labels=("threads",)),
}


@dataclass
class Cost:
    claims: int = 0
    time: float = 0.0  # processor time [s]
    processes: int = 0
    contexts: int = 0
    draws: int = 0

    def add(self, other):
        for name in self.__dict__:
            setattr(self, name, getattr(self, name) + getattr(other, name))


@dataclass
class Group:
    """Tests that run in one process."""

    program: dict
    suite: str
    cases: list
    cost: Cost = field(default_factory=Cost)
    failed: list = field(default_factory=list)  # (name, why)
    dearest: tuple = (0.0, "")


def cases_of(program):
    """The full names of the tests of a program, in their order."""
    if program["kind"] != "gtest":
        return [program["name"]]
    said = subprocess.run([*program["command"], "--gtest_list_tests"], capture_output=True, text=True, check=True,
                          stdin=subprocess.DEVNULL, env=environment_of(program))
    names, suite = [], ""
    for line in said.stdout.splitlines():
        line = line.split("#")[0].rstrip()
        if line and not line.startswith(" "):
            suite = line
        elif line:
            names.append(suite + line.strip())
    return names


def environment_of(program):
    return {**os.environ, **dict(setting.split("=", 1) for setting in program["environment"])}


def suite_of(name):
    return name.rsplit(".", 1)[0]


def programs_of(arguments):
    """The programs of a selection, or of one part of them: those of one floor, which stand together, stay together."""
    selection = SELECTIONS[arguments.selection]
    programs = []
    for program in json.loads((arguments.build / "tests/programs.json").read_text()):
        labels = set(program["labels"])
        if (labels & set(selection.labels) or not selection.labels) and not labels & set(selection.without):
            programs.append(program)
    if arguments.programs:
        at, parts = part_of(arguments.programs)
        programs = programs[len(programs) * at // parts:len(programs) * (at + 1) // parts]
    return programs


def chosen(selection, program, names):
    if selection.unless:
        left_out = re.compile(selection.unless)
        kept = re.compile(selection.kept) if selection.kept else None
        names = [n for n in names if not left_out.search(n) or (kept and kept.search(n))]
    if selection.only:
        picked = {n for n in names if re.search(selection.only, n)}
        if selection.firsts and program["name"] in SMOKE_PROGRAMS:
            suites = {suite_of(n) for n in picked}
            for name in names:
                if suite_of(name) not in suites and name.endswith("/egl"):
                    suites.add(suite_of(name))
                    picked.add(name)
        names = [n for n in names if n in picked]
    return names


def groups_of(programs, arguments):
    """What is to run: a group for each suite, the dearest first."""
    selection = SELECTIONS[arguments.selection]
    groups = []
    for program, names in zip(programs, listed(programs, arguments.jobs)):
        names = chosen(selection, program, names)
        if arguments.only:
            names = [n for n in names if re.search(arguments.only, n)]
        suites = {}
        for name in names:
            singly = arguments.singly or re.search(SINGLY, suite_of(name))
            suites.setdefault(name if singly else suite_of(name), []).append(name)
        for suite, cases in suites.items():
            if arguments.part and not in_part(suite, arguments.part):
                continue
            groups.append(Group(program, suite, cases))
    kept = kept_costs()[1]
    groups.sort(key=lambda g: -kept[g.suite].time if g.suite in kept else -1.0 * len(g.cases))
    if arguments.turn and groups:
        first = arguments.turn % len(groups)
        groups = groups[first:] + groups[:first]
    if arguments.shuffle:
        random.Random(arguments.shuffle).shuffle(groups)
        for group in groups:
            random.Random(arguments.shuffle).shuffle(group.cases)
    return groups


def listed(programs, jobs):
    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(cases_of, programs))


def part_of(text):
    """K and N of a part, written K/N; K counts from 0."""
    at, parts = (int(number) for number in text.split("/"))
    return at, parts


def in_part(suite, part):
    """Whether a suite is in a part; the same for every run."""
    at, parts = part_of(part)
    return int(hashlib.sha256(suite.encode()).hexdigest(), 16) % parts == at


# What runs now: ended when this program is.
running = {}
guard = threading.Lock()


def still_running(session):
    """Lines about the processes of a session and what they started: number, state, what its threads wait in, command."""
    found, parents = {}, {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
            command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace").strip()
            waits = [(task / "wchan").read_text() or "0" for task in sorted(folder.glob("task/[0-9]*"))]
        except OSError:  # it has ended
            continue
        pid = int(folder.name)
        parents[pid] = int(fields[1])
        found[pid] = (int(fields[3]), f"{pid} {fields[0]} [{' '.join(waits)}] {command or '(ended)'}")
    def is_of_session(pid):
        while pid in found:
            if found[pid][0] == session:
                return True
            pid = parents[pid]
        return False
    return [line for pid, (_, line) in sorted(found.items()) if is_of_session(pid)]


def run_process(program, arguments, output):
    """Runs a program to its end, or until it prints nothing for PATIENCE; then what still runs is added to its output.

    Returns the status of the wait and the processor time of it and of what it waited for."""
    process = subprocess.Popen([*program["command"], *arguments], stdout=output, stderr=subprocess.STDOUT,
                               stdin=subprocess.DEVNULL, cwd=program["folder"] or None, env=environment_of(program),
                               start_new_session=True)
    with guard:
        running[process.pid] = process
    ends = select.poll()
    ends.register(os.pidfd_open(process.pid), select.POLLIN)
    size, since, hangs = 0, time.monotonic(), False
    while not ends.poll(1000):
        now = os.fstat(output.fileno()).st_size
        if now != size:
            size, since = now, time.monotonic()
        elif time.monotonic() - since > PATIENCE:
            hangs = True
            output.seek(0, os.SEEK_END)
            output.write("".join(f"runs: {line}\n" for line in still_running(process.pid)).encode())
            os.killpg(process.pid, signal.SIGKILL)
            break
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    try:  # what it left behind
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    with guard:
        running.pop(process.pid, None)
    return ("hung" if hangs else process.returncode), used.ru_utime + used.ru_stime


BEGINS = re.compile(r"\[ RUN      \] (\S+)")
ENDS = re.compile(r"\[ +(OK|FAILED|SKIPPED) +\] ([^\s,(]+)")
COST = re.compile(r"\[   COST   \] (\d+) ms, (\d+) processes, (\d+) contexts, (\d+) draws")


def words_of(status):
    if status == "hung":
        return f"printed nothing for {PATIENCE:g} s"
    if status < 0:
        return f"ended by {signal.Signals(-status).name}"
    return f"ended with status {status}"


def run_group(group):
    """Runs the tests of a group. After one that ends the process, the others run in another process."""
    if group.program["kind"] != "gtest":
        return run_command(group)
    left = list(group.cases)
    while left:
        with tempfile.TemporaryFile() as output:
            status, used = run_process(group.program, ["--gtest_filter=" + ":".join(left), "--gtest_color=no"], output)
            output.seek(0)
            text = output.read().decode(errors="replace")
        group.cost.time += used
        at, words, done = None, [], set()
        for line in text.splitlines():
            begins, ends, cost = BEGINS.search(line), ENDS.search(line), COST.search(line)
            if begins and begins[1] in left:
                at, words = begins[1], []
            elif ends and ends[2] == at:
                done.add(at)
                if ends[1] != "OK":
                    group.failed.append((at, "\n".join(words) or ends[1].lower()))
                at, words = None, []
            elif cost:  # printed before its test's end
                for name, number in zip(("processes", "contexts", "draws"), cost.groups()[1:]):
                    setattr(group.cost, name, getattr(group.cost, name) + int(number))
                group.dearest = max(group.dearest, (int(cost[1]) / 1000, at or group.suite))
            else:
                words.append(line)
        left = [name for name in left if name not in done]
        if at:
            group.failed.append((at, "\n".join([*words[-200:], words_of(status)])))
            left.remove(at)
        elif status != 0 and not any(name in done for name, _ in group.failed):
            group.failed.append((group.suite, "\n".join([*words[-200:], f"after its tests: {words_of(status)}"])))
        if not done and not at:
            group.failed += [(name, f"did not run: {words_of(status)}") for name in left]
            break
    group.cost.claims = len(group.cases)
    return group


def run_command(group):
    """Runs Python's unittest, or another command whose status says all."""
    with tempfile.TemporaryFile() as output:
        status, group.cost.time = run_process(group.program, [], output)
        output.seek(0)
        text = output.read().decode(errors="replace")
    ran = re.search(r"^Ran (\d+) test", text, re.MULTILINE)
    group.cost.claims = int(ran[1]) if ran else 1
    skipped = re.search(r"skipped=(\d+)", text)
    failed = re.findall(r"^(?:FAIL|ERROR): (.*)$", text, re.MULTILINE)
    if status != 0 or skipped or (group.program["kind"] == "unittest" and not ran):
        names = failed or [words_of(status)]
        group.failed = [(f"{group.suite}: {names[0]}", text[-20000:])]
        group.failed += [(f"{group.suite}: {name}", "see above") for name in names[1:]]
    return group


class Speed:
    """How fast this machine is now: the processor time of a fixed loop, measured beside the tests."""

    def __init__(self):
        self.times = []

    def measure(self):
        begin = time.thread_time()
        block = bytes(1 << 20)
        for _ in range(16):
            hashlib.blake2b(block).digest()
        self.times.append(time.thread_time() - begin)

    def loop(self):
        return statistics.median(self.times)


def kept_costs():
    """The processor time of the loop, and the costs of the suites, that tests/costs.tsv keeps."""
    costs, loop = {}, None
    if COSTS.exists():
        for line in COSTS.read_text().splitlines():
            words = line.split("\t")
            if words[0] == "# loop":
                loop = float(words[1])
            elif not line.startswith("#"):
                costs[words[0]] = Cost(int(words[1]), float(words[2]), *map(int, words[3:6]))
    return loop, costs


def scale_of(loop):
    """From processor time now to that at the speed of tests/costs.tsv. @param loop what the loop takes now [s]"""
    kept_loop = kept_costs()[0]
    return kept_loop / loop if kept_loop else 1.0


def keep_costs(groups, loop, whole):
    """Writes what this run found for its suites. Others keep their rows, unless the run was whole."""
    kept_loop, costs = kept_costs()
    if whole:
        costs = {}
    scale = scale_of(loop)
    for group in groups:
        cost = group.cost
        costs[group.suite] = Cost(cost.claims, round(cost.time * scale, 2), cost.processes, cost.contexts, cost.draws)
    lines = ["# What each suite of a landing costs (./run test --keep-costs). Processor time in seconds, at a speed at "
             "which the loop of tests/run_suites.py takes as long as the next line says.",
             f"# loop\t{kept_loop or loop:.4f}", "# suite\tclaims\ttime\tprocesses\tcontexts\tdraws"]
    for suite, cost in sorted(costs.items()):
        lines.append(f"{suite}\t{cost.claims}\t{cost.time:.2f}\t{cost.processes}\t{cost.contexts}\t{cost.draws}")
    COSTS.write_text("\n".join(lines) + "\n")


def told_costs(groups, loop, check):
    """Prints the ten dearest suites beside what is kept of them. Returns what is over twice its budget."""
    kept, scale = kept_costs()[1], scale_of(loop)
    total = Cost()
    for group in groups:
        total.add(group.cost)
    print(f"\nThe ten dearest suites, of {total.time * scale:.0f} s of processor time (this machine took "
          f"{1 / scale:.2f} times as long), {total.processes} processes, {total.contexts} contexts, {total.draws} draws:")
    for group in sorted(groups, key=lambda g: -g.cost.time)[:10]:
        cost, before = group.cost, kept.get(group.suite)
        beside = f"kept {before.time:.1f} s" if before else "not kept yet"
        print(f"{cost.time * scale:8.1f} s ({beside}), {cost.claims} tests, {cost.processes} processes, "
              f"{cost.contexts} contexts, {cost.draws} draws: {group.suite}; dearest {group.dearest[1]} "
              f"{group.dearest[0] * scale:.1f} s")
    if not check:
        return []
    over = []
    for group in groups:
        before = kept.get(group.suite)
        seconds, name = group.dearest[0] * scale, group.dearest[1]
        # Processor time grows where others wait actively, as a job's processes do: what was kept so dear may be so.
        as_kept = before and group.cost.time * scale <= 2 * before.time
        if seconds > 2 * BUDGET_CLAIM and not as_kept:
            over.append(f"{name} took {seconds:.1f} s of processor time; a test's budget is {BUDGET_CLAIM} s")
        for what in ("processes", "contexts", "draws"):
            now, most = getattr(group.cost, what), 2 * getattr(before, what) + 5 if before else None
            if most is not None and now > most and not group.failed:
                over.append(f"{group.suite}: {now} {what}; tests/costs.tsv keeps {getattr(before, what)} "
                            f"(if that is meant: ./run test --keep-costs '^{group.suite}')")
    mean = total.time * scale / max(1, total.claims)
    if mean > 2 * BUDGET_MEAN:
        over.append(f"a test took {mean:.2f} s of processor time on average; the budget is {BUDGET_MEAN} s")
    return over


def run_all(groups, arguments):
    """Runs groups side by side; returns those that ran before the time was over, and the speed."""
    speed, waiting, ran = Speed(), list(reversed(groups)), []
    speed.measure()
    end = time.monotonic() + arguments.seconds if arguments.seconds else None

    def work():
        while True:
            with guard:
                if not waiting or (end and time.monotonic() > end):
                    return
                group = waiting.pop()
            begin = time.monotonic()
            try:
                run_group(group)
            except Exception as error:  # a worker that ends would leave the others' tests out
                group.failed.append((group.suite, f"could not be run: {error!r}"))
            took = time.monotonic() - begin
            with guard:
                ran.append(group)
                if len(ran) % 16 == 0:
                    speed.measure()
                print(f"[{len(ran)}/{len(groups)}] {'FAILED' if group.failed else 'passed'} {group.suite}: "
                      f"{len(group.cases)} in {took:.1f} s", flush=True)
                for name, why in group.failed:
                    print(f"---- {name} ({group.program['name']}) fails:\n{why}\n----", flush=True)

    workers = [threading.Thread(target=work) for _ in range(arguments.jobs)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    speed.measure()
    return ran, waiting, speed


def stop(*_):
    for process in list(running.values()):
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    os._exit(130)


def main():
    global PATIENCE
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="folder of the build, as build/release")
    parser.add_argument("selection", choices=SELECTIONS)
    parser.add_argument("--only", default="", help="regular expression of names of tests")
    parser.add_argument("--programs", default="", metavar="K/N", help="one part of the programs, in their order")
    parser.add_argument("--list-programs", action="store_true", help="name the programs, built or not; run nothing")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--singly", action="store_true", help="each test in a process of its own")
    parser.add_argument("--shuffle", type=int, default=0, metavar="SEED", help="in another order")
    parser.add_argument("--part", default="", metavar="K/N", help="one part of the suites")
    parser.add_argument("--seconds", type=float, default=0, help="no suite begins after so long")
    parser.add_argument("--turn", type=int, default=0, metavar="N", help="begin with the N-th suite, so that what --seconds "
                        "leaves out is not always the same")
    parser.add_argument("--patience", type=float, default=PATIENCE, help="a test that prints nothing new for so long hangs")
    parser.add_argument("--check-costs", action="store_true", help="what costs twice its budget fails")
    parser.add_argument("--keep-costs", action="store_true", help="write tests/costs.tsv")
    parser.add_argument("--list", action="store_true", help="name the tests, run none")
    parser.add_argument("--summary", type=Path, help="where to write how many passed and failed, and which failed")
    arguments = parser.parse_args()
    PATIENCE = arguments.patience
    signal.signal(signal.SIGINT, stop)
    signal.signal(signal.SIGTERM, stop)
    os.environ["ISOCHRON_TEST_COSTS"] = "1"
    # Shaders that one test has compiled are there for all others, also where a test gives its program folders of its own
    # for what it keeps, or the user's folder cannot be written.
    os.environ["MESA_SHADER_CACHE_DIR"] = str(arguments.build.resolve() / "tests/shader_cache")
    programs = programs_of(arguments)
    if arguments.list_programs:
        print(*(p["name"] for p in programs))
        return 0
    missing = [f"{p['name']} is not built" for p in programs if not Path(p["command"][0]).exists()]
    programs = [p for p in programs if Path(p["command"][0]).exists()]
    groups = groups_of(programs, arguments)
    if arguments.list:
        for group in groups:
            print(*group.cases, sep="\n")
        return 0
    begin = time.monotonic()
    ran, unrun, speed = run_all(groups, arguments)
    over = told_costs(ran, speed.loop(), arguments.check_costs and not arguments.only) if ran else []
    for line in over:
        print(f"over the budget: {line}")
    if unrun:
        print(f"{len(unrun)} of {len(groups)} suites did not begin within {arguments.seconds:.0f} s: "
              f"{', '.join(sorted(g.suite for g in unrun)[:10])} ...")
    if arguments.keep_costs:
        parts = (arguments.only, arguments.programs, arguments.part, arguments.seconds, arguments.singly)
        keep_costs([g for g in ran if not g.failed], speed.loop(), whole=not any(parts))
    failed = [f"{name} ({group.program['name']})" for group in ran for name, _ in group.failed] + over + missing
    passed = sum(max(0, g.cost.claims - len(g.failed)) for g in ran)
    print(f"{arguments.build} {arguments.selection}: {passed} passed, {len(failed)} failed, "
          f"in {time.monotonic() - begin:.0f} s", flush=True)
    if arguments.summary:
        arguments.summary.write_text("\n".join([f"{passed} {len(failed)}", *failed]) + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
