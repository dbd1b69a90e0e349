// The engine's knowledge and events, drawn over the spheres.
import type { BodyView, Box } from "kinesphere";
import { BoxGeometry, Color, Mesh, MeshBasicMaterial, type Scene } from "three";
import { along, type Palette, placeOfDuration } from "./colours.ts";
import { Lines } from "./lines.ts";
import type { Settings } from "./settings.ts";
import { shiftInto, type Shown, type ReportedEvent, wrapInto } from "./shown.ts";
import { MissedMarks, Sparks } from "./sparks.ts";
import { Spheres } from "./spheres.ts";
import { Trails } from "./trails.ts";
import { Ways } from "./ways.ts";

/** Life of the spark of a contact that a loop misses, of which there are few; that of others is 1. */
const missedLife = 2;

export class Overlays {
  /** A number for each body from 0 to 1, near 1 just after a probe. */
  glow = new Float32Array(0);
  private reportTimes = new Float64Array(0);
  private readonly bounds = new Spheres(0.4);
  private readonly boxes = new Lines(0.45);
  private readonly cells = new Lines(0.35);
  private readonly certificates = new Lines(0.9, true);
  private readonly alarms = new Lines(0.95);
  private readonly pull = new Lines(0.9);
  private readonly trails: Trails;
  private readonly ways: Ways;
  private readonly chosen = new Lines(1, true);
  private readonly zoneMaterial = new MeshBasicMaterial({ transparent: true, opacity: 0.2, depthWrite: false });
  private zone: Mesh | null = null;
  private zoneFlash = 0;
  private readonly sparks: Sparks;
  private readonly missed: MissedMarks;
  private palette: Palette | null = null;
  private readonly colour = new Color();

  constructor(private readonly scene: Scene) {
    this.sparks = new Sparks(scene);
    this.missed = new MissedMarks(scene);
    this.trails = new Trails(scene);
    this.ways = new Ways(scene);
    scene.add(this.bounds.object, this.boxes.object, this.cells.object, this.certificates.object,
              this.alarms.object, this.pull.object, this.chosen.object);
  }

  paint(palette: Palette, isDark: boolean): void {
    this.palette = palette;
    this.zoneMaterial.color = palette.zone;
    this.sparks.blend(isDark);
  }

  show(shown: Shown): void {
    this.sparks.clear();
    this.missed.clear();
    this.glow = new Float32Array(0);
    this.trails.show(shown);
    this.ways.show(shown);
    if (this.zone !== null) {
      this.scene.remove(this.zone);
      this.zone.geometry.dispose();
      this.zone = null;
    }
    if (shown.zone !== null) this.zone = this.zoneMesh(shown.zone);
  }

  /** Adds marks at contacts. */
  add(reported: readonly ReportedEvent[], shown: Shown, extent: number): void {
    const { missed: red, contact, zone } = this.palette!;
    for (const { event, missed } of reported) {
      const { sparks } = this;
      if (shown.alarms !== null && event.kind === "sensor_enter") {
        if (event.distance === shown.alarms.alarm) sparks.add(event.point, { colour: red, strength: 0.8, size: extent / 16, form: "ring" });
      } else if (event.kind === "sensor_enter") {
        this.zoneFlash = 1;
        sparks.add(event.firstState.position, { colour: zone, strength: 0.4, size: extent / 16, form: "glow" });
      } else if (missed) {
        const place = event.kind === "contact_begin" ? event.point : event.firstState.position;
        this.addMissed(event.time, wrapInto(Float64Array.from(place), shown.box, shown.periodic), extent);
      } else if (event.kind === "contact_begin") {
        const point = wrapInto(event.point.slice(), shown.box, shown.periodic);
        sparks.add(point, { colour: contact, strength: 0.75, size: extent / 22, form: "ring" });
      } else if (event.kind === "wall_begin") {
        sparks.add(event.point, { colour: contact, strength: 0.3, size: extent / 30, form: "glow" });
      }
    }
  }

  /**
   * `views` is set if a visible overlay needs it; `chosen` are places of the chosen bodies, and `focus` has them and their
   * partners if bounds, boxes and certificates of these alone are drawn.
   */
  update(shown: Shown, views: readonly BodyView[] | null, positions: Float64Array, settings: Settings, chosen: readonly number[],
         focus: ReadonlySet<number> | null, seconds: number, calm: boolean, pixels: number): void {
    const on = settings.overlays;
    this.sparks.fade(on.contacts ? seconds : Infinity, calm, pixels);
    this.missed.update(shown.time, on.evidence, this.palette!.missed);
    this.zoneFlash *= Math.exp(-seconds / (calm ? 2 : 0.25));
    this.zoneMaterial.opacity = 0.16 + (calm ? 0.12 : 0.45) * this.zoneFlash;
    if (views !== null && on.probes) this.followProbes(views, seconds, calm);
    else this.glow.fill(0);
    if (views !== null && on.bounds) this.drawBounds(shown, views, focus);
    else this.bounds.object.visible = false;
    if (views !== null && on.boxes) this.drawBoxes(shown, views, focus);
    else this.boxes.hide();
    if (on.cells) this.drawCells(shown);
    else this.cells.hide();
    if (views !== null && on.certificates) this.drawCertificates(shown, views, positions, focus === null ? null : chosen);
    else this.certificates.hide();
    this.trails.update(shown, positions, on.trails, this.palette!);
    this.ways.update(shown, positions, on.trails, chosen, this.palette!);
    this.drawAlarms(shown, positions);
    this.drawChosen(shown, positions, chosen);
  }

  /** Shows a line from a held sphere to its goal; none for null. */
  showPull(from: Float64Array | null, to: Float64Array | null): void {
    this.pull.begin(1);
    if (from !== null && to !== null) {
      this.pull.point(from[0]!, from[1]!, from[2]!, this.palette!.held);
      this.pull.point(to[0]!, to[1]!, to[2]!, this.palette!.held);
    }
    this.pull.end();
  }

  private zoneMesh(box: Box): Mesh {
    const size = [0, 1, 2].map((axis) => box.upper[axis]! - box.lower[axis]!);
    const mesh = new Mesh(new BoxGeometry(size[0], size[1], size[2]), this.zoneMaterial);
    mesh.position.set((box.lower[0]! + box.upper[0]!) / 2, (box.lower[1]! + box.upper[1]!) / 2,
                      (box.lower[2]! + box.upper[2]!) / 2);
    mesh.renderOrder = 2;
    this.scene.add(mesh);
    return mesh;
  }

  private addMissed(time: number, place: Float64Array, extent: number): void {
    const colour = this.palette!.missed;
    this.sparks.add(place, { colour, strength: 1, size: extent / 12, form: "crossedRing", life: missedLife });
    this.missed.add(time, place, colour);
  }

  private followProbes(views: readonly BodyView[], seconds: number, calm: boolean): void {
    if (this.glow.length !== views.length) {
      this.glow = new Float32Array(views.length);
      this.reportTimes = Float64Array.from(views, (view) => view.reportTime);
    }
    const fade = Math.exp(-seconds / (calm ? 1.5 : 0.18));
    for (let k = 0; k < views.length; ++k) {
      this.glow[k]! *= fade;
      if (views[k]!.reportTime === this.reportTimes[k]) continue;
      this.reportTimes[k] = views[k]!.reportTime;
      this.glow[k] = calm ? Math.min(0.3, this.glow[k]! + 0.4 * seconds) : 1;
    }
  }

  private drawBounds(shown: Shown, views: readonly BodyView[], focus: ReadonlySet<number> | null): void {
    this.bounds.resize(views.length);
    const centre = new Float64Array(3);
    for (let k = 0; k < views.length; ++k) {
      if (!views[k]!.enabled || focus?.has(k) === false) {
        this.bounds.hide(k);
        continue;
      }
      centre.set(views[k]!.centre);
      wrapInto(centre, shown.box, shown.periodic);
      this.bounds.put(k, centre[0]!, centre[1]!, centre[2]!, views[k]!.boundRadius, this.palette!.zone);
    }
    this.bounds.done();
  }

  private drawBoxes(shown: Shown, views: readonly BodyView[], focus: ReadonlySet<number> | null): void {
    this.boxes.begin(12 * views.length);
    for (const [k, { box, enabled }] of views.entries()) if (enabled && focus?.has(k) !== false) this.boxes.box(...inSight(shown, box.lower, box.upper), this.palette!.line);
    this.boxes.end();
  }

  private drawCells(shown: Shown): void {
    const cells = shown.view.cells();
    this.cells.begin((12 * cells.length) / 7);
    for (let at = 0; at < cells.length; at += 7) {
      const full = Math.log2(1 + cells[at + 6]!) / 5;
      this.cells.box(...inSight(shown, cells.subarray(at, at + 3), cells.subarray(at + 3, at + 6)),
                     along(this.palette!.times, 0.8 - full, this.colour));
    }
    this.cells.end();
  }

  /** Draws lines between pairs, coloured by the time until their certificates fail; with `of` those of these bodies alone. */
  private drawCertificates(shown: Shown, views: readonly BodyView[], positions: Float64Array, of: readonly number[] | null): void {
    const certificates = certificatesOf(shown, views);
    this.certificates.begin(certificates.length);
    for (const { first, second, until } of certificates) {
      if (of?.some((place) => place === first || place === second) === false) continue;
      along(this.palette!.times, placeOfDuration(until - shown.view.time), this.colour);
      this.certificates.between(shown, positions, first, second, this.colour);
    }
    this.certificates.end();
  }

  /** Draws a cube around each chosen body, and a line between two. */
  private drawChosen(shown: Shown, positions: Float64Array, chosen: readonly number[]): void {
    const { held } = this.palette!;
    const radii = shown.radii();
    const present = chosen.filter((place) => !Number.isNaN(positions[3 * place]!));
    this.chosen.begin(12 * present.length + 1);
    for (const place of present) {
      const corner = (side: number) => [0, 1, 2].map((axis) => positions[3 * place + axis]! + side * 1.15 * radii[place]!);
      this.chosen.box(corner(-1), corner(1), held);
    }
    if (present.length === 2) this.chosen.between(shown, positions, present[0]!, present[1]!, held);
    this.chosen.end();
  }

  /** Draws lines between pairs that may be too near to each other. */
  private drawAlarms(shown: Shown, positions: Float64Array): void {
    const pairs = [...shown.near];
    this.alarms.begin(pairs.length);
    for (const { first, second, distance } of pairs)
      this.alarms.between(shown, positions, first, second,
                          distance === shown.alarms?.alarm ? this.palette!.missed : this.palette!.contact);
    this.alarms.end();
  }
}

/** Certificates, by places of the two bodies in the picture, and when each fails. */
function certificatesOf({ view }: Shown, views: readonly BodyView[]): { first: number; second: number; until: number }[] {
  const numbers = view.certificates();
  const places = new Map(views.map(({ id }, k) => [id, k]));
  return Array.from({ length: numbers.length / 3 }, (_, k) =>
    ({ first: places.get(numbers[3 * k]!) ?? -1, second: places.get(numbers[3 * k + 1]!) ?? -1, until: numbers[3 * k + 2]! }))
    .filter(({ first, second }) => first >= 0 && second >= 0);
}

/** Returns places of the chosen bodies, and of those that they have a certificate with. */
export function focusOn(shown: Shown, views: readonly BodyView[], chosen: readonly number[]): ReadonlySet<number> {
  const focus = new Set(chosen);
  for (const { first, second } of certificatesOf(shown, views))
    if (chosen.includes(first) || chosen.includes(second)) focus.add(first).add(second);
  return focus;
}

/** Returns the corners of a box, moved so that its centre is in the visible period. */
function inSight({ box, periodic }: Shown, lower: Float64Array, upper: Float64Array): [Float64Array, Float64Array] {
  const shift = Float64Array.from([0, 1, 2], (axis) => shiftInto(box, periodic, axis, (lower[axis]! + upper[axis]!) / 2));
  return [lower.map((number, axis) => number + shift[axis]!), upper.map((number, axis) => number + shift[axis]!)];
}
