// Ghosts: their moments, colors and links are those of the program, and none is shown beside other surfaces than its own.
import { expect, test } from "vitest";
import { linked, linkOf } from "../src/link";
import type { Asked } from "../src/messages";
import { areShown, ghostColor, ghostMoments, Ghosts, NO_GHOSTS, type Ghost } from "../src/view/ghosts";

const settings = { earlier: 2, later: 2, every: 1, opacity: 0.5 };
const data = { times: [...Array(10).keys()], gaps: [6] };
const numbers = (of: typeof settings, step: number, fraction = 0, range: [number, number] = [0, 9]) => ghostMoments(of, { step, fraction }, range, data).map((at) => at.step + at.fraction / 65536);

test("ghosts are so many steps away, the nearest first, within the series and the range that plays", () => {
  expect(numbers(settings, 4)).toEqual([3, 5, 2, 6]);
  expect(numbers({ ...settings, every: 3 }, 4)).toEqual([1, 7]);
  expect(numbers(settings, 1)).toEqual([0, 2, 3]);
  expect(numbers(settings, 8)).toEqual([7, 9, 6]);
  expect(numbers(settings, 4, 0, [3, 5])).toEqual([3, 5]);
  expect(numbers({ ...settings, earlier: 0, later: 4 }, 2)).toEqual([3, 4, 5, 6]);
  expect(numbers({ ...settings, opacity: 0 }, 4)).toEqual([]);
  expect(numbers(NO_GHOSTS, 4)).toEqual([]);
});

test("between steps ghosts are as far between steps, but for gaps and the end", () => {
  expect(numbers(settings, 4, 32768)).toEqual([3.5, 5.5, 2.5, 6]);
  expect(numbers(settings, 7, 32768)).toEqual([6, 8.5, 5.5, 9]);
  expect(numbers(settings, 4, 32768, [3, 5])).toEqual([3.5]);
});

test("earlier ghosts are bluer, later ones warmer, the farther the more", () => {
  const now = { step: 4, fraction: 0 };
  const at = (step: number, color = "#808080") => ghostColor(color, { step, fraction: 0 }, now, settings);
  // Of 0.45 and 0.8 of the way, half and all of it: 0.625, 0.8.
  expect(at(3)).toBe(`#${[0.13, 0.36, 0.86].map((tint) => Math.round(0.375 * 128 + 0.625 * 255 * tint).toString(16).padStart(2, "0")).join("")}`);
  expect(at(6)).toBe(`#${[1, 0.76, 0.36].map((tint) => Math.round(0.2 * 128 + 0.8 * 255 * tint).toString(16).padStart(2, "0")).join("")}`);
});

test("a ghost is kept while the surfaces are the same, and shown while it is wished", () => {
  const ghosts = new Ghosts();
  const asked = (isovalue: number) => ({ array: 0, isovalues: [isovalue] }) as unknown as Asked;
  const ghost = (step: number): Ghost => ({ step, fraction: 0, level: 0, found: [] });
  const steps = (of: { step: number }[]) => of.map(({ step }) => step);
  ghosts.toggle();
  expect(ghosts.settings).toEqual({ earlier: 2, later: 2, every: 1, opacity: 0.25 });
  const wish = (around: number, isovalue: number) => steps(ghosts.wish(ghostMoments(ghosts.settings, { step: around, fraction: 0 }, [0, 9], data), asked(isovalue)));
  expect(wish(4, 1)).toEqual([3, 5, 2, 6]);
  for (const step of [5, 3]) ghosts.keep(ghost(step), asked(1));
  ghosts.keep(ghost(2), asked(7)); // it comes late: another isovalue is asked for
  expect(steps(ghosts.shown)).toEqual([3, 5]);
  expect(wish(5, 1)).toEqual([4, 6, 7]);
  expect(steps(ghosts.shown)).toEqual([3]);
  expect(wish(5, 2)).toEqual([4, 6, 3, 7]);
  expect(ghosts.shown).toEqual([]);
  ghosts.toggle();
  expect(areShown(ghosts.settings)).toBe(false);
});

test("a link keeps ghosts, and ignores what are none", () => {
  expect(linked(linkOf({ ghosts: settings })).ghosts).toEqual(settings);
  for (const word of ["5/0/1/0.5", "1/1/0/0.5", "1/1/1.5/0.5", "0/0/1/1", "1/1/1/0", "1/1/1/2", "1/1", "a/b/c/d", ""]) expect(linked(`#ghosts=${word}`)).toEqual({ isovalue: undefined });
});
