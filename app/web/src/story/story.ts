// Stories: files of key frames with texts. They hold views and texts, and are checked before any of it is shown.

import { MOST_GHOSTS, WIDEST_GHOSTS, type GhostSettings } from "../view/ghosts";

/** Where something is in the room of a key: +Y up, meters. */
export interface Pose {
  position: [number, number, number];
  /** x, y, z, w; of length 1. */
  turn: [number, number, number, number];
}
/** Where the data stand in that room: `scale * (turn * point) + place`, of points in physical space. */
export interface Similarity {
  place: [number, number, number];
  turn: [number, number, number, number];
  scale: number;
}

/** How values are colored; an empty array is the first one, or of slices that of the surfaces. */
export interface Coloring {
  by: string;
  map: string;
  array: string;
  range?: [number, number];
}
/** Slices that are seen: of each plane a point and its unit normal, physical space. */
export interface KeySlices {
  planes: number[][];
  /** The plane that is moved, among these. */
  picked: number;
  coloring?: Coloring;
  isolines: boolean;
  alone: boolean;
}

/** A key frame, as far as the page shows it. What it does not say stays as it is. */
export interface Key {
  head?: Pose;
  data?: Similarity;
  step?: number;
  /** So many 65536ths of the way to the next step. */
  fraction: number;
  blends?: boolean;
  array?: string;
  surfaces?: { isovalue: number; color: string; opacity: number }[];
  picked?: number;
  isovalue?: number;
  coloring?: Coloring;
  background?: string;
  /** A point on the plane and its normal towards what is cut away; empty: nothing is cut. */
  clip?: number[];
  /** Low and high corner of the box as indices of vertices; empty: there is none. */
  box?: number[];
  slices?: KeySlices;
  ghosts?: GhostSettings;
  name: string;
  text: string;
  /** What the text is about, physical space. */
  place?: [number, number, number];
}

/** Most bytes of a story's file. */
const LARGEST_STORY = 1 << 22;
const MOST_KEYS = 128;
const LONGEST_TEXT = 2000; // bytes, as below
const LONGEST_NAME = 256;
const DEEPEST = 16;
const LONGEST_FILM = 3600; // seconds
const SHORTEST_MOVE = 1 / 1024; // seconds
const MOST_SURFACES = 8;
const MOST_SLICES = 3;
const MOST_FRACTION = 65535;

/** A value of a file, with its name for messages. */
class Read {
  constructor(
    readonly value: unknown,
    readonly name: string,
  ) {}

  fail(expected: string): never {
    const got = JSON.stringify(this.value) ?? "nothing";
    throw new Error(`${this.name}: expected ${expected}, got ${got.length > 60 ? `${got.slice(0, 60)} ...` : got}`);
  }
  at(key: string): Read {
    const found = this.find(key);
    return found ?? new Read(undefined, key).fail("it to be there");
  }
  find(key: string): Read | undefined {
    const { value } = this;
    if (typeof value !== "object" || value === null || Array.isArray(value)) this.fail("an object");
    // Own members alone: what a text may be called is no member of all objects.
    return Object.hasOwn(value as object, key) ? new Read((value as Record<string, unknown>)[key], key) : undefined;
  }
  number(low = -Infinity, high = Infinity): number {
    const { value } = this;
    if (typeof value !== "number" || !Number.isFinite(value)) this.fail("a number");
    if ((value as number) < low || (value as number) > high) this.fail(`a number from ${low} to ${high}`);
    return value as number;
  }
  natural(most = 2 ** 32 - 1): number {
    const number = this.number();
    if (!Number.isInteger(number) || number < 0 || number > most) this.fail(`a whole number from 0 to ${most}`);
    return number;
  }
  text(most: number): string {
    if (typeof this.value !== "string" || new TextEncoder().encode(this.value).length > most) this.fail(`a text of at most ${most} bytes`);
    return this.value as string;
  }
  flag(): boolean {
    if (typeof this.value !== "boolean") this.fail("true or false");
    return this.value as boolean;
  }
  list(least: number, most: number): Read[] {
    const { value, name } = this;
    if (!Array.isArray(value) || value.length < least || value.length > most) this.fail(least === most ? `a list of ${most}` : `a list of ${least} to ${most}`);
    return (value as unknown[]).map((each) => new Read(each, name));
  }
  numbers<T extends number[]>(count: T["length"]): T {
    return this.list(count, count).map((each) => each.number()) as T;
  }
  /** Numbers whose squares add up to 1. */
  unit<T extends number[]>(count: T["length"]): T {
    const numbers = this.numbers<T>(count);
    const length = Math.hypot(...numbers);
    if (Math.abs(length - 1) > 1e-3) this.fail("a length of 1");
    return numbers.map((each) => each / length) as T;
  }
}

/** A point and a unit normal. */
const planeOf = (of: Read): number[] => [...of.at("point").numbers<number[]>(3), ...of.at("normal").unit<number[]>(3)];

const coloringOf = (of_coloring: Read): Coloring => ({
  by: of_coloring.at("by").text(LONGEST_NAME),
  map: of_coloring.at("map").text(LONGEST_NAME),
  array: of_coloring.find("array")?.text(LARGEST_STORY) ?? "",
  range: of(of_coloring.find("range"), (range) => {
    const ends = range.numbers<[number, number]>(2);
    return ends[0] < ends[1] ? ends : range.fail("two ascending numbers");
  }),
});

function slicesOf(slices: Read): KeySlices {
  const planes = slices.at("planes").list(0, MOST_SLICES).map((each) => ({ plane: planeOf(each), shown: each.find("shown")?.flag() ?? true }));
  const picked = slices.find("picked")?.natural(MOST_SLICES - 1) ?? 0;
  return {
    planes: planes.flatMap(({ plane, shown }) => (shown ? [plane] : [])),
    picked: planes.slice(0, picked).filter(({ shown }) => shown).length,
    coloring: of(slices.find("coloring"), coloringOf),
    isolines: slices.find("isolines")?.flag() ?? true,
    alone: slices.find("alone")?.flag() ?? false,
  };
}

/** A box whose low corner is lower along each axis; empty: it is not shown. */
function boxOf(box: Read): number[] {
  const [low, high] = [box.at("low").numbers<number[]>(3), box.at("high").numbers<number[]>(3)];
  if (!box.at("shown").flag()) return [];
  return low.every((n, axis) => n < high[axis]!) ? [...low, ...high] : box.at("high").fail("more than low along each axis");
}

const of = <T>(found: Read | undefined, read: (found: Read) => T): T | undefined => (found ? read(found) : undefined);

const colorOf = (of: Read): string =>
  `#${of.list(3, 3).map((each) => Math.round(each.number(0, 1) * 255).toString(16).padStart(2, "0")).join("")}`;

function keyOf(of_key: Read): Key {
  const find = (key: string) => of_key.find(key);
  const models = find("models")?.list(0, 16);
  if (models?.length) throw new Error(`models: a story opens no other files: expected none, got ${models.length}`);
  return {
    head: of(find("head"), (pose) => {
      const numbers = pose.numbers<number[]>(7);
      return { position: numbers.slice(0, 3) as Pose["position"], turn: new Read(numbers.slice(3), "head").unit<Pose["turn"]>(4) };
    }),
    data: of(find("room_from_physical"), (data) => ({
      place: data.at("translation").numbers<Similarity["place"]>(3),
      turn: data.at("rotation").unit<Similarity["turn"]>(4),
      scale: data.at("scale").number(1e-300),
    })),
    step: find("step")?.natural(),
    fraction: find("fraction")?.natural(MOST_FRACTION) ?? 0,
    blends: of(find("between"), (between) => between.text(LONGEST_NAME) === "blend"),
    array: find("array")?.text(LARGEST_STORY),
    surfaces: of(find("isosurfaces"), (surfaces) =>
      surfaces.list(1, MOST_SURFACES).map((each) => ({ isovalue: each.at("isovalue").number(), color: colorOf(each.at("color")), opacity: each.at("opacity").number(0, 1) })),
    ),
    picked: find("picked")?.natural(MOST_SURFACES - 1),
    isovalue: find("isovalue")?.number(),
    coloring: of(find("coloring"), coloringOf),
    background: find("look")?.at("background").text(LONGEST_NAME),
    clip: of(find("clip"), (clip) => {
      const plane = planeOf(clip);
      return clip.at("shown").flag() ? plane : [];
    }),
    box: of(find("clip_box"), boxOf),
    slices: of(find("slices"), slicesOf),
    ghosts: of(find("ghosts"), (ghosts) => ({
      earlier: ghosts.at("earlier").natural(MOST_GHOSTS),
      later: ghosts.at("later").natural(MOST_GHOSTS),
      every: Math.max(1, ghosts.at("every").natural(WIDEST_GHOSTS)),
      opacity: ghosts.at("opacity").number(0, 1),
    })),
    name: find("name")?.text(LONGEST_NAME) ?? "",
    text: find("text")?.text(LONGEST_TEXT) ?? "",
    place: find("place")?.numbers<[number, number, number]>(3),
  };
}

const depthOf = (value: unknown): number =>
  typeof value === "object" && value !== null ? 1 + Object.values(value).reduce<number>((most, each) => Math.max(most, depthOf(each)), 0) : 0;

/** The keys of a story's file. Fields that the page does not know say nothing. @param name for messages. Throws an Error in one line. */
export function storyOf(text: string, name: string): Key[] {
  let where = "";
  try {
    let json: unknown;
    try {
      json = JSON.parse(text);
    } catch {
      throw new Error("not a story: no JSON");
    }
    if (depthOf(json) > DEEPEST) throw new Error(`nested deeper than ${DEEPEST} levels`);
    const file = new Read(json, "story");
    if (file.find("format")?.value !== "isochron keys") throw new Error('not a story: expected "format": "isochron keys"');
    if (file.at("version").value !== 1) throw new Error(`version ${JSON.stringify(file.at("version").value)} of stories, this page reads 1`);
    let rests = -SHORTEST_MOVE;
    const keys = file.at("keys").list(1, MOST_KEYS).map((each, i) => {
      where = `key ${i + 1}: `;
      const time = each.at("time").number(0, LONGEST_FILM);
      if (time < rests + SHORTEST_MOVE) throw new Error(`time: expected more than ${rests} s, the end of the rest at the key before, got ${time}`);
      rests = time + (each.find("hold")?.number(0, LONGEST_FILM) ?? 0);
      return keyOf(each);
    });
    where = "";
    if (!keys.some((key) => key.text)) throw new Error(`no story: expected a key with a "text", got ${keys.length} without any`);
    return keys;
  } catch (error) {
    throw new Error(`${name}: ${where}${error instanceof Error ? error.message : String(error)}`);
  }
}

/** What of a story the data do not have, in one line; empty: nothing. */
export function misfit(keys: readonly Key[], steps: number, hasArray: (name: string) => boolean): string {
  for (const [i, { step, array, coloring, slices }] of keys.entries()) {
    if (step !== undefined && step >= steps) return `key ${i + 1}: step: expected 0 to ${steps - 1}, got ${step}`;
    for (const name of [array, coloring?.by === "value" ? coloring.array : undefined, slices?.coloring?.array])
      if (name !== undefined && !hasArray(name)) return `key ${i + 1}: the index has no array ${JSON.stringify(name)}`;
  }
  return "";
}

/** The story in a file beside the page. Throws an Error in one line: it is not there, or as `storyOf`. */
export async function storyAt(name: string, headers: Record<string, string>): Promise<Key[]> {
  const answer = await fetch(encodeURIComponent(name), { cache: "no-store", headers });
  if (!answer.ok) throw new Error(`${name}: the server answers ${answer.status} ${answer.statusText}`);
  const reader = answer.body!.getReader();
  const decoder = new TextDecoder();
  let text = "";
  let bytes = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return storyOf(text + decoder.decode(), name);
    bytes += value.length;
    if (bytes > LARGEST_STORY) {
      await reader.cancel();
      throw new Error(`${name}: expected at most ${LARGEST_STORY >> 20} MiB`);
    }
    text += decoder.decode(value, { stream: true });
  }
}

/** A step of a story: a key with a text. */
export interface StoryStep {
  /** From 1, among the steps. */
  number: number;
  of: number;
  /** Keys that the steps before and after it are, from 1; 0: there is none. */
  previous: number;
  next: number;
}
/** @param told number of any key, from 1; 0 is before the first step */
export function storyStep(keys: readonly Key[], told: number): StoryStep {
  const steps = keys.flatMap((key, i) => (key.text ? [i + 1] : []));
  return {
    number: steps.filter((each) => each <= told).length,
    of: steps.length,
    previous: steps.findLast((each) => each < told) ?? 0,
    next: steps.find((each) => each > told) ?? 0,
  };
}

/** `2 of 4: front arrives`; without a name `2 of 4`. */
export function storyHeading(keys: readonly Key[], told: number): string {
  const { number, of } = storyStep(keys, told);
  const name = keys[told - 1]?.name ?? "";
  return `${number} of ${of}${name ? `: ${name}` : ""}`;
}
