// The histogram of an array's values, in which the isovalue is dragged.
import type { Info } from "../reader/index_file";

const BARS = 96;

export class Histogram {
  private info: Info | null = null;
  private bars: number[] = [];
  private value = 0;
  private others: readonly number[] = [];
  /** Called while the isovalue is dragged, and at its end. */
  changed: (isovalue: number, done: boolean) => void = () => {};

  constructor(private readonly canvas: HTMLCanvasElement) {
    const at = (event: PointerEvent, done: boolean) => {
      const { low, high } = this.info!;
      const share = (event.clientX - canvas.getBoundingClientRect().left) / canvas.clientWidth;
      this.changed(low + (high - low) * Math.min(1, Math.max(0, share)), done);
    };
    canvas.addEventListener("pointerdown", (event) => {
      if (!this.info) return;
      canvas.setPointerCapture(event.pointerId);
      at(event, false);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (this.info && canvas.hasPointerCapture(event.pointerId)) at(event, false);
    });
    canvas.addEventListener("pointerup", (event) => this.info && at(event, true));
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  show(info: Info): void {
    this.info = info;
    this.bars = new Array<number>(BARS).fill(0);
    const width = 2 ** info.bins.exponent;
    info.bins.counts.forEach((count, i) => {
      const middle = info.slope * (info.bins.first + i + 0.5) * width + info.intercept;
      const bar = Math.floor(((middle - info.low) / (info.high - info.low || 1)) * BARS);
      this.bars[Math.min(BARS - 1, Math.max(0, bar))]! += count;
    });
    this.draw();
  }
  /** @param others isovalues of surfaces that are not dragged */
  mark(isovalue: number, others: readonly number[]): void {
    this.value = isovalue;
    this.others = others;
    this.draw();
  }

  draw(): void {
    const { canvas, info } = this;
    const ratio = window.devicePixelRatio;
    canvas.width = canvas.clientWidth * ratio;
    canvas.height = canvas.clientHeight * ratio;
    const context = canvas.getContext("2d");
    if (!context || !info) return;
    const style = getComputedStyle(canvas);
    const most = Math.log1p(Math.max(...this.bars));
    context.fillStyle = style.getPropertyValue("--quiet");
    this.bars.forEach((count, i) => {
      const height = most > 0 ? (Math.log1p(count) / most) * (canvas.height - 4 * ratio) : 0;
      context.fillRect((i / BARS) * canvas.width, canvas.height - height, canvas.width / BARS - ratio / 2, height);
    });
    const line = (value: number, width: number) => {
      const x = ((value - info.low) / (info.high - info.low || 1)) * canvas.width;
      context.fillRect(x - (width * ratio) / 2, 0, width * ratio, canvas.height);
    };
    context.fillStyle = style.getPropertyValue("--accent");
    for (const value of this.others) line(value, 1);
    line(this.value, 2);
  }
}
