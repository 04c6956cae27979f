// The surface of an isovalue at a step: which chunks hold it, what they need, their cells and triangles.
import type { ArrayOfIndex, IndexFile, StepEntry } from "../reader/index_file";
import { TYPES } from "../reader/index_file";
import { SLICE_ROW, type SliceValues } from "../messages";
import type { Range } from "../reader/ranges";

const AROUND = 27;
const OWN = 13;
const ALL_BRICKS = 0xffffffff;
const ALL_AROUND = 0x7ffffff;
/** Values of a slice: what a picture of rows of SLICE_ROW holds on every GPU. */
const MOST_SLICE_VALUES = SLICE_ROW * SLICE_ROW;
/** Values of chunks that are kept unpacked, in bytes. */
const MOST_KEPT = 256 << 20;
/** Records that are kept as they were read, in bytes. */
const MOST_RECORDS = 64 << 20;
/** Milliseconds of work without a look at newer wishes. */
const MOST_AT_ONCE = 30;

/** Lets messages of the page come in: data that are at hand never do. */
export const newerWishes = (): Promise<void> => new Promise((go) => setTimeout(go));

/** The triangles of one chunk; what the arrays hold is copied out of the module. */
export interface Piece {
  /** x, y, z of each active cell. */
  cells: Uint16Array;
  /** x, y, z of each point in physical space, less the grid's origin. */
  points: Float32Array;
  /** Of length 1, towards lower values. */
  normals: Float32Array;
  triangles: Uint32Array;
  /** Of another array at the points, where one was asked for. */
  values: Float32Array | null;
}

/** The table of a layer of chunks. */
interface Table {
  bytes: Uint8Array;
  /** Of each record, then the end of the last one. */
  offsets: number[];
  since: number[];
}

interface Kept {
  place: number;
  bytes: number;
  used: number;
}

/** One array at one level of detail, as the module knows it. */
export class Surfaces {
  private readonly volume: number;
  private readonly counts: [number, number, number];
  /** By step, then by layer. */
  private readonly tables = new Map<number, Table[]>();
  private readonly levelsOfStep = new Map<number, Uint8Array>();
  private readonly records = new Map<number, Uint8Array>();
  private readonly kept = new Map<number, Kept>();
  private keptBytes = 0;
  private recordBytes = 0;
  private clock = 0;

  constructor(
    private readonly file: IndexFile,
    readonly array: ArrayOfIndex,
    readonly level: number,
  ) {
    const { calls } = file.module;
    const { info } = array;
    const grid = array.levels[level]!;
    this.counts = grid.vertices.map((n) => Math.ceil(n / 16)) as [number, number, number];
    const words = [
      TYPES.indexOf(info.type), info.slope, info.intercept, ...grid.vertices, ...grid.spacing, ...info.direction.flat(),
      info.hasBricks ? 1 : 0, file.hasSince ? 1 : 0,
    ];
    const positions = [...grid.positions.map((at) => at.length), ...grid.positions.flat()];
    const put = (of: number[]) => file.module.put(new Uint8Array(Float64Array.from(of).buffer));
    const [description, places] = [put(words), put(positions)];
    this.volume = calls.volume(description, places);
    file.module.give(description);
    file.module.give(places);
  }

  close(): void {
    for (const { place } of this.kept.values()) this.file.module.give(place);
    this.kept.clear();
    this.file.module.calls.close(this.volume);
  }

  /** A number for a chunk at a step. */
  private key(step: number, layer: number, place: number): number {
    return (step * this.counts[2] + layer) * this.counts[0] * this.counts[1] + place;
  }
  private entry(step: number): StepEntry {
    return this.array.entries[this.level * this.file.steps + step]!;
  }
  private damaged(step: number, what: string): Error {
    return new Error(`${this.file.source.name}: damaged: ${this.array.info.array}, step ${step}: ${what}`);
  }

  /** Reads the tables and the levels of a step: they lie together behind its records. */
  private async readTables(step: number, stop?: AbortSignal): Promise<void> {
    if (this.levelsOfStep.has(step)) return;
    const entry = this.entry(step);
    const [bytes] = await this.file.source.read([{ begin: entry.offset + entry.tables, end: entry.offset + entry.bytes }], stop);
    const length = this.file.module.calls.table_bytes(this.volume);
    const tables: Table[] = [];
    const size = this.file.hasSince ? 8 : 4;
    for (let layer = 0; layer < this.counts[2]; ++layer) {
      const own = bytes!.subarray(layer * length, (layer + 1) * length);
      if (own.length !== length) throw this.damaged(step, "tables are missing");
      if (!this.withBytes([own], (at) => this.file.module.calls.check_table(this.volume, at)))
        throw this.damaged(step, `the checksum of the table of layer ${layer} does not match`);
      const view = new DataView(own.buffer, own.byteOffset, own.length);
      let end = entry.offset + Number(view.getBigUint64(8, true));
      const table: Table = { bytes: own, offsets: [], since: [] };
      for (let at = 16; at < length; at += size) {
        table.offsets.push(end);
        table.since.push(this.file.hasSince ? view.getUint32(at + 4, true) : step);
        end += view.getUint16(at, true);
      }
      table.offsets.push(end);
      if (end > entry.offset + entry.tables) throw this.damaged(step, `layer ${layer} lies outside its step`);
      tables.push(table);
    }
    this.tables.set(step, tables);
    this.levelsOfStep.set(step, bytes!.subarray(this.counts[2] * length));
  }

  /** Reads records that are not at hand, and checks them. */
  private async readRecords(step: number, wanted: readonly (readonly [layer: number, place: number])[], stop?: AbortSignal): Promise<void> {
    const missing = wanted.filter(([layer, place]) => !this.records.has(this.key(step, layer, place)));
    const ranges = missing.map(([layer, place]): Range => {
      const { offsets } = this.tables.get(step)![layer]!;
      return { begin: offsets[place]!, end: offsets[place + 1]! };
    });
    const { module } = this.file;
    const found = ranges.length ? await this.file.source.read(ranges, stop) : [];
    found.forEach((bytes, i) => {
      const [layer, place] = missing[i]!;
      const at = module.put(bytes);
      const sound = module.calls.check(this.volume, at, bytes.length);
      module.give(at);
      if (!sound) throw this.damaged(step, `chunk ${place} of layer ${layer}: its checksum does not match`);
      this.records.set(this.key(step, layer, place), bytes.slice()); // alone, not the whole answer
      this.recordBytes += bytes.length;
    });
  }

  /** Where the values of a chunk lie: at an earlier step, since which they have stayed. */
  private home(step: number, layer: number, place: number): number {
    const table = this.tables.get(step)![layer]!;
    const head = 4 + (this.array.info.hasBricks ? 64 : 0);
    const bytes = table.offsets[place + 1]! - table.offsets[place]!;
    const since = table.since[place]!;
    return since < step && bytes === head ? since : step;
  }

  /** Unpacks a chunk whose record is at hand. @return its place in the module's memory */
  private unpacked(step: number, layer: number, place: number): number {
    const key = this.key(step, layer, place);
    const known = this.kept.get(key);
    if (known) {
      known.used = ++this.clock;
      return known.place;
    }
    const { module } = this.file;
    const record = this.records.get(key)!;
    const bytes = module.calls.chunk_bytes(this.volume, layer, place);
    const out = module.take(bytes);
    const at = module.put(record);
    const sound = module.calls.unpack(this.volume, layer, place, at, record.length, out);
    module.give(at);
    if (!sound) {
      module.give(out);
      throw this.damaged(step, `chunk ${place} of layer ${layer}: it cannot be unpacked`);
    }
    this.kept.set(key, { place: out, bytes, used: ++this.clock });
    this.keptBytes += bytes;
    return out;
  }

  /** Forgets what was used longest ago. Not while a search holds places of memory. */
  private forget(): void {
    if (this.recordBytes > MOST_RECORDS) {
      this.records.clear();
      this.recordBytes = 0;
    }
    if (this.keptBytes <= MOST_KEPT) return;
    const oldest = [...this.kept.entries()].sort((a, b) => a[1].used - b[1].used);
    for (const [key, { place, bytes }] of oldest) {
      if (this.keptBytes <= MOST_KEPT / 2) break;
      this.file.module.give(place);
      this.kept.delete(key);
      this.recordBytes -= this.records.get(key)?.length ?? 0;
      this.records.delete(key);
      this.keptBytes -= bytes;
    }
  }

  /** Gets the records of chunks at a step, also of those whose values lie in records of earlier steps. */
  private async readChunks(step: number, chunks: Iterable<[layer: number, place: number]>, stop?: AbortSignal): Promise<void> {
    await this.readTables(step, stop);
    const byHome = new Map<number, [number, number][]>();
    for (const chunk of chunks) {
      const home = this.home(step, ...chunk);
      const others = byHome.get(home);
      if (others) others.push(chunk);
      else byHome.set(home, [chunk]);
    }
    await Promise.all([...byHome.keys()].map((home) => this.readTables(home, stop)));
    await Promise.all([...byHome].map(([home, some]) => this.readRecords(home, some, stop)));
  }

  /** Writes the places of unpacked chunks, whose records are at hand, where the module looks for them. */
  private point(step: number, needs: readonly [bit: number, layer: number, place: number][], pointers: number): void {
    const places = new Uint32Array(AROUND);
    for (const [bit, layer, place] of needs) places[bit] = this.unpacked(this.home(step, layer, place), layer, place);
    this.file.module.words(pointers, AROUND).set(places);
  }

  /** Gives bytes at each of some steps to the module, for one call; 0 stands for a step that is not there. */
  private withBytes<T>(bytes: readonly Uint8Array[], call: (first: number, second: number) => T): T {
    const { module } = this.file;
    const [first, second] = bytes.map((each) => module.put(each)) as [number, number?];
    try {
      return call(first, second ?? 0);
    } finally {
      module.give(first);
      if (second) module.give(second);
    }
  }

  /**
   * The values on a plane at a step or between two, of only the chunks that it cuts.
   * @param plane a point on it, less the grid's origin, and its unit normal
   * @return null: it cuts nothing
   */
  async slice(step: number, fraction: number, plane: readonly number[], stop?: AbortSignal): Promise<SliceValues | null> {
    const { module } = this.file;
    const { calls } = module;
    const { info } = this.array;
    const steps = fraction > 0 ? [step, step + 1] : [step];
    calls.set_colors(this.volume, fraction);
    const at = module.put(new Uint8Array(Float64Array.of(...plane, info.low, info.high).buffer));
    const count = calls.slice(this.volume, at, MOST_SLICE_VALUES);
    module.give(at);
    if (count < 0) throw new Error(`${this.file.source.name}: a slice of more than ${MOST_SLICE_VALUES} values`);
    if (count === 0) return null;
    const out = module.take(32);
    const parts = (): number[] => {
      calls.sliced(this.volume, out);
      return [...module.words(out, 8)];
    };
    try {
      const needed = module.words(parts()[0]!, 2 * count).slice();
      const chunks = Array.from({ length: count }, (_, i): [number, number] => [needed[2 * i]!, needed[2 * i + 1]!]);
      await Promise.all(steps.map((each) => this.readChunks(each, chunks, stop)));
      let began = performance.now();
      for (const [layer, place] of chunks) {
        if (performance.now() - began > MOST_AT_ONCE) {
          await newerWishes();
          began = performance.now();
        }
        stop?.throwIfAborted();
        const [now, next] = steps.map((each) => this.unpacked(this.home(each, layer, place), layer, place)) as [number, number?];
        calls.slice_chunk(this.volume, layer, place, now, next ?? 0);
      }
      const [, columns, shares, outline, columnCount, shareCount, outlineCount, axis] = parts() as [number, number, number, number, number, number, number, number];
      const rows = (words: number) => SLICE_ROW * Math.ceil(words / SLICE_ROW);
      const made: SliceValues = {
        axis,
        whole: [info.low, info.high],
        columns: new Uint32Array(2 * rows(columnCount)),
        shares: new Float32Array(rows(shareCount)),
        outline: new Float32Array(calls.memory.buffer, outline, outlineCount).slice(),
        ...this.array.levels[this.level]!,
      };
      made.columns.set(module.words(columns, 2 * columnCount));
      made.shares.set(new Float32Array(calls.memory.buffer, shares, shareCount));
      return made;
    } finally {
      module.give(out);
      this.forget();
    }
  }

  /**
   * The surface at a step or between two, piece by piece. One search at a time.
   * @param fraction of the way to the next step, in 65536ths
   * @param colors another array at the same level, whose values at the points are wanted
   */
  async find(step: number, fraction: number, isovalue: number, take: (piece: Piece) => void, stop?: AbortSignal, colors?: Surfaces): Promise<void> {
    const { module } = this.file;
    const { calls } = module;
    const steps = fraction > 0 ? [step, step + 1] : [step];
    await Promise.all(steps.map((each) => this.readTables(each, stop)));
    steps.forEach((each, which) => {
      const levels = this.levelsOfStep.get(each)!;
      if (!this.withBytes([levels], (at) => calls.set_levels(this.volume, which, at, levels.length))) throw this.damaged(each, "the levels of its bricks");
    });
    colors?.file.module.calls.set_colors(colors.volume, fraction);
    if (!calls.set_query(this.volume, fraction, isovalue)) return;

    // Candidates of all layers, then the chunks that their bricks need.
    const out = module.take(4 * this.counts[0] * this.counts[1]);
    const candidates: [number, number][] = [];
    for (let layer = 0; layer < this.counts[2]; ++layer) {
      const tables = steps.map((each) => this.tables.get(each)![layer]!.bytes);
      const count = this.withBytes(tables, (table, next) => calls.candidates(this.volume, table, next, out));
      if (count < 0) throw this.damaged(step, `the checksum of the table of layer ${layer} does not match`);
      for (const place of module.words(out, count)) candidates.push([layer, place]);
    }
    module.give(out);
    await Promise.all(steps.map((each) => this.readRecords(each, candidates, stop)));
    const around = module.take(4);
    const asked: { layer: number; place: number; bricks: number; needs: [bit: number, layer: number, place: number][] }[] = [];
    const needed = new Map<number, [number, number]>();
    for (const [layer, place] of candidates) {
      let bricks = ALL_BRICKS;
      let reach = ALL_AROUND;
      if (this.array.info.hasBricks) {
        const records = steps.map((each) => this.records.get(this.key(each, layer, place))!.subarray(0, 68));
        bricks = this.withBytes(records, (record, next) => calls.bricks(this.volume, record, next, around)) >>> 0;
        reach = module.words(around, 1)[0]! | (1 << OWN);
      }
      if (bricks === 0) continue;
      const at = calls.at(this.volume, place);
      const needs: [number, number, number][] = [];
      for (let bit = 0; bit < AROUND; ++bit) {
        if (!((reach >>> bit) & 1)) continue;
        const [x, y, z] = [(at & 0xffff) + (bit % 3) - 1, (at >>> 16) + (Math.floor(bit / 3) % 3) - 1, layer + Math.floor(bit / 9) - 1];
        if (x < 0 || y < 0 || z < 0 || x >= this.counts[0] || y >= this.counts[1] || z >= this.counts[2]) continue;
        const other = calls.place(this.volume, x, y);
        needs.push([bit, z, other]);
        needed.set(this.key(0, z, other), [z, other]);
      }
      asked.push({ layer, place, bricks, needs });
    }
    module.give(around);
    await Promise.all(steps.flatMap((each) => [this.readChunks(each, needed.values(), stop), colors?.readChunks(each, needed.values(), stop)]));

    const pointers = steps.map(() => module.take(4 * AROUND));
    const [now, next] = [pointers[0]!, pointers[1] ?? 0];
    const found = module.take(24);
    let began = performance.now();
    try {
      for (const { layer, place, bricks, needs } of asked) {
        if (performance.now() - began > MOST_AT_ONCE) {
          await newerWishes();
          began = performance.now();
        }
        stop?.throwIfAborted();
        steps.forEach((each, i) => this.point(each, needs, pointers[i]!));
        const count = calls.find(this.volume, layer, place, bricks, now, next);
        if (count === 0) continue;
        calls.found(this.volume, found);
        const [cells, points, normals, triangles, pointCount, triangleCount] = module.words(found, 6) as unknown as [number, number, number, number, number, number];
        let values: Float32Array | null = null;
        if (colors) {
          steps.forEach((each, i) => colors.point(each, needs, pointers[i]!));
          const at = calls.values(colors.volume, this.volume, layer, place, now, next);
          values = new Float32Array(calls.memory.buffer, at, pointCount).slice();
        }
        const memory = calls.memory.buffer;
        take({
          cells: new Uint16Array(memory, cells, 3 * count).slice(),
          points: new Float32Array(memory, points, 3 * pointCount).slice(),
          normals: new Float32Array(memory, normals, 3 * pointCount).slice(),
          triangles: new Uint32Array(memory, triangles, 3 * triangleCount).slice(),
          values,
        });
      }
    } finally {
      for (const each of pointers) module.give(each);
      module.give(found);
      this.forget();
      colors?.forget();
    }
  }
}
