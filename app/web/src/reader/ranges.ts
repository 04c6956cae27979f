// Bytes of a file by ranges: of a web server, or of whatever else has them.

/** Offset of the first byte, and of the one after the last. */
export interface Range {
  begin: number;
  end: number;
}

/** What reads a file by ranges. */
export interface ByteSource {
  readonly name: string;
  /** The bytes of each range, in order. Throws FileChanged, or another Error in one line. */
  read(ranges: readonly Range[], stop?: AbortSignal): Promise<Uint8Array[]>;
}

/** The file is not the one that was opened: open it anew. */
export class FileChanged extends Error {}

/** Ranges with fewer bytes than this between them are asked for together. */
const NEAR = 16 << 10;
/** Most bytes of one request. */
const TOGETHER = 4 << 20;
/** Requests at a time, as many as browsers send to a server of HTTP/1.1. */
const AT_A_TIME = 6;

/** Joins ranges that are near each other. `parts` are numbers of the given ranges. */
export function joined(ranges: readonly Range[]): (Range & { parts: number[] })[] {
  const order = ranges.map((_, i) => i).sort((a, b) => ranges[a]!.begin - ranges[b]!.begin);
  const runs: (Range & { parts: number[] })[] = [];
  for (const i of order) {
    const { begin, end } = ranges[i]!;
    const last = runs.at(-1);
    if (last && begin - last.end < NEAR && end - last.begin <= TOGETHER) {
      last.end = Math.max(last.end, end);
      last.parts.push(i);
    } else {
      runs.push({ begin, end, parts: [i] });
    }
  }
  return runs;
}

/** A file of a web server. Counts what it asks for. */
export class HttpSource implements ByteSource {
  requests = 0;
  bytes = 0;
  private tag: string | null = null;
  private free = AT_A_TIME;
  private readonly waiting: (() => void)[] = [];

  constructor(
    readonly name: string,
    private readonly headers: Record<string, string> = {},
  ) {}

  async read(ranges: readonly Range[], stop?: AbortSignal): Promise<Uint8Array[]> {
    const found = new Array<Uint8Array>(ranges.length);
    await Promise.all(
      joined(ranges).map(async (run) => {
        const bytes = await this.inTurn(() => this.ask(run, stop));
        for (const part of run.parts) {
          const { begin, end } = ranges[part]!;
          found[part] = bytes.subarray(begin - run.begin, end - run.begin);
        }
      }),
    );
    return found;
  }

  private async inTurn<T>(work: () => Promise<T>): Promise<T> {
    if (this.free > 0) --this.free;
    else await new Promise<void>((go) => this.waiting.push(go));
    try {
      return await work();
    } finally {
      const next = this.waiting.shift();
      if (next) next();
      else ++this.free;
    }
  }

  private async ask(range: Range, stop?: AbortSignal): Promise<Uint8Array> {
    stop?.throwIfAborted();
    ++this.requests;
    const own = new AbortController();
    const ended = () => own.abort(stop?.reason);
    stop?.addEventListener("abort", ended);
    try {
      const answer = await fetch(this.name, {
        // Chromium answers ranges of one address one after the other behind its own cache.
        cache: "no-store",
        headers: { ...this.headers, Range: `bytes=${range.begin}-${range.end - 1}` },
        signal: own.signal,
      });
      if (answer.status === 200) {
        own.abort(); // all of the file would come
        throw new Error(`${this.name}: the server sends the whole file where a range of it is asked for`);
      }
      if (answer.status !== 206) throw new Error(`${this.name}: the server answers ${answer.status} ${answer.statusText}`);
      this.check(answer.headers.get("ETag"));
      const bytes = new Uint8Array(await answer.arrayBuffer());
      this.bytes += bytes.length;
      if (bytes.length !== range.end - range.begin)
        throw new Error(`${this.name}: ${bytes.length} bytes came where ${range.end - range.begin} were asked for; the file is truncated`);
      return bytes;
    } finally {
      stop?.removeEventListener("abort", ended);
    }
  }

  /** A strong tag names the file's content: another one is another file. */
  private check(tag: string | null): void {
    if (!tag || tag.startsWith("W/")) return;
    if (this.tag && this.tag !== tag) throw new FileChanged(`${this.name}: the file has changed`);
    this.tag = tag;
  }
}
