// Ghosts in the panel: how many, how far apart, and of which moments they are.
import { areShown, ghostColor, MOST_GHOSTS, WIDEST_GHOSTS, type Ghosts, type Moment } from "./ghosts";

const FIELDS = [["earlier", 0, MOST_GHOSTS], ["later", 0, MOST_GHOSTS], ["every", 1, WIDEST_GHOSTS], ["opacity", 0, 1]] as const;

export class GhostPanel {
  private readonly fields: HTMLInputElement[];

  /** @param parts holds the fields, in their order, and `.words` @param changed called after a setting was changed */
  constructor(
    private readonly ghosts: Ghosts,
    private readonly tick: HTMLInputElement,
    private readonly parts: HTMLElement,
    changed: () => void,
  ) {
    this.fields = [...parts.querySelectorAll("input")];
    tick.addEventListener("change", () => {
      ghosts.toggle();
      changed();
    });
    this.fields.forEach((field, i) =>
      field.addEventListener("change", () => {
        const [name, low, high] = FIELDS[i]!;
        const number = Math.min(high, Math.max(low, Number(field.value)));
        if (Number.isFinite(number)) ghosts.settings = { ...ghosts.settings, [name]: name === "opacity" ? number : Math.round(number) };
        changed();
      }),
    );
  }

  /** @param there whether the series can have any @param color of the surface @param momentOf a ghost's moment in words */
  show(there: boolean, color: string, now: Moment, momentOf: (at: Moment) => string): void {
    const { settings, shown, wished } = this.ghosts;
    this.tick.checked = areShown(settings);
    this.tick.parentElement!.hidden = !there;
    this.parts.hidden = !this.tick.checked || !there;
    this.fields.forEach((field, i) => {
      if (document.activeElement !== field) field.value = String(settings[FIELDS[i]![0]]);
    });
    const lines = shown.map((ghost) => {
      const line = document.createElement("div");
      const mark = line.appendChild(document.createElement("span"));
      mark.textContent = "■ ";
      mark.style.color = ghostColor(color, ghost, now, settings);
      line.append(`${momentOf(ghost)}${ghost.level ? ", simplified" : ""}`);
      return line;
    });
    const words = this.parts.querySelector(".words")!;
    words.replaceChildren(...lines);
    if (shown.length < wished.length) words.append("more come");
    else if (!shown.length) words.append("the series has no such steps");
  }
}
