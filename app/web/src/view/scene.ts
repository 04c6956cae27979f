// The picture: the surface, its box, light and the camera that turns around them.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Surface } from "../link";
import type { Found, SliceValues } from "../messages";
import type { Info } from "../reader/index_file";
import type { Key } from "../story/story";
import { STORY_MOVE, Way, type Sight } from "../story/way";
import { Headset, type HeadsetWishes } from "./headset";
import { edgesOf, facesOf, outlineOf, type Box, type Plane } from "./planes";
import { Slices, type SliceLook } from "./slices";
import { Ticks } from "./ticks";

/** Camera: place and target in one list of numbers, for links. */
export type View = [number, number, number, number, number, number];
/** Colors of the outlines of what cuts surfaces. */
const CUT = 0xff9e52;
const UP = new THREE.Vector3(0, 0, 1);

function geometryOf(found: Found): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(found.points, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(found.normals, 3));
  geometry.setIndex(new THREE.BufferAttribute(found.triangles, 1));
  return geometry;
}

export class Scene {
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  /** The data: what hands grab in a headset. */
  private readonly world = new THREE.Group();
  private readonly camera = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
  private controls: OrbitControls;
  private bounds = new THREE.Sphere();
  private way: { way: Way; began: number | null } | null = null;
  private inside: Headset | null = null;
  private readonly surfaces: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>[] = [];
  private readonly ghostMeshes = new Map<Found, THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>>();
  private readonly slices = new Slices();
  private box: THREE.LineSegments | null = null;
  private wanted = false;
  private looks: readonly Surface[] = [];
  /** What cuts the surfaces, among the data, and where that is in the world. */
  private cutsOfData: THREE.Plane[] = [];
  private cuts: THREE.Plane[] = [];
  private readonly cutLines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: CUT }));
  /** Called after the camera was moved. */
  moved: () => void = () => {};
  /** Called when a way that `go` began is at its end, or somebody else has taken the camera. */
  arrived: () => void = () => {};
  /** Called after the picture was drawn. */
  drawn: () => void = () => {};

  private readonly ticks: Ticks;

  /** @param numbers gets the ticks of the box */
  constructor(canvas: HTMLCanvasElement, numbers: HTMLElement) {
    this.ticks = new Ticks(numbers);
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.camera.up.copy(UP);
    this.controls = this.newControls();
    const key = new THREE.DirectionalLight(0xffffff, 2.2);
    key.position.set(-0.6, 0.8, 1);
    this.camera.add(key);
    this.cutLines.frustumCulled = false;
    this.world.add(this.slices.group, this.cutLines);
    this.scene.add(this.world, this.camera, new THREE.HemisphereLight(0xffffff, 0x303440, 1.1));
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  /** They keep what was up when they were made. */
  private newControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.renderer.domElement);
    controls.addEventListener("change", () => {
      this.draw();
      this.moved();
    });
    controls.addEventListener("start", () => this.way && this.arrive());
    return controls;
  }

  /** Shows the box of an array, and looks at it from a corner. */
  frame(info: Info): void {
    const size = info.vertices.map((n, axis) => info.positions[axis]!.at(-1) ?? (n - 1) * info.spacing[axis]!);
    const columns = info.direction.map((column, axis) => new THREE.Vector3(...column).multiplyScalar(size[axis]!));
    this.ticks.show(info, columns);
    const corners = [...Array(8).keys()].map((bits) =>
      columns.reduce((sum, column, axis) => (bits >> axis & 1 ? sum.add(column) : sum), new THREE.Vector3()),
    );
    const lines: THREE.Vector3[] = [];
    for (let bits = 0; bits < 8; ++bits)
      for (let axis = 0; axis < 3; ++axis) if (!(bits >> axis & 1)) lines.push(corners[bits]!, corners[bits | (1 << axis)]!);
    if (this.box) this.world.remove(this.box);
    this.box = new THREE.LineSegments(
      new THREE.BufferGeometry().setFromPoints(lines),
      new THREE.LineBasicMaterial({ color: 0x808898, transparent: true, opacity: 0.6 }),
    );
    this.world.add(this.box);
    const bounds = (this.bounds = new THREE.Box3().setFromPoints(corners).getBoundingSphere(new THREE.Sphere()));
    this.camera.near = bounds.radius / 100;
    this.camera.far = bounds.radius * 40;
    this.camera.updateProjectionMatrix();
    const eye = bounds.center.clone().add(new THREE.Vector3(-0.6, -0.85, 0.5).normalize().multiplyScalar((bounds.radius * 3.1) / Math.min(1, this.camera.aspect)));
    this.sight = { eye, target: bounds.center, up: UP };
  }

  /** Center of the data, less their origin, and the radius around it. */
  get data(): THREE.Sphere {
    return this.bounds;
  }
  get aspect(): number {
    return this.camera.aspect;
  }
  get sight(): Sight {
    return { eye: this.camera.position.clone(), target: this.controls.target.clone(), up: this.camera.up.clone() };
  }
  set sight({ eye, target, up }: Sight) {
    this.way = null;
    if (!up.equals(this.camera.up)) {
      this.camera.up.copy(up);
      this.controls.dispose();
      this.controls = this.newControls();
    }
    this.camera.position.copy(eye);
    this.controls.target.copy(target);
    this.controls.update();
    this.draw();
  }
  /** Goes to a view within a moment; who takes the camera meanwhile has it. @param leaps it is there at once */
  go(to: Sight, leaps: boolean): void {
    if (leaps) {
      this.sight = to;
      this.moved();
      this.arrived();
      return;
    }
    this.way = { way: new Way(this.sight, to, this.bounds.center), began: null };
    requestAnimationFrame(this.goOn);
  }
  private readonly goOn = (now: number): void => {
    if (!this.way) return;
    this.way.began ??= now;
    const share = (now - this.way.began) / 1000 / STORY_MOVE;
    if (share >= 1) {
      this.arrive();
    } else {
      const { eye, target, up } = this.way.way.at(share);
      this.camera.position.copy(eye);
      this.camera.quaternion.setFromRotationMatrix(new THREE.Matrix4().lookAt(eye, target, up));
      this.controls.target.copy(target);
      this.draw();
      requestAnimationFrame(this.goOn);
    }
    this.moved();
  };
  /** The way ends where the camera is. */
  private arrive(): void {
    const { way, began } = this.way!;
    const share = began === null ? 0 : (performance.now() - began) / 1000 / STORY_MOVE;
    this.sight = share >= 1 ? way.at(1) : { ...this.sight, up: way.at(1).up };
    this.arrived();
  }
  /** In a headset the data stand as they do in a key's room. @return false: nobody is in a headset */
  stand(key: Key, origin: readonly number[]): boolean {
    this.inside?.stand(key, origin);
    return this.inside !== null;
  }
  /** Where a place among the data, less their origin, is in the picture [pixels]; null: behind the camera. */
  placeInPicture(at: readonly number[]): { x: number; y: number } | null {
    const clip = new THREE.Vector3(...(at as [number, number, number])).project(this.camera);
    const { clientWidth, clientHeight } = this.renderer.domElement;
    return clip.z < 1 ? { x: ((clip.x + 1) / 2) * clientWidth, y: ((1 - clip.y) / 2) * clientHeight } : null;
  }

  get view(): View {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()] as View;
  }
  /** What is up in the picture; null: the data's z. */
  get up(): number[] | null {
    return this.camera.up.equals(UP) ? null : this.camera.up.toArray();
  }

  /** @param colors of each surface, linear, three for each point; null: it has its own color */
  show(found: readonly Found[], colors: readonly (Float32Array | null)[]): void {
    while (this.surfaces.length > found.length) {
      const gone = this.surfaces.pop()!;
      this.world.remove(gone);
      gone.geometry.dispose();
      gone.material.dispose();
    }
    found.forEach((each, i) => {
      const geometry = geometryOf(each);
      const own = colors[i];
      if (own) geometry.setAttribute("color", new THREE.BufferAttribute(own, 3));
      let surface = this.surfaces[i];
      if (!surface) {
        surface = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ roughness: 0.45, metalness: 0, side: THREE.DoubleSide }));
        surface.frustumCulled = false;
        this.surfaces.push(surface);
        this.world.add(surface);
      }
      surface.geometry.dispose();
      surface.geometry = geometry;
      surface.material.vertexColors = Boolean(own);
    });
    this.look(this.looks);
  }
  /** Shows ghosts in their colors; those that were shown before are still there. */
  ghosts(found: readonly { mesh: Found; color: string; opacity: number }[]): void {
    for (const [mesh, { geometry, material }] of this.ghostMeshes)
      if (!found.some((each) => each.mesh === mesh)) {
        this.world.remove(this.ghostMeshes.get(mesh)!);
        geometry.dispose();
        material.dispose();
        this.ghostMeshes.delete(mesh);
      }
    for (const { mesh, color, opacity } of found) {
      let ghost = this.ghostMeshes.get(mesh);
      if (!ghost) {
        ghost = new THREE.Mesh(geometryOf(mesh), new THREE.MeshStandardMaterial({ roughness: 0.45, metalness: 0, side: THREE.DoubleSide, transparent: true, depthWrite: false }));
        ghost.frustumCulled = false;
        ghost.renderOrder = 1; // drawn after translucent surfaces
        this.ghostMeshes.set(mesh, ghost);
        this.world.add(ghost);
      }
      ghost.material.color.set(color);
      ghost.material.opacity = opacity;
    }
    this.look(this.looks);
  }
  /** Shows slices of an array with this grid. */
  slice(values: readonly SliceValues[], info: Info, look: SliceLook): void {
    this.slices.show(values, info.direction);
    this.slices.look(look);
    this.draw();
  }
  /** How the surfaces look: opaque ones are drawn first, and what is behind a translucent one is seen. */
  look(looks: readonly Surface[]): void {
    this.looks = looks;
    this.surfaces.forEach(({ material }, i) => {
      const { color, opacity } = looks[i] ?? { color: "#e8d3a0", opacity: 1 };
      material.color.set(material.vertexColors ? "#ffffff" : color);
      material.opacity = opacity;
      material.transparent = opacity < 1;
      material.depthWrite = opacity >= 1 || looks.length === 1;
      material.visible = opacity > 0;
      material.needsUpdate = true;
    });
    for (const { material } of [...this.surfaces, ...this.ghostMeshes.values()]) material.clippingPlanes = this.cuts.length ? this.cuts : null;
    this.draw();
  }
  /** Cuts away what lies beyond planes, or outside a box; null: there is none. */
  clip(info: Info, planes: readonly Plane[], box: Box | null): void {
    const origin = new THREE.Vector3(...info.origin);
    this.cutsOfData = [...planes, ...(box ? facesOf(info, box) : [])].map((plane) => {
      const [point, normal] = [0, 3].map((first) => new THREE.Vector3().fromArray(plane, first));
      return new THREE.Plane().setFromNormalAndCoplanarPoint(normal!.negate(), point!.sub(origin));
    });
    this.cuts = this.cutsOfData.map((plane) => plane.clone());
    this.renderer.localClippingEnabled = this.cuts.length > 0;
    this.cutLines.geometry.dispose();
    const lines = [...planes.flatMap((plane) => outlineOf(info, plane)), ...(box ? edgesOf(info, box) : [])];
    this.cutLines.geometry = new THREE.BufferGeometry().setFromPoints(lines.map((end) => new THREE.Vector3(...end)));
    this.look(this.looks);
  }
  background(color: string): void {
    this.scene.background = new THREE.Color(color);
    this.draw();
  }

  /** Prepares headsets. @return what enters one; null where there is none */
  async headset(wishes: HeadsetWishes, changed: (inside: boolean) => void): Promise<(() => Promise<void>) | null> {
    if (!(await Headset.there())) return null;
    const headset = new Headset(this.renderer, this.scene, this.world, () => new THREE.Box3().setFromObject(this.box!, true), wishes);
    headset.changed = (inside) => {
      this.inside = inside ? headset : null;
      // Two eyes do not wait for what the page draws, and the page draws nothing meanwhile.
      if (inside)
        this.renderer.setAnimationLoop((now: number) => {
          headset.frame(now);
          this.render();
        });
      else this.resize();
      changed(inside);
    };
    return () => headset.enter();
  }

  /** Length of a pixel in the plane that the camera turns around, in the unit of the data. */
  get pixel(): number {
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2))) / Math.max(1, this.renderer.domElement.clientHeight);
  }

  /** The picture as PNG. */
  picture(): Promise<Blob | null> {
    this.render();
    return new Promise((take) => this.renderer.domElement.toBlob(take, "image/png"));
  }

  /** Draws once, with the next refresh. */
  draw(): void {
    if (this.wanted || this.renderer.xr.isPresenting) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      this.render();
    });
  }
  private render(): void {
    this.world.updateMatrixWorld();
    this.cuts.forEach((cut, i) => cut.copy(this.cutsOfData[i]!).applyMatrix4(this.world.matrixWorld));
    this.renderer.render(this.scene, this.camera);
    const { clientWidth, clientHeight } = this.renderer.domElement;
    if (!this.renderer.xr.isPresenting) this.ticks.draw(this.camera, clientWidth, clientHeight);
    this.drawn();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.renderer.domElement;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
