// A list of planes in the panel: adds, removes, turns and moves them.
import type { Info } from "../reader/index_file";
import { acrossAxis, along, movedTo, nextAxis, planeAcross, reachAlong, type Plane } from "./planes";

export class PlaneList {
  planes: Plane[] = [];
  picked = 0;
  private readonly list: HTMLSelectElement;
  private readonly normal: HTMLInputElement;
  private readonly place: HTMLInputElement;

  /**
   * @param name of the list: `NAME` is its choice, `NAME-add`, `NAME-remove`, `NAME-parts`, `NAME-normal`, `NAME-axes` and
   * `NAME-place` its parts
   * @param most planes that there may be @param changed called after one was changed; `drags`: more will follow soon
   */
  constructor(
    private readonly name: string,
    private readonly most: number,
    private readonly info: () => Info,
    private readonly changed: (drags: boolean) => void,
  ) {
    this.list = this.part<HTMLSelectElement>("");
    this.normal = this.part<HTMLInputElement>("-normal");
    this.place = this.part<HTMLInputElement>("-place");
    this.list.addEventListener("change", () => {
      this.picked = Number(this.list.value);
      this.show();
    });
    this.part("-add").addEventListener("click", () => this.add());
    this.part("-remove").addEventListener("click", () => {
      this.planes.splice(this.picked, 1);
      this.set(this.planes, this.picked);
      this.changed(false);
    });
    this.normal.addEventListener("change", () => this.turn(this.normal.value.split(",").map(Number)));
    this.part("-axes").querySelectorAll("button").forEach((button, axis) => button.addEventListener("click", () => this.turn([0, 1, 2].map((i) => Number(i === axis)))));
    for (const event of ["input", "change"])
      this.place.addEventListener(event, () => {
        const { low, high } = reachAlong(this.info(), this.now!.slice(3));
        this.move(low + Number(this.place.value) * (high - low), event === "input");
      });
  }

  private part<T extends HTMLElement>(name: string): T {
    return document.getElementById(this.name + name) as T;
  }
  /** The plane that is picked. */
  get now(): Plane | undefined {
    return this.planes[this.picked];
  }
  set(planes: Plane[], picked = 0): void {
    this.planes = planes.slice(0, this.most);
    this.picked = Math.max(0, Math.min(picked, this.planes.length - 1));
  }
  /** Adds a plane across the axis after that of the one that is picked. */
  add(): void {
    const info = this.info();
    const added = planeAcross(info, acrossAxis(info, nextAxis(info, this.now)));
    if (!added || this.planes.length === this.most) return;
    this.set([...this.planes, added], this.planes.length);
    this.changed(false);
  }
  /** Turns the picked plane about its point. */
  turn(normal: readonly number[]): void {
    const turned = planeAcross(this.info(), normal);
    if (!turned || !this.now) return this.show();
    this.planes[this.picked] = [...this.now.slice(0, 3), ...turned.slice(3)];
    this.changed(false);
  }
  /** Moves the picked plane along its normal. */
  move(at: number, drags: boolean): void {
    if (!this.now) return;
    this.planes[this.picked] = movedTo(this.info(), this.now, at);
    this.changed(drags);
  }
  /** Moves the picked plane by cells. */
  nudge(cells: number): void {
    if (this.now) this.move(along(this.now) + cells * reachAlong(this.info(), this.now.slice(3)).cell, false);
  }

  /** Shows the list, and where the one is that is moved. */
  show(): void {
    const { planes, now } = this;
    this.list.replaceChildren(...(planes.length ? planes.map((_, i) => new Option(String(i + 1), String(i))) : [new Option("none", "")]));
    this.list.value = planes.length ? String(this.picked) : "";
    this.part<HTMLButtonElement>("-remove").disabled = planes.length === 0;
    this.part<HTMLButtonElement>("-add").disabled = planes.length === this.most;
    this.part("-parts").hidden = planes.length === 0;
    if (!now) return;
    if (document.activeElement !== this.normal) this.normal.value = now.slice(3).map((n) => +n.toPrecision(4) + 0).join(", ");
    const { low, high } = reachAlong(this.info(), now.slice(3));
    if (document.activeElement !== this.place) this.place.value = String((along(now) - low) / (high - low));
  }
}
