// A file of the disk as a source of ranges.
import { closeSync, openSync, readSync } from "node:fs";
import type { ByteSource, Range } from "../src/reader/ranges";

export class FileSource implements ByteSource {
  private readonly file: number;
  constructor(readonly name: string) {
    this.file = openSync(name, "r");
  }
  read(ranges: readonly Range[]): Promise<Uint8Array[]> {
    return Promise.resolve(
      ranges.map(({ begin, end }) => {
        const bytes = new Uint8Array(end - begin);
        if (readSync(this.file, bytes, 0, bytes.length, begin) !== bytes.length) throw new Error(`${this.name}: truncated`);
        return bytes;
      }),
    );
  }
  close(): void {
    closeSync(this.file);
  }
}
