"""What is wrong is said in the line that the program prints."""

import os
import pickle
import unittest

import isochron
from made_series import SeriesTest, program


class Lines(SeriesTest):
    def expect_line_of(self, arguments, call, options={}):
        ran = program(*arguments)
        self.assertEqual(ran.returncode, 1, ran.stderr)
        with self.assertRaises(isochron.Error) as raised:
            call()
        # The program tells commands that work before that line, which names its options.
        line = ran.stderr.splitlines()[-1]
        for option, parameter in options.items():
            line = line.replace(option, parameter)
        self.assertEqual(f"isochron: {raised.exception}", line)

    def query(self, *more, name="run.isochron", step=0):
        return ["query", name, "--isovalue", 0, "--step", step, *more]

    def test_a_file_that_is_missing(self):
        self.expect_line_of(self.query(name="none.isochron"), lambda: isochron.open("none.isochron"))

    def test_a_file_that_is_no_index(self):
        self.expect_line_of(self.query(name="t0.vti"), lambda: isochron.open("t0.vti"),
                            {"`isochron build t0.vti -o t0.isochron`": "isochron.build('t0.vti', 't0.isochron')"})

    def test_an_index_that_is_cut_off(self):
        with open("run.isochron", "rb") as file:
            whole = file.read()
        with open("cut.isochron", "wb") as file:
            file.write(whole[: len(whole) // 2])
        self.expect_line_of(self.query(name="cut.isochron"), lambda: isochron.open("cut.isochron"))

    def test_a_step_that_is_not_there(self):
        for step in (4, -1):
            for call in (self.run_.cells, self.run_.mesh, lambda _, at: self.run_.values(at)):
                self.expect_line_of(self.query(step=step), lambda: call(0, step))
        self.expect_line_of(
            ["change", "run.isochron", "--isovalue", 0, "--step", 0, "--to-step", 9],
            lambda: self.run_.change(0, 0, 9),
        )

    def test_an_array_that_is_not_there(self):
        self.expect_line_of(self.query("--array", "height"), lambda: self.run_.cells(0, array="height"))

    def test_files_that_cannot_be_indexed(self):
        self.expect_line_of(["build", "none*.vti", "-o", "n.isochron"], lambda: isochron.build("none*.vti", "n.isochron"))
        self.expect_line_of(["build", "t0.vti", "-o", "n.isochron"], lambda: isochron.build("t0.vti", "n.isochron"),
                            {"--array": "array", "--all-arrays": "all_arrays=True"})
        self.assertFalse(os.path.exists("n.isochron"))

    def test_an_error_can_be_pickled(self):
        again = pickle.loads(pickle.dumps(isochron.Error("run.isochron: damaged")))
        self.assertEqual((type(again), str(again)), (isochron.Error, "run.isochron: damaged"))
        self.assertEqual(f"{isochron.Error.__module__}.{isochron.Error.__qualname__}", "isochron.Error")


class Builds(SeriesTest):
    def test_progress_is_told_up_to_the_end(self):
        told = []
        run = isochron.build("t*.vti", "told.isochron", array="depth", progress=lambda *of: told.append(of))
        self.assertEqual(run.arrays, ("depth",))
        self.assertTrue(all(isinstance(phase, str) and 0 <= fraction <= 1 for phase, fraction in told))
        self.assertEqual([fraction for _, fraction in told], sorted(fraction for _, fraction in told))

    def test_what_progress_raises_ends_the_build_and_leaves_nothing(self):
        def stop(phase, fraction):
            raise KeyboardInterrupt

        before = sorted(os.listdir())
        with self.assertRaises(KeyboardInterrupt):
            isochron.build("t*.vti", "stopped.isochron", array="depth", progress=stop)
        self.assertEqual(sorted(os.listdir()), before)

    def test_files_that_are_no_index_are_not_replaced(self):
        with open("t0.vti") as file:
            before = file.read()
        with self.assertRaisesRegex(isochron.Error, "t0.vti"):
            isochron.build("t*.vti", "t0.vti", array="depth")
        with open("t0.vti") as file:
            self.assertEqual(file.read(), before)


if __name__ == "__main__":
    unittest.main()
