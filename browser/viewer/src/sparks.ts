// Marks at places of events: sparks that fade, and those of missed contacts, which stay.
import {
  AdditiveBlending, BufferAttribute, BufferGeometry, type Color, NormalBlending, Points, type Scene, ShaderMaterial,
} from "three";

/** What a mark looks like, so that colours are not all that tells them apart. */
export const forms = { glow: 0, ring: 1, crossedRing: 2 } as const;
export type Form = keyof typeof forms;

const vertices = `
  attribute vec4 tint;
  attribute float size;
  attribute float form;
  uniform float pixels;
  varying vec4 colour;
  varying float kind;
  void main() {
    colour = tint;
    kind = form;
    vec4 place = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * place;
    // Sizes below 0 are pixels.
    gl_PointSize = size < 0.0 ? -size : clamp(size * pixels / -place.z, kind > 0.5 ? 14.0 : 0.0, 96.0);
  }`;
const fragments = `
  varying vec4 colour;
  varying float kind;
  void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float away = length(at);
    float glow = smoothstep(1.0, 0.0, away);
    float shine = glow * glow;
    if (kind > 0.5) {
      float ring = smoothstep(0.2, 0.1, abs(away - 0.78));
      float arm = 0.7071 * min(abs(at.x - at.y), abs(at.x + at.y));
      float arms = kind > 1.5 && away < 0.6 ? smoothstep(0.18, 0.08, arm) : 0.0;
      shine = max(max(ring, arms), 0.3 * shine);
    }
    gl_FragColor = vec4(colour.rgb, colour.a * shine);
    #include <colorspace_fragment>
  }`;

/** Points of these forms. The oldest gives way to a new one. */
class Marks {
  protected readonly places: BufferAttribute;
  protected readonly tints: BufferAttribute;
  private readonly sizes: BufferAttribute;
  private readonly kinds: BufferAttribute;
  private readonly material = new ShaderMaterial({
    vertexShader: vertices, fragmentShader: fragments, transparent: true, depthWrite: false, depthTest: false,
    uniforms: { pixels: { value: 1000 } },
  });
  private next = 0;

  constructor(scene: Scene, protected readonly count: number) {
    const numbers = (each: number) => new BufferAttribute(new Float32Array(each * count), each);
    [this.places, this.tints, this.sizes, this.kinds] = [numbers(3), numbers(4), numbers(1), numbers(1)];
    const points = new Points(new BufferGeometry().setAttribute("position", this.places).setAttribute("tint", this.tints)
      .setAttribute("size", this.sizes).setAttribute("form", this.kinds), this.material);
    points.frustumCulled = false;
    points.renderOrder = 3;
    scene.add(points);
  }

  blend(additive: boolean): void {
    this.material.blending = additive ? AdditiveBlending : NormalBlending;
  }

  /** `pixels` are the pixels that a length takes at a distance of 1. */
  protected uploadFor(pixels: number): void {
    this.material.uniforms["pixels"]!.value = pixels;
    for (const attribute of [this.places, this.tints, this.sizes, this.kinds]) attribute.needsUpdate = true;
  }
  /** Puts a mark that is not seen yet; returns its number. */
  protected put(place: ArrayLike<number>, colour: Color, size: number, form: Form): number {
    const k = this.next;
    this.next = (k + 1) % this.count;
    this.places.setXYZ(k, place[0]!, place[1]!, place[2]!);
    this.tints.setXYZW(k, colour.r, colour.g, colour.b, 0);
    this.sizes.setX(k, size);
    this.kinds.setX(k, forms[form]);
    return k;
  }
}

export interface Spark {
  colour: Color;
  /** Brightness at first. */
  strength: number;
  size: number;
  form: Form;
  /** How long it lives, in multiples of what others do. */
  life?: number;
}

const sparkCount = 512;

export class Sparks extends Marks {
  /** The rest of each spark's life, down to 0, and its initial brightness, which falls from 1 on. */
  private readonly life = new Float32Array(sparkCount);
  private readonly strength = new Float32Array(sparkCount);

  constructor(scene: Scene) {
    super(scene, sparkCount);
  }

  clear(): void {
    this.life.fill(0);
  }

  add(place: ArrayLike<number>, { colour, strength, size, form, life = 1 }: Spark): void {
    const k = this.put(place, colour, size, form);
    this.life[k] = life;
    this.strength[k] = strength;
  }

  fade(seconds: number, calm: boolean, pixels: number): void {
    const duration = calm ? 3 : 0.6;
    for (let k = 0; k < sparkCount; ++k) {
      this.life[k] = Math.max(0, this.life[k]! - seconds / duration);
      // In calm mode sparks appear slowly, too.
      const shape = calm ? 0.35 * Math.min(1, Math.max(0, 4 * (1 - this.life[k]!))) : 1;
      this.tints.setW(k, this.strength[k]! * Math.min(1, this.life[k]!) * shape);
    }
    this.uploadFor(pixels);
  }
}

const missedCount = 512;
/** Pixels of a mark, on large pages and on phones. */
const [largePixels, smallPixels] = [20, 14];

/** Marks of the contacts that a loop misses: they stay, until time goes back before them. */
export class MissedMarks extends Marks {
  private readonly times = new Float64Array(missedCount).fill(Infinity);

  constructor(scene: Scene) {
    super(scene, missedCount);
    this.blend(false);
  }

  clear(): void {
    this.times.fill(Infinity);
  }

  add(time: number, place: ArrayLike<number>, colour: Color): void {
    const size = -(Math.min(innerWidth, innerHeight) < 500 ? smallPixels : largePixels) * Math.min(devicePixelRatio, 2);
    this.times[this.put(place, colour, size, "crossedRing")] = time;
  }

  update(time: number, visible: boolean, colour: Color): void {
    for (let k = 0; k < missedCount; ++k) {
      if (this.times[k]! > time) this.times[k] = Infinity;
      this.tints.setXYZW(k, colour.r, colour.g, colour.b, visible && this.times[k] !== Infinity ? 1 : 0);
    }
    this.uploadFor(1);
  }
}
