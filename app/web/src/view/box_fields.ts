// The clip box in the panel: whether there is one, and where it ends.
import type { Info } from "../reader/index_file";
import { boxWithin, wholeBox, type Box } from "./planes";

export class BoxFields {
  private now: Box | null = null;
  /** Low and high end of each axis. */
  private readonly ends: HTMLInputElement[];

  /** @param tick whether there is a box @param parts holds the fields of its ends @param changed called after it was changed */
  constructor(
    private readonly tick: HTMLInputElement,
    private readonly parts: HTMLElement,
    private readonly info: () => Info,
    changed: () => void,
  ) {
    this.ends = [...parts.querySelectorAll("input")];
    tick.addEventListener("change", () => {
      this.now = tick.checked ? wholeBox(info()) : null;
      changed();
    });
    this.ends.forEach((end, i) =>
      end.addEventListener("change", () => {
        const number = Number(end.value.replace(",", "."));
        const moved = Number.isFinite(number) ? boxWithin(info(), this.now!.map((n, place) => (place === this.placeOf(i) ? number : n))) : null;
        if (moved) this.now = moved;
        end.value = this.wordOf(i);
        changed();
      }),
    );
  }
  private placeOf(field: number): number {
    return (field >> 1) + 3 * (field & 1);
  }
  private wordOf(field: number): string {
    return String(+this.now![this.placeOf(field)]!.toPrecision(6));
  }
  get box(): Box | null {
    return this.now;
  }
  /** @param box is cut to the data; null, or nothing left of it: there is none */
  set(box: Box | null): void {
    this.now = box && boxWithin(this.info(), box);
  }
  show(): void {
    this.tick.checked = this.now !== null;
    this.parts.hidden = this.now === null;
    this.ends.forEach((end, i) => {
      if (this.now && document.activeElement !== end) end.value = this.wordOf(i);
    });
  }
}
