// The card of a story in a headset: on a hand's panel, with buttons that rays press.
import * as THREE from "three";

/** What a card says. */
export interface CardWords {
  heading: string;
  text: string;
  /** Whether there is a step before it, and one after it. */
  previous: boolean;
  next: boolean;
}
export type CardButton = "previous" | "next" | "leave";
const BUTTONS: readonly CardButton[] = ["previous", "next", "leave"];
const LABELS = { previous: "Previous", next: "Next", leave: "Leave" };

const [WIDTH, HEIGHT, EDGE, BAR] = [768, 512, 24, 84]; // pixels
const METERS = 0.3;

/** A text in lines that are not wider than `most`, as `width` measures them. */
export function wrapped(text: string, most: number, width: (line: string) => number): string[] {
  return text.split("\n").flatMap((paragraph) => {
    const lines = [""];
    for (const word of paragraph.split(" ")) {
      const last = lines.at(-1)!;
      const longer = last === "" ? word : `${last} ${word}`;
      if (last !== "" && width(longer) > most) lines.push(word);
      else lines[lines.length - 1] = longer;
    }
    return lines;
  });
}

export class HandCard {
  readonly mesh: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshBasicMaterial>;
  private readonly canvas = document.createElement("canvas");
  private shown = "";
  private readonly rays = new THREE.Raycaster();

  constructor() {
    this.canvas.width = WIDTH;
    this.canvas.height = HEIGHT;
    this.mesh = new THREE.Mesh(
      new THREE.PlaneGeometry(METERS, (METERS * HEIGHT) / WIDTH),
      new THREE.MeshBasicMaterial({ map: new THREE.CanvasTexture(this.canvas), side: THREE.DoubleSide }),
    );
    this.mesh.visible = false;
  }

  /** @param words null: no story is told */
  show(words: CardWords | null): void {
    this.mesh.visible = words !== null;
    const all = JSON.stringify(words);
    if (!words || all === this.shown) return;
    this.shown = all;
    const context = this.canvas.getContext("2d")!;
    context.fillStyle = "#171a21";
    context.fillRect(0, 0, WIDTH, HEIGHT);
    context.fillStyle = "#f3b64b";
    context.font = "34px system-ui, sans-serif";
    context.fillText(words.heading, EDGE, 50, WIDTH - 2 * EDGE);
    // As large as it fits.
    const room = HEIGHT - BAR - 76;
    let size = 34;
    let lines: string[] = [];
    for (; size >= 14; size -= 2) {
      context.font = `${size}px system-ui, sans-serif`;
      lines = wrapped(words.text, WIDTH - 2 * EDGE, (line) => context.measureText(line).width);
      if (lines.length * size * 1.3 <= room) break;
    }
    context.fillStyle = "#e8eaf0";
    lines.slice(0, Math.floor(room / (size * 1.3))).forEach((line, i) => context.fillText(line, EDGE, 76 + (i + 0.8) * size * 1.3, WIDTH - 2 * EDGE));
    context.font = "32px system-ui, sans-serif";
    context.textAlign = "center";
    BUTTONS.forEach((button, i) => {
      const there = button === "leave" || words[button];
      const width = WIDTH / BUTTONS.length;
      context.fillStyle = there ? "#3a4254" : "#20242e";
      context.fillRect(i * width + 6, HEIGHT - BAR, width - 12, BAR - 8);
      context.fillStyle = there ? "#e8eaf0" : "#5b6478";
      context.fillText(LABELS[button], (i + 0.5) * width, HEIGHT - BAR / 2 + 8);
    });
    context.textAlign = "start";
    this.mesh.material.map!.needsUpdate = true;
  }

  /** What the ray of a hand points at; `card`: at no button of it, null: past the card. */
  at(hand: THREE.Object3D): CardButton | "card" | null {
    if (!this.mesh.visible) return null;
    hand.updateMatrixWorld();
    this.rays.ray.origin.setFromMatrixPosition(hand.matrixWorld);
    this.rays.ray.direction.set(0, 0, -1).transformDirection(hand.matrixWorld);
    const uv = this.rays.intersectObject(this.mesh, false)[0]?.uv;
    if (!uv) return null;
    return (1 - uv.y) * HEIGHT < HEIGHT - BAR ? "card" : BUTTONS[Math.min(BUTTONS.length - 1, Math.floor(uv.x * BUTTONS.length))]!;
  }
}
