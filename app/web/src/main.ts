// The page: opens the index beside it, and shows the surface that the controls and the link ask for.
import "./style.css";
import { linked, linkOf, type Linked } from "./link";
import type { Asked, Found, FromWorker, ToWorker } from "./messages";
import type { Info } from "./reader/index_file";
import { colorsOf, drawLegend, MAP_NAMES, type MapName } from "./view/colors";
import { Histogram } from "./view/histogram";
import { Scene, type View } from "./view/scene";

const MOST_PLAYED = 12; // steps a second

function part<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no part ${id}`);
  return found as T;
}

const chip = part("chip");
const arrays = part<HTMLSelectElement>("array");
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

const scene = new Scene(part<HTMLCanvasElement>("picture"));
const histogram = new Histogram(part<HTMLCanvasElement>("histogram"));
const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
const say = (words: ToWorker) => worker.postMessage(words);

let state: Linked = linked(location.hash);
let infos: Info[] = [];
let levels = 1;
let asked: Asked = { array: 0, step: 0, isovalue: 0, colors: null };
let last: { asked: Asked; found: Found } | null = null;
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

/** Asks for the surface: coarse levels first, and while something is dragged only these. */
function ask(coarse: boolean): void {
  const finest = coarse ? Math.min(levels - 1, info().vertices.some((n) => n > 160) ? 2 : info().vertices.some((n) => n > 80) ? 1 : 0) : 0;
  const wanted: number[] = [];
  for (let level = levels - 1; level >= finest; --level) {
    const size = Math.max(...info().vertices) / 2 ** level;
    if (level === finest || (size >= 24 && size <= 130 && wanted.length === 0 && !playing)) wanted.push(level);
  }
  say({ kind: "find", number: ++number, asked, levels: wanted });
  chip.textContent = "searching …";
  histogram.isovalue = asked.isovalue;
  if (document.activeElement !== isovalue) isovalue.value = words(asked.isovalue);
  time.value = String(asked.step);
  const { times, timeUnit } = info();
  moment.textContent = `step ${asked.step + 1} of ${times.length}: ${words(times[asked.step]!)} ${timeUnit}`;
  if (coarse) keepSoon();
  else keep();
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
    array: asked.array, step: asked.step, isovalue: asked.isovalue, view: scene.view, color: color.value,
    opacity: Number(opacity.value), background: background.value,
    ...(asked.colors === null ? {} : { colors: asked.colors, map: map.value }),
    ...(clipAxis.value === "" ? {} : { clip: [Number(clipAxis.value), Number(clipShare.value)] as [number, number] }),
  };
  history.replaceState(null, "", linkOf(state));
}

function choose(array: number, isovalue = firstIsovalue(infos[array]!)): void {
  asked = { ...asked, array, isovalue };
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
  if (last) scene.show(last.found, of && last.found.values ? colorsOf(name, last.found.values, of.low, of.high) : null);
}

function clip(): void {
  clipShare.hidden = clipAxis.value === "";
  scene.clip(info(), clipAxis.value === "" ? null : { axis: Number(clipAxis.value), share: Number(clipShare.value) });
  keepSoon();
}

function opened(found: Info[], count: number): void {
  infos = found;
  levels = count;
  arrays.replaceChildren(...infos.map((each, i) => new Option(each.array || "values", String(i))));
  const linkedView = state.view;
  asked.step = Math.min(state.step ?? 0, infos[0]!.times.length - 1);
  choose(Math.min(state.array ?? 0, infos.length - 1), state.isovalue);
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
  if (data.kind === "opened") return opened(data.arrays, data.levels);
  if (data.kind === "failed") {
    chip.textContent = data.words;
    chip.classList.add("failed");
    if (playing) play.click();
    return;
  }
  if (data.number < shown) return; // an older wish
  shown = data.number;
  last = data;
  paint();
  const exact = data.level === 0;
  const cells = data.found.cells.toLocaleString("en");
  chip.classList.remove("failed");
  chip.textContent = data.found.cells === 0 && exact ? "no surface at this isovalue" : exact ? `exact: ${cells} cells` : `preview, 1/${2 ** data.level} of the resolution`;
  chip.dataset["exact"] = String(exact);
  chip.dataset["cells"] = String(data.found.cells);
  chip.title = `${data.requests} requests, ${(data.bytes / 1e6).toFixed(1)} MB`;
  if (!playing || !data.last) return;
  clearTimeout(turn);
  turn = window.setTimeout(next, 1000 / MOST_PLAYED);
};

function next(): void {
  if (!playing) return;
  asked = { ...asked, step: (asked.step + 1) % info().times.length };
  ask(false);
}

histogram.changed = (value, done) => {
  asked = { ...asked, isovalue: value };
  ask(!done);
};
isovalue.addEventListener("change", () => {
  const value = Number(isovalue.value.replace(",", "."));
  if (!Number.isFinite(value)) return void (isovalue.value = words(asked.isovalue));
  asked = { ...asked, isovalue: value };
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
const style = () => {
  scene.color(color.value, Number(opacity.value));
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
        asked = { ...asked, isovalue: Math.min(high, Math.max(low, asked.isovalue + share * (high - low))) };
        ask(true);
      },
      step: (steps) => {
        const count = info().times.length;
        asked = { ...asked, step: (asked.step + steps + count) % count };
        ask(false);
      },
      words: () => `${info().array || "values"} ${words(asked.isovalue)} ${info().valueUnit}\n${moment.textContent ?? ""}`,
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
scene.moved = keepSoon;

async function begin(): Promise<void> {
  if (state.color) color.value = state.color;
  if (state.opacity) opacity.value = String(state.opacity);
  background.value = state.background ?? (matchMedia("(prefers-color-scheme: light)").matches ? "#f4f5f7" : "#0f1116");
  scene.color(color.value, Number(opacity.value));
  scene.background(background.value);
  // The token came with the link; addresses that are copied leave it out, and this tab remembers it.
  const token = new URLSearchParams(location.hash.replace(/^#/, "")).get("token") ?? sessionStorage.getItem("token");
  if (token) sessionStorage.setItem("token", token);
  const headers: Record<string, string> = token ? { Authorization: `Bearer ${token}` } : {};
  let file = state.file;
  if (!file) {
    // The server, or whoever put the page there, says which files lie beside it.
    const answer = await fetch("site.json", { cache: "no-store", headers });
    if (!answer.ok) throw new Error("no index is named in the link, and site.json is not there");
    file = ((await answer.json()) as { files: string[] }).files[0];
  }
  if (!file) throw new Error("site.json names no index");
  state.file = file;
  document.title = `${file} - Isochron`;
  say({ kind: "open", address: new URL(encodeURIComponent(file), location.href.split("#")[0]).href, headers });
}
begin().catch((error: unknown) => {
  chip.textContent = error instanceof Error ? error.message : String(error);
  chip.classList.add("failed");
});
