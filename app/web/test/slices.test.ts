// Slices hold the values of the index, of only the chunks that a plane cuts; missing ones are missing.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";
import { linked, linkOf } from "../src/link";
import type { SliceValues } from "../src/messages";
import { Module } from "../src/module";
import { IndexFile } from "../src/reader/index_file";
import { Surfaces } from "../src/search/surfaces";
import { FileSource } from "./file_source";

const program = process.env["ISOCHRON_PROGRAM"] ?? "isochron";
const n = [40, 36, 50] as const;
const value = (x: number, y: number, z: number, t: number) => 2 * x - 3 * y + z + 10 * t;
let folder: string;
let source: FileSource;
let surfaces: Surfaces;

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "isochron-slices-"));
  const names = [0, 1].map((t) => {
    const values = new Float32Array(n[0] * n[1] * n[2]);
    for (let i = 0; i < values.length; ++i) {
      const [x, y, z] = [i % n[0], Math.floor(i / n[0]) % n[1], Math.floor(i / n[0] / n[1])];
      values[i] = x === 7 && y === 8 ? NaN : value(x, y, z, t);
    }
    const name = join(folder, `t${t}.raw`);
    writeFileSync(name, values);
    return name;
  });
  const index = join(folder, "a.isochron");
  execFileSync(program, ["build", ...names, "-o", index, "--dims", ...n.map(String), "--type", "f32"], { stdio: "pipe" });
  source = new FileSource(index);
  const module = await Module.load(readFileSync(new URL("../src/isochron.wasm", import.meta.url)));
  const file = await IndexFile.open(source, module);
  surfaces = new Surfaces(file, file.arrays[0]!, 0);
});
afterAll(() => {
  surfaces.close();
  source.close();
  rmSync(folder, { recursive: true });
});

/** The share at a vertex; undefined: it is not in the slice. */
function shareAt(slice: SliceValues, vertex: readonly number[]): number | undefined {
  const [axis1, axis2] = [(slice.axis + 1) % 3, (slice.axis + 2) % 3];
  const column = vertex[axis2]! * n[axis1]! + vertex[axis1]!;
  const at = slice.columns[2 * column]! + vertex[slice.axis]! - slice.columns[2 * column + 1]!;
  const end = column + 1 < n[axis1]! * n[axis2]! ? slice.columns[2 * column + 2]! : slice.columns[2 * column]! + 2;
  return vertex[slice.axis]! < slice.columns[2 * column + 1]! || at >= end ? undefined : slice.shares[at];
}

test.each([
  ["across z", 0, [0, 0, 20.5, 0, 0, 1], 2],
  ["across x between steps", 32768, [7.5, 0, 0, 1, 0, 0], 0],
  ["oblique, between steps", 16384, [20, 18, 25, 0, 0.6, 0.8], 2],
] as const)("holds the values %s", async (_, fraction, plane, axis) => {
  const slice = (await surfaces.slice(0, fraction, plane))!;
  expect(slice.axis).toBe(axis);
  const { low, high } = surfaces.array.info;
  const wrong: number[][] = [];
  let seen = 0;
  let missing = 0;
  for (let z = 0; z < n[2]; ++z)
    for (let y = 0; y < n[1]; ++y)
      for (let x = 0; x < n[0]; ++x) {
        const beyond = [x, y, z].reduce((sum, at, i) => sum + (at - plane[i]!) * plane[3 + i]!, 0);
        const share = shareAt(slice, [x, y, z]);
        if (share === undefined ? Math.abs(beyond) < 0.5 : Math.abs(beyond) > 3) wrong.push([x, y, z]);
        if (share === undefined) continue;
        ++seen;
        if (x === 7 && y === 8) {
          if (share < 1e38) wrong.push([x, y, z, share]);
          ++missing;
        } else if (Math.abs(low + share * (high - low) - value(x, y, z, fraction / 65536)) > 1e-3) {
          wrong.push([x, y, z, low + share * (high - low)]);
        }
      }
  expect(wrong).toEqual([]);
  expect(seen).toBeGreaterThan(1000);
  expect(missing).toBeGreaterThan(0);
  expect(slice.outline.length).toBe(12);
});

test("reads only what the plane cuts, and nothing beside the data", async () => {
  const fresh = new Surfaces((surfaces as unknown as { file: IndexFile }).file, surfaces.array, 0);
  const read = source.read.bind(source);
  let ranges = 0;
  source.read = (wanted, ...others) => {
    ranges += wanted.length;
    return read(wanted, ...others);
  };
  expect(await fresh.slice(0, 0, [0, 0, -1, 0, 0, 1])).toBeNull();
  expect(ranges).toBe(0);
  await fresh.slice(0, 0, [0, 0, 20.5, 0, 0, 1]);
  expect(ranges).toBe(1 + 3 * 3); // the tables, and one layer of chunks
  source.read = read;
  fresh.close();
});

test("a link keeps slices, and ignores what is none", () => {
  const state = { slices: [[1, 2, 3, 0, 0.6, 0.8], [4, 5, 6, 1, 0, 0]], sliceof: 1, slicemap: "coolwarm", slicerange: [-2, 7.5], isolines: 0, alone: 1 };
  expect(linked(linkOf(state))).toMatchObject(state);
  expect(linked("#slices=1/2/3/0/0/0,1/2,a/b/c/d/e/f,//////&slicerange=2,1&slicemap=none")).toEqual({ isovalue: undefined });
  expect(linked(`#slices=${Array(9).fill("1/2/3/0/0/1").join(",")}`).slices).toHaveLength(3);
});
