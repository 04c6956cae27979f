// What cuts surfaces: faces of a box and outlines of planes lie where they cut, on any axes, and links keep them.
import { expect, test } from "vitest";
import { linked, linkOf } from "../src/link";
import type { Info } from "../src/reader/index_file";
import { acrossAxis, along, boxWithin, edgesOf, facesOf, movedTo, nextAxis, outlineOf, planeAcross, reachAlong, wholeBox } from "../src/view/planes";

const info = (more: Partial<Info> = {}): Info => ({
  vertices: [11, 21, 5], spacing: [1, 0.5, 2], origin: [100, -20, 3], direction: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], positions: [[], [], []], ...more,
} as Info);
/** Axes that are neither at right angles nor right-handed, and an uneven one. */
const skew = info({ direction: [[0, 1, 0], [0.6, 0.8, 0], [0, 0, 1]], positions: [[], [], [0, 1, 3, 4, 10]] });
const beyond = (plane: number[], at: readonly number[], { origin }: Info) => [0, 1, 2].reduce((sum, i) => sum + (at[i]! + origin[i]! - plane[i]!) * plane[3 + i]!, 0);
/** Along an uneven axis of few vertices, from one vertex to the next. */
const uneven = (at: number[], index: number) => at.slice(1).reduce((sum, next, i) => sum + (next - at[i]!) * Math.min(1, Math.max(0, index - i)), at[0]!);
const place = (of: Info, index: number[]) =>
  [0, 1, 2].map((i) => index.reduce((sum, n, axis) => sum + (of.positions[axis]!.length ? uneven(of.positions[axis]!, n) : n * of.spacing[axis]!) * of.direction[axis]![i]!, 0));

test.each([["upright", info()], ["skew and uneven", skew]])("the faces of a box cut what is outside it: %s axes", (_, of) => {
  const box = [2, 3.5, 1.5, 10, 12, 3];
  const faces = facesOf(of, box);
  expect(faces).toHaveLength(5); // one of them is a face of the data
  let cut = 0;
  for (let x = 0; x <= 10; x += 0.5)
    for (let y = 0.25; y <= 20; y += 0.5)
      for (let z = 0.01; z <= 4; z += 0.06) {
        const outside = x < 2 || y < 3.5 || y > 12 || z < 1.5 || z > 3;
        const away = faces.some((face) => beyond(face, place(of, [x, y, z]), of) > 1e-9);
        if (outside !== away) throw new Error(`${x} ${y} ${z}`);
        cut += Number(away);
      }
  expect(cut).toBeGreaterThan(1000);
  for (const face of faces) expect(Math.hypot(...face.slice(3))).toBeCloseTo(1, 12);
  expect(facesOf(of, wholeBox(of))).toEqual([]);
});

test.each([["upright", info()], ["skew and uneven", skew]])("outlines lie on the plane and on faces of the data: %s axes", (_, of) => {
  for (const normal of [[1, 0, 0], [0, 0.6, 0.8], [1, 1, 1], [-2, 1, 0.3]]) {
    const plane = planeAcross(of, normal)!;
    const ends = outlineOf(of, plane);
    expect(ends.length).toBeGreaterThanOrEqual(6);
    const { low, high } = reachAlong(of, plane.slice(3));
    expect(along(plane)).toBeGreaterThan(low);
    expect(along(plane)).toBeLessThan(high);
    ends.forEach((end, i) => {
      expect(beyond(plane, end, of)).toBeCloseTo(0, 9);
      if (i % 2 === 1) expect(end).toEqual(ends[(i + 1) % ends.length]); // one line goes on from another
    });
    expect(outlineOf(of, movedTo(of, plane, high + 5).map((n, i) => n + plane[i + 3]! * 1e-3 || n))).toEqual([]);
  }
  expect(edgesOf(of, wholeBox(of))).toHaveLength(24);
});

test("a plane goes to the next axis, across the data's faces", () => {
  for (const of of [info(), skew])
    for (const axis of [0, 1, 2]) {
      const normal = acrossAxis(of, axis);
      expect(nextAxis(of, planeAcross(of, normal)!)).toBe((axis + 1) % 3);
      of.direction.forEach((column, other) => expect(column.reduce((sum, n, i) => sum + n * normal[i]!, 0))[other === axis ? "toBeGreaterThan" : "toBeCloseTo"](0));
    }
  expect(nextAxis(info(), undefined)).toBe(2);
  expect(planeAcross(info(), [0, 0, 0])).toBeNull();
});

test("a box stays within the data, and is none without a middle", () => {
  expect(boxWithin(info(), [-3, 1, 0, 99, 2.5, 4])).toEqual([0, 1, 0, 10, 2.5, 4]);
  expect(boxWithin(info(), [10, 1, 0, 12, 2.5, 4])).toBeNull();
});

test("a link keeps planes and box, also those of earlier versions, and ignores what is none", () => {
  const state = { planes: [[1, 2, 3, 0, 0.6, 0.8], [4, 5, 6, 1, 0, 0]], box: [0, 1.5, 2, 10, 12, 3.25] };
  expect(linked(linkOf(state))).toMatchObject(state);
  expect(linked("#plane=1,2,3,0,0.6,0.8").planes).toEqual([[1, 2, 3, 0, 0.6, 0.8]]);
  expect(linked("#clip=2,0.25").clip).toEqual([2, 0.25]);
  expect(linked("#planes=1/2/3/0/0/0,1/2&plane=1,2,3,0,0,0&box=0,0,0,1,1,0&clip=3,1")).toEqual({ isovalue: undefined });
  expect(linked(`#planes=${Array(9).fill("1/2/3/0/0/1").join(",")}`).planes).toHaveLength(6);
});
