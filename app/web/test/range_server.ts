// A small web server of one folder, which answers ranges; its faults are asked for.
import { createServer, type Server } from "node:http";
import { readFileSync, statSync } from "node:fs";
import { extname, join, normalize } from "node:path";

const KINDS: Record<string, string> = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".json": "application/json" };

export interface Faults {
  /** Sends the whole file, as servers without ranges do. */
  ignoresRanges?: boolean;
  /** Each answer has another tag. */
  changes?: boolean;
  /** Answers several ranges at once, in parts; else the whole file, or with `spans` one range over all. */
  several?: boolean;
  spans?: boolean;
  /** Leaves every third of several ranges out. */
  leavesOut?: boolean;
  /** Flips a bit in what lies behind this offset. */
  damageFrom?: number;
}

export class RangeServer {
  asked = 0;
  faults: Faults = {};
  private readonly server: Server;

  constructor(private readonly folders: string[]) {
    this.server = createServer((request, answer) => {
      const name = normalize(decodeURIComponent((request.url ?? "/").split("?")[0]!));
      const path = this.folders.map((folder) => join(folder, name === "/" ? "index.html" : name)).find((each) => {
        try {
          return statSync(each).isFile();
        } catch {
          return false;
        }
      });
      if (!path || name.includes("..")) return void answer.writeHead(404).end();
      const all = readFileSync(path);
      const head: Record<string, string> = {
        "Content-Type": KINDS[extname(path)] ?? "application/octet-stream",
        ETag: `"${this.faults.changes ? ++this.asked : statSync(path).mtimeMs}"`,
      };
      const asked = (request.headers.range ?? "").replace(/^bytes=/, "").split(",");
      if (asked.length > 1 && (this.faults.several || this.faults.spans)) {
        ++this.asked;
        const ranges = asked.map((each) => each.split("-").map(Number) as [number, number]);
        if (this.faults.spans) {
          const [first, last] = [Math.min(...ranges.map((each) => each[0])), Math.max(...ranges.map((each) => each[1]))];
          return void answer.writeHead(206, { ...head, "Content-Range": `bytes ${first}-${last}/${all.length}` }).end(all.subarray(first, last + 1));
        }
        const parts = ranges.filter((_, i) => !this.faults.leavesOut || i % 3 !== 2).flatMap(([first, last]) => [
          Buffer.from(`\r\n--edge\r\nContent-Type: application/octet-stream\r\nContent-Range: bytes ${first}-${last}/${all.length}\r\n\r\n`),
          all.subarray(first, last + 1),
        ]);
        return void answer.writeHead(206, { ...head, "Content-Type": "multipart/byteranges; boundary=edge" }).end(Buffer.concat([...parts, Buffer.from("\r\n--edge--\r\n")]));
      }
      const range = /^(\d+)-(\d+)$/.exec(asked[0]!);
      if (!range || asked.length > 1 || this.faults.ignoresRanges) return void answer.writeHead(200, head).end(all);
      ++this.asked;
      const [begin, end] = [Number(range[1]), Math.min(all.length, Number(range[2]) + 1)];
      const bytes = Buffer.from(all.subarray(begin, end));
      if (this.faults.damageFrom !== undefined && begin >= this.faults.damageFrom) bytes[bytes.length >> 1]! ^= 1;
      answer.writeHead(206, { ...head, "Content-Range": `bytes ${begin}-${end - 1}/${all.length}` }).end(bytes);
    });
  }
  async listen(): Promise<string> {
    await new Promise<void>((ready) => this.server.listen(0, "127.0.0.1", ready));
    const address = this.server.address();
    if (typeof address !== "object" || !address) throw new Error("no port");
    return `http://127.0.0.1:${address.port}/`;
  }
  async close(): Promise<void> {
    this.server.closeAllConnections();
    await new Promise((done) => this.server.close(done));
  }
}
