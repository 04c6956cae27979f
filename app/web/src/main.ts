// The page: opens the index beside it, and shows the surface that the controls and the link ask for.
import "./style.css";
import { Vector3 } from "three";
import { isPlain, linked, linkOf, MOST_CUTS, MOST_SLICES, MOST_SURFACES, type Linked, type Surface } from "./link";
import type { Asked, Found, FromWorker, SliceValues, ToWorker } from "./messages";
import type { Info } from "./reader/index_file";
import { misfit, storyAt, type Key } from "./story/story";
import { Teller } from "./story/teller";
import { sightOf } from "./story/way";
import { BoxFields } from "./view/box_fields";
import { colorsOf, drawLegend, MAP_NAMES, type MapName } from "./view/colors";
import { momentText } from "./view/dates";
import { GhostPanel } from "./view/ghost_panel";
import { areShown, ghostColor, ghostMoments, Ghosts, NO_GHOSTS } from "./view/ghosts";
import { Histogram } from "./view/histogram";
import { PlaneList } from "./view/plane_list";
import { acrossAxis, distanceAt, nextAxis, type Plane } from "./view/planes";
import { Scene } from "./view/scene";

const LOOK = 2000; // milliseconds between two looks at a file that grows
const FRACTIONS = 65536; // moments from a step to the next
/** Backgrounds of stories by their names. */
const BACKGROUNDS: Record<string, string> = { dark: "#0f1116", light: "#f0f1f2", white: "#ffffff", gray: "#454749", gradient: "#1c212a" };
/** Colors of surfaces that are added. */
const COLORS = ["#e8d3a0", "#6aa9e9", "#e07a5f", "#81b29a", "#b18ae0", "#f2cc5c", "#5fc9c9", "#d98cb3"];

function part<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no part ${id}`);
  return found as T;
}

const chip = part("chip");
const arrays = part<HTMLSelectElement>("array");
const surface = part<HTMLSelectElement>("surface");
const add = part<HTMLButtonElement>("add");
const remove = part<HTMLButtonElement>("remove");
const [from, to] = [part<HTMLInputElement>("from"), part<HTMLInputElement>("to")];
const speed = part<HTMLSelectElement>("speed");
const isovalue = part<HTMLInputElement>("isovalue");
const unit = part("unit");
const time = part<HTMLInputElement>("time");
const moment = part("moment");
const play = part<HTMLButtonElement>("play");
const color = part<HTMLInputElement>("color");
const opacity = part<HTMLInputElement>("opacity");
const background = part<HTMLInputElement>("background");

const between = part<HTMLInputElement>("between");
const colorBy = part<HTMLSelectElement>("color-by");
const map = part<HTMLSelectElement>("map");
const sliceOf = part<HTMLSelectElement>("slice-of");
const sliceMap = part<HTMLSelectElement>("slice-map");
const isolines = part<HTMLInputElement>("isolines");
const alone = part<HTMLInputElement>("alone");
sliceMap.replaceChildren(...MAP_NAMES.map((name) => new Option(name, name)));
map.replaceChildren(...MAP_NAMES.map((name) => new Option(name, name)));

const scene = new Scene(part<HTMLCanvasElement>("picture"), part("ticks"));
const teller = new Teller(part("card"), part<HTMLButtonElement>("tell"), {
  show: showKey,
  go: goToKey,
  changed: () => {
    document.body.classList.toggle("told", teller.told > 0);
    scene.draw();
    keepSoon();
  },
});
// What stands above the bar follows its height.
new ResizeObserver(() => document.documentElement.style.setProperty("--bar", `${part("bar").offsetHeight}px`)).observe(part("bar"));
const histogram = new Histogram(part<HTMLCanvasElement>("histogram"));
const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
const say = (words: ToWorker) => worker.postMessage(words);

let state: Linked = linked(location.hash);
let infos: Info[] = [];
let levels = 1;
let asked: Asked = { array: 0, step: 0, fraction: 0, isovalues: [0], colors: null, slices: [], sliceOf: 0, alone: false, ghosts: [], ghostTriangles: 0 };
let range: number[] | null = null; // the ends of the color map; null: all values
let story: Key[] | null = null;
let badStory = ""; // why there is none
let sliceRange: number[] | null = null; // the ends of their color map; null: all values
let surfaces: Surface[] = [{ isovalue: 0, color: COLORS[0]!, opacity: 1 }];
let picked = 0;
let grows = false; // the server says that the file may
let last: { asked: Asked; found: Found[]; slices: SliceValues[] } | null = null;
let number = 0;
let shown = 0;
let playing = false;
let played = { at: 0, now: 0 }; // between steps: where playing is, and since when
let turn = 0; // the timer of the next step
let later = 0; // the timer of the address

const info = (): Info => infos[asked.array]!;
const words = (value: number): string => String(+value.toPrecision(6));
const ghosts = new Ghosts();
const ghostPanel = new GhostPanel(ghosts, part<HTMLInputElement>("ghosts"), part("ghost-parts"), () => ask(false));
const box = new BoxFields(part<HTMLInputElement>("boxed"), part("box-parts"), info, clip);
const slices = new PlaneList("slice", MOST_SLICES, info, ask);
const clips = new PlaneList("clip", MOST_CUTS, info, clip);

/** The first isovalue: above which about a fiftieth of the values lie. */
function firstIsovalue(of: Info): number {
  const { counts, first, exponent } = of.bins;
  const all = counts.reduce((a, b) => a + b, 0);
  let above = 0;
  for (let i = counts.length - 1; i > 0; --i) {
    above += counts[i]!;
    if (above > all / 50) return of.slope * (first + i) * 2 ** exponent + of.intercept;
  }
  return (of.low + of.high) / 2;
}

/** Asks for the surfaces: coarse levels first, and while something is dragged only these. */
function ask(coarse: boolean): void {
  const { origin } = info();
  asked = {
    ...asked,
    isovalues: surfaces.map((each) => each.isovalue),
    slices: slices.planes.map((each) => each.map((n, i) => n - (origin[i] ?? 0))),
    sliceOf: sliceOf.value === "" ? asked.array : Number(sliceOf.value),
    alone: alone.checked,
  };
  // While time plays between steps, ghosts of whole ones serve longer than it takes to make them.
  const now = { step: asked.step, fraction: playing ? 0 : asked.fraction };
  const hidden = asked.alone && asked.slices.length > 0;
  const missing = ghosts.wish(hidden ? [] : ghostMoments(ghosts.settings, now, playRange(), info()), asked);
  asked = { ...asked, ghosts: coarse ? [] : missing, ghostTriangles: ghosts.most };
  const finest = coarse ? Math.min(levels - 1, info().vertices.some((n) => n > 160) ? 2 : info().vertices.some((n) => n > 80) ? 1 : 0) : 0;
  const wanted: number[] = [];
  for (let level = levels - 1; level >= finest; --level) {
    const size = Math.max(...info().vertices) / 2 ** level;
    if (level === finest || (size >= 24 && size <= 130 && wanted.length === 0 && !playing)) wanted.push(level);
  }
  say({ kind: "find", number: ++number, asked, levels: wanted });
  chip.textContent = "searching …";
  listSurfaces();
  slices.show();
  sayMoment();
  if (coarse) keepSoon();
  else keep();
}

/** The first and last step that plays. */
function playRange(): [number, number] {
  const end = info().times.length - 1;
  const within = (text: string, otherwise: number) => (/^\d+$/.test(text) ? Math.min(end, Number(text)) : otherwise);
  return [within(from.value, 0), within(to.value, end)];
}

function momentWords(): string {
  const { times } = info();
  const steps = asked.fraction ? `between steps ${asked.step + 1} and ${asked.step + 2}` : `step ${asked.step + 1}`;
  return `${steps} of ${times.length}: ${dateOf(asked.step, asked.fraction)}`;
}
/** When a moment is: a date of the data's calendar, or a time. */
function dateOf(step: number, fraction = 0): string {
  const { times, timeUnit } = info();
  return momentText(times, step, fraction, timeUnit);
}
/** Says when moments are: in the time bar, for screen readers, in the browser's tab. */
function sayMoment(): void {
  time.step = between.checked ? "any" : "1";
  time.value = String(asked.step + asked.fraction / FRACTIONS);
  moment.textContent = momentWords();
  time.setAttribute("aria-valuetext", moment.textContent);
  for (const end of [from, to]) end.title = dateOf(Math.min(Math.max(0, Math.floor(Number(end.value)) || 0), info().times.length - 1));
  document.title = `${state.file}, ${dateOf(asked.step, asked.fraction)} - Isochron`;
}

/** Shows the list of surfaces, and the values of the one that is changed. */
function listSurfaces(): void {
  const own = surfaces[picked]!;
  surface.replaceChildren(...surfaces.map((each, i) => new Option(`${i + 1}: ${words(each.isovalue)}`, String(i))));
  surface.value = String(picked);
  remove.disabled = surfaces.length === 1;
  add.disabled = surfaces.length === MOST_SURFACES;
  histogram.mark(own.isovalue, surfaces.filter((_, i) => i !== picked).map((each) => each.isovalue));
  if (document.activeElement !== isovalue) isovalue.value = words(own.isovalue);
  color.value = own.color;
  opacity.value = String(own.opacity);
}

/** Changes the surface that is picked. */
function change(by: Partial<Surface>): void {
  surfaces = surfaces.map((each, i) => (i === picked ? { ...each, ...by } : each));
}

/** Shows how long things are, by a bar of a round length. */
function drawScale(): void {
  if (!infos.length) return;
  const most = 160 * scene.pixel;
  const tens = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map((n) => n * tens).find((each) => each <= most) ?? tens;
  part("scale").style.width = `${length / scene.pixel}px`;
  part("scale-words").textContent = `${words(length)} ${info().lengthUnit}`;
}

/** Sets what is behind the data, and the ink of what is written on it. */
function backdrop(color: string): void {
  background.value = color;
  scene.background(color);
  const light = [1, 3, 5].reduce((sum, at, i) => sum + parseInt(color.slice(at, at + 2), 16) * [0.3, 0.59, 0.11][i]!, 0) > 128;
  document.body.classList.toggle("on-light", light);
  document.body.classList.toggle("on-dark", !light);
}

/** Puts the state into the address when nothing has moved for a moment: browsers count how often. */
function keepSoon(): void {
  clearTimeout(later);
  later = window.setTimeout(keep, 300);
}

/** Puts the state into the address, without a new page in the history. */
function keep(): void {
  state = {
    ...(state.file ? { file: state.file } : {}),
    array: asked.array, step: asked.step, ...(asked.fraction ? { fraction: asked.fraction } : {}), isovalue: surfaces[picked]!.isovalue, view: scene.view, background: background.value,
    ...(surfaces.length > 1 ? { surfaces, picked } : { color: surfaces[0]!.color, opacity: surfaces[0]!.opacity }),
    ...(scene.up ? { up: scene.up } : {}),
    ...(asked.colors === null ? {} : { colors: asked.colors, map: map.value, ...(range ? { range } : {}) }),
    ...(slices.planes.length
      ? {
          slices: slices.planes, slicemap: sliceMap.value, ...(sliceOf.value === "" ? {} : { sliceof: Number(sliceOf.value) }), ...(sliceRange ? { slicerange: sliceRange } : {}),
          ...(isolines.checked ? {} : { isolines: 0 }), ...(alone.checked ? { alone: 1 } : {}),
        }
      : {}),
    ...(areShown(ghosts.settings) ? { ghosts: ghosts.settings } : {}),
    ...(clips.planes.length ? { planes: clips.planes } : {}),
    ...(box.box ? { box: box.box } : {}),
    ...(story && state.story ? { story: state.story, told: teller.told } : {}),
  };
  history.replaceState(null, "", linkOf(state));
}

function choose(array: number, of?: Surface[]): void {
  asked = { ...asked, array };
  surfaces = of ?? [{ ...surfaces[0]!, isovalue: firstIsovalue(infos[array]!) }];
  picked = 0;
  arrays.value = String(array);
  unit.textContent = info().valueUnit;
  time.max = String(info().times.length - 1);
  histogram.show(info());
}

/** Shows the slices that were found last. */
function paintSlices(): void {
  const ofSlices = infos[(last?.asked ?? asked).sliceOf]!;
  const [bottom, top] = (sliceRange ?? [ofSlices.low, ofSlices.high]) as [number, number];
  drawLegend(part<HTMLCanvasElement>("slice-colors"), sliceMap.value as MapName);
  part("slice-words").textContent = `${words(bottom)} to ${words(top)} ${ofSlices.valueUnit}`;
  if (last)
    scene.slice(last.slices, ofSlices, {
      map: sliceMap.value as MapName,
      range: [bottom, top],
      lines: isolines.checked && last.asked.sliceOf === last.asked.array ? surfaces : [],
    });
}

/** Shows what was found last in its colors, with their legend. */
function paint(): void {
  const colors = (last?.asked ?? asked).colors;
  const of = colors === null ? null : infos[colors]!;
  const [low, high] = (range ?? [of?.low ?? 0, of?.high ?? 0]) as [number, number];
  const name = map.value as MapName;
  part("legend").hidden = of === null;
  if (of) {
    drawLegend(part<HTMLCanvasElement>("legend-colors"), name);
    part("legend-words").textContent = `${words(low)} to ${words(high)} ${of.valueUnit}`;
  }
  scene.look(surfaces);
  paintSlices();
  paintGhosts();
  if (last) scene.show(last.found, last.found.map(({ values }) => (of && values ? colorsOf(name, values, low, high) : null)));
}

/** Shows the ghosts that are at hand, beside what is shown. */
function paintGhosts(): void {
  const { settings } = ghosts;
  const now = last?.asked ?? asked;
  ghostPanel.show(info().times.length > 1, surfaces[picked]!.color, now, ({ step, fraction }) => dateOf(step, fraction));
  scene.ghosts(
    ghosts.shown.flatMap((ghost) =>
      ghost.found.flatMap((mesh, i) => (surfaces[i] && surfaces[i].opacity > 0 ? [{ mesh, color: ghostColor(surfaces[i].color, ghost, now, settings), opacity: settings.opacity }] : [])),
    ),
  );
}

/** Shows what cuts the surfaces. */
function clip(): void {
  clips.show();
  box.show();
  scene.clip(info(), clips.planes, box.box);
  keepSoon();
}

/** Shows all of a story's key but its view. */
function showKey(key: Key): void {
  if (playing) play.click();
  const array = key.array === undefined ? asked.array : arrayCalled(key.array);
  let shown = key.surfaces ?? (array === asked.array ? surfaces : undefined);
  if (array !== asked.array) choose(array, shown);
  shown ??= surfaces;
  picked = Math.min(key.picked ?? picked, shown.length - 1);
  surfaces = shown.map((each, i) => (i === picked && key.isovalue !== undefined ? { ...each, isovalue: key.isovalue } : each));
  between.checked = key.blends ?? between.checked;
  if (key.step !== undefined) asked = { ...asked, step: key.step, fraction: between.checked && key.step + 1 < info().times.length ? key.fraction : 0 };
  if (key.coloring) {
    const { by, map: name, array: of } = key.coloring;
    const first = infos.findIndex((_, i) => i !== array);
    const colors = by !== "value" ? -1 : of === "" ? first : arrayCalled(of);
    asked = { ...asked, colors: colors < 0 ? null : colors };
    colorBy.value = colors < 0 ? "" : String(colors);
    map.value = mapCalled(name);
    range = key.coloring.range ?? null;
  }
  if (key.background !== undefined) {
    backdrop(BACKGROUNDS[key.background] ?? BACKGROUNDS["dark"]!);
  }
  if (key.slices) {
    const { planes, picked: moved, coloring, isolines: lines, alone: hides } = key.slices;
    slices.set(planes, moved);
    [isolines.checked, alone.checked] = [lines, hides];
    if (coloring) {
      sliceOf.value = coloring.array === "" ? "" : String(arrayCalled(coloring.array));
      sliceMap.value = mapCalled(coloring.map);
      sliceRange = coloring.range ?? null;
    }
  }
  if (key.ghosts) ghosts.settings = key.ghosts;
  if (key.clip) clips.set(key.clip.length ? [key.clip] : []);
  if (key.box) box.set(key.box.length ? key.box : null);
  clip();
  ask(false);
}
/** A map that the page has. */
const mapCalled = (name: string): string => ((MAP_NAMES as string[]).includes(name) ? name : "viridis");
/** The number of an array; empty: the first. */
const arrayCalled = (name: string): number => (name === "" ? 0 : infos.findIndex((each) => each.array === name));

/** Goes to the view of a story's key. */
function goToKey(key: Key, leaps: boolean): void {
  const { origin } = info();
  if (scene.stand(key, origin)) return;
  const { center, radius } = scene.data;
  const to = sightOf(key, origin, center, radius, scene.aspect);
  if (!to) return;
  const still = leaps || matchMedia("(prefers-reduced-motion: reduce)").matches;
  teller.card.dataset["moving"] = String(!still);
  scene.go(to, still);
}

/** The line from the card to what its text is about. */
function drawStoryLine(): void {
  const line = part("card-line");
  const about = teller.key?.place;
  const at = about && !document.body.classList.contains("inside") ? scene.placeInPicture(about.map((each, i) => each - info().origin[i]!)) : null;
  line.toggleAttribute("hidden", at === null);
  if (!at) return;
  const box = teller.card.getBoundingClientRect();
  const ends = { x1: Math.min(Math.max(at.x, box.left), box.right), y1: Math.min(Math.max(at.y, box.top), box.bottom), x2: at.x, y2: at.y };
  for (const [name, value] of Object.entries(ends)) line.firstElementChild!.setAttribute(name, String(value));
}

/** The file has more steps: what is shown stays, but for the last step, which the new last one follows. */
function grown(found: Info[]): void {
  const wasLast = asked.step === info().times.length - 1;
  const wholeRange = to.value === String(info().times.length - 1);
  infos = found;
  ghosts.forget();
  asked.array = Math.min(asked.array, infos.length - 1);
  const steps = info().times.length;
  time.max = String(steps - 1);
  if (wholeRange) to.value = time.max;
  if (wasLast) asked.fraction = 0;
  asked.step = wasLast ? steps - 1 : Math.min(asked.step, steps - 1);
  histogram.show(info());
  ask(false);
}

const ofUnit = (plane: Plane): Plane => [...plane.slice(0, 3), ...plane.slice(3).map((n) => n / Math.hypot(...plane.slice(3)))];
/** The plane of a link of earlier versions, at a share of an axis's vertices. */
function acrossAt(axis: number, share: number): Plane {
  const { direction, origin, vertices } = info();
  const far = distanceAt(info(), axis, share * (vertices[axis]! - 1));
  return [...origin.map((n, i) => n + far * direction[axis]![i]!), ...direction[axis]!];
}

function opened(found: Info[], count: number): void {
  infos = found;
  levels = count;
  arrays.replaceChildren(...infos.map((each, i) => new Option(each.array || "values", String(i))));
  const { view, up, told } = state;
  asked.step = Math.min(state.step ?? 0, infos[0]!.times.length - 1);
  asked.fraction = asked.step + 1 < infos[0]!.times.length ? (state.fraction ?? 0) : 0;
  between.checked = asked.fraction > 0;
  const one = { isovalue: state.isovalue ?? NaN, color: state.color ?? COLORS[0]!, opacity: state.opacity ?? 1 };
  const given = state.surfaces ?? (state.isovalue === undefined ? undefined : [one]);
  surfaces = given ?? [{ ...one, isovalue: 0 }];
  choose(Math.min(state.array ?? 0, infos.length - 1), given);
  picked = Math.min(state.picked ?? 0, surfaces.length - 1);
  [from.value, to.value] = ["0", time.max];
  colorBy.replaceChildren(new Option("one color", ""), ...infos.map((each, i) => new Option(each.array || "values", String(i))));
  colorBy.parentElement!.hidden = infos.length < 2;
  if (state.colors !== undefined && state.colors < infos.length) asked.colors = state.colors;
  colorBy.value = asked.colors === null ? "" : String(asked.colors);
  if (state.map) map.value = state.map;
  range = state.range ?? null;
  slices.set((state.slices ?? []).map(ofUnit));
  clips.set((state.planes ?? []).map(ofUnit));
  ghosts.settings = state.ghosts ?? NO_GHOSTS;
  if (state.clip) clips.set([...clips.planes, acrossAt(...state.clip)]);
  box.set(state.box ?? null);
  sliceRange = state.slicerange ?? null;
  sliceOf.replaceChildren(new Option("as the surfaces", ""), ...infos.map((each, i) => new Option(each.array || "values", String(i))));
  sliceOf.value = state.sliceof !== undefined && state.sliceof < infos.length ? String(state.sliceof) : "";
  sliceOf.hidden = infos.length < 2;
  if (state.slicemap) sliceMap.value = state.slicemap;
  isolines.checked = state.isolines !== 0;
  alone.checked = state.alone === 1;
  scene.frame(info());
  const place = (first: number) => new Vector3(...(view!.slice(first, first + 3) as [number, number, number]));
  if (view) scene.sight = { eye: place(0), target: place(3), up: up ? new Vector3(...(up as [number, number, number])) : new Vector3(0, 0, 1) };
  document.body.classList.add("open");
  clip();
  if (story && !badStory) {
    const why = misfit(story, infos[0]!.times.length, (name) => arrayCalled(name) >= 0);
    if (why) [story, badStory] = [null, `${state.story}: ${why}`];
  }
  // A link that has a view of its own has all the rest, too; one that names a step alone shows that.
  if (story) teller.open(story, view ? (told ?? 0) : (told ?? null), view === undefined);
  if (view || !teller.told) ask(false);
}

worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
  if (data.kind === "opened") return data.again ? grown(data.arrays) : opened(data.arrays, data.levels);
  if (data.kind === "failed") {
    if (data.changed && grows) return say({ kind: "look" }); // and asks again then
    chip.textContent = data.changed ? `${data.words}; open the page again` : data.words;
    chip.classList.add("failed");
    if (playing) play.click();
    return;
  }
  if (data.number < shown) return; // an older wish
  shown = data.number;
  if (data.kind === "ghost") {
    ghosts.keep(data.ghost, data.asked);
    paintGhosts();
    return goOn(data.last);
  }
  last = data;
  paint();
  const exact = data.level === 0;
  const count = data.found.reduce((sum, each) => sum + each.cells, 0);
  const cells = count.toLocaleString("en");
  chip.classList.remove("failed");
  chip.textContent = data.found.length === 0 && exact ? "exact: slices alone" : count === 0 && exact ? "no surface at this isovalue" : exact ? `exact: ${cells} cells` : `preview, 1/${2 ** data.level} of the resolution`;
  chip.dataset["exact"] = String(exact);
  chip.dataset["cells"] = String(count);
  if (badStory && exact) chip.textContent += `; ${badStory}`;
  chip.title = `${data.requests} requests, ${(data.bytes / 1e6).toFixed(1)} MB`;
  goOn(data.last);
};

/** Plays on. @param whole all of the moment is shown */
function goOn(whole: boolean): void {
  if (!playing || !whole) return;
  clearTimeout(turn);
  turn = window.setTimeout(next, between.checked ? 0 : 1000 / Number(speed.value));
}

/** @param at steps from the first one, and a part of the way to the next */
function momentAt(at: number): { step: number; fraction: number } {
  const number = Math.round(between.checked ? at * FRACTIONS : Math.round(at) * FRACTIONS);
  return { step: Math.floor(number / FRACTIONS), fraction: number % FRACTIONS };
}

function next(): void {
  if (!playing) return;
  const [first, final] = playRange();
  if (between.checked) {
    const now = performance.now();
    const at = played.at + Math.min(1, ((now - played.now) / 1000) * Number(speed.value));
    played = { at: at < first || played.at >= final ? first : Math.min(at, final), now };
    asked = { ...asked, ...momentAt(info().gaps.includes(Math.floor(played.at)) ? Math.floor(played.at) : played.at) };
  } else {
    asked = { ...asked, fraction: 0, step: asked.step < first || asked.step >= final ? first : asked.step + 1 };
  }
  ask(false);
}

histogram.changed = (value, done) => {
  change({ isovalue: value });
  ask(!done);
};
isovalue.addEventListener("change", () => {
  const value = Number(isovalue.value.replace(",", "."));
  if (!Number.isFinite(value)) return void (isovalue.value = words(surfaces[picked]!.isovalue));
  change({ isovalue: value });
  ask(false);
});
between.addEventListener("change", () => {
  if (!between.checked) asked = { ...asked, fraction: 0 };
  ask(false);
});
arrays.addEventListener("change", () => {
  choose(Number(arrays.value));
  scene.frame(info());
  ask(false);
});
time.addEventListener("input", () => {
  asked = { ...asked, ...momentAt(Number(time.value)) };
  ask(false);
});
for (const end of [from, to]) end.addEventListener("change", sayMoment);
play.addEventListener("click", () => {
  playing = !playing;
  play.textContent = playing ? "Pause" : "Play";
  played = { at: asked.step + asked.fraction / FRACTIONS, now: performance.now() };
  if (playing) next();
});
surface.addEventListener("change", () => {
  picked = Number(surface.value);
  listSurfaces();
  keep();
});
add.addEventListener("click", () => {
  // In the middle of the widest gap between the surfaces and the ends of the values.
  const { low, high } = info();
  const places = [low, ...surfaces.map((each) => each.isovalue).filter((value) => value > low && value < high), high].sort((a, b) => a - b);
  const widest = places.slice(1).reduce<[number, number]>((best, place, i) => (place - places[i]! > best[1] - best[0] ? [places[i]!, place] : best), [0, 0]);
  const color = COLORS.find((each) => surfaces.every((other) => other.color !== each)) ?? COLORS[0]!;
  surfaces = [...surfaces, { isovalue: (widest[0] + widest[1]) / 2, color, opacity: 1 }];
  picked = surfaces.length - 1;
  // Surfaces around the new one would hide it.
  if (surfaces.length === 2 && surfaces[0]!.opacity === 1) surfaces[0] = { ...surfaces[0]!, opacity: 0.4 };
  ask(false);
});
remove.addEventListener("click", () => {
  surfaces = surfaces.filter((_, i) => i !== picked);
  picked = Math.min(picked, surfaces.length - 1);
  ask(false);
});
const style = () => {
  change({ color: color.value, opacity: Number(opacity.value) });
  scene.look(surfaces);
  paintGhosts();
  if (slices.planes.length) paintSlices();
  backdrop(background.value);
  keepSoon();
};
for (const input of [color, opacity, background]) input.addEventListener("input", style);
colorBy.addEventListener("change", () => {
  range = null;
  asked = { ...asked, colors: colorBy.value === "" ? null : Number(colorBy.value) };
  ask(false);
});
map.addEventListener("change", () => {
  paint();
  keep();
});
sliceOf.addEventListener("change", () => {
  sliceRange = null;
  ask(false);
});
for (const input of [sliceMap, isolines])
  input.addEventListener("change", () => {
    paint();
    keep();
  });
alone.addEventListener("change", () => ask(false));
part("clip-flip").addEventListener("click", () => clips.now && clips.turn(clips.now.slice(3).map((n) => -n + 0)));
part("copy").addEventListener("click", () => {
  keep();
  void navigator.clipboard?.writeText(location.href);
  chip.textContent = "link copied";
});
part("save").addEventListener("click", () => {
  void scene.picture().then((blob) => {
    if (!blob) return;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `${info().array || "surface"}_${+(asked.step + asked.fraction / FRACTIONS).toFixed(4)}.png`;
    link.click();
    URL.revokeObjectURL(link.href);
  });
});
document.addEventListener("keydown", (event) => {
  if (event.target instanceof HTMLInputElement || !infos.length) return;
  if (teller.pressed(event)) return event.preventDefault();
  const steps = info().times.length;
  if (event.key === " ") play.click();
  else if (event.key === "ArrowRight") asked = { ...asked, step: Math.min(steps - 1, asked.step + 1), fraction: 0 };
  else if (event.key === "ArrowLeft") asked = { ...asked, step: asked.fraction ? asked.step : Math.max(0, asked.step - 1), fraction: 0 };
  else if (event.key === "6") return slices.add();
  else if (event.key === "7") return clips.now ? clips.turn(acrossAxis(info(), nextAxis(info(), clips.now))) : clips.add();
  else if (event.key === "g") ghosts.toggle();
  else if (event.key === "h" && slices.planes.length) alone.checked = !alone.checked;
  else if (event.key === "Delete") slices.set([]);
  else if (event.key === "ArrowUp" || event.key === "ArrowDown") return (slices.now ? slices : clips).nudge(event.key === "ArrowUp" ? 1 : -1);
  else return;
  event.preventDefault();
  if (event.key !== " ") ask(false);
});
const enter = part<HTMLButtonElement>("enter");
void scene
  .headset(
    {
      isovalue: (share) => {
        const { low, high } = info();
        change({ isovalue: Math.min(high, Math.max(low, surfaces[picked]!.isovalue + share * (high - low))) });
        ask(true);
      },
      step: (steps) => {
        const count = info().times.length;
        asked = { ...asked, step: (asked.step + steps + count) % count, fraction: 0 };
        ask(false);
      },
      card: () => {
        const { key, heading, can } = teller;
        return key ? { heading, text: key.text, ...can } : null;
      },
      tell: (button) => teller.press(button),
      words: () => `${info().array || "values"} ${words(surfaces[picked]!.isovalue)} ${info().valueUnit}\n${moment.textContent ?? ""}`,
    },
    (inside) => {
      document.body.classList.toggle("inside", inside);
      if (!inside) ask(false);
    },
  )
  .then((begin) => {
    if (!begin) return;
    enter.hidden = false;
    enter.addEventListener("click", () => void begin().catch((error: unknown) => (chip.textContent = String(error))));
  });
scene.moved = () => {
  drawScale();
  keepSoon();
};
scene.arrived = () => (teller.card.dataset["moving"] = "false");
scene.drawn = drawStoryLine;

/** The story beside the page; what is wrong with it is said, and the data are shown all the same. */
async function openStory(name: string, headers: Record<string, string>): Promise<void> {
  try {
    story = await storyAt(name, headers);
    state.story = name;
  } catch (error) {
    badStory = error instanceof Error ? error.message : String(error);
  }
}

async function begin(): Promise<void> {
  backdrop(state.background ?? (matchMedia("(prefers-color-scheme: light)").matches ? "#f4f5f7" : "#0f1116"));
  // The token came with the link; addresses that are copied leave it out, and this tab remembers it.
  const token = new URLSearchParams(location.hash.replace(/^#/, "")).get("token") ?? sessionStorage.getItem("token");
  if (token) sessionStorage.setItem("token", token);
  const headers: Record<string, string> = token ? { Authorization: `Bearer ${token}` } : {};
  // The server, or whoever put the page there, says which files lie beside it.
  const answer = await fetch("site.json", { cache: "no-store", headers });
  if (!answer.ok && !state.file) throw new Error("no index is named in the link, and site.json is not there");
  const site = answer.ok ? ((await answer.json()) as { files: string[]; follow?: boolean; story?: string }) : { files: [] };
  const file = state.file ?? site.files[0];
  grows = site.follow === true;
  if (!file) throw new Error("site.json names no index");
  state.file = file;
  const name = state.story ?? site.story;
  if (name !== undefined && isPlain(name)) await openStory(name, headers);
  document.title = `${file} - Isochron`;
  say({ kind: "open", address: new URL(encodeURIComponent(file), location.href.split("#")[0]).href, headers });
  if (grows) setInterval(() => document.hidden || say({ kind: "look" }), LOOK);
}
begin().catch((error: unknown) => {
  chip.textContent = error instanceof Error ? error.message : String(error);
  chip.classList.add("failed");
});
