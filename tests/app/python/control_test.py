"""A session in a window that Python steers."""

import contextlib
import os
import shutil
import subprocess
import tempfile
import time
import unittest

import numpy as np

import isochron
from made_series import arrays_of, write_vti

PROGRAM = os.environ["ISOCHRON_PROGRAM"]


@unittest.skipUnless(shutil.which("xvfb-run"), "needs xvfb-run")
class Control(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        for step in range(3):
            write_vti(os.path.join(self.folder, f"t{step}.vti"), step, arrays_of(step))
        self.index = os.path.join(self.folder, "a.isochron")
        isochron.build(os.path.join(self.folder, "t*.vti"), self.index, array="depth")
        self.socket = os.path.join(self.folder, "control.sock")
        environment = {**os.environ, "XDG_STATE_HOME": self.folder, "XDG_RUNTIME_DIR": self.folder}
        self.program = subprocess.Popen(
            ["xvfb-run", "-a", PROGRAM, "explore", self.index, f"--control={self.socket}", "--size", "320", "240"],
            env=environment, stderr=subprocess.DEVNULL, cwd=self.folder,
        )
        while not os.path.exists(self.socket):
            self.assertIsNone(self.program.poll(), "it listens before it ends")
            time.sleep(0.05)

    def tearDown(self):
        with contextlib.suppress(isochron.Error), isochron.connect(self.socket) as session:
            session.tell(quit=True)
        self.assertEqual(self.program.wait(), 0)
        shutil.rmtree(self.folder, ignore_errors=True)

    def test_says_commands_and_gets_what_is_shown(self):
        run = isochron.open(self.index)
        low, high = run.range()
        isovalue = 0.5 * (low + high)
        with isochron.connect(self.socket) as session:
            session.tell(step=np.int64(1), isovalue=isovalue)
            self.assertEqual(session.state()["step"], 1)
            np.testing.assert_array_equal(session.cells(), run.cells(isovalue, step=1))
            points, faces = session.mesh(dtype=np.float64)
            there, ours = run.mesh(isovalue, step=1, dtype=np.float64)
            np.testing.assert_allclose(points, there, atol=1e-3)
            np.testing.assert_array_equal(faces, ours)
            ends = [(0, 0, 0), (2.5, 1, 3)]
            with self.assertRaisesRegex(isochron.Error, "expected places, or a ruler"):
                session.profile()
            session.tell(rulers={"list": [{"name": "", "places": ends, "angle": False, "shown": True}], "picked": 0,
                                 "angle": False}, curves={"shown": True, "measure": "profile", "logarithmic": False})  # fmt: skip
            line = run.profile(*ends, step=1)
            self.assertEqual(line.tobytes(), session.profile().tobytes())
            self.assertEqual(session.profile(*ends[::-1], step=0).tobytes(), run.profile(*ends[::-1]).tobytes())
            session.tell(undo=True)
            picture = session.picture()
            self.assertEqual(picture.shape[2], 3)
            self.assertGreater(picture.std(), 0)
            self.assertEqual(session.note["state"]["step"], 1)
            self.assertEqual(session.note["state"]["isosurfaces"][0]["isovalue"], isovalue)
            self.assertEqual(session.note["footprint"], "surface")
            session.tell(undo=True)
            self.assertEqual(session.state()["step"], 0)
            with self.assertRaisesRegex(isochron.Error, "step is 9, expected at most 2"):
                session.tell(step=9)
            seen = []
            with isochron.connect(self.socket) as other:
                for event in session.events("time", rate=120):
                    seen.append(event["time"]["step"])
                    if len(seen) == 3:
                        break
                    other.tell(step=len(seen))
            self.assertEqual(seen, [0, 1, 2])
            self.assertEqual(session.state()["step"], 2, "the connection still answers")

    def test_who_finds_nobody_is_told_so(self):
        with self.assertRaisesRegex(isochron.Error, "nobody listens there"):
            isochron.connect(os.path.join(self.folder, "other.sock"))


if __name__ == "__main__":
    unittest.main()
