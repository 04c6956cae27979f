"""Measures of surfaces against numpy on what `mesh` and `values` give."""

import unittest

import numpy as np

import isochron
from made_series import STEPS, SeriesTest


class Measures(SeriesTest):
    def test_are_those_of_the_mesh_and_of_the_values(self):
        run, isovalue = self.run_, float(np.median(self.run_.values(1)))
        points, faces = run.mesh(isovalue, 1, dtype=np.float64)
        a, b, c = (points[faces[:, k]] for k in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
        found = run.measure(isovalue, 1)
        self.assertAlmostEqual(found["area"], area, delta=1e-6 * area)
        self.assertEqual(found["cells"], len(run.cells(isovalue, 1)))
        edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        count = np.unique(edges, axis=0, return_counts=True)[1]
        self.assertEqual(found["euler"], len(points) - len(count) + len(faces))
        self.assertEqual(found["border_edges"], np.count_nonzero(count == 1))
        whole = np.prod([(n - 1) * d for n, d in zip(run.shape[1:], run.spacing)])
        self.assertAlmostEqual(found["volume"] + found["volume_below"], whole, delta=1e-9 * whole)
        self.assertTrue(np.isnan(found["mean"]))

    def test_of_all_steps_are_rows(self):
        run, isovalue = self.run_, float(np.median(self.run_.values(1)))
        rows = run.measures(isovalue)
        self.assertEqual(rows["step"].tolist(), list(range(STEPS)))
        np.testing.assert_array_equal(rows["time"], run.times)
        self.assertEqual(rows["area"][1], run.measure(isovalue, 1)["area"])
        self.assertEqual(run.measures(isovalue, slice(1, 2))["step"].tolist(), [1])
        with self.assertRaisesRegex(isochron.Error, "isovalue"):
            run.measures(np.nan)

    def test_of_a_part_are_those_of_its_values(self):
        run, isovalue = self.run_, float(np.median(self.run_.values(1)))
        crop = {"x": slice(1, 6), "z": slice(2, None)}
        found, pieces = run.measure(isovalue, 1, crop=crop), run.pieces(isovalue, 1, crop=crop)
        values = run.values(1)[2:, :, 1:6]
        corners = [values[i : i - 1 or None, j : j - 1 or None, k : k - 1 or None]
                   for i in (0, 1) for j in (0, 1) for k in (0, 1)]  # fmt: skip
        self.assertEqual(found["cells"], np.count_nonzero(
            (np.min(corners, axis=0) < isovalue) & (isovalue <= np.max(corners, axis=0))))  # fmt: skip
        whole = np.prod([(n - 1) * d for n, d in zip(values.shape, run.spacing)])
        self.assertAlmostEqual(found["volume"] + found["volume_below"], whole, delta=1e-9 * whole)
        self.assertAlmostEqual(pieces["area"].sum(), found["area"], delta=1e-9 * found["area"])
        self.assertEqual(run.measures(isovalue, 1, crop=crop)["area"][0], found["area"])
        with self.assertRaisesRegex(isochron.Error, "crop: expected vertices from 0 to"):
            run.measure(isovalue, 1, crop="0:1,0:1,5:99")

    def test_of_both_sides_of_a_plane_add_up(self):
        run, isovalue = self.run_, float(np.median(self.run_.values(1)))
        point = run.origin + run.spacing[::-1] * (np.array(run.shape[:0:-1]) - 1) * 0.4
        plane = np.array([*point, 0.3, -0.5, 0.4])
        left, other = (run.measure(isovalue, 1, clip=[*point, *(side * plane[3:])]) for side in (1, -1))
        whole = run.measure(isovalue, 1)
        for name in ("area", "volume", "volume_below"):
            self.assertGreater(left[name], 0)
            self.assertAlmostEqual(left[name] + other[name], whole[name], delta=1e-9 * whole[name])
        self.assertEqual(run.measures(isovalue, 1, clip=plane)["area"][0], left["area"])
        self.assertEqual(len(run.pieces(isovalue, 1, clip=plane)), left["pieces"])
        for wrong in ([1, 2, 3], [0, 0, 0, 0, 0, 0], [0, 0, 0, np.nan, 0, 1]):
            with self.assertRaisesRegex(isochron.Error, "clip: expected"):
                run.measure(isovalue, 1, clip=wrong)

    def test_without_dust_are_those_of_the_larger_pieces(self):
        run, isovalue = self.run_, float(np.median(self.run_.values(1)))
        pieces, least = run.pieces(isovalue, 1), 40
        large = run.pieces(isovalue, 1, dust=least)
        self.assertTrue(0 < len(large) < len(pieces), "the series has both")
        kept = run.measure(isovalue, 1, dust=least)
        self.assertEqual(kept["pieces"], len(large))
        self.assertAlmostEqual(kept["area"], large["area"].sum(), delta=1e-9 * kept["area"])
        self.assertEqual(run.measures(isovalue, 1, dust=least)["area"][0], kept["area"])
        points, faces = run.mesh(isovalue, 1, dust=least)
        self.assertEqual(len(faces), large["triangles"].sum())
        self.assertEqual(faces.max(), len(points) - 1)
        for wrong in (-1, 1.5, 1 << 32):
            with self.assertRaisesRegex(isochron.Error, "dust: expected"):
                run.measure(isovalue, 1, dust=wrong)

    def test_of_the_distance_from_a_place_are_those_to_the_nearest_point(self):
        run, isovalue = self.run_, float(np.median(self.run_.values(1)))
        points, _ = run.mesh(isovalue, 1, dtype=np.float64)
        place = points[3] + (40.0, -30.0, 20.0)
        nearest = np.linalg.norm(points - place, axis=1).min()
        found = run.measures(isovalue, 1, place=place)["distance"][0]
        self.assertLessEqual(found, nearest * (1 + 1e-6))
        self.assertGreater(found, nearest - 2 * max(run.spacing))
        self.assertTrue(np.isnan(run.measure(isovalue, 1)["distance"]))
        with self.assertRaisesRegex(isochron.Error, "place: expected 3 numbers"):
            run.measure(isovalue, 1, place=(1, 2))

    def test_along_a_line_are_those_of_the_vertices(self):
        run = self.run_
        nz, _, nx = run.shape[1:]

        def place(x, y, z):
            return run.origin + run.spacing[::-1] * np.array([x, y, z])

        line = run.profile(place(0, 1, 2), place(nx - 1, 1, 2), place(nx - 1, 1, nz), step=1)
        self.assertEqual(len(line), 513)
        self.assertEqual(line["value"][0], run.values(1)[2, 1, 0])
        along = line["z"] == line["z"][0]
        vertices = run.origin[0] + run.spacing[2] * np.arange(nx)
        whole = np.interp(line["x"][along], vertices, run.values(1)[2, 1].astype(float))
        np.testing.assert_allclose(line["value"][along], whole, rtol=1e-6, atol=1e-6)
        self.assertTrue(np.isnan(line["value"][-1]), "beyond the data")
        np.testing.assert_allclose(np.diff(line["distance"]), line["distance"][-1] / 512)
        self.assertEqual(len(run.profile(place(1, 1, 1), place(1, 1, 1))), 0)
        for wrong in ([(0, 0, 0)], [(0, 0), (1, 1)], [(0, 0, 0), (np.nan, 0, 0)]):
            with self.assertRaisesRegex(isochron.Error, "profile"):
                run.profile(*wrong)

    def test_of_pieces_add_up(self):
        run, isovalue = self.run_, float(np.median(self.run_.values(1)))
        pieces, found = run.pieces(isovalue, 1), run.measure(isovalue, 1)
        self.assertEqual(len(pieces), found["pieces"])
        self.assertAlmostEqual(pieces["area"].sum(), found["area"], delta=1e-9 * found["area"])
        self.assertTrue(np.all(np.diff(pieces["area"]) <= 0))
        self.assertTrue(np.all(pieces["low"] <= pieces["centroid"]) and np.all(pieces["centroid"] <= pieces["high"]))
        np.testing.assert_array_equal(pieces["closed"] == 1, np.isfinite(pieces["volume"]))


if __name__ == "__main__":
    unittest.main()
