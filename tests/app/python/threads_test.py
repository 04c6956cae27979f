"""Several threads use one run, others of the interpreter go on meanwhile, and steps are asked for ahead."""

import gc
import sys
import threading
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import isochron
from made_series import STEPS, SeriesTest


def questions(run):
    """Calls without arguments, each with its name."""
    for step in range(STEPS):
        for isovalue in (-2, 0, 0.5, 3):
            for array in ("rho", "depth"):
                yield lambda s=step, i=isovalue, a=array: run.cells(i, s, array=a)
                yield lambda s=step, i=isovalue, a=array: run.mesh(i, s, array=a)[0]
                yield lambda s=step, i=isovalue, a=array: run.change(i, s, (s + 1) % STEPS, array=a)[0]
                yield lambda s=step, i=isovalue, a=array: run.values(s, slice(i * 2, 19), array=a) if i == 3 else s


class Threads(SeriesTest):
    def test_all_get_the_answers_of_one(self):
        asked = list(questions(self.run_))
        expected = [ask() for ask in asked]
        fresh = list(questions(isochron.open("run.isochron")))
        order = np.random.default_rng(1)
        with ThreadPoolExecutor(8) as pool:
            orders = [order.permutation(len(asked)) for _ in range(8)]
            for numbers, answers in zip(orders, pool.map(lambda of: [fresh[i]() for i in of], orders)):
                for number, answer in zip(numbers, answers):
                    np.testing.assert_array_equal(answer, expected[number])

    def test_others_go_on_during_each_call(self):
        run = self.run_
        calls = {
            "open": lambda: isochron.open("run.isochron"),
            "cells": lambda: run.cells(0),
            "change": lambda: run.change(0, 0, 1),
            "mesh": lambda: run.mesh(0),
            "mesh of doubles": lambda: run.mesh(0, dtype=np.float64),
            "values": lambda: run.values(0),
        }
        interval = sys.getswitchinterval()
        for name, call in calls.items():
            ready, begin, went_on = threading.Event(), threading.Event(), []

            def other():
                ready.set()
                begin.wait()
                went_on.append(True)

            thread = threading.Thread(target=other)
            thread.start()
            ready.wait()
            gc.disable()
            sys.setswitchinterval(3600)  # so that this thread keeps the interpreter, unless a call lets go of it
            try:
                begin.set()
                for _ in range(20000):
                    call()
                    if went_on:
                        break
                self.assertTrue(went_on, name)
            finally:
                sys.setswitchinterval(interval)
                gc.enable()
                thread.join()

    def test_a_run_may_be_closed_while_it_is_asked(self):
        for _ in range(20):
            run = isochron.open("run.isochron")
            expected = self.run_.cells(0, 1)

            def ask():
                try:
                    return run.cells(0, 1)
                except isochron.Error as error:
                    self.assertIn("is closed", str(error))
                    return expected

            with ThreadPoolExecutor(4) as pool:
                answers = [pool.submit(ask) for _ in range(8)]
                run.close()
                for answer in answers:
                    np.testing.assert_array_equal(answer.result(), expected)


class Iteration(SeriesTest):
    def test_gives_the_answers_of_each_step(self):
        for number, step in enumerate(self.run_):
            self.assertEqual((step.number, step.time), (number, 0.5 * number))
            np.testing.assert_array_equal(step.cells(0), self.run_.cells(0, number))
            np.testing.assert_array_equal(step.values(z=slice(2, 9), array="depth"),
                                          self.data[number]["depth"][2:9])
            for answer, expected in zip(step.mesh(0.5, array="depth"), self.run_.mesh(0.5, number, array="depth")):
                np.testing.assert_array_equal(answer, expected)
        self.assertEqual(number, STEPS - 1)

    def test_asks_the_next_step_in_the_background(self):
        asked = threading.Semaphore(0)
        answered = []

        class Watched(isochron.Run):
            def cells(self, isovalue, step=0, *, array=None):
                answered.append((step, threading.current_thread() is threading.main_thread()))
                asked.release()
                return super().cells(isovalue, step, array=array)

        for step in Watched("run.isochron"):
            step.cells(0)
            if step.number + 1 < STEPS:
                # This call's own question, for the first step, and the one for the next, which nobody has asked yet.
                for _ in range(2 if step.number == 0 else 1):
                    asked.acquire()
        self.assertEqual(answered, [(0, True), (1, False), (2, False), (3, False)])

    def test_may_be_left_and_begun_again(self):
        for step in self.run_:
            step.cells(0)
            break
        kept = step
        np.testing.assert_array_equal(kept.cells(0), self.run_.cells(0, 0))
        self.assertEqual([step.cells(0).size for step in self.run_], [self.run_.cells(0, i).size for i in range(STEPS)])

    def test_says_what_is_wrong_where_it_is_asked(self):
        for step in self.run_:
            with self.assertRaisesRegex(isochron.Error, "no array height"):
                step.cells(0, array="height")


if __name__ == "__main__":
    unittest.main()
