// Ticks: numbers along three edges of the box, as texts over the picture.
import * as THREE from "three";
import type { Info } from "../reader/index_file";

/** Ticks of an axis, about. */
const WANTED = 5;
/** Labels nearer to each other than this [pixels] are left out. */
const NEAREST = 34;

interface Tick {
  /** Along its axis, as a distance from the first vertex. */
  at: number;
  words: string;
}

/** Round numbers in a range, about as many as are wanted. */
export function roundNumbers(low: number, high: number): number[] {
  if (!(high > low)) return [];
  const tens = 10 ** Math.floor(Math.log10((high - low) / WANTED));
  const step = [1, 2, 5, 10].map((n) => n * tens).find((each) => (high - low) / each <= WANTED) ?? 10 * tens;
  const numbers: number[] = [];
  for (let i = Math.ceil(low / step); i * step <= high + step * 1e-9; ++i) numbers.push(i * step);
  return numbers;
}

export class Ticks {
  private columns: THREE.Vector3[] = [];
  private ticks: Tick[][] = [];
  private units: string[] = [];
  private shown: HTMLSpanElement[] = [];

  constructor(private readonly place: HTMLElement) {}

  /** @param columns the edges of the box from its first vertex */
  show(info: Info, columns: readonly THREE.Vector3[]): void {
    this.columns = [...columns];
    this.units = [0, 1, 2].map((axis) => `${"xyz"[axis]} ${info.lengthUnit}`.trim());
    this.ticks = columns.map((column, axis) => {
      // Along an axis of space, numbers are places in it; else distances.
      const direction = info.direction[axis]!;
      const first = direction[axis] === 1 ? info.origin[axis]! : 0;
      return roundNumbers(first, first + column.length()).map((value) => ({ at: value - first, words: String(+value.toPrecision(6)) }));
    });
  }

  /** Puts the labels where the camera sees their edges: of each axis, the edge that is lowest in the picture. */
  draw(camera: THREE.PerspectiveCamera, width: number, height: number): void {
    const labels: { x: number; y: number; words: string }[] = [];
    const project = (at: THREE.Vector3) => {
      const clip = at.clone().project(camera);
      return { x: ((clip.x + 1) / 2) * width, y: ((1 - clip.y) / 2) * height, seen: clip.z < 1 };
    };
    this.columns.forEach((column, axis) => {
      const others = this.columns.filter((_, i) => i !== axis);
      const edges = [0, 1, 2, 3].map((bits) => others.reduce((sum, other, i) => ((bits >> i) & 1 ? sum.add(other) : sum), new THREE.Vector3()));
      const middle = (edge: THREE.Vector3) => project(edge.clone().addScaledVector(column, 0.5)).y;
      const edge = edges.reduce((low, each) => (middle(each) > middle(low) ? each : low));
      const along = column.clone().normalize();
      const put = (at: number, words: string) => {
        const { x, y, seen } = project(edge.clone().addScaledVector(along, at));
        if (seen && labels.every((other) => Math.hypot(other.x - x, other.y - y) > NEAREST)) labels.push({ x, y, words });
      };
      for (const { at, words } of this.ticks[axis]!) put(at, words);
      put(column.length() * 1.08, this.units[axis]!);
    });
    while (this.shown.length < labels.length) this.shown.push(this.place.appendChild(document.createElement("span")));
    this.shown.forEach((span, i) => {
      const label = labels[i];
      span.hidden = !label;
      if (!label) return;
      span.textContent = label.words;
      span.style.left = `${label.x}px`;
      span.style.top = `${label.y}px`;
    });
  }
}
