// What the page and its worker say to each other.
import type { Info } from "./reader/index_file";
import type { Ghost, Moment } from "./view/ghosts";

/** What is shown: surfaces of one array at a step, or at a moment between two. */
export interface Asked {
  array: number;
  step: number;
  /** So many 65536ths of the way to the next step. */
  fraction: number;
  isovalues: number[];
  /** The array whose values color the surface; null: its own color. */
  colors: number | null;
  /** Planes, each a point on it, less the data's origin, and its unit normal. */
  slices: number[][];
  /** The array whose values the slices show. */
  sliceOf: number;
  /** Surfaces are hidden, and not searched, while there are slices. */
  alone: boolean;
  /** Moments whose surfaces are wanted afterwards, and how many triangles each may have. */
  ghosts: Moment[];
  ghostTriangles: number;
}

export type ToWorker =
  | { kind: "open"; address: string; headers: Record<string, string> }
  /** Opens the file again if it is another one by now. */
  | { kind: "look" }
  /** @param coarsest levels to show, the coarsest first, the finest at last: 0 is the volume itself */
  | { kind: "find"; number: number; asked: Asked; levels: number[] };

/** A surface, in arrays that are handed over. */
export interface Found {
  points: Float32Array;
  normals: Float32Array;
  triangles: Uint32Array;
  values: Float32Array | null;
  cells: number;
}

/** The values at the vertices of all cells that a plane cuts, in arrays that are handed over (index/extraction/slice_runs.h). */
export interface SliceValues {
  /** Along which columns lie. */
  axis: number;
  /** Where the run of each column begins in `shares`, and at which vertex; filled up to whole rows of SLICE_ROW. */
  columns: Uint32Array;
  /** Lowest and highest value of the array when it was read. */
  whole: readonly [number, number];
  /** As shares of `whole`; 3e38: missing. Filled up as `columns`. */
  shares: Float32Array;
  /** Corners in their order, in distances along the axes of the grid. */
  outline: Float32Array;
  /** Of the level of detail. */
  vertices: readonly number[];
  spacing: readonly number[];
  positions: readonly (readonly number[])[];
}
/** Texels in a row of the pictures in which columns and shares go to the GPU. */
export const SLICE_ROW = 2048;

export type FromWorker =
  /** @param again it is a later state of the file that was open */
  | { kind: "opened"; arrays: Info[]; levels: number; again: boolean }
  | { kind: "found"; number: number; asked: Asked; level: number; found: Found[]; slices: SliceValues[]; last: boolean; requests: number; bytes: number }
  | { kind: "ghost"; number: number; asked: Asked; ghost: Ghost; last: boolean }
  | { kind: "failed"; number: number; words: string; changed: boolean };
