// Stories: what is damaged or hostile in them ends in one line, and the way to a view is as the program has it.
import * as THREE from "three";
import { expect, test } from "vitest";
import { linked, linkOf } from "../src/link";
import { gapsOf } from "../src/reader/index_file";
import { misfit, storyHeading, storyOf, storyStep, type Key } from "../src/story/story";
import { sightOf, Way, type Sight } from "../src/story/way";
import { wrapped } from "../src/view/hand_card";

const file = (keys: unknown, more: object = {}) => JSON.stringify({ format: "isochron keys", version: 1, keys, ...more });
const told = (key: object) => storyOf(file([{ time: 0, text: "a", ...key }]), "s")[0]!;

test("a story has the keys that the page shows, and what it does not know says nothing", () => {
  const key = told({
    name: "front", place: [1, 2, 3], step: 4, fraction: 7, between: "blend", array: "T", isosurfaces: [{ isovalue: 2.5, color: [1, 0.5, 0], opacity: 0.25 }],
    picked: 0, isovalue: 3, coloring: { by: "value", map: "viridis", array: "p", range: [0, 9], reversed: true, news: 1 }, look: { background: "white", sparkle: 3 },
    clip: { shown: true, point: [0, 1, 2], normal: [0, 0, -1] }, clip_box: { shown: true, low: [0, 1.5, 2], high: [9, 8, 7] },
    slices: {
      planes: [{ point: [1, 1, 1], normal: [0, 1, 0], shown: false }, { point: [1, 2, 3], normal: [1, 0, 0] }, { point: [4, 5, 6], normal: [0, 0.6, 0.8] }], picked: 2,
      coloring: { by: "value", map: "coolwarm", array: "p", range: [1, 2] }, isolines: false, alone: true,
    },
    head: [0, 1.6, 0, 0, 0, 0, 1], room_from_physical: { translation: [1, 2, 3], rotation: [0, 0, 0, 1], scale: 2, exaggeration: 5 },
    models: [], ghosts: { earlier: 2, later: 0, every: 3, opacity: 0.5 }, later_versions: { anything: [1, 2] }, __proto__: null,
  });
  expect(key).toEqual({
    name: "front", text: "a", place: [1, 2, 3], step: 4, fraction: 7, blends: true, array: "T", surfaces: [{ isovalue: 2.5, color: "#ff8000", opacity: 0.25 }],
    picked: 0, isovalue: 3, coloring: { by: "value", map: "viridis", array: "p", range: [0, 9] }, background: "white",
    clip: [0, 1, 2, 0, 0, -1], box: [0, 1.5, 2, 9, 8, 7],
    slices: { planes: [[1, 2, 3, 1, 0, 0], [4, 5, 6, 0, 0.6, 0.8]], picked: 1, coloring: { by: "value", map: "coolwarm", array: "p", range: [1, 2] }, isolines: false, alone: true },
    ghosts: { earlier: 2, later: 0, every: 3, opacity: 0.5 }, head: { position: [0, 1.6, 0], turn: [0, 0, 0, 1] }, data: { place: [1, 2, 3], turn: [0, 0, 0, 1], scale: 2 },
  });
  expect(storyOf(file([{ time: 0, text: "a" }], { data: "../../etc/passwd", more: 1 }), "s")).toHaveLength(1);
});

test.each<[string, string, RegExp]>([
  ["no JSON", "{", /^s: not a story: no JSON$/],
  ["another format", '{"format": "isochron session"}', /^s: not a story: expected "format": "isochron keys"$/],
  ["no object", "[1]", /^s: story: expected an object, got \[1\]$/],
  ["a later version", '{"format": "isochron keys", "version": 2, "keys": []}', /^s: version 2 of stories, this page reads 1$/],
  ["no keys", file([]), /^s: keys: expected a list of 1 to 128, got \[\]$/],
  ["too many keys", file(Array.from({ length: 129 }, (_, time) => ({ time, text: "a" }))), /^s: keys: expected a list of 1 to 128/],
  ["no texts", file([{ time: 0 }, { time: 2 }]), /^s: no story: expected a key with a "text", got 2 without any$/],
  ["a long text", file([{ time: 0, text: "ä".repeat(1001) }]), /^s: key 1: text: expected a text of at most 2000 bytes/],
  ["a text that is none", file([{ time: 0, text: { toString: 1 } }]), /^s: key 1: text: expected a text/],
  ["a time that goes back", file([{ time: 1, hold: 2, text: "a" }, { time: 2 }]), /^s: key 2: time: expected more than 3 s/],
  ["a film without end", file([{ time: 1, hold: 1e9, text: "a" }]), /^s: key 1: hold: expected a number from 0 to 3600/],
  ["half a step", file([{ time: 0, text: "a", step: 0.5 }]), /^s: key 1: step: expected a whole number/],
  ["a fraction of a later step", file([{ time: 0, text: "a", step: 0, fraction: 65536 }]), /^s: key 1: fraction: expected a whole number from 0 to 65535/],
  ["an infinite number", file([{ time: 0, text: "a", isovalue: 0 }]).replace('"isovalue":0', '"isovalue":1e999'), /^s: key 1: isovalue: expected a number/],
  ["nine surfaces", file([{ time: 0, text: "a", isosurfaces: Array(9).fill({}) }]), /^s: key 1: isosurfaces: expected a list of 1 to 8/],
  ["a surface without a color", file([{ time: 0, text: "a", isosurfaces: [{ isovalue: 1, opacity: 1 }] }]), /^s: key 1: color: expected it to be there/],
  ["a turn of length 2", file([{ time: 0, text: "a", room_from_physical: { translation: [0, 0, 0], rotation: [0, 0, 0, 2], scale: 1 } }]), /^s: key 1: rotation: expected a length of 1/],
  ["no scale", file([{ time: 0, text: "a", room_from_physical: { translation: [0, 0, 0], rotation: [0, 0, 0, 1], scale: 0 } }]), /^s: key 1: scale: expected/],
  ["files of models", file([{ time: 0, text: "a", models: [{ path: "/etc/passwd" }] }]), /^s: key 1: models: a story opens no other files: expected none, got 1$/],
  ["four slices", file([{ time: 0, text: "a", slices: { planes: Array(4).fill({ point: [0, 0, 0], normal: [1, 0, 0] }) } }]), /^s: key 1: planes: expected a list of 0 to 3/],
  ["a slice without a direction", file([{ time: 0, text: "a", slices: { planes: [{ point: [0, 0, 0], normal: [0, 0, 0] }] } }]), /^s: key 1: normal: expected a length of 1/],
  ["a box without a middle", file([{ time: 0, text: "a", clip_box: { shown: true, low: [0, 3, 0], high: [9, 3, 9] } }]), /^s: key 1: high: expected more than low along each axis, got \[9,3,9\]$/],
  ["five ghosts", file([{ time: 0, text: "a", ghosts: { earlier: 5, later: 0, every: 1, opacity: 1 } }]), /^s: key 1: earlier: expected a whole number from 0 to 4/],
  ["a deep nest", file([{ time: 0, text: "a", x: JSON.parse("[".repeat(40) + "]".repeat(40)) as unknown }]), /^s: nested deeper than 16 levels$/],
])("%s is refused in a line", (_, text, said) => {
  expect(() => storyOf(text, "s")).toThrow(said);
});

test("no damage of a story does more than end in a line", () => {
  const sound = file([{ time: 0, text: "a <b>c</b>", isosurfaces: [{ isovalue: 2.5, color: [1, 0.5, 0], opacity: 0.25 }], clip: { shown: true, point: [0, 1, 2], normal: [0, 0, 1] } }]);
  let state = 7;
  const next = (most: number) => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) % most;
  let refused = 0;
  for (let round = 0; round < 2000; ++round) {
    const at = next(sound.length);
    const damaged = sound.slice(0, at) + '0123456789[]{}",:-a'[next(19)]! + sound.slice(at + next(3));
    try {
      for (const key of storyOf(damaged, "s")) expect(key.surfaces?.every(({ color }) => /^#[0-9a-f]{6}$/.test(color)) ?? true).toBe(true);
    } catch (error) {
      ++refused;
      expect((error as Error).message).toMatch(/^s: [^\n]{5,300}$/);
    }
  }
  expect(refused).toBeGreaterThan(500);
});

test("a story is refused that needs steps or arrays that the data do not have", () => {
  const has = (name: string) => ["", "T"].includes(name);
  const of = (...keys: object[]) => misfit(keys.map((each) => key(each)), 4, has);
  expect(of({ step: 3, array: "T" }, { coloring: { by: "value", map: "x", array: "" } }, { coloring: { by: "surface", map: "x", array: "gone" } })).toBe("");
  expect(of({ step: 3 }, { step: 4 })).toBe("key 2: step: expected 0 to 3, got 4");
  expect(of({ array: "gone" })).toBe('key 1: the index has no array "gone"');
  const slices = (array: string) => ({ planes: [], picked: 0, coloring: { by: "value", map: "x", array }, isolines: true, alone: false });
  expect(of({ slices: slices("T") })).toBe("");
  expect(of({ slices: slices("gone") })).toBe('key 1: the index has no array "gone"');
  expect(of({ coloring: { by: "value", map: "x", array: "gone" } })).toBe('key 1: the index has no array "gone"');
});

test("steps are the keys with texts, numbered as the program numbers them", () => {
  const keys = ["", "a", "", "b", "c", ""].map((text, i) => ({ text, name: i === 3 ? "front" : "", fraction: 0 }));
  expect(storyStep(keys, 0)).toEqual({ number: 0, of: 3, previous: 0, next: 2 });
  expect(storyStep(keys, 2)).toEqual({ number: 1, of: 3, previous: 0, next: 4 });
  expect(storyStep(keys, 4)).toEqual({ number: 2, of: 3, previous: 2, next: 5 });
  expect(storyStep(keys, 6)).toEqual({ number: 3, of: 3, previous: 5, next: 0 });
  expect(storyHeading(keys, 4)).toBe("2 of 3: front");
  expect(storyHeading(keys, 5)).toBe("3 of 3");
});

test("a link names the file of a story beside it and its key, and no other place", () => {
  const state = { file: "a.isochron", story: "tour.isochron-story", told: 3, up: [0, 1, 0], planes: [[1, 2, 3, 0, 0, 1]], fraction: 5, range: [0, 1] };
  expect(linked(linkOf(state))).toEqual({ ...state, isovalue: undefined });
  for (const story of ["../a", "/a", "http://x/a", "a/b", ".a", "a?b", "a#b", "\\a"])
    expect(linked(`#story=${encodeURIComponent(story)}&told=-1&fraction=65536&up=0,0,0&plane=1,1,1,0,0,0&range=2,1`)).toEqual({ isovalue: undefined });
});

const data = { place: [0.1, 1.2, -2.8], turn: [0.5, 0.5, -0.5, 0.5], scale: 0.25 } as const;
const key = (more: object) => ({ name: "", text: "a", fraction: 0, ...more }) as Key;

test("a key is seen from where its viewer stood, and things at the depth of the center are as large as in the window", () => {
  const origin = [10, 20, 30];
  const center = new THREE.Vector3(3, 2, 1);
  const sight = sightOf(key({ data, head: { position: [0.3, 1.5, 0.2], turn: [0, Math.sin(0.1), 0, Math.cos(0.1)] } }), origin, center, 5, 1.6)!;
  const turn = new THREE.Quaternion(...data.turn);
  const inRoom = (at: THREE.Vector3) => at.clone().add(new THREE.Vector3(10, 20, 30)).applyQuaternion(turn).multiplyScalar(data.scale).add(new THREE.Vector3(...data.place));
  // The camera lies on the line that the viewer looked along.
  const [eye, target] = [inRoom(sight.eye), inRoom(sight.target)];
  const head = new THREE.Vector3(0.3, 1.5, 0.2);
  const ahead = new THREE.Vector3(0, 0, -1).applyQuaternion(new THREE.Quaternion(0, Math.sin(0.1), 0, Math.cos(0.1)));
  expect(target.clone().sub(head).cross(ahead).length()).toBeLessThan(1e-9);
  expect(target.clone().sub(eye).normalize().distanceTo(ahead)).toBeLessThan(1e-9);
  const depth = inRoom(center).sub(head).dot(ahead);
  expect(target.clone().sub(head).dot(ahead)).toBeCloseTo(depth, 9);
  expect(target.distanceTo(eye) * Math.tan(THREE.MathUtils.degToRad(20))).toBeCloseTo((depth * 0.5) / 1.2, 9);
  expect(sightOf(key({}), origin, center, 5, 1)).toBeNull();
  // A tall picture shows all of the middle.
  const tall = sightOf(key({ data, head: { position: [0.3, 1.5, 0.2], turn: [0, Math.sin(0.1), 0, Math.cos(0.1)] } }), origin, center, 5, 0.5)!;
  expect(tall.eye.distanceTo(tall.target)).toBeCloseTo(2 * sight.eye.distanceTo(sight.target), 9);
});

test("a view whose picture stands upright turns about the data's z, another one about its own", () => {
  const upright = { place: [0, 1.6, -3], turn: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2], scale: 1 };
  expect(sightOf(key({ data: upright }), [0, 0, 0], new THREE.Vector3(), 1, 1)!.up.toArray()).toEqual([0, 0, 1]);
  const lying = sightOf(key({ data: { ...upright, turn: [0, 0, 0, 1] } }), [0, 0, 0], new THREE.Vector3(), 1, 1)!.up;
  expect(lying.distanceTo(new THREE.Vector3(0, 1, 0))).toBeLessThan(1e-9);
});

test("the way between views begins and ends at them, and a place that both show alike stays where it is", () => {
  const sight = (eye: number[], target: number[], up = [0, 0, 1]): Sight => ({ eye: new THREE.Vector3(...(eye as [number, number, number])), target: new THREE.Vector3(...(target as [number, number, number])), up: new THREE.Vector3(...(up as [number, number, number])) });
  const [first, last] = [sight([0, -10, 0], [0, 0, 0]), sight([2, 0, 1], [0, 0, 0])];
  const way = new Way(first, last, new THREE.Vector3());
  for (const [share, end] of [[0, first], [1, last], [1 - 1e-9, last]] as const) {
    const at = way.at(share);
    expect(at.eye.distanceTo(end.eye)).toBeLessThan(1e-6);
    expect(at.target.distanceTo(end.target)).toBeLessThan(1e-6);
  }
  // Both turn around the same place: so does the way, ever nearer, in even proportions.
  const distances = [...Array(11).keys()].map((i) => {
    const { eye, target } = way.at(i / 10);
    expect(target.length()).toBeLessThan(1e-6);
    return eye.length();
  });
  expect(distances.every((each, i) => i === 0 || each < distances[i - 1]!)).toBe(true);
  expect(distances[5]).toBeCloseTo(Math.sqrt(10 * Math.hypot(2, 1)), 6);
  // What both turn around is nowhere near the data's center.
  const far = new Way(sight([5, -10, 0], [5, 0, 0]), sight([15, 0, 0], [5, 0, 0]), new THREE.Vector3(0, 40, 0));
  for (let i = 0; i <= 10; ++i) expect(far.at(i / 10).target.distanceTo(new THREE.Vector3(5, 0, 0))).toBeLessThan(0.1);
  // Aside, at one size: no overshoot.
  const aside = new Way(sight([0, -10, 0], [0, 0, 0]), sight([4, -10, 0], [4, 0, 0]), new THREE.Vector3());
  for (let i = 0; i <= 10; ++i) {
    const { eye } = aside.at(i / 10);
    expect(eye.x).toBeGreaterThanOrEqual(-1e-9);
    expect(eye.x).toBeLessThanOrEqual(4 + 1e-9);
    expect(Math.abs(eye.y + 10)).toBeLessThan(1e-6);
  }
});

test("gaps are those of the program", () => {
  expect(gapsOf([0, 1, 2, 6, 7, 8], [])).toEqual([2]);
  expect(gapsOf([0, 1, 2, 3], [1])).toEqual([1]);
  expect(gapsOf([0], [])).toEqual([]);
});

test("lines of a card are as wide as it, and keep their words", () => {
  const text = "a few words that\nstand in lines and averyveryverylongword here";
  const lines = wrapped(text, 12, (line) => line.length);
  expect(lines.join(" ").split(" ")).toEqual(text.split(/[ \n]/));
  for (const line of lines) expect(line.length <= 12 || !line.includes(" ")).toBe(true);
});
