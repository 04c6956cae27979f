// Views of a story's keys in the page's camera, and the way from one view to the next.
import * as THREE from "three";
import type { Key } from "./story";

/** A camera: where it is, what it turns around, and what is up in its picture. */
export interface Sight {
  eye: THREE.Vector3;
  target: THREE.Vector3;
  up: THREE.Vector3;
}

/** Seconds to the view of a step, as in the native program. */
export const STORY_MOVE = 1.2;
/** Half the height of a desktop's screen, and of the page's picture, at distance 1. */
const SCREEN_HALF = 0.5 / 1.2;
const PAGE_HALF = Math.tan(THREE.MathUtils.degToRad(20));
const HEAD = { position: [0, 1.6, 0], turn: [0, 0, 0, 1] } as const;
/** A camera turns about the data's own z where its picture is tilted against it by less [radians]. */
const UPRIGHT = 0.02;
/** The camera is at least this share of the data's size away from what it turns around. */
const NEAREST = 0.02;

/**
 * What a key's viewer sees, in the middle of a desktop's window: at the depth of the data's center, things are equally large in
 * the page. Heights are not exaggerated.
 * @param center, size of the data, physical space less `origin` @param aspect width of the page's picture over its height
 */
export function sightOf(key: Key, origin: readonly number[], center: THREE.Vector3, size: number, aspect: number): Sight | null {
  if (!key.data) return null;
  const { place, turn, scale } = key.data;
  const head = key.head ?? HEAD;
  const back = new THREE.Quaternion(...turn).invert();
  const toData = (direction: THREE.Vector3) => direction.applyQuaternion(new THREE.Quaternion(...head.turn)).applyQuaternion(back);
  const eye = new THREE.Vector3(...head.position).sub(new THREE.Vector3(...place)).divideScalar(scale).applyQuaternion(back).sub(new THREE.Vector3(...origin));
  const ahead = toData(new THREE.Vector3(0, 0, -1)).normalize();
  const seenUp = toData(new THREE.Vector3(0, 1, 0)).normalize();
  const depth = Math.max(center.clone().sub(eye).dot(ahead), NEAREST * size);
  const target = eye.clone().addScaledVector(ahead, depth);
  // A narrow picture shows what a square one does.
  const distance = (depth * SCREEN_HALF) / PAGE_HALF / Math.min(1, aspect);
  if (![...eye.toArray(), distance].every(Number.isFinite)) return null;
  const upright = new THREE.Vector3(0, 0, 1);
  const flat = upright.clone().addScaledVector(ahead, -ahead.z);
  const tilted = flat.length() < UPRIGHT || seenUp.angleTo(flat) > UPRIGHT;
  return { eye: target.clone().addScaledVector(ahead, -distance), target, up: tilted ? seenUp : upright };
}

/** A similarity from the data to a room in which the eye is at 0 and what it turns around one unit ahead. */
interface Placed {
  turn: THREE.Quaternion;
  scale: number;
  place: THREE.Vector3;
}
const AHEAD = new THREE.Vector3(0, 0, -1);

function placed({ eye, target, up }: Sight): Placed {
  const turn = new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().lookAt(eye, target, up)).invert();
  const scale = 1 / Math.max(eye.distanceTo(target), 1e-300);
  return { turn, scale, place: eye.clone().negate().applyQuaternion(turn).multiplyScalar(scale) };
}

/** The place of the data that moves least, in the sense of least squares; close to `pivot` where that is open. */
function stillPlace(from: Placed, to: Placed, pivot: THREE.Vector3): THREE.Vector3 {
  const axes = ({ turn, scale }: Placed) => new THREE.Matrix3().setFromMatrix4(new THREE.Matrix4().makeRotationFromQuaternion(turn)).multiplyScalar(scale);
  const off = axes(from).clone();
  const other = axes(to);
  off.elements = off.elements.map((each, i) => (each - other.elements[i]!) / 2) as typeof off.elements;
  const apart = placeOf(from, pivot).sub(placeOf(to, pivot)).divideScalar(2);
  const across = off.clone().transpose();
  const squares = across.clone().multiply(off).multiplyScalar(2);
  const open = 1e-3 * (from.scale ** 2 + to.scale ** 2);
  for (const i of [0, 4, 8]) squares.elements[i]! += open;
  return pivot.clone().sub(apart.applyMatrix3(across).multiplyScalar(2).applyMatrix3(squares.invert()));
}
const placeOf = ({ turn, scale, place }: Placed, at: THREE.Vector3) => at.clone().applyQuaternion(turn).multiplyScalar(scale).add(place);

/** The way from one view to another: it turns the shortest way, grows in even proportions, and rests at both ends. */
export class Way {
  private readonly from: Placed;
  private readonly to: Placed;
  private readonly still: THREE.Vector3;
  private readonly ends: [THREE.Vector3, THREE.Vector3];

  /** @param center of the data */
  constructor(
    first: Sight,
    private readonly last: Sight,
    center: THREE.Vector3,
  ) {
    [this.from, this.to] = [placed(first), placed(last)];
    this.still = stillPlace(this.from, this.to, center);
    this.ends = [placeOf(this.from, this.still), placeOf(this.to, this.still)];
  }

  /** @param share of the time, from 0 to 1 */
  at(share: number): Sight {
    if (share >= 1) return this.last;
    const eased = share * share * (3 - 2 * share);
    const growth = Math.log(this.to.scale / this.from.scale);
    const scale = this.from.scale * Math.exp(growth * eased);
    const turn = this.from.turn.clone().slerp(this.to.turn, eased);
    const moved = growth === 0 ? eased : Math.expm1(growth * eased) / Math.expm1(growth);
    const back = turn.clone().invert();
    const place = this.ends[0].clone().lerp(this.ends[1], moved).sub(this.still.clone().applyQuaternion(turn).multiplyScalar(scale));
    const toData = (at: THREE.Vector3) => at.sub(place).divideScalar(scale).applyQuaternion(back);
    return { eye: toData(new THREE.Vector3()), target: toData(AHEAD.clone()), up: new THREE.Vector3(0, 1, 0).applyQuaternion(back) };
  }
}
