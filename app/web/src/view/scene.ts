// The picture: the surface, its box, light and the camera that turns around them.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Surface } from "../link";
import type { Found } from "../messages";
import type { Info } from "../reader/index_file";
import { Headset, type HeadsetWishes } from "./headset";
import { Ticks } from "./ticks";

/** Camera: place, target and zoom in one list of numbers, for links. */
export type View = [number, number, number, number, number, number];

export class Scene {
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  /** The data: what hands grab in a headset. */
  private readonly world = new THREE.Group();
  private readonly camera = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly surfaces: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>[] = [];
  private box: THREE.LineSegments | null = null;
  private wanted = false;
  private looks: readonly Surface[] = [];
  private cuts = false;
  /** The clip plane among the data, and where that is in the world. */
  private readonly cutOfData = new THREE.Plane();
  private readonly cut = new THREE.Plane();
  /** Called after the camera was moved. */
  moved: () => void = () => {};

  private readonly ticks: Ticks;

  /** @param numbers gets the ticks of the box */
  constructor(canvas: HTMLCanvasElement, numbers: HTMLElement) {
    this.ticks = new Ticks(numbers);
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => {
      this.draw();
      this.moved();
    });
    const key = new THREE.DirectionalLight(0xffffff, 2.2);
    key.position.set(-0.6, 0.8, 1);
    this.camera.add(key);
    this.scene.add(this.world, this.camera, new THREE.HemisphereLight(0xffffff, 0x303440, 1.1));
    new ResizeObserver(() => this.resize()).observe(canvas);
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
    const bounds = new THREE.Box3().setFromPoints(corners).getBoundingSphere(new THREE.Sphere());
    this.controls.target.copy(bounds.center);
    this.camera.near = bounds.radius / 100;
    this.camera.far = bounds.radius * 40;
    this.camera.position.copy(bounds.center).add(new THREE.Vector3(-0.6, -0.85, 0.5).normalize().multiplyScalar((bounds.radius * 3.1) / Math.min(1, this.camera.aspect)));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  get view(): View {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()] as View;
  }
  set view(view: View) {
    this.camera.position.set(view[0], view[1], view[2]);
    this.controls.target.set(view[3], view[4], view[5]);
    this.controls.update();
    this.draw();
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
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(each.points, 3));
      geometry.setAttribute("normal", new THREE.BufferAttribute(each.normals, 3));
      const own = colors[i];
      if (own) geometry.setAttribute("color", new THREE.BufferAttribute(own, 3));
      geometry.setIndex(new THREE.BufferAttribute(each.triangles, 1));
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
      material.clippingPlanes = this.cuts ? [this.cut] : null;
      material.needsUpdate = true;
    });
    this.draw();
  }
  /** Cuts away what lies beyond a plane: along an axis of the array at a share of its length; null: nothing. */
  clip(info: Info, at: { axis: number; share: number } | null): void {
    this.renderer.localClippingEnabled = at !== null;
    if (at) {
      const size = info.positions[at.axis]!.at(-1) ?? (info.vertices[at.axis]! - 1) * info.spacing[at.axis]!;
      const along = new THREE.Vector3(...info.direction[at.axis]!);
      this.cutOfData.setFromNormalAndCoplanarPoint(along.clone().negate(), along.multiplyScalar(size * at.share));
    }
    this.cuts = at !== null;
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
    this.cut.copy(this.cutOfData).applyMatrix4(this.world.matrixWorld);
    this.renderer.render(this.scene, this.camera);
    const { clientWidth, clientHeight } = this.renderer.domElement;
    if (!this.renderer.xr.isPresenting) this.ticks.draw(this.camera, clientWidth, clientHeight);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.renderer.domElement;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
