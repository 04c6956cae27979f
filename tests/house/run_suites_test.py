"""What tests/run_suites.py makes of test programs that pass, fail, crash, leak at their end, hang, or say nothing."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import run_suites  # noqa: E402

PROGRAM = """#!/usr/bin/env python3
import os, signal, sys
tests = {tests!r}
if "--gtest_list_tests" in sys.argv:
    print("Suite.")
    for name in tests:
        print("  " + name)
    sys.exit()
chosen = [a for a in sys.argv if a.startswith("--gtest_filter=")][0].split("=")[1].split(":")
failed = 0
for name, does in tests.items():
    if "Suite." + name not in chosen:
        continue
    print("[ RUN      ] Suite." + name, flush=True)
    if does == "crash":
        os.kill(os.getpid(), signal.SIGSEGV)
    if does == "hang":
        signal.pause()
    word = {{"fail": "[  FAILED  ]", "skip": "[  SKIPPED ]"}}.get(does, "[       OK ]")
    failed += does == "fail"
    print("why " + name)
    print("[   COST   ] 1500 ms, 2 processes, 1 contexts, 7 draws")
    print(word + " Suite." + name + " (1 ms)", flush=True)
sys.exit({status} or (1 if failed else 0))
"""


class Suites(unittest.TestCase):
    def run_tests(self, tests, status=0):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder, "program")
            program.write_text(PROGRAM.format(tests=tests, status=status))
            program.chmod(0o700)
            described = {"name": "program", "kind": "gtest", "command": [str(program)], "labels": [],
                         "environment": [], "folder": folder}
            names = run_suites.cases_of(described)
            self.assertEqual(names, ["Suite." + name for name in tests])
            return run_suites.run_group(run_suites.Group(described, "Suite", names))

    def failures(self, tests, status=0):
        return dict(self.run_tests(tests, status).failed)

    def test_what_passes_has_passed_and_its_costs_are_added(self):
        group = self.run_tests({"A": "", "B": ""})
        self.assertEqual(group.failed, [])
        self.assertEqual((group.cost.claims, group.cost.processes, group.cost.contexts, group.cost.draws), (2, 4, 2, 14))
        self.assertEqual(group.dearest, (1.5, "Suite.B"))

    def test_a_failure_is_told_with_its_own_words(self):
        self.assertEqual(self.failures({"A": "", "B": "fail", "C": ""}), {"Suite.B": "why B"})

    def test_what_is_skipped_has_not_passed(self):
        self.assertEqual(list(self.failures({"A": "skip", "B": ""})), ["Suite.A"])

    def test_a_crash_is_told_with_the_test_that_ran_and_the_others_run(self):
        failed = self.failures({"A": "", "B": "crash", "C": "fail", "D": ""})
        self.assertEqual(list(failed), ["Suite.B", "Suite.C"])
        self.assertIn("SIGSEGV", failed["Suite.B"])

    def test_a_program_that_fails_after_its_tests_has_failed(self):
        self.assertIn("status 23", self.failures({"A": ""}, status=23)["Suite"])

    def test_a_test_that_hangs_is_ended_and_what_still_ran_is_told(self):
        patience, run_suites.PATIENCE = run_suites.PATIENCE, 1
        self.addCleanup(setattr, run_suites, "PATIENCE", patience)
        told = self.failures({"A": "hang", "B": ""})["Suite.A"]
        self.assertIn("printed nothing", told)
        self.assertRegex(told, r"runs: \d+ S \[.*\] .*/program --gtest_filter=Suite.A")

    def test_every_program_is_in_one_part_and_what_is_not_built_has_failed(self):
        with tempfile.TemporaryDirectory() as build:
            names = [f"program{number}" for number in range(5)]
            Path(build, "tests").mkdir()
            Path(build, "tests/programs.json").write_text(json.dumps(
                [{"name": name, "kind": "gtest", "command": [f"{build}/{name}"], "labels": ["threads"],
                  "environment": [], "folder": build} for name in names]))
            def run(*more):
                return subprocess.run([run_suites.__file__, build, "threads", *more], capture_output=True, text=True)
            parts = [run("--list-programs", "--programs", f"{k}/2").stdout.split() for k in range(2)]
            self.assertEqual(parts[0] + parts[1], names)
            ran = run("--turn", "3")
            self.assertEqual(ran.returncode, 1)
            self.assertIn("0 passed, 5 failed", ran.stdout)

    def test_every_suite_is_in_one_part(self):
        for suite in ("A", "B", "Contexts/C", "D/0"):
            self.assertEqual(sum(run_suites.in_part(suite, f"{k}/3") for k in range(3)), 1)


if __name__ == "__main__":
    unittest.main()
