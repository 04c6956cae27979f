// Slices: the colors of values on planes through the data, trilinear in each cell, with lines of isovalues
// (as render/shaders/passes/slice.frag).
import * as THREE from "three";
import { SLICE_ROW, type SliceValues } from "../messages";
import { colorsOf, type MapName } from "./colors";

const SHADES = 1024;
/** Half the width of the lines, in pixels of the page. */
const LINE = 0.8;

/** How slices are colored. */
export interface SliceLook {
  map: MapName;
  /** Values at the ends of the map. */
  range: readonly [number, number];
  lines: readonly { isovalue: number; color: string }[];
}

const VERTEX = `
out vec3 at;
void main() {
  at = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = `
precision highp usampler2D;
uniform usampler2D columns;
uniform sampler2D shares, map, places;
uniform ivec3 cells;
uniform vec3 spacing;
uniform bvec3 uneven;
uniform int axis, lineCount;
uniform vec2 onMap;
uniform float halfWidth;
uniform vec4 lines[8];
in vec3 at;
ivec2 texel(int i) { return ivec2(i % ${SLICE_ROW}, i / ${SLICE_ROW}); }
float place(int of, int i) { return uneven[of] ? texelFetch(places, ivec2(i, of), 0).x : float(i) * spacing[of]; }
int cellAlong(int of, float far) {
  if (!uneven[of]) return clamp(int(floor(far / spacing[of])), 0, cells[of] - 1);
  int low = 0, high = cells[of];
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (place(of, middle) <= far) low = middle; else high = middle;
  }
  return low;
}
void main() {
  ivec3 cell;
  vec3 local;
  for (int i = 0; i < 3; ++i) {
    cell[i] = cellAlong(i, at[i]);
    float low = place(i, cell[i]);
    local[i] = clamp((at[i] - low) / (place(i, cell[i] + 1) - low), 0.0, 1.0);
  }
  int axis1 = axis == 2 ? 0 : axis + 1, axis2 = axis == 0 ? 2 : axis - 1;
  int across = cells[axis1] + 1, first = cell[axis2] * across + cell[axis1];
  float values[8];
  float most = 0.0;
  for (int i = 0; i < 4; ++i) {
    uvec2 column = texelFetch(columns, texel(first + (i & 1) + (i >> 1) * across), 0).xy;
    int from = int(column.x) + cell[axis] - int(column.y);
    values[2 * i] = texelFetch(shares, texel(from), 0).x;
    values[2 * i + 1] = texelFetch(shares, texel(from + 1), 0).x;
    most = max(most, max(values[2 * i], values[2 * i + 1]));
  }
  float a = local[axis], b = local[axis1], c = local[axis2];
  float share = mix(mix(mix(values[0], values[1], a), mix(values[2], values[3], a), b),
                    mix(mix(values[4], values[5], a), mix(values[6], values[7], a), b), c);
  float slope = length(vec2(dFdx(share), dFdy(share)));
  if (most >= 1.5e38) discard;
  vec3 color = texelFetch(map, ivec2(int(clamp(onMap.x * share + onMap.y, 0.0, 1.0) * ${SHADES - 1}.0 + 0.5), 0), 0).rgb;
  for (int i = 0; i < lineCount; ++i) {
    float distant = abs(share - lines[i].w);
    if (!(slope > 0.0) || slope > 1e3 || distant > slope * (halfWidth + 2.0)) continue;
    float pixels = distant / slope;
    color = mix(color, vec3(0.0), 0.6 * clamp(halfWidth + 1.5 - pixels, 0.0, 1.0));
    color = mix(color, lines[i].rgb, clamp(halfWidth + 0.5 - pixels, 0.0, 1.0));
  }
  gl_FragColor = vec4(color, 1.0);
  #include <colorspace_fragment>
}`;

type Slice = THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;

function texture(data: Float32Array | Uint32Array, width: number, format: THREE.PixelFormat, parts: number): THREE.DataTexture {
  const made = new THREE.DataTexture(data, width, data.length / width / parts, format, data instanceof Float32Array ? THREE.FloatType : THREE.UnsignedIntType);
  if (format === THREE.RGIntegerFormat) made.internalFormat = "RG32UI";
  made.needsUpdate = true;
  return made;
}

export class Slices {
  /** In distances along the axes of the grid. */
  readonly group = new THREE.Group();
  private slices: Slice[] = [];
  private wholes: (readonly [number, number])[] = [];

  constructor() {
    this.group.matrixAutoUpdate = false;
  }

  /** @param direction columns: unit vectors along the axes of the grid */
  show(values: readonly SliceValues[], direction: readonly (readonly number[])[]): void {
    for (const { geometry, material } of this.slices) {
      geometry.dispose();
      for (const { value } of Object.values(material.uniforms)) if (value instanceof THREE.Texture) value.dispose();
      material.dispose();
    }
    this.group.clear();
    const [x, y, z] = direction.map((column) => new THREE.Vector3(...(column as [number, number, number])));
    this.group.matrix.makeBasis(x!, y!, z!);
    this.wholes = values.map((each) => each.whole);
    this.slices = values.map((each) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(each.outline, 3));
      geometry.setIndex(Array.from({ length: each.outline.length / 3 - 2 }, (_, i) => [0, i + 1, i + 2]).flat());
      const longest = Math.max(1, ...each.positions.map((at) => at.length));
      const places = new Float32Array(3 * longest);
      each.positions.forEach((at, axis) => places.set(at, axis * longest));
      const uniforms = {
        columns: texture(each.columns, SLICE_ROW, THREE.RGIntegerFormat, 2),
        shares: texture(each.shares, SLICE_ROW, THREE.RedFormat, 1),
        places: texture(places, longest, THREE.RedFormat, 1),
        map: null as THREE.Texture | null,
        cells: each.vertices.map((n) => n - 1),
        spacing: [...each.spacing],
        uneven: each.positions.map((at) => at.length > 0),
        axis: each.axis,
        lineCount: 0,
        onMap: [1, 0],
        halfWidth: 1,
        lines: Array.from({ length: 8 }, () => new THREE.Vector4()),
      };
      const material = new THREE.ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        side: THREE.DoubleSide,
        uniforms: Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, { value }])),
      });
      const slice = new THREE.Mesh(geometry, material);
      slice.frustumCulled = false;
      this.group.add(slice);
      return slice;
    });
  }

  look({ map, range, lines }: SliceLook): void {
    const shares = Float32Array.from({ length: SHADES }, (_, i) => i / (SHADES - 1));
    const shades = colorsOf(map, shares, 0, 1);
    const colors = new Float32Array(4 * SHADES).fill(1);
    for (let i = 0; i < SHADES; ++i) colors.set(shades.subarray(3 * i, 3 * i + 3), 4 * i);
    const scale = 1 / Math.max(range[1] - range[0], 1e-30);
    const own = new THREE.Color();
    this.slices.forEach(({ material }, which) => {
      const [low, high] = this.wholes[which]!;
      const wide = high - low;
      const { uniforms } = material;
      (uniforms["map"]!.value as THREE.Texture | null)?.dispose();
      uniforms["map"]!.value = texture(colors, SHADES, THREE.RGBAFormat, 4);
      uniforms["onMap"]!.value = [wide * scale, (low - range[0]) * scale];
      uniforms["halfWidth"]!.value = LINE * window.devicePixelRatio;
      uniforms["lineCount"]!.value = lines.length;
      lines.forEach(({ isovalue, color }, i) => {
        own.set(color);
        (uniforms["lines"]!.value as THREE.Vector4[])[i]!.set(own.r, own.g, own.b, wide > 0 ? (isovalue - low) / wide : 0);
      });
    });
  }
}
