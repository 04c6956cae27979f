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
export function joined(ranges: readonly Range[], near = NEAR): (Range & { parts: number[] })[] {
  const order = ranges.map((_, i) => i).sort((a, b) => ranges[a]!.begin - ranges[b]!.begin);
  const runs: (Range & { parts: number[] })[] = [];
  for (const i of order) {
    const { begin, end } = ranges[i]!;
    const last = runs.at(-1);
    if (last && begin - last.end <= near && end - last.begin <= TOGETHER) {
      last.end = Math.max(last.end, end);
      last.parts.push(i);
    } else {
      runs.push({ begin, end, parts: [i] });
    }
  }
  return runs;
}

/** Most ranges of one request of several: servers refuse or ignore more. */
const MOST_RANGES = 200;

/** The parts of a multipart answer by their first byte. @param boundary as the header Content-Type has it */
export function partsOf(body: Uint8Array, boundary: string): Map<number, Uint8Array> {
  const parts = new Map<number, Uint8Array>();
  const line = new TextEncoder().encode(`--${boundary}`);
  const starts = (at: number) => line.every((byte, i) => body[at + i] === byte);
  let at = 0;
  while (at < body.length && !starts(at)) ++at;
  while (at < body.length) {
    at += line.length;
    if (body[at] === 0x2d && body[at + 1] === 0x2d) return parts; // the last line
    let end = at; // of the head: an empty line
    while (end + 3 < body.length && !(body[end] === 13 && body[end + 1] === 10 && body[end + 2] === 13 && body[end + 3] === 10)) ++end;
    const head = new TextDecoder().decode(body.subarray(at, end));
    const range = /content-range:\s*bytes (\d+)-(\d+)\//i.exec(head);
    if (!range) return parts;
    const [begin, last] = [Number(range[1]), Number(range[2])];
    const first = end + 4;
    at = first + last - begin + 1;
    if (at + 2 > body.length) return parts;
    parts.set(begin, body.subarray(first, at));
    at += 2; // the end of its last line
    if (!starts(at)) return parts;
  }
  return parts;
}

/** A file of a web server. Counts what it asks for. */
export class HttpSource implements ByteSource {
  requests = 0;
  bytes = 0;
  private tag: string | null = null;
  /** Whether the server answers several ranges at once; null: not known yet. */
  private several: boolean | null = null;
  private free = AT_A_TIME;
  private readonly waiting: (() => void)[] = [];

  constructor(
    readonly name: string,
    private readonly headers: Record<string, string> = {},
  ) {}

  async read(ranges: readonly Range[], stop?: AbortSignal): Promise<Uint8Array[]> {
    const found = new Array<Uint8Array>(ranges.length);
    let runs = joined(ranges, 0);
    const several = () => this.several; // which asking changes
    if (several() !== false && runs.length > AT_A_TIME) {
      const groups = Array.from({ length: Math.ceil(runs.length / MOST_RANGES) }, (_, i) => runs.slice(i * MOST_RANGES, (i + 1) * MOST_RANGES));
      // The first group says whether the server can do it.
      const rest = several() === null ? [await this.askTogether(groups[0]!, ranges, found, stop)] : [];
      const begun = rest.length;
      if (several() !== false)
        rest.push(...(await Promise.all(groups.slice(begun).map((group) => this.askTogether(group, ranges, found, stop)))));
      if (several() === true && rest.every(Boolean)) return found;
      runs = runs.filter((run) => run.parts.some((part) => !found[part]));
    }
    const left = runs.flatMap((run) => run.parts);
    await Promise.all(
      joined(left.map((part) => ranges[part]!)).map(async (run) => {
        const bytes = (await this.inTurn(() => this.ask([run], stop))).bytes;
        for (const i of run.parts) {
          const part = left[i]!;
          const { begin, end } = ranges[part]!;
          found[part] = bytes.subarray(begin - run.begin, end - run.begin);
        }
      }),
    );
    return found;
  }

  /** Asks for several ranges in one request. @return false: some are left to be asked for alone */
  private async askTogether(runs: (Range & { parts: number[] })[], ranges: readonly Range[], found: Uint8Array[], stop?: AbortSignal): Promise<boolean> {
    const { bytes, boundary } = await this.inTurn(() => this.ask(runs, stop));
    this.several = boundary !== null;
    if (boundary === null) return false;
    const parts = partsOf(bytes, boundary);
    let all = true;
    for (const run of runs) {
      const own = parts.get(run.begin);
      if (own?.length !== run.end - run.begin) {
        all = false;
        continue;
      }
      for (const part of run.parts) {
        const { begin, end } = ranges[part]!;
        found[part] = own.subarray(begin - run.begin, end - run.begin);
      }
    }
    return all;
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

  private async ask(ranges: readonly Range[], stop?: AbortSignal): Promise<{ bytes: Uint8Array; boundary: string | null }> {
    stop?.throwIfAborted();
    ++this.requests;
    const own = new AbortController();
    const ended = () => own.abort(stop?.reason);
    stop?.addEventListener("abort", ended);
    try {
      const answer = await fetch(this.name, {
        // Chromium answers ranges of one address one after the other behind its own cache.
        cache: "no-store",
        headers: { ...this.headers, Range: `bytes=${ranges.map(({ begin, end }) => `${begin}-${end - 1}`).join(",")}` },
        signal: own.signal,
      });
      if (answer.status !== 206) {
        own.abort(); // the whole file may come
        if (ranges.length > 1) return { bytes: new Uint8Array(), boundary: null };
        if (answer.status === 200) throw new Error(`${this.name}: the server sends the whole file where a range of it is asked for`);
        throw new Error(`${this.name}: the server answers ${answer.status} ${answer.statusText}`);
      }
      this.check(answer.headers.get("ETag"));
      const boundary = /^multipart\/byteranges;.*boundary="?([^";]+)/i.exec(answer.headers.get("Content-Type") ?? "")?.[1] ?? null;
      if (ranges.length > 1 && boundary === null) {
        own.abort(); // it sends one range that spans them all
        return { bytes: new Uint8Array(), boundary };
      }
      const bytes = new Uint8Array(await answer.arrayBuffer());
      this.bytes += bytes.length;
      const wanted = ranges[0]!.end - ranges[0]!.begin;
      if (ranges.length === 1 && bytes.length !== wanted)
        throw new Error(`${this.name}: ${bytes.length} bytes came where ${wanted} were asked for; the file is truncated`);
      return { bytes, boundary };
    } finally {
      stop?.removeEventListener("abort", ended);
    }
  }

  /** Whether the server says that the file is another one by now. */
  async hasChanged(): Promise<boolean> {
    const answer = await fetch(this.name, { method: "HEAD", cache: "no-store", headers: this.headers });
    const tag = answer.headers.get("ETag");
    return answer.ok && tag !== null && this.tag !== null && tag !== this.tag;
  }
  /** The file as it is now. */
  anew(): HttpSource {
    return new HttpSource(this.name, this.headers);
  }

  /** A strong tag names the file's content: another one is another file. */
  private check(tag: string | null): void {
    if (!tag || tag.startsWith("W/")) return;
    if (this.tag && this.tag !== tag) throw new FileChanged(`${this.name}: the file has changed`);
    this.tag = tag;
  }
}
