// Reads, searches and makes triangles, beside the page. A newer wish ends the search for an older one.
import type { Asked, FromWorker, Found, SliceValues, ToWorker } from "./messages";
import { Module } from "./module";
import { IndexFile } from "./reader/index_file";
import { FileChanged, HttpSource } from "./reader/ranges";
import { newerWishes, Surfaces, type Piece } from "./search/surfaces";
import type { Moment } from "./view/ghosts";

const scope = self as unknown as DedicatedWorkerGlobalScope;
let source: HttpSource;
let file: IndexFile | undefined;
let module: Module | undefined;
let running: AbortController | null = null;
let idle: Promise<void> = Promise.resolve();
const known = new Map<string, Surfaces>();

function say(words: FromWorker, hand: Transferable[] = []): void {
  scope.postMessage(words, hand);
}

/** Pieces of a surface as one. */
function whole(pieces: Piece[]): Found {
  const sum = (of: (piece: Piece) => number) => pieces.reduce((total, piece) => total + of(piece), 0);
  const found: Found = {
    points: new Float32Array(sum((piece) => piece.points.length)),
    normals: new Float32Array(sum((piece) => piece.normals.length)),
    triangles: new Uint32Array(sum((piece) => piece.triangles.length)),
    values: pieces[0]?.values ? new Float32Array(sum((piece) => piece.points.length / 3)) : null,
    cells: sum((piece) => piece.cells.length / 3),
  };
  let point = 0;
  let corner = 0;
  for (const piece of pieces) {
    found.points.set(piece.points, 3 * point);
    found.normals.set(piece.normals, 3 * point);
    if (piece.values) found.values?.set(piece.values, point);
    for (const number of piece.triangles) found.triangles[corner++] = number + point;
    point += piece.points.length / 3;
  }
  return found;
}

async function open(from: HttpSource, again: boolean): Promise<void> {
  module ??= await Module.load(fetch(new URL("./isochron.wasm", import.meta.url)));
  const opened = await IndexFile.open(from, module);
  for (const surfaces of known.values()) surfaces.close();
  known.clear();
  source = from;
  file = opened;
  say({ kind: "opened", arrays: file.arrays.map((each) => each.info), levels: file.arrays[0]!.levels.length, again });
}

/** Goes on with a later state of the file: one with the same arrays and more steps. */
async function look(): Promise<void> {
  if (!file || !(await source.hasChanged())) return;
  await open(source.anew(), true);
}

function surfacesOf(array: number, level: number): Surfaces {
  const key = `${array} ${level}`;
  let surfaces = known.get(key);
  if (!surfaces) known.set(key, (surfaces = new Surfaces(file!, file!.arrays[array]!, level)));
  return surfaces;
}

/** The surfaces of isovalues at a moment. */
async function surfacesAt({ array, colors, isovalues }: Asked, { step, fraction }: Moment, level: number, stop: AbortSignal, colored: boolean): Promise<Found[]> {
  const surfaces = surfacesOf(array, level);
  const found: Found[] = [];
  for (const isovalue of isovalues) {
    const pieces: Piece[] = [];
    await surfaces.find(step, fraction, isovalue, (piece) => pieces.push(piece), stop, colored && colors !== null ? surfacesOf(colors, level) : undefined);
    found.push(whole(pieces));
  }
  return found;
}
const buffersOf = (found: Found[]): Transferable[] =>
  found.flatMap((each) => [each.points.buffer, each.normals.buffer, each.triangles.buffer, ...(each.values ? [each.values.buffer] : [])]);

/** Makes the surfaces of other moments, as fine as their triangles may be. @param triangles of the surfaces that they stand beside */
async function findGhosts(number: number, asked: Asked, triangles: number, stop: AbortSignal): Promise<void> {
  let level = 0;
  // Each level of detail has about a quarter of the triangles.
  while (level + 1 < file!.arrays[asked.array]!.levels.length && triangles / 4 ** level > asked.ghostTriangles) ++level;
  for (const [i, moment] of asked.ghosts.entries()) {
    await newerWishes();
    if (stop.aborted) return;
    const found = await surfacesAt(asked, moment, level, stop, false);
    say({ kind: "ghost", number, asked, ghost: { ...moment, level, found }, last: i + 1 === asked.ghosts.length }, buffersOf(found));
  }
}

async function find(wish: Extract<ToWorker, { kind: "find" }>, stop: AbortSignal): Promise<void> {
  const { number, asked, levels } = wish;
  let triangles = 0;
  for (const level of levels) {
    await newerWishes();
    if (stop.aborted) return;
    const slices: SliceValues[] = [];
    for (const plane of asked.slices) {
      const slice = await surfacesOf(asked.sliceOf, level).slice(asked.step, asked.fraction, plane, stop);
      if (slice) slices.push(slice);
    }
    const found = asked.alone && asked.slices.length ? [] : await surfacesAt(asked, asked, level, stop, true);
    triangles = found.reduce((sum, each) => sum + each.triangles.length / 3, 0);
    say(
      { kind: "found", number, asked, level, found, slices, last: level === levels.at(-1) && asked.ghosts.length === 0, requests: source.requests, bytes: source.bytes },
      [...buffersOf(found), ...slices.flatMap((each) => [each.columns.buffer, each.shares.buffer, each.outline.buffer])],
    );
  }
  await findGhosts(number, asked, triangles, stop);
}

function failed(number: number, error: unknown): void {
  if (error instanceof DOMException && error.name === "AbortError") return;
  say({ kind: "failed", number, words: error instanceof Error ? error.message : String(error), changed: error instanceof FileChanged });
}

scope.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if (data.kind === "open") {
    idle = open(new HttpSource(data.address, data.headers), false).catch((error: unknown) => failed(0, error));
    return;
  }
  if (data.kind === "look") {
    idle = idle.then(look).catch(() => {}); // the next look may see more
    return;
  }
  running?.abort(new DOMException("a newer wish", "AbortError"));
  const stop = (running = new AbortController());
  // One search at a time: the module has one memory.
  idle = idle.then(() => find(data, stop.signal)).catch((error: unknown) => failed(data.number, error));
};
