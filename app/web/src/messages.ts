// What the page and its worker say to each other.
import type { Info } from "./reader/index_file";

/** What is shown: surfaces of one array at a step, or at a moment between two. */
export interface Asked {
  array: number;
  step: number;
  /** So many 65536ths of the way to the next step. */
  fraction: number;
  isovalues: number[];
  /** The array whose values color the surface; null: its own color. */
  colors: number | null;
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

export type FromWorker =
  /** @param again it is a later state of the file that was open */
  | { kind: "opened"; arrays: Info[]; levels: number; again: boolean }
  | { kind: "found"; number: number; asked: Asked; level: number; found: Found[]; last: boolean; requests: number; bytes: number }
  | { kind: "failed"; number: number; words: string; changed: boolean };
