// The page in a scripted headset: both eyes see the data, hands move and scale them, sticks change isovalue and time.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { chromium, type Browser, type Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { RangeServer } from "./range_server";

const program = process.env["ISOCHRON_PROGRAM"] ?? "isochron";
let folder: string;
let server: RangeServer;
let browser: Browser;
let page: Page;

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "isochron-headset-"));
  const n = 32;
  const names = [0, 1, 2].map((t) => {
    const values = Float32Array.from({ length: n ** 3 }, (_, i) => Math.hypot((i % n) - 15.5, (Math.floor(i / n) % n) - 15.5, Math.floor(i / n / n) - 15.5) + t);
    const name = join(folder, `t${t}.raw`);
    writeFileSync(name, values);
    return name;
  });
  execFileSync(program, ["build", ...names, "-o", join(folder, "ball.isochron"), "--dims", `${n}`, `${n}`, `${n}`, "--type", "f32"], { stdio: "pipe" });
  writeFileSync(join(folder, "site.json"), JSON.stringify({ files: ["ball.isochron"], story: "tour.isochron-story" }));
  const keys = [
    { time: 0, text: "One." },
    { time: 2, name: "near", text: "Two: the data stand to the right, and much smaller.", head: [0, 1.6, 0, 0, 0, 0, 1], room_from_physical: { translation: [0.1, 1.4, -0.8], rotation: [0, 0, 0, 1], scale: 0.01 } },
  ];
  writeFileSync(join(folder, "tour.isochron-story"), JSON.stringify({ format: "isochron keys", version: 1, keys }));
  server = new RangeServer([new URL("../site", import.meta.url).pathname, folder]);
  browser = await chromium.launch({ executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  page = await browser.newPage({ viewport: { width: 800, height: 600 } });
  const runtime = readFileSync(join(dirname(createRequire(import.meta.url).resolve("iwer/package.json")), "build/iwer.min.js"), "utf8");
  await page.addInitScript(`${runtime}
    window.headset = new IWER.XRDevice(IWER.metaQuest3);
    window.headset.installRuntime({ forceInstall: true });
    window.headset.stereoEnabled = true;
    window.headset.position.set(0, 1.6, 0);`);
  await page.goto(`${await server.listen()}#isovalue=9.5&background=%23000000&told=0`);
  await page.waitForSelector('#chip[data-exact="true"]');
  await page.click("#enter");
  await page.waitForFunction(() => document.body.classList.contains("inside"), null, { polling: 50 });
});
afterAll(async () => {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
});

/** Runs a script of the headset, then waits for some frames. */
async function act(script: string): Promise<void> {
  await page.evaluate(`(() => { const headset = window.headset; ${script} })()`);
  await page.evaluate("new Promise((done) => { let left = 12; const next = () => (--left ? headset.activeSession ? headset.activeSession.requestAnimationFrame(next) : setTimeout(next, 16) : done()); next(); })");
}
/** The middle and the size of what is bright in each half of the picture: one for each eye. */
async function seen(): Promise<{ x: number; y: number; size: number }[]> {
  return page.evaluate(() => {
    const canvas = document.getElementById("picture") as HTMLCanvasElement;
    const copy = document.createElement("canvas");
    copy.width = canvas.width;
    copy.height = canvas.height;
    const context = copy.getContext("2d")!;
    context.drawImage(canvas, 0, 0);
    const half = canvas.width / 2;
    return [0, 1].map((eye) => {
      const { data } = context.getImageData(eye * half, 0, half, canvas.height);
      let [count, sumX, sumY] = [0, 0, 0];
      for (let i = 0; i < data.length; i += 4)
        // The surface is of a warm color; box, rays and panel are not.
        if (data[i]! > 60 && data[i]! > 1.25 * data[i + 2]! && data[i + 1]! > 1.1 * data[i + 2]! && data[i + 1]! > 0.75 * data[i]!) {
          ++count;
          sumX += (i / 4) % half;
          sumY += Math.floor(i / 4 / half);
        }
      return { x: sumX / count / half, y: sumY / count / canvas.height, size: Math.sqrt(count) / half };
    });
  });
}

test("both eyes see the data in front of the viewer, the left eye farther to the right", async () => {
  await act("");
  if (process.env["ISOCHRON_SHOT"]) await page.screenshot({ path: process.env["ISOCHRON_SHOT"] });
  const [left, right] = await seen();
  for (const eye of [left!, right!]) {
    expect(eye.size).toBeGreaterThan(0.1);
    expect(Math.abs(eye.x - 0.5)).toBeLessThan(0.25);
  }
  expect(left!.x).toBeGreaterThan(right!.x);
});

test("a hand moves the data, and two scale them", async () => {
  await act("headset.controllers.right.position.set(0.2, 1.2, -0.4); headset.controllers.left.position.set(-0.2, 1.2, -0.4);");
  const before = (await seen())[0]!;
  await act("headset.controllers.right.updateButtonValue('trigger', 1);");
  await act("headset.controllers.right.position.set(0.4, 1.35, -0.4);");
  await act("headset.controllers.right.updateButtonValue('trigger', 0);");
  const moved = (await seen())[0]!;
  expect(moved.x).toBeGreaterThan(before.x + 0.03);
  expect(moved.y).toBeLessThan(before.y - 0.02);
  await act("headset.controllers.right.position.set(0.7, 1.35, -0.4);"); // without the trigger
  expect((await seen())[0]!.x).toBeCloseTo(moved.x, 2);
  await act("headset.controllers.right.position.set(0.1, 1.3, -0.6); headset.controllers.left.position.set(-0.1, 1.3, -0.6);");
  await act("headset.controllers.left.updateButtonValue('squeeze', 1); headset.controllers.right.updateButtonValue('squeeze', 1);");
  await act("headset.controllers.right.position.set(0.16, 1.3, -0.6); headset.controllers.left.position.set(-0.16, 1.3, -0.6);");
  await act("headset.controllers.left.updateButtonValue('squeeze', 0); headset.controllers.right.updateButtonValue('squeeze', 0);");
  expect((await seen())[0]!.size).toBeGreaterThan(1.25 * moved.size);
});

test("a story is told by stick and by the ray on its card, and the data stand where a step has them", async () => {
  const told = (key: number) => page.waitForFunction((wanted) => location.hash.includes(`told=${wanted}`), key, { polling: 50 });
  await act("headset.controllers.right.position.set(0.7, 1.35, 0.4); headset.controllers.left.position.set(-0.2, 1.2, -0.4);");
  const before = (await seen())[0]!;
  await page.evaluate("document.getElementById('tell').click()");
  await told(1);
  expect((await seen())[0]!.size).toBeCloseTo(before.size, 2); // it says nothing of the view
  await act("headset.controllers.right.updateAxis('thumbstick', 'x-axis', 1);");
  await act("headset.controllers.right.updateAxis('thumbstick', 'x-axis', 0);");
  await told(2);
  for (let i = 0; i < 4; ++i) await act(""); // dark, then there
  const after = (await seen())[0]!;
  expect(after.size).toBeLessThan(0.8 * before.size);
  if (process.env["ISOCHRON_SHOT"]) await page.screenshot({ path: `${process.env["ISOCHRON_SHOT"]}.story.png` });
  // The card lies above the left hand; its buttons are at its lower edge, the first on the left.
  await act("headset.controllers.left.position.set(0, 1.2, -0.5); headset.controllers.left.quaternion.set(0, 0, 0, 1);");
  await act("headset.controllers.right.quaternion.set(0, 0, 0, 1); headset.controllers.right.position.set(-0.1, 1.2 + 0.19 - 0.086, -0.2);");
  await act("headset.controllers.right.updateButtonValue('trigger', 1);");
  await act("headset.controllers.right.updateButtonValue('trigger', 0);");
  await told(1);
  await act("headset.controllers.right.position.set(0.1, 1.2 + 0.19 - 0.086, -0.2);");
  await act("headset.controllers.right.updateButtonValue('trigger', 1);");
  await act("headset.controllers.right.updateButtonValue('trigger', 0);");
  await told(0);
  await act("headset.controllers.right.position.set(0.7, 1.35, 0.4);");
});

test("sticks change time and isovalue, and leaving gives the page back", async () => {
  await act("headset.controllers.right.updateAxis('thumbstick', 'x-axis', 1);");
  await page.waitForFunction(() => !location.hash.includes("step=0"), null, { polling: 50 }); // it goes round
  await act("headset.controllers.right.updateAxis('thumbstick', 'x-axis', 0);");
  await act("headset.controllers.right.updateAxis('thumbstick', 'y-axis', 1);");
  await act("headset.controllers.right.updateAxis('thumbstick', 'y-axis', 0);");
  const less = () => Number(new URLSearchParams(location.hash.slice(1)).get("isovalue")) < 9.5;
  await page.waitForFunction(less, null, { polling: 50 }); // the link follows once nothing changes
  const isovalue = Number(new URLSearchParams((await page.evaluate("location.hash") as string).slice(1)).get("isovalue"));
  expect(isovalue).toBeGreaterThan(0);
  await page.evaluate("headset.activeSession.end()");
  await page.waitForFunction(() => !document.body.classList.contains("inside"), null, { polling: 50 });
  await page.waitForSelector('#chip[data-exact="true"]');
});
