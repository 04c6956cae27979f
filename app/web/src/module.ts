// The WebAssembly module: checks, unpacks, finds cells and makes triangles (module/module.cpp).
import { decompress } from "fzstd";

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  take(bytes: number): number;
  give(place: number): void;
  checksum(bytes: number, count: number, out: number): void;
  volume(description: number, positions: number): number;
  close(volume: number): void;
  place(volume: number, x: number, y: number): number;
  at(volume: number, place: number): number;
  chunk_bytes(volume: number, layer: number, place: number): number;
  table_bytes(volume: number): number;
  set_levels(volume: number, which: number, bytes: number, count: number): number;
  set_query(volume: number, fraction: number, isovalue: number): number;
  set_colors(volume: number, fraction: number): void;
  candidates(volume: number, table: number, tableNext: number, out: number): number;
  check_table(volume: number, table: number): number;
  check(volume: number, record: number, count: number): number;
  unpack(volume: number, layer: number, place: number, record: number, count: number, out: number): number;
  bricks(volume: number, record: number, recordNext: number, around: number): number;
  find(volume: number, layer: number, place: number, bricks: number, around: number, aroundNext: number): number;
  values(other: number, of: number, layer: number, place: number, around: number, aroundNext: number): number;
  found(volume: number, out: number): void;
  slice(volume: number, plane: number, most: number): number;
  slice_chunk(volume: number, layer: number, place: number, values: number, valuesNext: number): void;
  sliced(volume: number, out: number): void;
}

/** Unpacks an LZ4 block; -1 where it is damaged. */
export function lz4(packed: Uint8Array, out: Uint8Array): number {
  let from = 0;
  let to = 0;
  const length = (start: number): number => {
    let sum = start;
    if (start === 15) {
      let byte: number;
      do {
        byte = packed[from++] ?? -1;
        if (byte < 0) return -1;
        sum += byte;
      } while (byte === 255);
    }
    return sum;
  };
  while (from < packed.length) {
    const token = packed[from++]!;
    const literals = length(token >> 4);
    if (literals < 0 || from + literals > packed.length || to + literals > out.length) return -1;
    out.set(packed.subarray(from, from + literals), to);
    from += literals;
    to += literals;
    if (from === packed.length) return to;
    const back = (packed[from] ?? 0) | ((packed[from + 1] ?? 0) << 8);
    from += 2;
    const more = length(token & 15);
    if (more < 0 || back === 0 || back > to || to + more + 4 > out.length) return -1;
    for (let i = 0; i < more + 4; ++i, ++to) out[to] = out[to - back]!;
  }
  return -1;
}

/** The module's memory and functions. One for each thread. */
export class Module {
  private constructor(readonly calls: Exports) {}

  static async load(code: BufferSource | Promise<Response>): Promise<Module> {
    let calls!: Exports;
    const bytes = (place: number, count: number) => new Uint8Array(calls.memory.buffer, place, count);
    const imports = {
      page: {
        lz4: (packed: number, out: number, count: number, size: number) => lz4(bytes(packed, count), bytes(out, size)),
        zstd: (out: number, size: number, packed: number, count: number) => {
          try {
            return decompress(bytes(packed, count), bytes(out, size)).length;
          } catch {
            return -1;
          }
        },
      },
      // What the C library asks of a system: there is none.
      wasi_snapshot_preview1: { fd_close: () => 8, fd_seek: () => 8, fd_write: () => 8 },
    };
    const made =
      code instanceof Promise
        ? await WebAssembly.instantiateStreaming(code, imports)
        : await WebAssembly.instantiate(code, imports);
    calls = (made as WebAssembly.WebAssemblyInstantiatedSource).instance.exports as unknown as Exports;
    calls._initialize();
    return new Module(calls);
  }

  /** Views of the memory: valid until the next call, which may make it larger. */
  bytes(place: number, count: number): Uint8Array {
    return new Uint8Array(this.calls.memory.buffer, place, count);
  }
  words(place: number, count: number): Uint32Array {
    return new Uint32Array(this.calls.memory.buffer, place, count);
  }

  /** Memory with a copy of these bytes, for whoever gives it back. */
  put(bytes: Uint8Array): number {
    const place = this.take(bytes.length);
    this.bytes(place, bytes.length).set(bytes);
    return place;
  }
  take(bytes: number): number {
    const place = this.calls.take(Math.max(1, bytes));
    if (place === 0) throw new Error("out of memory");
    return place;
  }
  give(place: number): void {
    this.calls.give(place);
  }

  /** XXH3-64 of bytes. */
  checksum(bytes: Uint8Array): bigint {
    const from = this.put(bytes);
    const out = this.take(8);
    this.calls.checksum(from, bytes.length, out);
    const [low, high] = this.words(out, 2);
    this.give(from);
    this.give(out);
    return BigInt(low!) | (BigInt(high!) << 32n);
  }
}
