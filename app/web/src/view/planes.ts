// Planes among the data, which show slices or cut surfaces, and the box that cuts them: where they are, and their outlines.
import type { Info } from "../reader/index_file";

/** A point on it, and its unit normal: six numbers, physical space. A plane that cuts takes away the side of its normal. */
export type Plane = number[];
/** Its low and its high corner as indices of vertices along the axes, which may lie between vertices. What is outside is cut away. */
export type Box = number[];
type Triple = [number, number, number];

const dot = (a: readonly number[], b: readonly number[]): number => a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;

/** How far a place along an axis is from the first vertex. @param index of a vertex, or between two */
export function distanceAt({ positions, spacing, vertices }: Info, axis: number, index: number): number {
  const at = positions[axis]!;
  if (!at.length) return index * spacing[axis]!;
  const low = Math.min(Math.max(0, Math.floor(index)), vertices[axis]! - 2);
  return at[low]! + (index - low) * (at[low + 1]! - at[low]!);
}
/** A place by its indices, less the data's origin. */
function placeAt(info: Info, index: readonly number[]): Triple {
  const place: Triple = [0, 0, 0];
  info.direction.forEach((column, axis) => {
    const far = distanceAt(info, axis, index[axis]!);
    column.forEach((n, i) => (place[i]! += far * n));
  });
  return place;
}
export const wholeBox = ({ vertices }: Info): Box => [0, 0, 0, ...vertices.map((n) => n - 1)];

/** A box within the data; null: nothing is left of it. */
export function boxWithin({ vertices }: Info, box: Box): Box | null {
  const within = box.map((n, i) => Math.min(Math.max(0, n), vertices[i % 3]! - 1));
  return [0, 1, 2].every((axis) => within[axis]! < within[axis + 3]!) ? within : null;
}

/** The lowest and highest distance of the data's box along a normal, and how far a cell reaches there. */
export function reachAlong(info: Info, normal: readonly number[]): { low: number; high: number; cell: number } {
  let low = dot(info.origin, normal);
  let high = low;
  let cell = 0;
  info.direction.forEach((column, axis) => {
    const cells = info.vertices[axis]! - 1;
    const whole = dot(column, normal) * distanceAt(info, axis, cells);
    if (whole < 0) low += whole;
    else high += whole;
    cell = Math.max(cell, Math.abs(whole) / cells);
  });
  return { low, high, cell };
}
/** Where a plane lies along its normal. */
export const along = (plane: Plane): number => dot(plane, plane.slice(3));

/** The plane elsewhere along its normal, within the data. */
export function movedTo(info: Info, plane: Plane, at: number): Plane {
  const normal = plane.slice(3);
  const { low, high } = reachAlong(info, normal);
  const by = Math.min(high, Math.max(low, at)) - along(plane);
  return [...plane.slice(0, 3).map((n, i) => n + by * normal[i]!), ...normal];
}
/** A plane through the middle of the data. @return null: that is no direction */
export function planeAcross(info: Info, normal: readonly number[]): Plane | null {
  const length = Math.hypot(...normal);
  if (normal.length !== 3 || !(length > 0) || !Number.isFinite(length)) return null;
  const middle = placeAt(info, info.vertices.map((n) => (n - 1) / 2));
  return [...middle.map((n, i) => n + info.origin[i]!), ...normal.map((n) => n / length)];
}
/** At right angles to the data's faces at both ends of an axis, towards its higher end. */
export function acrossAxis({ direction }: Info, axis: number): Triple {
  const [a, b] = [direction[(axis + 1) % 3]!, direction[(axis + 2) % 3]!];
  const normal: Triple = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const length = Math.hypot(...normal) * Math.sign(dot(normal, direction[axis]!));
  return normal.map((n) => n / length + 0) as Triple;
}
/** The axis after the one that a plane is across; the last one after none of them. */
export function nextAxis(info: Info, plane: Plane | undefined): number {
  const before = plane ? [0, 1, 2].findIndex((axis) => Math.abs(dot(acrossAxis(info, axis), plane.slice(3))) > 0.999) : 1;
  return (before + 1) % 3;
}

/** The faces of a box that cut something. */
export function facesOf(info: Info, box: Box): Plane[] {
  const corner = (high: boolean) => placeAt(info, high ? box.slice(3) : box).map((n, i) => n + info.origin[i]!);
  return [0, 1, 2].flatMap((axis) => {
    const normal = acrossAxis(info, axis);
    return [
      ...(box[axis]! > 0 ? [[...corner(false), ...normal.map((n) => -n + 0)]] : []),
      ...(box[axis + 3]! < info.vertices[axis]! - 1 ? [[...corner(true), ...normal]] : []),
    ];
  });
}

/** The twelve edges of a box, two ends each, less the data's origin. */
export function edgesOf(info: Info, box: Box): Triple[] {
  const corner = (bits: number) => placeAt(info, [0, 1, 2].map((axis) => box[axis + 3 * ((bits >> axis) & 1)]!));
  return [...Array(8).keys()].flatMap((bits) => [0, 1, 2].flatMap((axis) => ((bits >> axis) & 1 ? [] : [corner(bits), corner(bits | (1 << axis))])));
}
/** Where a plane meets the faces of the data's box: two ends for each line, less the data's origin. */
export function outlineOf(info: Info, plane: Plane): Triple[] {
  const [point, normal] = [plane.slice(0, 3).map((n, i) => n - info.origin[i]!), plane.slice(3)];
  const edges = edgesOf(info, wholeBox(info));
  const corners: Triple[] = [];
  for (let i = 0; i < edges.length; i += 2) {
    const [from, to] = [edges[i]!, edges[i + 1]!];
    const [a, b] = [dot(from, normal) - dot(point, normal), dot(to, normal) - dot(point, normal)];
    if (a !== b && a * b <= 0) corners.push(from.map((n, k) => n + (a / (a - b)) * (to[k]! - n)) as Triple);
  }
  if (corners.length < 3) return [];
  // In their order around their middle.
  const middle = corners[0]!.map((_, i) => corners.reduce((sum, each) => sum + each[i]!, 0) / corners.length);
  const across = (at: Triple) => at.map((n, i) => n - middle[i]!);
  const first = across(corners[0]!);
  const second = [normal[1]! * first[2]! - normal[2]! * first[1]!, normal[2]! * first[0]! - normal[0]! * first[2]!, normal[0]! * first[1]! - normal[1]! * first[0]!];
  const angle = (at: Triple) => Math.atan2(dot(across(at), second), dot(across(at), first));
  const around = corners.map((at) => ({ at, turn: angle(at) })).sort((a, b) => a.turn - b.turn);
  return around.flatMap(({ at }, i) => [at, around[(i + 1) % around.length]!.at]);
}
