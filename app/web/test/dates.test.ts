// Moments are written as the program writes them, in each calendar and unit, at steps and between them.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";
import { momentText } from "../src/view/dates";

const program = process.env["ISOCHRON_PROGRAM"] ?? "isochron";
let folder: string;
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), "isochron-dates-"));
});
afterAll(() => rmSync(folder, { recursive: true }));

const run = (...words: string[]) => execFileSync(program, words, { stdio: ["ignore", "pipe", "pipe"] }).toString();

const hours = [0, 0.5, 1, 7.25, 30.4, 365, 1000.123];
test.each<[string, number[]]>([
  ["days since 1582-10-01", [...hours, 3, 3.5, 4]],
  ["Days since 1600-03-01 06:30:15.5 +02:00 (proleptic_gregorian)", hours],
  ["days since 1500-02-28 (proleptic_gregorian)", hours],
  ["days since 1999-12-31T18 (360_day)", hours],
  ["hours since 2000-02-28 23:00 (noleap)", [...hours, 100000]],
  ["hours since 2001-02-28 UTC (all_leap)", hours],
  ["minutes since 1900-02-28 00:00 -5 (julian)", [...hours, 1440.5]],
  ["seconds since 1970-01-01", [...hours, 1e9, 1e9 + 3600]],
  ["months since 1979-01-31", [0, 0.5, 1, 1.5, 12, 13.25]],
  ["years since 2004-02-29 (gregorian)", [0, 0.25, 1, 4]],
  ["years since 0001-01-01 (noleap)", [0, 0.25, 1, 4]],
  ["months since 1990-01-15 (360_day)", [0, 0.5, 1, 26]],
  ["days since 99990-01-01 (julian)", [0, 300, 3000, 90000]],
  ["days since 2000-02-30", [0, 1, 2]],
  ["fortnights since 2000-01-01", [0, 1, 2]],
  ["s", [0, 0.1, 0.1000001, 1e-7, 3e-7, 12345678, 12345679, 1e9]],
  ["", [0, 1, 2.5, 100000.5, 300001.5]],
])("%s", (unit, times) => {
  times = [...times].sort((a, b) => a - b);
  const files = times.map((time, i) => join(folder, `v${i}_${time.toFixed(7)}.raw`));
  for (const file of files) writeFileSync(file, "abcdefgh");
  const index = join(folder, "a.isochron");
  run("build", ...files, "-o", index, "--dims", "2", "2", "2", "--type", "u8", "--times-from-names", "--time-unit", unit, "--force");
  const info = JSON.parse(run("info", index, "--json")) as { times: number[]; time_unit: string; dates?: string[] };
  expect(info.times).toEqual(times);
  const moments = [...times.keys()].flatMap((step) => (step + 1 < times.length ? [[step, 0], [step, (20000 + 9137 * step) % 65536]] : [[step, 0]]) as [number, number][]);
  // Dates of all steps come at once; the others are asked for.
  const asked = moments.filter(([, fraction]) => fraction || !info.dates);
  for (const [step, fraction] of asked.slice(0, 8)) {
    const said = /\(time (.*)\)$/m.exec(run("query", index, "--isovalue", "99", "--step", `${step}`, "--fraction", `${fraction}`, "--repeat", "0"));
    expect(momentText(times, step, fraction, info.time_unit)).toBe(said![1]);
  }
  if (info.dates) expect(times.map((_, step) => momentText(times, step, 0, info.time_unit))).toEqual(info.dates);
});
