// Ranges of a file: joined, in one request or several, and never other bytes than were asked for.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, beforeEach, expect, test } from "vitest";
import { HttpSource, joined, partsOf, type Range } from "../src/reader/ranges";
import { RangeServer } from "./range_server";

let folder: string;
let server: RangeServer;
let address: string;
let bytes: Uint8Array;

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "isochron-ranges-"));
  bytes = Uint8Array.from({ length: 1 << 20 }, (_, i) => (i * 2654435761) >>> 24);
  writeFileSync(join(folder, "file"), bytes);
  server = new RangeServer([folder]);
  address = `${await server.listen()}file`;
});
afterAll(async () => {
  await server.close();
  rmSync(folder, { recursive: true });
});
beforeEach(() => {
  server.faults = {};
  server.asked = 0;
});

const RANGES: Range[] = Array.from({ length: 300 }, (_, i) => ({ begin: ((i * 7919) % 300) * 3000, end: ((i * 7919) % 300) * 3000 + 100 + i }));

test("near ranges are joined, and none is lost", () => {
  const runs = joined(RANGES);
  expect(runs.length).toBe(1);
  expect(runs[0]!.parts.length).toBe(RANGES.length);
  expect(joined(RANGES, 0).length).toBe(300);
});

test.each([
  ["a server of several ranges", { several: true }, 2],
  ["a server of single ranges", {}, 2],
  ["a server that spans several ranges by one", { spans: true }, 2],
  ["a server that leaves some of several out", { several: true, leavesOut: true }, 8],
])("%s gives all of them", async (_, faults, most) => {
  server.faults = faults;
  const source = new HttpSource(address);
  const found = await source.read(RANGES);
  found.forEach((each, i) => expect(each).toEqual(bytes.subarray(RANGES[i]!.begin, RANGES[i]!.end)));
  expect(source.requests).toBeLessThanOrEqual(most);
  const again = await source.read(RANGES.slice(0, 9));
  again.forEach((each, i) => expect(each).toEqual(bytes.subarray(RANGES[i]!.begin, RANGES[i]!.end)));
});

test("a multipart answer that is cut gives what is whole of it", () => {
  const text = "\r\n--b\r\nContent-Range: bytes 5-7/99\r\n\r\nabc\r\n--b\r\nContent-Type: x\r\nContent-Range: bytes 20-21/99\r\n\r\nde\r\n--b--\r\n";
  const whole = new TextEncoder().encode(text);
  for (let length = 0; length <= whole.length; ++length) {
    const parts = partsOf(whole.subarray(0, length), "b");
    for (const [begin, part] of parts) expect(new TextDecoder().decode(part)).toBe(begin === 5 ? "abc" : "de");
  }
  expect(partsOf(whole, "b").size).toBe(2);
});

test("a file that ends early is told", async () => {
  await expect(new HttpSource(address).read([{ begin: (1 << 20) - 4, end: (1 << 20) + 4 }])).rejects.toThrow(/truncated/);
  expect(readFileSync(join(folder, "file")).length).toBe(1 << 20);
});
