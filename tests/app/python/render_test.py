"""Pictures of a run, drawn by the program."""

import json
import unittest

import numpy as np

import isochron
from made_series import SeriesTest

SIZE = (160, 90)


class Render(SeriesTest):
    def picture(self, **state):
        return self.run_.render({"array": "depth", "isovalue": 0.6, "bounding_box": False, **state}, size=SIZE)

    def test_shows_the_surface_that_is_asked_for(self):
        pixels = self.picture()
        self.assertEqual((pixels.shape, pixels.dtype), ((90, 160, 3), np.uint8))
        background = pixels[0, 0].astype(int)
        shown = np.abs(pixels.astype(int) - background).sum(axis=2) > 60
        self.assertTrue(shown[45, 80])
        self.assertFalse(shown[[0, 0, -1, -1], [0, -1, 0, -1]].any())
        smaller = np.abs(self.picture(isovalue=0.3).astype(int) - background).sum(axis=2) > 60
        self.assertGreater(shown.sum(), 1.5 * smaller.sum())
        self.assertGreater(smaller.sum(), 0)

    def test_is_the_same_picture_each_time(self):
        np.testing.assert_array_equal(self.picture(step=2), self.picture(step=2))
        self.assertFalse(np.array_equal(self.picture(step=2), self.picture(step=0)))

    def test_numbers_may_be_those_of_numpy(self):
        steps = np.array([0, 2])
        np.testing.assert_array_equal(self.picture(step=steps.max()), self.picture(step=2))

    def test_fields_may_be_named(self):
        shown = {"array": "depth", "bounding_box": False, "step": 0}
        named = self.run_.render(shown, size=SIZE, isovalue=0.6, step=2)
        np.testing.assert_array_equal(named, self.picture(step=2))

    def test_a_saved_session_says_what_is_shown(self):
        state = {"array": "depth", "isovalue": 0.6, "bounding_box": False, "step": 1}
        with open("kept.isochron-session", "w") as file:
            json.dump({"state": state}, file)
        np.testing.assert_array_equal(self.run_.render("kept.isochron-session", size=SIZE), self.picture(step=1))

    def test_what_is_wrong_with_the_state_is_said(self):
        with self.assertRaisesRegex(isochron.Error, '^state: unknown key "isovalues"'):
            self.run_.render({"isovalues": 1}, size=SIZE)
        with self.assertRaisesRegex(isochron.Error, "height"):
            self.run_.render({"array": "height"}, size=SIZE)
        with isochron.open("run.isochron") as run:
            pass
        with self.assertRaisesRegex(isochron.Error, "is closed"):
            run.render(size=SIZE)


if __name__ == "__main__":
    unittest.main()
