// The page: opens the index beside it, and shows the surface that the controls and the link ask for.
import "./style.css";
import { linked, linkOf, MOST_SURFACES, type Linked, type Surface } from "./link";
import type { Asked, Found, FromWorker, ToWorker } from "./messages";
import type { Info } from "./reader/index_file";
import { colorsOf, drawLegend, MAP_NAMES, type MapName } from "./view/colors";
import { Histogram } from "./view/histogram";
import { Scene, type View } from "./view/scene";

const LOOK = 2000; // milliseconds between two looks at a file that grows
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

const colorBy = part<HTMLSelectElement>("color-by");
const map = part<HTMLSelectElement>("map");
const clipAxis = part<HTMLSelectElement>("clip-axis");
const clipShare = part<HTMLInputElement>("clip-share");
map.replaceChildren(...MAP_NAMES.map((name) => new Option(name, name)));

const scene = new Scene(part<HTMLCanvasElement>("picture"), part("ticks"));
const histogram = new Histogram(part<HTMLCanvasElement>("histogram"));
const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
const say = (words: ToWorker) => worker.postMessage(words);

let state: Linked = linked(location.hash);
let infos: Info[] = [];
let levels = 1;
let asked: Asked = { array: 0, step: 0, isovalues: [0], colors: null };
let surfaces: Surface[] = [{ isovalue: 0, color: COLORS[0]!, opacity: 1 }];
let picked = 0;
let grows = false; // the server says that the file may
let last: { asked: Asked; found: Found[] } | null = null;
let number = 0;
let shown = 0;
let playing = false;
let turn = 0; // the timer of the next step
let later = 0; // the timer of the address

const info = (): Info => infos[asked.array]!;
const words = (value: number): string => String(+value.toPrecision(6));

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
  asked = { ...asked, isovalues: surfaces.map((each) => each.isovalue) };
  const finest = coarse ? Math.min(levels - 1, info().vertices.some((n) => n > 160) ? 2 : info().vertices.some((n) => n > 80) ? 1 : 0) : 0;
  const wanted: number[] = [];
  for (let level = levels - 1; level >= finest; --level) {
    const size = Math.max(...info().vertices) / 2 ** level;
    if (level === finest || (size >= 24 && size <= 130 && wanted.length === 0 && !playing)) wanted.push(level);
  }
  say({ kind: "find", number: ++number, asked, levels: wanted });
  chip.textContent = "searching …";
  listSurfaces();
  time.value = String(asked.step);
  const { times, timeUnit } = info();
  moment.textContent = `step ${asked.step + 1} of ${times.length}: ${words(times[asked.step]!)} ${timeUnit}`;
  if (coarse) keepSoon();
  else keep();
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

/** Puts the state into the address when nothing has moved for a moment: browsers count how often. */
function keepSoon(): void {
  clearTimeout(later);
  later = window.setTimeout(keep, 300);
}

/** Puts the state into the address, without a new page in the history. */
function keep(): void {
  state = {
    ...(state.file ? { file: state.file } : {}),
    array: asked.array, step: asked.step, isovalue: surfaces[picked]!.isovalue, view: scene.view, background: background.value,
    ...(surfaces.length > 1 ? { surfaces, picked } : { color: surfaces[0]!.color, opacity: surfaces[0]!.opacity }),
    ...(asked.colors === null ? {} : { colors: asked.colors, map: map.value }),
    ...(clipAxis.value === "" ? {} : { clip: [Number(clipAxis.value), Number(clipShare.value)] as [number, number] }),
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

/** Shows what was found last in its colors, with their legend. */
function paint(): void {
  const colors = (last?.asked ?? asked).colors;
  const of = colors === null ? null : infos[colors]!;
  const name = map.value as MapName;
  part("legend").hidden = of === null;
  if (of) {
    drawLegend(part<HTMLCanvasElement>("legend-colors"), name);
    part("legend-words").textContent = `${words(of.low)} to ${words(of.high)} ${of.valueUnit}`;
  }
  scene.look(surfaces);
  if (last) scene.show(last.found, last.found.map(({ values }) => (of && values ? colorsOf(name, values, of.low, of.high) : null)));
}

function clip(): void {
  clipShare.hidden = clipAxis.value === "";
  scene.clip(info(), clipAxis.value === "" ? null : { axis: Number(clipAxis.value), share: Number(clipShare.value) });
  keepSoon();
}

/** The file has more steps: what is shown stays, but for the last step, which the new last one follows. */
function grown(found: Info[]): void {
  const wasLast = asked.step === info().times.length - 1;
  const wholeRange = to.value === String(info().times.length - 1);
  infos = found;
  asked.array = Math.min(asked.array, infos.length - 1);
  const steps = info().times.length;
  time.max = String(steps - 1);
  if (wholeRange) to.value = time.max;
  asked.step = wasLast ? steps - 1 : Math.min(asked.step, steps - 1);
  histogram.show(info());
  ask(false);
}

function opened(found: Info[], count: number): void {
  infos = found;
  levels = count;
  arrays.replaceChildren(...infos.map((each, i) => new Option(each.array || "values", String(i))));
  const linkedView = state.view;
  asked.step = Math.min(state.step ?? 0, infos[0]!.times.length - 1);
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
  const cut = state.clip;
  scene.frame(info());
  if (linkedView) scene.view = linkedView as View;
  document.body.classList.add("open");
  if (cut) {
    clipAxis.value = String(cut[0]);
    clipShare.value = String(cut[1]);
  }
  clip();
  ask(false);
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
  last = data;
  paint();
  const exact = data.level === 0;
  const count = data.found.reduce((sum, each) => sum + each.cells, 0);
  const cells = count.toLocaleString("en");
  chip.classList.remove("failed");
  chip.textContent = count === 0 && exact ? "no surface at this isovalue" : exact ? `exact: ${cells} cells` : `preview, 1/${2 ** data.level} of the resolution`;
  chip.dataset["exact"] = String(exact);
  chip.dataset["cells"] = String(count);
  chip.title = `${data.requests} requests, ${(data.bytes / 1e6).toFixed(1)} MB`;
  if (!playing || !data.last) return;
  clearTimeout(turn);
  turn = window.setTimeout(next, 1000 / Number(speed.value));
};

function next(): void {
  if (!playing) return;
  const end = info().times.length - 1;
  const within = (text: string, otherwise: number) => (/^\d+$/.test(text) ? Math.min(end, Number(text)) : otherwise);
  const [first, final] = [within(from.value, 0), within(to.value, end)];
  asked = { ...asked, step: asked.step < first || asked.step >= final ? first : asked.step + 1 };
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
arrays.addEventListener("change", () => {
  choose(Number(arrays.value));
  scene.frame(info());
  ask(false);
});
time.addEventListener("input", () => {
  asked = { ...asked, step: Number(time.value) };
  ask(false);
});
play.addEventListener("click", () => {
  playing = !playing;
  play.textContent = playing ? "Pause" : "Play";
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
  scene.background(background.value);
  keepSoon();
};
for (const input of [color, opacity, background]) input.addEventListener("input", style);
colorBy.addEventListener("change", () => {
  asked = { ...asked, colors: colorBy.value === "" ? null : Number(colorBy.value) };
  ask(false);
});
map.addEventListener("change", () => {
  paint();
  keep();
});
clipAxis.addEventListener("change", clip);
clipShare.addEventListener("input", clip);
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
    link.download = `${info().array || "surface"}_${asked.step}.png`;
    link.click();
    URL.revokeObjectURL(link.href);
  });
});
document.addEventListener("keydown", (event) => {
  if (event.target instanceof HTMLInputElement || !infos.length) return;
  const steps = info().times.length;
  if (event.key === " ") play.click();
  else if (event.key === "ArrowRight") asked = { ...asked, step: Math.min(steps - 1, asked.step + 1) };
  else if (event.key === "ArrowLeft") asked = { ...asked, step: Math.max(0, asked.step - 1) };
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
        asked = { ...asked, step: (asked.step + steps + count) % count };
        ask(false);
      },
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

async function begin(): Promise<void> {
  background.value = state.background ?? (matchMedia("(prefers-color-scheme: light)").matches ? "#f4f5f7" : "#0f1116");
  scene.background(background.value);
  // The token came with the link; addresses that are copied leave it out, and this tab remembers it.
  const token = new URLSearchParams(location.hash.replace(/^#/, "")).get("token") ?? sessionStorage.getItem("token");
  if (token) sessionStorage.setItem("token", token);
  const headers: Record<string, string> = token ? { Authorization: `Bearer ${token}` } : {};
  // The server, or whoever put the page there, says which files lie beside it.
  const answer = await fetch("site.json", { cache: "no-store", headers });
  if (!answer.ok && !state.file) throw new Error("no index is named in the link, and site.json is not there");
  const site = answer.ok ? ((await answer.json()) as { files: string[]; follow?: boolean }) : { files: [] };
  const file = state.file ?? site.files[0];
  grows = site.follow === true;
  if (!file) throw new Error("site.json names no index");
  state.file = file;
  document.title = `${file} - Isochron`;
  say({ kind: "open", address: new URL(encodeURIComponent(file), location.href.split("#")[0]).href, headers });
  if (grows) setInterval(() => document.hidden || say({ kind: "look" }), LOOK);
}
begin().catch((error: unknown) => {
  chip.textContent = error instanceof Error ? error.message : String(error);
  chip.classList.add("failed");
});
