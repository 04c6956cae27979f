// The page finds the cells that `isochron query` finds, in indices of all types that the program builds.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";
import { Module } from "../src/module";
import { IndexFile, TYPES } from "../src/reader/index_file";
import { Surfaces } from "../src/search/surfaces";
import { FileSource } from "./file_source";

const program = process.env["ISOCHRON_PROGRAM"] ?? "isochron";
const rounds = Number(process.env["ISOCHRON_QUERIES"] ?? 6);
let folder: string;
let module: Module;

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "isochron-web-"));
  module = await Module.load(readFileSync(new URL("../src/isochron.wasm", import.meta.url)));
});
afterAll(() => rmSync(folder, { recursive: true }));

/** Numbers from 0 to 1, the same in each run. */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

const ARRAYS = {
  i8: Int8Array, u8: Uint8Array, i16: Int16Array, u16: Uint16Array, i32: Int32Array, f32: Float32Array, f64: Float64Array,
};

/** Writes a series of raw files, parts of which stay from step to step. */
function series(type: keyof typeof ARRAYS, size: readonly [number, number, number], steps: number, seed: number): string[] {
  const next = random(seed);
  const names: string[] = [];
  for (let t = 0; t < steps; ++t) {
    const values = new ARRAYS[type](size[0] * size[1] * size[2]);
    let i = 0;
    for (let z = 0; z < size[2]; ++z)
      for (let y = 0; y < size[1]; ++y)
        for (let x = 0; x < size[0]; ++x, ++i) {
          const moving = x < size[0] / 2 ? 0 : t;
          const smooth = Math.sin(0.3 * x + moving) * Math.cos(0.25 * y) + Math.sin(0.2 * z + 0.1 * y);
          values[i] = type.startsWith("f") ? smooth + 0.02 * (x % 3) : Math.round(50 * smooth + 5 * (moving ? next() : 0)) + (type.startsWith("u") ? 110 : 0);
          if (type.startsWith("f") && (x * 7 + y * 13 + z * 29) % 97 === 0) values[i] = NaN;
        }
    const name = join(folder, `${type}_${t}.raw`);
    writeFileSync(name, values);
    names.push(name);
  }
  return names;
}

/** The ids that the program finds. */
function idsOf(index: string, step: number, fraction: number, level: number, isovalue: number): Uint32Array {
  const out = join(folder, "ids.bin");
  execFileSync(program, ["query", index, `--isovalue=${isovalue}`, "--step", `${step}`, "--fraction", `${fraction}`, "--level", `${level}`, "--ids", out, "--force", "--repeat", "0"], { stdio: "pipe" });
  return new Uint32Array(Uint8Array.from(readFileSync(out)).buffer);
}

const CASES: [string, keyof typeof ARRAYS, [number, number, number], string[]][] = [
  ...TYPES.map((type): [string, keyof typeof ARRAYS, [number, number, number], string[]] => [type, type, [37, 33, 50], []]),
  ["stretched", "f32", [2, 65, 17], ["--spacing", "0.5", "2", "3"]],
  ["lz4", "i16", [40, 20, 35], ["--codec", "lz4"]],
  ["zstd", "f32", [40, 20, 35], ["--codec", "zstd"]],
  ["scan", "u8", [33, 18, 20], ["--tiers", "tree"]],
  ["scan of floats", "f32", [20, 18, 20], ["--tiers", "tree"]],
];

test.each(CASES)("finds the cells of %s", async (name, type, size, options) => {
  const index = join(folder, `${name}.isochron`);
  execFileSync(program, ["build", ...series(type, size, 3, 7), "-o", index, "--dims", ...size.map(String), "--type", type, ...options], { stdio: "pipe" });
  await compare(name, index, size);
});

test("finds the cells of scaled whole numbers", async () => {
  // NIfTI, which has a slope.
  const size = [34, 21, 20] as const;
  const files = series("i16", size, 3, 7).map((raw) => {
    const header = new DataView(new ArrayBuffer(352));
    header.setInt32(0, 348, true);
    [3, ...size, 1, 1, 1, 1].forEach((n, i) => header.setInt16(40 + 2 * i, n, true));
    header.setInt16(70, 4, true); // i16
    header.setInt16(72, 16, true);
    [1, 1, 1, 1].forEach((n, i) => header.setFloat32(76 + 4 * i, n, true));
    [352, -0.37, 5.25].forEach((n, i) => header.setFloat32(108 + 4 * i, n, true));
    new TextEncoder().encode("n+1").forEach((byte, i) => header.setUint8(344 + i, byte));
    const nifti = raw.replace(".raw", ".nii");
    writeFileSync(nifti, Buffer.concat([Buffer.from(header.buffer), readFileSync(raw)]));
    return nifti;
  });
  const index = join(folder, "scaled.isochron");
  execFileSync(program, ["build", ...files, "-o", index], { stdio: "pipe" });
  await compare("scaled", index, size);
});

/** Compares random surfaces of an index of three steps. */
async function compare(name: string, index: string, size: readonly number[]): Promise<void> {
  const source = new FileSource(index);
  const file = await IndexFile.open(source, module);
  const [array] = file.arrays;
  expect(array!.info.vertices).toEqual(size);
  const next = random(CASES.findIndex((each) => each[0] === name) + 2);
  for (let round = 0; round < rounds; ++round) {
    const level = round % 2 ? Math.floor(next() * array!.levels.length) : 0;
    const step = Math.floor(next() * 3);
    // Every second one between two steps, half of these where blends are ties of the isovalue.
    const fraction = round % 4 < 2 || step === 2 ? 0 : round % 8 < 4 ? 32768 : 1 + Math.floor(next() * 65535);
    const { low, high } = array!.info;
    let isovalue = low + (high - low) * (1.1 * next() - 0.05);
    if (round % 3 === 0) isovalue = Math.round(isovalue); // a tie of whole numbers
    const surfaces = new Surfaces(file, array!, level);
    const cells = array!.levels[level]!.vertices.map((n) => n - 1);
    const ids: number[] = [];
    let triangles = 0;
    await surfaces.find(step, fraction, isovalue, (piece) => {
      for (let i = 0; i < piece.cells.length; i += 3)
        ids.push((piece.cells[i + 2]! * cells[1]! + piece.cells[i + 1]!) * cells[0]! + piece.cells[i]!);
      triangles += piece.triangles.length / 3;
      expect(piece.triangles.every((corner) => corner < piece.points.length / 3)).toBe(true);
    });
    ids.sort((a, b) => a - b);
    const wanted = idsOf(index, step, fraction, level, isovalue);
    expect(ids.length, `${name} step ${step} + ${fraction} level ${level} isovalue ${isovalue}`).toBe(wanted.length);
    expect(Uint32Array.from(ids)).toEqual(wanted);
    expect(triangles).toBeGreaterThanOrEqual(ids.length);
    surfaces.close();
  }
  source.close();
}

test("values of another array are interpolated where the surface cuts edges", async () => {
  const n = [20, 37, 18] as const;
  const cells = (f: (x: number, y: number, z: number) => number): string => {
    const words: number[] = [];
    for (let z = 0; z < n[2]; ++z) for (let y = 0; y < n[1]; ++y) for (let x = 0; x < n[0]; ++x) words.push(f(x, y, z));
    return words.join(" ");
  };
  const extent = `0 ${n[0] - 1} 0 ${n[1] - 1} 0 ${n[2] - 1}`;
  const arrays = { d: cells((x, y, z) => Math.hypot(x - 9.3, y - 18.2, z - 8.4)), w: cells((x, y, z) => 2 * x - 3 * y + 5 * z) };
  const data = Object.entries(arrays).map(([name, text]) => `<DataArray type="Float32" Name="${name}" format="ascii">${text}</DataArray>`);
  writeFileSync(join(folder, "two.vti"), `<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian"><ImageData WholeExtent="${extent}" Origin="100 0 -5" Spacing="0.5 2 1">` +
    `<Piece Extent="${extent}"><PointData>${data.join("")}</PointData></Piece></ImageData></VTKFile>`);
  const index = join(folder, "two.isochron");
  execFileSync(program, ["build", join(folder, "two.vti"), "-o", index, "--array", "d", "--array", "w"], { stdio: "pipe" });
  const source = new FileSource(index);
  const file = await IndexFile.open(source, module);
  expect(file.arrays.map((each) => each.info.array)).toEqual(["d", "w"]);
  const [surfaces, colors] = [0, 1].map((i) => new Surfaces(file, file.arrays[i]!, 0));
  let points = 0;
  await surfaces!.find(0, 0, 7.1, (piece) => {
    piece.values!.forEach((value, i) => {
      const [x, y, z] = piece.points.subarray(3 * i, 3 * i + 3);
      expect(value).toBeCloseTo(2 * (x! / 0.5) - 3 * (y! / 2) + 5 * z!, 3);
      ++points;
    });
  }, undefined, colors);
  expect(points).toBeGreaterThan(500);
  surfaces!.close();
  colors!.close();
  source.close();
});
