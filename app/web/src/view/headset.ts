// The surface in a headset: WebXR. Hands grab it, turn and scale it with two; sticks change isovalue and time.
import * as THREE from "three";
import type { Key } from "../story/story";
import { HandCard, type CardButton, type CardWords } from "./hand_card";

/** What a hand's buttons ask for. */
export interface HeadsetWishes {
  /** @param share of the range of values, to be added to the isovalue */
  isovalue(share: number): void;
  /** @param steps to go forward, or back */
  step(steps: number): void;
  /** The words on the hand's panel: isovalue and moment. */
  words(): string;
  /** The card of the story beside it; null: none is told. */
  card(): CardWords | null;
  /** What was pressed on the card. */
  tell(button: CardButton): void;
}

const SIZE = 1.0; // of the longest side of the data, in meters
const PLACE = new THREE.Vector3(0, 1.2, -1.1);
const DEAD = 0.3; // of a stick
const ISOVALUE_A_SECOND = 0.25; // of the range, with the stick at its end
const STEPS_A_SECOND = 8;
const PUSHED = 0.5; // of a stick, that goes to another step of a story
const DARK = 200; // milliseconds, before the data stand elsewhere
const RAY = 0.15; // meters
const LONG_RAY = 0.8; // where there is a card to press

/** The angle of a direction about the upright axis. */
const headingOf = (turn: THREE.Quaternion) => {
  const ahead = new THREE.Vector3(0, 0, -1).applyQuaternion(turn);
  return Math.atan2(-ahead.x, -ahead.z);
};

/** Where an object follows hands that hold it: one moves and turns it, two also scale it. */
export class Grip {
  private held: { hand: THREE.Object3D; from: THREE.Matrix4 }[] = [];
  private readonly object: THREE.Object3D;

  constructor(object: THREE.Object3D) {
    this.object = object;
  }
  take(hand: THREE.Object3D): void {
    if (this.held.length < 2 && !this.held.some((each) => each.hand === hand)) this.held.push({ hand, from: new THREE.Matrix4() });
    this.begin();
  }
  leave(hand: THREE.Object3D): void {
    this.held = this.held.filter((each) => each.hand !== hand);
    this.begin();
  }
  /** From here on the object follows. */
  private begin(): void {
    this.object.updateMatrix();
    const frame = this.frame();
    if (frame) for (const each of this.held) each.from = frame.clone().invert().multiply(this.object.matrix);
  }
  /** The place, direction and scale that the hands give. */
  private frame(): THREE.Matrix4 | null {
    for (const { hand } of this.held) hand.updateMatrixWorld();
    const [first, second] = this.held.map((each) => each.hand);
    if (!first) return null;
    if (!second) return new THREE.Matrix4().compose(first.getWorldPosition(new THREE.Vector3()), first.getWorldQuaternion(new THREE.Quaternion()), new THREE.Vector3(1, 1, 1));
    const a = first.getWorldPosition(new THREE.Vector3());
    const b = second.getWorldPosition(new THREE.Vector3());
    const along = b.clone().sub(a);
    const length = Math.max(0.01, along.length());
    // Turned with the line between the hands, and about it with the first hand.
    const up = new THREE.Vector3(0, 1, 0).applyQuaternion(first.getWorldQuaternion(new THREE.Quaternion()));
    const side = along.normalize();
    const back = side.clone().cross(up).normalize();
    const basis = new THREE.Matrix4().makeBasis(side, back.clone().cross(side), back);
    return new THREE.Matrix4().compose(a.add(b).multiplyScalar(0.5), new THREE.Quaternion().setFromRotationMatrix(basis), new THREE.Vector3(length, length, length));
  }
  follow(): void {
    const frame = this.frame();
    const first = this.held[0];
    if (frame && first) frame.multiply(first.from).decompose(this.object.position, this.object.quaternion, this.object.scale);
  }
}

export class Headset {
  private readonly grip: Grip;
  private readonly hands: THREE.Group[];
  private readonly panel: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshBasicMaterial>;
  private readonly canvas = document.createElement("canvas");
  private readonly card = new HandCard();
  private leap: { from: number | null; act: () => void } | null = null;
  private pushed = 0;
  private shownWords = "";
  private stepped = 0;
  private before = 0;
  /** Called when the session begins and ends. */
  changed: (inside: boolean) => void = () => {};

  /** @param world what is grabbed @param box of the data, in the world's own space */
  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly scene: THREE.Scene,
    private readonly world: THREE.Group,
    private readonly box: () => THREE.Box3,
    private readonly wishes: HeadsetWishes,
  ) {
    this.grip = new Grip(world);
    this.canvas.width = 512;
    this.canvas.height = 128;
    this.panel = new THREE.Mesh(new THREE.PlaneGeometry(0.2, 0.05), new THREE.MeshBasicMaterial({ map: new THREE.CanvasTexture(this.canvas) }));
    this.panel.position.set(0, 0.06, -0.05);
    this.panel.rotation.x = -0.6;
    this.hands = [0, 1].map((i) => {
      const hand = renderer.xr.getController(i);
      const ray = new THREE.Line(new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), new THREE.Vector3(0, 0, -1)]), new THREE.LineBasicMaterial({ color: 0xf3b64b }));
      ray.name = "ray";
      hand.add(ray);
      for (const [begin, end] of [["selectstart", "selectend"], ["squeezestart", "squeezeend"]] as const) {
        hand.addEventListener(begin, () => {
          const at = begin === "selectstart" ? this.card.at(hand) : null;
          if (at === null) this.grip.take(hand);
          else if (at !== "card") this.wishes.tell(at);
        });
        hand.addEventListener(end, () => this.grip.leave(hand));
      }
      return hand;
    });
    this.card.mesh.position.set(0, 0.19, -0.1);
    this.card.mesh.rotation.x = -0.4;
    this.hands[0]!.add(this.panel, this.card.mesh);
  }

  static async there(): Promise<boolean> {
    return (await navigator.xr?.isSessionSupported("immersive-vr").catch(() => false)) ?? false;
  }

  async enter(): Promise<void> {
    const session = await navigator.xr!.requestSession("immersive-vr", { optionalFeatures: ["local-floor", "hand-tracking"] });
    this.renderer.xr.enabled = true;
    this.renderer.xr.setReferenceSpaceType("local-floor");
    await this.renderer.xr.setSession(session);
    this.place();
    this.scene.add(...this.hands);
    this.changed(true);
    session.addEventListener("end", () => {
      this.scene.remove(...this.hands);
      this.renderer.setAnimationLoop(null);
      this.renderer.xr.enabled = false;
      this.world.position.set(0, 0, 0);
      this.world.quaternion.identity();
      this.world.scale.setScalar(1);
      this.world.visible = true;
      this.leap = null;
      this.changed(false);
    });
  }

  /** Puts the data in front of the viewer, their z upwards. */
  private place(): void {
    const box = this.box();
    const size = box.getSize(new THREE.Vector3());
    const scale = SIZE / Math.max(size.x, size.y, size.z);
    this.world.scale.setScalar(scale);
    this.world.quaternion.setFromAxisAngle(new THREE.Vector3(1, 0, 0), -Math.PI / 2);
    this.world.position.copy(PLACE).sub(box.getCenter(new THREE.Vector3()).multiplyScalar(scale).applyQuaternion(this.world.quaternion));
  }

  /** The data stand to the viewer as they stood to a key's: after a moment in which they are not seen. */
  stand(key: Key, origin: readonly number[]): void {
    const { data, head } = key;
    if (!data) return;
    this.leap = {
      from: null,
      act: () => {
        const turn = new THREE.Quaternion(...data.turn);
        const place = new THREE.Vector3(...data.place).add(new THREE.Vector3(...(origin as [number, number, number])).multiplyScalar(data.scale).applyQuaternion(turn));
        if (head) {
          const viewer = this.renderer.xr.getCamera();
          const [from, to] = [new THREE.Vector3(...head.position), viewer.getWorldPosition(new THREE.Vector3())];
          const around = headingOf(viewer.getWorldQuaternion(new THREE.Quaternion())) - headingOf(new THREE.Quaternion(...head.turn));
          const about = new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 1, 0), around);
          place.sub(from).applyQuaternion(about).add(to);
          turn.premultiply(about);
        }
        this.world.position.copy(place);
        this.world.quaternion.copy(turn);
        this.world.scale.setScalar(data.scale);
      },
    };
  }
  private goOn(now: number): void {
    if (!this.leap) return;
    this.leap.from ??= now;
    this.world.visible = now - this.leap.from >= DARK;
    if (!this.world.visible) return;
    this.leap.act();
    this.leap = null;
  }

  /** Follows hands and sticks; called for each frame. @param now in milliseconds */
  frame(now: number): void {
    const seconds = Math.min(0.1, (now - this.before) / 1000);
    this.before = now;
    const told = this.wishes.card();
    this.card.show(told);
    for (const hand of this.hands) hand.getObjectByName("ray")!.scale.z = told ? LONG_RAY : RAY;
    this.goOn(now);
    this.grip.follow();
    let pushed = 0;
    for (const source of this.renderer.xr.getSession()?.inputSources ?? []) {
      const axes = source.gamepad?.axes ?? [];
      const [x, y] = [axes[2] ?? 0, axes[3] ?? 0];
      if (Math.abs(y) > DEAD) this.wishes.isovalue(-y * ISOVALUE_A_SECOND * seconds);
      if (told) {
        if (Math.abs(x) > Math.abs(pushed)) pushed = x;
      } else if (Math.abs(x) > DEAD && now - this.stepped > 1000 / STEPS_A_SECOND) {
        this.stepped = now;
        this.wishes.step(Math.sign(x));
      }
    }
    if (pushed > PUSHED && this.pushed <= PUSHED) this.wishes.tell("next");
    if (pushed < -PUSHED && this.pushed >= -PUSHED) this.wishes.tell("previous");
    this.pushed = pushed;
    const words = this.wishes.words();
    if (words !== this.shownWords) this.write((this.shownWords = words));
  }

  private write(words: string): void {
    const context = this.canvas.getContext("2d")!;
    context.fillStyle = "#171a21";
    context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    context.fillStyle = "#e8eaf0";
    context.font = "38px system-ui, sans-serif";
    words.split("\n").forEach((line, i) => context.fillText(line, 16, 50 + 54 * i, this.canvas.width - 32));
    this.panel.material.map!.needsUpdate = true;
  }
}
