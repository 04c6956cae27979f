// The built page in Chromium: opens an index by ranges, shows its surface, obeys controls and links, and says in a line what is wrong.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium, type Browser, type Page } from "playwright-core";
import { afterAll, beforeAll, beforeEach, expect, test } from "vitest";
import { RangeServer } from "./range_server";

const program = process.env["ISOCHRON_PROGRAM"] ?? "isochron";
let folder: string;
let server: RangeServer;
let address: string;
let browser: Browser;

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "isochron-page-"));
  const n = 40;
  const names: string[] = [];
  for (let t = 0; t < 3; ++t) {
    const values = new Float32Array(n ** 3);
    for (let i = 0; i < values.length; ++i) {
      const at = [i % n, Math.floor(i / n) % n, Math.floor(i / n / n)].map((k) => k - n / 2 + 0.25);
      values[i] = Math.hypot(...at) + t;
    }
    names.push(join(folder, `t${t}.raw`));
    writeFileSync(names.at(-1)!, values);
  }
  execFileSync(program, ["build", ...names, "-o", join(folder, "ball.isochron"), "--dims", `${n}`, `${n}`, `${n}`, "--type", "f32", "--value-unit", "mm"], { stdio: "pipe" });
  writeFileSync(join(folder, "site.json"), JSON.stringify({ files: ["ball.isochron"] }));
  writeFileSync(join(folder, "other.isochron"), "no index at all, but long enough for a header ".repeat(400));
  server = new RangeServer([new URL("../site", import.meta.url).pathname, folder]);
  address = await server.listen();
  browser = await chromium.launch({ executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
});
afterAll(async () => {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
});
beforeEach(() => {
  server.faults = {};
});

async function open(hash = ""): Promise<Page> {
  const page = await browser.newPage({ viewport: { width: 800, height: 600 } });
  await page.goto(address + hash);
  return page;
}
/** Waits until the exact surface is shown. @return number of its cells */
async function exact(page: Page): Promise<number> {
  await page.waitForSelector('#chip[data-exact="true"]');
  return Number(await page.getAttribute("#chip", "data-cells"));
}
function cells(step: number, isovalue: number, fraction = 0): number {
  const said = execFileSync(program, ["query", join(folder, "ball.isochron"), `--isovalue=${isovalue}`, "--step", `${step}`, "--fraction", `${fraction}`, "--repeat", "0", "--json"], { stdio: "pipe" });
  return (JSON.parse(said.toString()) as { active_cells: number }).active_cells;
}
const settled = (page: Page, wanted: number) => page.waitForFunction((count) => {
  const chip = document.getElementById("chip")!;
  return chip.dataset["exact"] === "true" && chip.dataset["cells"] === String(count);
}, wanted);
/** The color of the picture at shares of its width and height. */
const pixel = (page: Page, x: number, y: number) => page.evaluate(([px, py]) => {
  const canvas = document.getElementById("picture") as HTMLCanvasElement;
  const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
  const context = copy.getContext("2d")!;
  context.drawImage(canvas, 0, 0);
  return [...context.getImageData(px! * canvas.width, py! * canvas.height, 1, 1).data.slice(0, 3)];
}, [x, y]);
/** Waits until what was set is drawn. */
const drawn = (page: Page) => page.evaluate(() => new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go))));

test("shows the surface, and obeys isovalue, time and link", async () => {
  const page = await open("#isovalue=12.5&background=%230f1116");
  expect(await exact(page)).toBe(cells(0, 12.5));
  await page.fill("#isovalue", "9,5");
  await page.press("#isovalue", "Enter");
  await settled(page, cells(0, 9.5));
  await page.evaluate(() => (document.activeElement as HTMLElement).blur());
  await page.keyboard.press("ArrowRight");
  await settled(page, cells(1, 9.5));
  const link = page.url();
  expect(link).toContain("step=1");
  expect(link).toContain("isovalue=9.5");
  const again = await browser.newPage();
  await again.goto(link);
  await settled(again, cells(1, 9.5));
  // The ball is in the middle of the picture, and the background is not.
  const middle = await pixel(page, 0.5, 0.5);
  expect(middle[0]! + middle[1]!).toBeGreaterThan(150);
  const side = await pixel(page, 0.98, 0.5);
  expect(side[0]! + side[1]!).toBeLessThan(80);
  await page.close();
  await again.close();
});

test.each<[string, () => string, RegExp]>([
  ["a server without ranges", () => ((server.faults = { ignoresRanges: true }), ""), /sends the whole file/],
  ["a file that changes", () => ((server.faults = { changes: true }), ""), /has changed/],
  ["damaged chunks", () => ((server.faults = { damageFrom: 8192 }), ""), /damaged/],
  ["a foreign file", () => "#file=other.isochron", /not an index of Isochron/],
  ["a file that is not there", () => "#file=gone.isochron", /404/],
])("says in a line that there is %s", async (_, prepare, said) => {
  const page = await open(prepare());
  await page.waitForSelector("#chip.failed");
  expect(await page.textContent("#chip")).toMatch(said);
  await page.close();
});

test("shows several surfaces, and the link has them all", async () => {
  const page = await open("#surfaces=12.5/ff0000/1,6/00ff00/0.5&picked=1");
  await settled(page, cells(0, 12.5) + cells(0, 6));
  expect(await page.inputValue("#isovalue")).toBe("6");
  expect(await page.inputValue("#color")).toBe("#00ff00");
  await page.click("#add");
  await page.fill("#isovalue", "15");
  await page.press("#isovalue", "Enter");
  await settled(page, cells(0, 12.5) + cells(0, 6) + cells(0, 15));
  const again = await browser.newPage();
  await again.goto(page.url());
  await settled(again, cells(0, 12.5) + cells(0, 6) + cells(0, 15));
  expect(await again.inputValue("#surface")).toBe("2");
  await again.click("#remove");
  await settled(again, cells(0, 12.5) + cells(0, 6));
  await page.close();
  await again.close();
});

test("plays a range of steps", async () => {
  const page = await open("#isovalue=12.5");
  await exact(page);
  await page.fill("#from", "1");
  await page.fill("#to", "2");
  await page.selectOption("#speed", "24");
  await page.click("#play");
  const seen = new Set<string>();
  for (let i = 0; i < 40 && seen.size < 2; ++i) {
    await page.waitForTimeout(100);
    seen.add(await page.inputValue("#time"));
  }
  await page.click("#play");
  expect([...seen].filter((step) => step !== "0").sort()).toEqual(["1", "2"]);
  await page.close();
});

test("shows the steps that are appended, at the last step", async () => {
  const [grows, list] = [join(folder, "grows.isochron"), join(folder, "site.json")];
  const build = (more: string[], steps: number[]) =>
    execFileSync(program, ["build", ...steps.map((t) => join(folder, `t${t}.raw`)), "-o", grows, "--dims", "40", "40", "40", "--type", "f32", ...more], { stdio: "pipe" });
  build([], [0, 1]);
  writeFileSync(list, JSON.stringify({ files: ["grows.isochron"], follow: true }));
  const page = await open("#isovalue=12.5&step=1");
  await settled(page, cells(1, 12.5));
  build(["--append"], [0, 1, 2]);
  await settled(page, cells(2, 12.5));
  expect(await page.inputValue("#time")).toBe("2");
  writeFileSync(list, JSON.stringify({ files: ["ball.isochron"] }));
  await page.close();
});

test("numbers the box, and says how long things are", async () => {
  const page = await open("#isovalue=12.5");
  await exact(page);
  const ticks = await page.$$eval("#ticks span:not([hidden])", (spans) => spans.map((span) => span.textContent));
  expect(ticks).toContain("x");
  expect(ticks).toContain("20");
  const [words, width] = await page.$eval("#scale", (bar) => [bar.textContent, bar.getBoundingClientRect().width] as const);
  expect(Number(words)).toBeGreaterThan(0);
  // They are seen on any background, whatever the colors of the panels.
  for (const [color, light] of [["#ffffff", false], ["#000000", true]] as const) {
    await page.fill("#background", color);
    const ink = await page.$$eval("#ticks, #scale", (parts) => parts.map((part) => getComputedStyle(part).color.match(/\d+/g)!.map(Number)));
    for (const levels of ink) expect(Math.min(...levels) > 128).toBe(light);
  }
  expect(width).toBeGreaterThan(50);
  await page.close();
});

test("shows exact cells between steps, by slider and while time plays", async () => {
  const page = await open("#isovalue=12.5");
  await settled(page, cells(0, 12.5));
  await page.check("#between");
  await page.$eval("#time", (slider: HTMLInputElement) => {
    slider.value = "0.5";
    slider.dispatchEvent(new Event("input"));
  });
  await settled(page, cells(0, 12.5, 32768));
  expect(await page.textContent("#moment")).toMatch(/^between steps 1 and 2 of 3: 0.5/);
  expect(page.url()).toContain("fraction=32768");
  const again = await browser.newPage();
  await again.goto(page.url());
  await settled(again, cells(0, 12.5, 32768));
  expect(await again.isChecked("#between")).toBe(true);
  await page.selectOption("#speed", "1");
  await page.evaluate(() => {
    const moment = document.getElementById("moment")!;
    const first = moment.textContent!;
    new MutationObserver(() => {
      const { textContent } = moment;
      if (textContent!.startsWith("between") && textContent !== first) document.body.dataset["seen"] = textContent!;
    }).observe(moment, { childList: true });
  });
  await page.click("#play");
  await page.waitForSelector("body[data-seen]");
  await page.click("#play");
  await page.uncheck("#between");
  await settled(page, cells(Math.floor(Number(await page.inputValue("#time"))), 12.5));
  await page.close();
  await again.close();
});

test("tells a story by keys, buttons and touch, and a link opens at its step", async () => {
  const list = join(folder, "site.json");
  const view = { room_from_physical: { translation: [-1, 1, -4], rotation: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2], scale: 0.05 }, head: [0, 1.6, 0, 0, 0, 0, 1] };
  const keys = [
    { time: 0, text: "Step <b>one</b> <img src=x onerror=alert(1)>", isovalue: 12.5, step: 0 },
    { time: 2, text: "", isovalue: 3 },
    { time: 4, name: "half", text: "In between.", place: [20, 20, 20], isovalue: 9.5, step: 1, fraction: 16384, between: "blend", look: { background: "white" }, clip: { shown: true, point: [20, 20, 20], normal: [0, 0.6, 0.8] }, ...view },
    {
      time: 6, text: "The end.", step: 2, between: "hold", clip: { shown: false, point: [0, 0, 0], normal: [0, 0, 1] }, clip_box: { shown: true, low: [0, 2, 0], high: [39, 99, 30.5] },
      slices: { planes: [{ point: [20, 20, 20], normal: [0, 0, 1] }, { point: [9, 20, 20], normal: [1, 0, 0] }], picked: 1, coloring: { by: "value", map: "coolwarm", range: [5, 9] }, isolines: false },
    },
    { time: 8, text: "Slices alone.", slices: { planes: [{ point: [20, 20, 20], normal: [0, 1, 0] }], alone: true }, clip_box: { shown: false, low: [0, 0, 0], high: [0, 0, 0] } },
  ];
  writeFileSync(join(folder, "tour.isochron-story"), JSON.stringify({ format: "isochron keys", version: 1, keys }));
  writeFileSync(list, JSON.stringify({ files: ["ball.isochron"], story: "tour.isochron-story" }));
  const page = await open();
  const heading = () => page.textContent("#card .heading");
  await settled(page, cells(0, 12.5));
  expect(await heading()).toBe("1 of 4");
  expect(await page.textContent("#card .text")).toBe(keys[0]!.text);
  expect(await page.$("#card .text *")).toBeNull();
  const first = await page.evaluate("location.hash") as string;
  await page.keyboard.press("PageDown");
  await settled(page, cells(1, 9.5, 16384));
  await page.waitForSelector('#card[data-moving="false"]');
  expect(await heading()).toBe("2 of 4: half");
  expect(await page.inputValue("#clip-normal")).toBe("0, 0.6, 0.8");
  expect(await page.isVisible("#card-line line")).toBe(true);
  await page.waitForFunction(() => /told=3/.test(location.hash) && /fraction=16384/.test(location.hash) && /view=20(%2C|\.0)/.test(location.hash));
  const link = new URLSearchParams(new URL(page.url()).hash.slice(1));
  expect(link.get("planes")).toBe("20/20/20/0/0.6/0.8");
  expect(link.get("background")).toBe("#ffffff");
  // The head at 0, 1.6, 0 among the data: (head - translation) / scale, turned back, less their origin; the camera is on the line ahead.
  const camera = link.get("view")!.split(",").map(Number);
  expect(camera[0]).toBeCloseTo(20, 3);
  expect(camera[2]).toBeCloseTo(12, 3);
  expect(camera.slice(3)).toEqual([expect.closeTo(20, 3), expect.closeTo(19.5, 3), expect.closeTo(12, 3)]);
  const again = await browser.newPage({ viewport: { width: 800, height: 600 } });
  await again.goto(page.url());
  await settled(again, cells(1, 9.5, 16384));
  expect(await again.textContent("#card .heading")).toBe("2 of 4: half");
  expect(new URLSearchParams(new URL(again.url()).hash.slice(1)).get("view")).toBe(link.get("view"));
  // A link that names a step alone shows it.
  const bare = await browser.newPage();
  await bare.goto(`${address}#told=3`);
  await settled(bare, cells(1, 9.5, 16384));
  await page.click("#card .next");
  await settled(page, cells(2, 9.5));
  await page.waitForFunction(() => location.hash.includes("told=4") && !location.hash.includes("planes"));
  const end = new URLSearchParams(new URL(page.url()).hash.slice(1));
  expect(Object.fromEntries(["slices", "slicemap", "slicerange", "isolines", "box", "alone"].map((name) => [name, end.get(name)]))).toEqual({
    slices: "20/20/20/0/0/1,9/20/20/1/0/0", slicemap: "coolwarm", slicerange: "5,9", isolines: "0", box: "0,2,0,39,39,30.5", alone: null,
  });
  await page.keyboard.press("PageDown");
  await settled(page, 0);
  expect(await page.textContent("#chip")).toBe("exact: slices alone");
  expect(await page.isChecked("#boxed")).toBe(false);
  expect(await page.isDisabled("#card .next")).toBe(true);
  await page.keyboard.press("PageUp");
  await page.$eval("#card", (card) => {
    for (const [name, clientX] of [["pointerdown", 100], ["pointerup", 200]] as const) card.dispatchEvent(new PointerEvent(name, { pointerType: "touch", clientX }));
  });
  await settled(page, cells(1, 9.5, 16384));
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => location.hash.includes("told=0"));
  expect(await page.isVisible("#card")).toBe(false);
  await page.keyboard.press("PageDown"); // belongs to a story that is told
  expect(await page.isVisible("#card")).toBe(false);
  await page.click("#tell");
  await settled(page, cells(0, 12.5));
  expect(first).toContain("told=1");
  writeFileSync(list, JSON.stringify({ files: ["ball.isochron"] }));
  await page.close();
  await again.close();
  await bare.close();
});

test.each<[string, string, RegExp]>([
  ["damaged", '{"format": "isochron keys", "version": 1, "keys": [{"time": 0, "text": 7}]}', /tour.isochron-story: key 1: text: expected a text/],
  ["about other data", '{"format": "isochron keys", "version": 1, "keys": [{"time": 0, "text": "a", "step": 3}]}', /tour.isochron-story: key 1: step: expected 0 to 2, got 3/],
  ["too large", " ".repeat((1 << 22) + 1), /tour.isochron-story: expected at most 4 MiB/],
])("says in a line that a story is %s, and shows the data", async (_, story, said) => {
  writeFileSync(join(folder, "tour.isochron-story"), story);
  const page = await open("#isovalue=12.5&story=tour.isochron-story");
  await settled(page, cells(0, 12.5));
  expect(await page.textContent("#chip")).toMatch(said);
  expect(await page.isVisible("#card")).toBe(false);
  expect(await page.isVisible("#tell")).toBe(false);
  await page.close();
});

test("shows slices by keys, field and link, beside the surface and alone", async () => {
  const page = await open("#isovalue=12.5&background=%23000000&view=19.75,-60,19.75,19.75,19.75,19.75");
  await settled(page, cells(0, 12.5));
  await page.keyboard.press("6"); // across z
  await page.waitForFunction(() => location.hash.includes("slices=19.5%2F19.5%2F19.5%2F0%2F0%2F1"));
  await page.fill("#slice-normal", "0, 2, 0");
  await page.press("#slice-normal", "Enter");
  await page.evaluate(() => (document.activeElement as HTMLElement).blur());
  await page.keyboard.press("h");
  await settled(page, 0);
  expect(await page.textContent("#chip")).toBe("exact: slices alone");
  expect(await page.textContent("#slice-words")).toMatch(/^0.4.* to .* mm$/);
  await drawn(page);
  // In the middle of the ball are the lowest values, which are dark violet in viridis; in its corners are green ones.
  const [dark, green, beside] = [await pixel(page, 0.5, 0.5), await pixel(page, 0.5 + 0.22, 0.5 - 0.3), await pixel(page, 0.5 + 0.28, 0.5)];
  expect(dark[2]!).toBeGreaterThan(dark[1]! + 40);
  expect(green[1]!).toBeGreaterThan(green[2]! + 20);
  expect(beside).toEqual([0, 0, 0]);
  await page.keyboard.press("ArrowUp");
  await page.waitForFunction(() => location.hash.includes("slices=19.5%2F20.5%2F19.5%2F0%2F1%2F0"));
  const again = await browser.newPage({ viewport: { width: 800, height: 600 } });
  await again.goto(page.url());
  await settled(again, 0);
  expect(await again.isChecked("#alone")).toBe(true);
  expect(await again.inputValue("#slice-normal")).toBe("0, 1, 0");
  await page.keyboard.press("h");
  await settled(page, cells(0, 12.5));
  await page.keyboard.press("Delete");
  await page.waitForFunction(() => !location.hash.includes("slices"));
  expect(await page.isVisible("#slice-parts")).toBe(false);
  await page.close();
  await again.close();
});

test("cuts surfaces by planes and a box, and links hold them", async () => {
  // Seen from the front, x to the right and z upwards; the ball's radius is 12.5 around 19.75.
  const page = await open("#isovalue=12.5&background=%23000000&view=19.75,-60,19.75,19.75,19.75,19.75");
  await settled(page, cells(0, 12.5));
  const seen = async () => {
    await drawn(page);
    const light = async (x: number, z: number) => (await pixel(page, 0.5 + x, 0.5 - z)).some((n) => n > 40);
    const [topLeft, topRight] = [await light(-0.08, 0.12), await light(0.08, 0.12)];
    return { topLeft, topRight, bottomLeft: await light(-0.08, -0.12), bottomRight: await light(0.08, -0.12) };
  };
  const holds = (words: string) => page.waitForFunction((each) => decodeURIComponent(location.hash).includes(each), words);
  const all = { topLeft: true, topRight: true, bottomLeft: true, bottomRight: true };
  expect(await seen()).toEqual(all);
  await page.keyboard.press("7"); // across z, and the upper half is cut away
  await holds("planes=19.5/19.5/19.5/0/0/1");
  expect(await seen()).toEqual({ ...all, topLeft: false, topRight: false });
  await page.click("#clip-flip");
  await holds("planes=19.5/19.5/19.5/0/0/-1");
  expect(await seen()).toEqual({ ...all, bottomLeft: false, bottomRight: false });
  await page.click("#clip-add"); // across x
  await page.evaluate(() => (document.activeElement as HTMLElement).blur());
  await page.keyboard.press("ArrowDown");
  await holds("planes=19.5/19.5/19.5/0/0/-1,18.5/19.5/19.5/1/0/0");
  expect(await seen()).toEqual({ topLeft: true, topRight: false, bottomLeft: false, bottomRight: false });
  await page.check("#boxed");
  await page.fill("#box-parts label:first-child input:first-child", "15,5");
  await page.press("#box-parts label:first-child input:first-child", "Enter");
  await holds("box=15.5,0,0,39,39,39");
  expect((await seen()).topLeft).toBe(false);
  const again = await browser.newPage({ viewport: { width: 800, height: 600 } });
  await again.goto(page.url());
  await settled(again, cells(0, 12.5));
  expect(await again.$$eval("#clip option", (options) => options.length)).toBe(2);
  expect(await again.isChecked("#boxed")).toBe(true);
  expect(await again.inputValue("#box-parts label:first-child input:first-child")).toBe("15.5");
  await page.uncheck("#boxed");
  await page.click("#clip-remove");
  await page.click("#clip-remove");
  await page.waitForFunction(() => !/planes|box/.test(location.hash));
  expect(await seen()).toEqual(all);
  await page.close();
  await again.close();
});

test("shows ghosts of other steps, also while time plays, and links hold them", async () => {
  // Seen from the front: the ball shrinks by 1 each step, so that only the ghost of an earlier step is beside it.
  const page = await open("#isovalue=12.5&step=1&background=%23000000&view=19.75,-60,19.75,19.75,19.75,19.75");
  await settled(page, cells(1, 12.5));
  const beside = () => pixel(page, 0.5, 0.5 - (12.05 / 77.4) * (800 / 600)); // 12.05 above the middle
  expect(await beside()).toEqual([0, 0, 0]);
  const words = () => page.$$eval("#ghost-parts .words div", (lines) => lines.map((line) => line.textContent!.replace("■ ", "")));
  await page.keyboard.press("g");
  await page.waitForFunction(() => document.querySelectorAll("#ghost-parts .words div").length === 2);
  expect(await words()).toEqual(["0", "2"]);
  await settled(page, cells(1, 12.5));
  await drawn(page);
  const blue = await beside();
  expect(blue[2]!).toBeGreaterThan(blue[0]! + 10);
  await page.fill("#ghost-parts input:first-child", "0");
  await page.press("#ghost-parts input:first-child", "Enter");
  await page.waitForFunction(() => document.querySelectorAll("#ghost-parts .words div").length === 1);
  await page.waitForFunction(() => decodeURIComponent(location.hash).includes("ghosts=0/2/1/0.25"));
  await drawn(page);
  expect(await beside()).toEqual([0, 0, 0]);
  const again = await browser.newPage({ viewport: { width: 800, height: 600 } });
  await again.goto(page.url());
  await settled(again, cells(1, 12.5));
  await again.waitForFunction(() => document.querySelectorAll("#ghost-parts .words div").length === 1);
  // Time goes on when the ghosts are there, too.
  await again.selectOption("#speed", "24");
  await again.evaluate(() => {
    const seen = new Set<string>();
    new MutationObserver(() => {
      seen.add(`${document.getElementById("moment")!.textContent!.slice(5, 6)}: ${[...document.querySelectorAll("#ghost-parts .words div")].map((line) => line.textContent!.slice(2)).join()}`);
      document.body.dataset["seen"] = [...seen].join(" ");
    }).observe(document.querySelector("#ghost-parts .words")!, { childList: true });
  });
  await again.click("#play");
  await again.waitForFunction(() => /1: 1,2/.test(document.body.dataset["seen"] ?? "") && /2: 2/.test(document.body.dataset["seen"] ?? ""));
  await page.close();
  await again.close();
});

test("says dates of the data's calendar", async () => {
  const file = join(folder, "dated.isochron");
  execFileSync(program, ["build", ...[0, 1, 2].map((t) => join(folder, `t${t}.raw`)), "-o", file, "--dims", "40", "40", "40", "--type", "f32", "--time-unit", "days since 2000-02-29 06:00 (360_day)"], { stdio: "pipe" });
  const page = await open("#file=dated.isochron&isovalue=12.5&step=1");
  await exact(page);
  expect(await page.textContent("#moment")).toBe("step 2 of 3: 2000-02-30 06:00 (360_day)");
  expect(await page.getAttribute("#time", "aria-valuetext")).toBe("step 2 of 3: 2000-02-30 06:00 (360_day)");
  expect(await page.getAttribute("#to", "title")).toBe("2000-03-01 06:00 (360_day)");
  expect(await page.title()).toBe("dated.isochron, 2000-02-30 06:00 (360_day) - Isochron");
  await page.check("#between");
  await page.$eval("#time", (slider: HTMLInputElement) => {
    slider.value = "1.5";
    slider.dispatchEvent(new Event("input"));
  });
  await page.waitForFunction(() => document.getElementById("moment")!.textContent === "between steps 2 and 3 of 3: 2000-02-30 18:00 (360_day)");
  await page.close();
});

test("a link holds settings alone", async () => {
  const page = await open("#file=../../etc/passwd&isovalue=12.5&color=javascript:alert(1)");
  expect(await exact(page)).toBe(cells(0, 12.5));
  expect(page.url()).not.toContain("passwd");
  await page.close();
});

test("asks for little of the file", async () => {
  server.asked = 0;
  const page = await open("#isovalue=12.5");
  await exact(page);
  expect(server.asked).toBeLessThan(12);
  expect(statSync(join(folder, "ball.isochron")).size).toBeGreaterThan(100_000);
  await page.close();
});
