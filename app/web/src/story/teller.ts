// Tells a story: its card, and the ways to its steps by buttons, keys, touch and the hands of a headset.
import { storyHeading, storyStep, type Key } from "./story";

/** Pixels that a finger moves sideways to go to another step. */
const SWIPE = 40;

/** What the page does for a story. */
export interface Stage {
  /** Shows all of a key but its view. */
  show(key: Key): void;
  /** Goes to the view of a key. @param leaps at once */
  go(key: Key, leaps: boolean): void;
  /** Another step is told, or none: `told` has changed. */
  changed(): void;
}

export class Teller {
  private keys: readonly Key[] = [];
  /** Number of the key that is told, from 1; 0: none. */
  told = 0;

  /**
   * @param card with the parts `.heading`, `.text`, and the buttons `.previous`, `.next`, `.leave`
   * @param begin the button that begins the story, or goes back to it
   */
  constructor(
    readonly card: HTMLElement,
    private readonly begin: HTMLButtonElement,
    private readonly stage: Stage,
  ) {
    for (const button of ["previous", "next", "leave"] as const) this.part(button).addEventListener("click", () => this.press(button));
    begin.addEventListener("click", () => this.onwards());
    let from: number | null = null;
    card.addEventListener("pointerdown", (event) => (from = event.pointerType === "mouse" ? null : event.clientX));
    card.addEventListener("pointerup", (event) => {
      const moved = from === null ? 0 : event.clientX - from;
      from = null;
      if (moved < -SWIPE) this.onwards();
      if (moved > SWIPE) this.back();
    });
  }

  /** @param told the key that is told; 0: none; null: the first step @param shows it, at once */
  open(keys: readonly Key[], told: number | null, shows: boolean): void {
    this.keys = keys;
    this.begin.hidden = false;
    const key = told ?? storyStep(keys, 0).next;
    this.tell(keys[key - 1]?.text ? key : 0, shows ? true : null);
  }
  /** The key that is told. */
  get key(): Key | null {
    return this.keys[this.told - 1] ?? null;
  }
  get heading(): string {
    return storyHeading(this.keys, this.told);
  }
  get there(): boolean {
    return this.keys.length > 0;
  }
  /** Whether there is a step before the one that is told, and one after it. */
  get can(): { previous: boolean; next: boolean } {
    const { previous, next } = storyStep(this.keys, this.told);
    return { previous: previous > 0, next: next > 0 };
  }
  press(button: "previous" | "next" | "leave"): void {
    ({ previous: () => this.back(), next: () => this.onwards(), leave: () => this.leave() })[button]();
  }

  onwards(): void {
    this.to(storyStep(this.keys, this.told).next);
  }
  back(): void {
    this.to(storyStep(this.keys, this.told).previous);
  }
  leave(): void {
    this.tell(0, null);
  }
  private to(key: number): void {
    if (key) this.tell(key, false);
  }

  /** The keys of the program as far as browsers leave them free, and those that remote controls of talks send. @return whether it was one */
  pressed({ key, altKey, metaKey, shiftKey, ctrlKey }: KeyboardEvent): boolean {
    if (!this.there || altKey || metaKey) return false;
    // Ctrl begins a story, too; without it, the key belongs to a story that is told.
    const ours = this.told > 0 || ctrlKey;
    if (key === "PageDown" && ours && !shiftKey) this.onwards();
    else if (key === "PageUp" && ours && !shiftKey) this.back();
    else if (this.told > 0 && (key === "Escape" || (key === "PageUp" && ctrlKey && shiftKey))) this.leave();
    else return false;
    return true;
  }

  /** @param leaps to the view; null: the view stays */
  private tell(told: number, leaps: boolean | null): void {
    this.told = told;
    const key = this.key;
    this.card.hidden = key === null;
    if (key) {
      const { can } = this;
      this.part("heading").textContent = this.heading;
      this.part("text").textContent = key.text;
      this.part("text").scrollTop = 0;
      this.part<HTMLButtonElement>("previous").disabled = !can.previous;
      this.part<HTMLButtonElement>("next").disabled = !can.next;
      if (leaps !== null) {
        this.stage.show(key);
        this.stage.go(key, leaps);
      }
    }
    this.stage.changed();
  }
  private part<T extends HTMLElement>(name: string): T {
    return this.card.querySelector<T>(`.${name}`)!;
  }
}
