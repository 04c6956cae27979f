// Color maps: from a share of the way through a range to a color.

/** Colors at equal distances, sRGB from 0 to 255. */
const MAPS = {
  // Viridis (S. van der Walt and N. Smith, 2015, CC0), each thirty-second of it.
  viridis: [
    [68, 1, 84], [72, 21, 103], [72, 38, 119], [69, 55, 129], [64, 71, 136], [57, 86, 140], [51, 99, 141], [45, 112, 142], [40, 125, 142],
    [35, 138, 141], [31, 150, 139], [32, 163, 135], [41, 175, 127], [60, 187, 117], [85, 198, 103], [115, 208, 85], [149, 216, 64], [184, 222, 41],
    [220, 227, 25], [253, 231, 37],
  ],
  // Blue and red around a light middle (K. Moreland, 2009, doi:10.1007/978-3-642-10520-3_9).
  coolwarm: [[59, 76, 192], [98, 130, 234], [141, 176, 254], [184, 208, 249], [221, 221, 221], [245, 196, 173], [244, 154, 123], [222, 96, 77], [180, 4, 38]],
  gray: [[20, 20, 20], [245, 245, 245]],
} as const;

export type MapName = keyof typeof MAPS;
export const MAP_NAMES = Object.keys(MAPS) as MapName[];

/** The color at a share from 0 to 1, as sRGB from 0 to 255; missing values are gray. */
export function colorAt(map: MapName, share: number): [number, number, number] {
  if (Number.isNaN(share)) return [128, 128, 128];
  const colors = MAPS[map];
  const at = Math.min(1, Math.max(0, share)) * (colors.length - 1);
  const low = Math.min(colors.length - 2, Math.floor(at));
  const part = at - low;
  return [0, 1, 2].map((i) => colors[low]![i]! + part * (colors[low + 1]![i]! - colors[low]![i]!)) as [number, number, number];
}

/** Colors of values, linear from 0 to 1, three for each. */
export function colorsOf(map: MapName, values: Float32Array, low: number, high: number): Float32Array {
  // A table: thousands of shades are enough, and the light of each is made linear once.
  const SHADES = 1024;
  const table = new Float32Array(3 * (SHADES + 1));
  for (let i = 0; i <= SHADES; ++i)
    colorAt(map, i / SHADES).forEach((level, k) => {
      const light = level / 255;
      table[3 * i + k] = light <= 0.04045 ? light / 12.92 : ((light + 0.055) / 1.055) ** 2.4;
    });
  const out = new Float32Array(3 * values.length);
  const scale = high > low ? SHADES / (high - low) : 0;
  for (let i = 0; i < values.length; ++i) {
    const value = values[i]!;
    if (Number.isNaN(value)) {
      out.fill(0.216, 3 * i, 3 * i + 3);
      continue;
    }
    const shade = Math.round(Math.min(SHADES, Math.max(0, (value - low) * scale)));
    out[3 * i] = table[3 * shade]!;
    out[3 * i + 1] = table[3 * shade + 1]!;
    out[3 * i + 2] = table[3 * shade + 2]!;
  }
  return out;
}

/** Draws the legend: the colors, and numbers at both ends. */
export function drawLegend(canvas: HTMLCanvasElement, map: MapName): void {
  const context = canvas.getContext("2d");
  if (!context) return;
  canvas.width = 128;
  canvas.height = 1;
  for (let x = 0; x < canvas.width; ++x) {
    context.fillStyle = `rgb(${colorAt(map, x / (canvas.width - 1)).map(Math.round).join(" ")})`;
    context.fillRect(x, 0, 1, 1);
  }
}
