// The state in the link: settings alone, no paths but the name of the file beside the page.

import { MAP_NAMES } from "./view/colors";
import { areShown, MOST_GHOSTS, WIDEST_GHOSTS, type GhostSettings } from "./view/ghosts";

/** A surface of the array, and how it looks. */
export interface Surface {
  isovalue: number;
  /** `#rrggbb`, and 0 to 1. */
  color: string;
  opacity: number;
}
/** As many as the native program shows. */
export const MOST_SURFACES = 8;
export const MOST_SLICES = 3;
export const MOST_CUTS = 6;

export interface Linked {
  file?: string;
  array?: number;
  step?: number;
  isovalue?: number;
  view?: number[];
  color?: string;
  opacity?: number;
  surfaces?: Surface[];
  picked?: number;
  background?: string;
  colors?: number;
  map?: string;
  /** The ends of the color map. */
  range?: number[];
  /** Of links of earlier versions: a clip plane across an axis. */
  clip?: [axis: number, share: number];
  /** Clip planes: of each a point, and its normal towards what is cut away, physical space. */
  planes?: number[][];
  /** Outside this box all is cut away: its low and its high corner as indices of vertices. */
  box?: number[];
  /** Slices: of each a point, and its normal, physical space. */
  slices?: number[][];
  /** The array whose values they show; absent: the surfaces'. */
  sliceof?: number;
  slicemap?: string;
  slicerange?: number[];
  /** 0: no lines of the isovalues on them. */
  isolines?: number;
  /** 1: without the surfaces. */
  alone?: number;
  ghosts?: GhostSettings;
  /** What is up in the picture; absent: the data's z. */
  up?: number[];
  /** So many 65536ths of the way to the next step. */
  fraction?: number;
  /** The file of the story beside the page, and its key that is told, from 1; 0: none. */
  story?: string;
  told?: number;
}

const numberOf = (text: string | null): number | undefined => {
  const value = text === null || text === "" ? NaN : Number(text);
  return Number.isFinite(value) ? value : undefined;
};

/** A list of planes: of each a point and its normal. */
function planesOf(text: string | null, most: number): number[][] | undefined {
  const planes = (text ?? "")
    .split(",")
    .map((word) => word.split("/").map((number) => numberOf(number) ?? NaN))
    .filter((plane) => plane.length === 6 && plane.every(Number.isFinite) && Math.hypot(...plane.slice(3)) > 0);
  return planes.length ? planes.slice(0, most) : undefined;
}

/** A name beside the page: no folder, no other server. */
export const isPlain = (name: string): boolean => /^[^/\\:?#]+$/.test(name) && !name.startsWith(".");

/** What a link says; anything else in it is ignored. */
export function linked(hash: string): Linked {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const state: Linked = {};
  const file = words.get("file");
  if (file && isPlain(file)) state.file = file;
  const story = words.get("story");
  if (story && isPlain(story)) state.story = story;
  for (const name of ["array", "step", "colors", "picked", "told", "fraction", "sliceof", "isolines", "alone"] as const) {
    const value = numberOf(words.get(name));
    if (value !== undefined && Number.isInteger(value) && value >= 0) state[name] = value;
  }
  if (state.fraction !== undefined && state.fraction > 65535) delete state.fraction;
  state.isovalue = numberOf(words.get("isovalue"));
  const opacity = numberOf(words.get("opacity"));
  if (opacity !== undefined && opacity > 0 && opacity <= 1) state.opacity = opacity;
  // Each as isovalue/rrggbb/opacity.
  const surfaces = (words.get("surfaces") ?? "").split(",").map((word): Surface => {
    const [isovalue, color, share] = word.split("/");
    const opacity = numberOf(share ?? null) ?? 1;
    return { isovalue: numberOf(isovalue ?? null) ?? NaN, color: /^[0-9a-f]{6}$/i.test(color ?? "") ? `#${color}` : "#e8d3a0", opacity: Math.min(1, Math.max(0, opacity)) };
  });
  if (surfaces.length <= MOST_SURFACES && surfaces.every(({ isovalue }) => Number.isFinite(isovalue))) state.surfaces = surfaces;
  for (const name of ["map", "slicemap"] as const) {
    const map = words.get(name);
    if (map && (MAP_NAMES as string[]).includes(map)) state[name] = map;
  }
  // Earlier versions wrote one plane, as `plane`.
  const planes = planesOf(words.get("planes"), MOST_CUTS) ?? planesOf(words.get("plane")?.replaceAll(",", "/") ?? null, 1);
  if (planes) state.planes = planes;
  // earlier/later/every/opacity
  const [earlier, later, every, share] = (words.get("ghosts") ?? "").split("/").map((word) => numberOf(word) ?? NaN) as [number, number?, number?, number?];
  const isCount = (n: number | undefined, low: number, high: number): n is number => Number.isInteger(n) && n! >= low && n! <= high;
  if (isCount(earlier, 0, MOST_GHOSTS) && isCount(later, 0, MOST_GHOSTS) && isCount(every, 1, WIDEST_GHOSTS) && share! <= 1 && areShown({ earlier, later, every, opacity: share! }))
    state.ghosts = { earlier, later, every, opacity: share! };
  const slices = planesOf(words.get("slices"), MOST_SLICES);
  if (slices) state.slices = slices;
  const clip = (words.get("clip") ?? "").split(",").map(Number);
  if (clip.length === 2 && [0, 1, 2].includes(clip[0]!) && clip[1]! >= 0 && clip[1]! <= 1) state.clip = clip as [number, number];
  for (const [name, count] of [["view", 6], ["up", 3], ["box", 6], ["range", 2], ["slicerange", 2]] as const) {
    const numbers = (words.get(name) ?? "").split(",").map(Number);
    if (numbers.length === count && numbers.every(Number.isFinite)) state[name] = numbers;
  }
  if (state.up && !(Math.hypot(...state.up) > 0)) delete state.up;
  if (state.box?.slice(0, 3).some((low, axis) => !(low < state.box![axis + 3]!))) delete state.box;
  for (const name of ["range", "slicerange"] as const) if (!(state[name]?.[0]! < state[name]?.[1]!)) delete state[name];
  for (const name of ["color", "background"] as const) {
    const value = words.get(name);
    if (value && /^#[0-9a-f]{6}$/i.test(value)) state[name] = value;
  }
  return state;
}

export function linkOf(state: Linked): string {
  const words = new URLSearchParams();
  const { surfaces, ghosts, ...others } = state;
  if (ghosts) words.set("ghosts", [ghosts.earlier, ghosts.later, ghosts.every, +ghosts.opacity.toPrecision(3)].join("/"));
  if (surfaces) words.set("surfaces", surfaces.map(({ isovalue, color, opacity }) => `${isovalue}/${color.slice(1)}/${opacity}`).join(","));
  for (const name of ["slices", "planes"] as const) {
    const planes = others[name];
    delete others[name];
    if (planes) words.set(name, planes.map((plane) => plane.map((n) => +n.toPrecision(9)).join("/")).join(","));
  }
  for (const [name, value] of Object.entries(others) as [string, unknown][])
    if (value !== undefined) words.set(name, Array.isArray(value) ? value.map((n: number) => +n.toPrecision(6)).join(",") : String(value));
  return `#${words.toString()}`;
}
