// Ghosts: surfaces of earlier and later moments, translucent, beside those that are shown (app/choice/ghost_supply.cpp).
import type { Asked, Found } from "../messages";
import type { Info } from "../reader/index_file";

export interface GhostSettings {
  /** How many, 0 to 4. */
  earlier: number;
  later: number;
  /** Steps from one to the next. */
  every: number;
  opacity: number;
}
export interface Moment {
  step: number;
  /** So many 65536ths of the way to the next step. */
  fraction: number;
}
/** The surfaces of another moment. */
export interface Ghost extends Moment {
  /** Of detail; 0: all of it. */
  level: number;
  found: Found[];
}

export const MOST_GHOSTS = 4;
export const WIDEST_GHOSTS = 100000;
const USUAL = 2;
const OPACITY = 0.25;
/** Triangles of all ghosts together. */
const MOST_TRIANGLES = 1 << 18;
const MOST_KEPT = 32;
const [EARLIER, LATER] = [[0.13, 0.36, 0.86], [1, 0.76, 0.36]] as const;
const [LEAST_TINT, MOST_TINT] = [0.45, 0.8];
export const NO_GHOSTS: GhostSettings = { earlier: 0, later: 0, every: 1, opacity: OPACITY };

const far = ({ step, fraction }: Moment): number => step + fraction / 65536;
const same = (a: Moment, b: Moment): boolean => far(a) === far(b);
export const areShown = ({ earlier, later, opacity }: GhostSettings): boolean => earlier + later > 0 && opacity > 0;

/** Their moments, the nearest first: within the range that plays, between steps where the shown one is; where there is a gap, the step is held. */
export function ghostMoments(ghosts: GhostSettings, shown: Moment, [first, last]: readonly [number, number], { times, gaps }: Pick<Info, "times" | "gaps">): Moment[] {
  const moments: Moment[] = [];
  const add = (step: number) => {
    if (step < 0 || step >= times.length) return;
    const at = { step, fraction: step + 1 === times.length || gaps.includes(step) ? 0 : shown.fraction };
    if (far(at) >= first && far(at) <= last && !same(at, shown)) moments.push(at);
  };
  for (let k = 1; areShown(ghosts) && k <= MOST_GHOSTS; ++k) {
    if (k <= ghosts.earlier) add(shown.step - k * ghosts.every);
    if (k <= ghosts.later) add(shown.step + k * ghosts.every);
  }
  return moments;
}

/** The color of a ghost: earlier ones are bluer, later ones warmer, by the share of the way to the farthest one. @param color `#rrggbb` */
export function ghostColor(color: string, at: Moment, now: Moment, { earlier, later, every }: GhostSettings): string {
  const [count, tint] = far(at) < far(now) ? [earlier, EARLIER] : [later, LATER];
  const share = Math.min(1, Math.abs(far(at) - far(now)) / (Math.max(1, count) * every));
  const part = LEAST_TINT + share * (MOST_TINT - LEAST_TINT);
  const mixed = tint.map((level, i) => Math.round((1 - part) * parseInt(color.slice(1 + 2 * i, 3 + 2 * i), 16) + part * level * 255));
  return `#${mixed.map((level) => level.toString(16).padStart(2, "0")).join("")}`;
}

/** Which ghosts are wished, and which are at hand. */
export class Ghosts {
  settings = NO_GHOSTS;
  /** The nearest first. */
  wished: Moment[] = [];
  private kept: Ghost[] = [];
  private of = "";

  /** Two of each, or none. */
  toggle(): void {
    const { settings } = this;
    const count = areShown(settings) ? 0 : USUAL;
    this.settings = { ...settings, earlier: count, later: count, opacity: settings.opacity > 0 ? settings.opacity : OPACITY };
  }
  /** Triangles that one of them may have. */
  get most(): number {
    return MOST_TRIANGLES / Math.max(1, this.settings.earlier + this.settings.later);
  }
  /** Sets what is wished beside what is asked for. @return those that are not at hand */
  wish(moments: Moment[], { array, isovalues }: Asked): Moment[] {
    const of = JSON.stringify([array, isovalues]);
    if (of !== this.of) this.kept = [];
    this.of = of;
    this.wished = moments;
    return moments.filter((at) => !this.kept.some((ghost) => same(ghost, at)));
  }
  /** @param asked what the ghost was made beside */
  keep(ghost: Ghost, { array, isovalues }: Asked): void {
    if (JSON.stringify([array, isovalues]) !== this.of) return;
    this.kept = [ghost, ...this.kept.filter((other) => !same(other, ghost))].slice(0, MOST_KEPT);
  }
  /** Those wished ones that are at hand, by time. */
  get shown(): Ghost[] {
    return this.kept.filter((ghost) => this.wished.some((at) => same(at, ghost))).sort((a, b) => far(a) - far(b));
  }
  /** The file has changed. */
  forget(): void {
    this.kept = [];
  }
}
