// An open index: its header, its metadata, and where the chunks of its steps lie (docs/FORMATS.md).
import type { Module } from "../module";
import type { ByteSource } from "./ranges";

const SLOT = 4096;
const OLDEST = 3;
const NEWEST = 5;
/** Versions up to this one do not say since when chunks have stayed. */
const WITHOUT_SINCE = 3;
const MOST_METADATA = 1 << 30;
const EDGE = 16;
export const TYPES = ["i8", "u8", "i16", "u16", "i32", "f32", "f64"] as const;

interface Section {
  offset: number;
  bytes: number;
  checksum: bigint;
}
const SECTIONS = ["tree", "steps", "directory", "checksums", "metadata"] as const;
type Sections = Record<(typeof SECTIONS)[number], Section>;

interface Header {
  version: number;
  sequence: bigint;
  fileBytes: number;
  sections: Sections;
}

/** Where the chunks of a step lie. */
export interface StepEntry {
  offset: number;
  bytes: number;
  tables: number;
}

/** What the metadata of an array says, as far as the page uses it. */
export interface Info {
  array: string;
  type: (typeof TYPES)[number];
  slope: number;
  intercept: number;
  vertices: [number, number, number];
  spacing: [number, number, number];
  origin: [number, number, number];
  /** Columns. */
  direction: [number, number, number][];
  positions: [number[], number[], number[]];
  times: number[];
  /** Steps behind which nothing is blended while time plays, ascending. */
  gaps: number[];
  timeUnit: string;
  lengthUnit: string;
  valueUnit: string;
  low: number;
  high: number;
  /** Counts of values in bins, for the histogram. */
  bins: { first: number; exponent: number; counts: number[] };
  hasBricks: boolean;
}

/** The grid of a level of detail. */
export interface Level {
  vertices: [number, number, number];
  spacing: [number, number, number];
  positions: [number[], number[], number[]];
}

/** One array of an index, with its levels of detail. */
export interface ArrayOfIndex {
  info: Info;
  levels: Level[];
  /** Those of the level `level` at `step`: `entries[level * steps + step]`. */
  entries: StepEntry[];
}

function safe(value: bigint): number {
  const number = Number(value);
  if (!Number.isSafeInteger(number)) throw new Error("a number of the file is too large");
  return number;
}

function sectionAt(view: DataView, at: number): Section {
  return {
    offset: safe(view.getBigUint64(at, true)),
    bytes: safe(view.getBigUint64(at + 8, true)),
    checksum: view.getBigUint64(at + 16, true),
  };
}

/** The header of a slot; null where it is blank or damaged. */
function headerOf(module: Module, slot: Uint8Array): Header | null {
  const view = new DataView(slot.buffer, slot.byteOffset, slot.length);
  if (new TextDecoder().decode(slot.subarray(0, 8)) !== "ISOCHRON") return null;
  const sumAt = 40 + SECTIONS.length * 24;
  const copy = slot.slice();
  copy.fill(0, sumAt, sumAt + 8);
  if (module.checksum(copy) !== view.getBigUint64(sumAt, true)) return null;
  const sections = {} as Sections;
  SECTIONS.forEach((name, i) => (sections[name] = sectionAt(view, 40 + 24 * i)));
  return {
    version: view.getUint32(8, true),
    sequence: view.getBigUint64(16, true),
    fileBytes: safe(view.getBigUint64(24, true)),
    sections,
  };
}

function text(value: unknown): string {
  if (typeof value === "string") return value;
  // Bytes that are no UTF-8 come as numbers.
  if (Array.isArray(value)) return new TextDecoder().decode(Uint8Array.from(value as number[]));
  return "";
}

function numbers(value: unknown, count: number, what: string): number[] {
  if (!Array.isArray(value) || (count >= 0 && value.length !== count) || !value.every((n) => typeof n === "number"))
    throw new Error(`metadata: ${what}`);
  return value as number[];
}

/** The steps behind which the next one is more than three times the median away, or files are missing (index/volume/step_gaps.cpp). */
export function gapsOf(times: readonly number[], missingAfter: readonly number[]): number[] {
  const apart = times.slice(1).map((time, i) => time - times[i]!);
  const median = apart.toSorted((a, b) => a - b)[Math.floor(apart.length / 2)]!;
  return apart.flatMap((gap, step) => (gap > 3 * median || missingAfter.includes(step) ? [step] : []));
}

function infoOf(json: Record<string, any>): Info {
  const type = TYPES.find((each) => each === json.type);
  if (!type) throw new Error("metadata: type");
  const three = (value: unknown, what: string) => numbers(value, 3, what) as [number, number, number];
  const counts = json.stats?.counts ?? {};
  const slope = Number(json.slope);
  const scaled = [counts.low, counts.high].map((stored) => slope * Number(stored) + Number(json.intercept));
  const direction = json.direction as unknown[];
  if (!Array.isArray(direction) || direction.length !== 3) throw new Error("metadata: direction");
  const positions = (Array.isArray(json.positions) ? json.positions : [[], [], []]) as unknown[];
  return {
    array: text(json.array),
    type,
    slope,
    intercept: Number(json.intercept),
    vertices: three(json.vertices, "vertices"),
    spacing: three(json.spacing, "spacing"),
    origin: three(json.origin, "origin"),
    direction: direction.map((column) => three(column, "direction")),
    positions: [0, 1, 2].map((axis) => numbers(positions[axis], -1, "positions")) as Info["positions"],
    times: numbers(json.times, -1, "times"),
    gaps: gapsOf(numbers(json.times, -1, "times"), numbers(json.missing_after ?? [], -1, "missing_after")),
    timeUnit: text(json.time_unit),
    lengthUnit: text(json.length_unit),
    valueUnit: text(json.value_unit),
    low: Math.min(...scaled),
    high: Math.max(...scaled),
    bins: { first: Number(counts.first), exponent: Number(counts.exponent), counts: numbers(counts.bins, -1, "counts") },
    hasBricks: Array.isArray(json.plan?.tiers) && json.plan.tiers.includes("bricks"),
  };
}

/** All levels of a grid, the finest first (index/file/detail_levels.cpp). */
export function levelsOf(info: Info): Level[] {
  const levels: Level[] = [{ vertices: info.vertices, spacing: info.spacing, positions: info.positions }];
  for (let last = levels[0]!; last.vertices.some((n) => n > EDGE); last = levels.at(-1)!) {
    const coarser = (at: number[]) => (at.length ? [...at.filter((_, i) => i % 2 === 0 && i + 1 < at.length), at.at(-1)!] : []);
    levels.push({
      vertices: last.vertices.map((n) => Math.floor(n / 2) + 1) as Level["vertices"],
      spacing: last.spacing.map((d) => 2 * d) as Level["spacing"],
      positions: last.positions.map(coarser) as Level["positions"],
    });
  }
  return levels;
}

/** Opens an index. Throws an Error in one line: foreign, older, damaged, changed meanwhile. */
export class IndexFile {
  private constructor(
    readonly source: ByteSource,
    readonly module: Module,
    readonly hasSince: boolean,
    readonly arrays: ArrayOfIndex[],
  ) {}

  get steps(): number {
    return this.arrays[0]!.info.times.length;
  }

  static async open(source: ByteSource, module: Module): Promise<IndexFile> {
    const damaged = (what: string) => new Error(`${source.name}: damaged: ${what}`);
    const [head] = await source.read([{ begin: 0, end: 2 * SLOT }]);
    const slots = [head!.subarray(0, SLOT), head!.subarray(SLOT)].map((slot) => headerOf(module, slot));
    const sound = slots.filter((slot): slot is Header => slot !== null);
    if (sound.length === 0) {
      const magic = new TextDecoder().decode(head!.subarray(0, 8));
      throw magic === "ISOCHRON" ? damaged("its header") : new Error(`${source.name}: not an index of Isochron`);
    }
    const header = sound.reduce((a, b) => (b.sequence > a.sequence ? b : a));
    if (header.version < OLDEST)
      throw new Error(`${source.name}: version ${header.version} of the format; build it again: isochron build OLD -o NEW`);
    if (header.version > NEWEST) throw new Error(`${source.name}: version ${header.version} of the format, this page reads up to ${NEWEST}`);
    const hasSince = header.version > WITHOUT_SINCE;

    const section = async (of: Section, name: string): Promise<Uint8Array> => {
      if (of.offset + of.bytes > header.fileBytes || of.bytes > MOST_METADATA) throw damaged(`section ${name}`);
      if (of.bytes === 0) return new Uint8Array();
      const [bytes] = await source.read([{ begin: of.offset, end: of.offset + of.bytes }]);
      if (module.checksum(bytes!) !== of.checksum) throw damaged(`the checksum of section ${name} does not match`);
      return bytes!;
    };
    const arrayOf = async (sections: Sections): Promise<{ array: ArrayOfIndex; json: Record<string, any> }> => {
      const [words, steps] = await Promise.all([section(sections.metadata, "metadata"), section(sections.steps, "steps")]);
      let json: Record<string, any>;
      try {
        json = JSON.parse(new TextDecoder().decode(words)) as Record<string, any>;
      } catch {
        throw damaged("metadata");
      }
      if (json.referral) throw new Error(`${source.name}: has no copy of its values; build it without --refer`);
      const info = infoOf(json);
      const view = new DataView(steps.buffer, steps.byteOffset, steps.length);
      const entries: StepEntry[] = [];
      for (let at = 0; at + 24 <= steps.length; at += 24) {
        const entry = { offset: safe(view.getBigUint64(at, true)), bytes: safe(view.getBigUint64(at + 8, true)), tables: safe(view.getBigUint64(at + 16, true)) };
        if (entry.offset + entry.bytes > header.fileBytes || entry.tables > entry.bytes) throw damaged("a step lies outside the file");
        entries.push(entry);
      }
      const levels = levelsOf(info);
      if (entries.length < levels.length * info.times.length) throw damaged("steps are missing");
      return { array: { info, levels, entries }, json };
    };
    const first = await arrayOf(header.sections);
    const more = ((first.json.arrays ?? []) as Record<string, any>[]).map((of) => {
      const sections = {} as Sections;
      for (const name of SECTIONS) {
        const [offset, bytes, sum] = of.sections?.[name] as [number, number, string];
        sections[name] = { offset, bytes, checksum: BigInt(`0x${sum}`) };
      }
      return arrayOf(sections);
    });
    const others = (await Promise.all(more)).map((each) => each.array);
    return new IndexFile(source, module, hasSince, [first.array, ...others]);
  }
}
