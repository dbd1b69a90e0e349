// The visible part of the plane.
import type { Bounds } from "./scene.ts";

export interface Insets {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export interface Look {
  x: number;
  y: number;
  /** Pixels per unit of length. */
  scale: number;
}

const leastScale = 1e-9;
const mostScale = 1e9;

export class View {
  width = 1;
  height = 1;
  /** Space at the edges that panels cover. */
  insets: Insets = { left: 0, right: 0, top: 0, bottom: 0 };
  /** The centre of the space between the insets. */
  look: Look = { x: 0, y: 0, scale: 1 };
  private flight: { from: Look; to: Look; start: number; seconds: number } | null = null;

  get middle(): [number, number] {
    const { left, right, top, bottom } = this.insets;
    return [(left + this.width - right) / 2, (top + this.height - bottom) / 2];
  }
  get free(): [number, number] {
    const { left, right, top, bottom } = this.insets;
    return [Math.max(this.width - left - right, 50), Math.max(this.height - top - bottom, 50)];
  }

  toScreen(x: number, y: number): [number, number] {
    const [middleX, middleY] = this.middle;
    return [middleX + (x - this.look.x) * this.look.scale, middleY - (y - this.look.y) * this.look.scale];
  }
  toPlane(x: number, y: number): [number, number] {
    const [middleX, middleY] = this.middle;
    return [this.look.x + (x - middleX) / this.look.scale, this.look.y - (y - middleY) / this.look.scale];
  }
  /** The bounds of all that is visible, including the space below panels. */
  get bounds(): Bounds {
    const [left, top] = this.toPlane(0, 0);
    const [right, bottom] = this.toPlane(this.width, this.height);
    return { left, right, bottom, top };
  }

  pan(pixelsX: number, pixelsY: number): void {
    this.flight = null;
    this.look = { ...this.look, x: this.look.x - pixelsX / this.look.scale, y: this.look.y + pixelsY / this.look.scale };
  }
  /** Zooms around this place of the screen. */
  zoom(factor: number, x = this.middle[0], y = this.middle[1]): void {
    this.flight = null;
    const [atX, atY] = this.toPlane(x, y);
    const scale = Math.min(Math.max(this.look.scale * factor, leastScale), mostScale);
    this.look = { ...this.look, scale };
    const [nowX, nowY] = this.toPlane(x, y);
    this.look = { x: this.look.x + atX - nowX, y: this.look.y + atY - nowY, scale };
  }

  /** Returns the look that shows these bounds with a margin, and at least `leastWidth` of the plane. */
  lookAt(bounds: Bounds, leastWidth: number): Look {
    const [freeX, freeY] = this.free;
    const width = Math.max(bounds.right - bounds.left, leastWidth, 1e-9);
    const height = Math.max(bounds.top - bounds.bottom, leastWidth, 1e-9);
    const scale = 0.84 * Math.min(freeX / width, freeY / height);
    return { x: (bounds.left + bounds.right) / 2, y: (bounds.bottom + bounds.top) / 2, scale: Math.min(Math.max(scale, leastScale), mostScale) };
  }
  /** Returns true if the bounds lie between the panels and fill a good part of the space there. */
  suits(bounds: Bounds, leastWidth: number): boolean {
    const [left, top] = this.toScreen(bounds.left, bounds.top);
    const [right, bottom] = this.toScreen(bounds.right, bounds.bottom);
    const { insets } = this;
    return left >= insets.left && right <= this.width - insets.right && top >= insets.top && bottom <= this.height - insets.bottom &&
      this.look.scale > 0.6 * this.lookAt(bounds, leastWidth).scale;
  }

  flyTo(to: Look, seconds: number): void {
    if (seconds === 0) this.look = to;
    this.flight = seconds === 0 ? null : { from: this.look, to, start: performance.now(), seconds };
  }
  /** Continues a flight. Returns true while there is one. */
  fly(now: number): boolean {
    if (this.flight === null) return false;
    const { from, to, start, seconds } = this.flight;
    const part = Math.min(Math.max((now - start) / 1000 / seconds, 0), 1);
    const eased = part * part * (3 - 2 * part);
    const scale = from.scale * (to.scale / from.scale) ** eased;
    // The centre moves in proportion to the visible size, so that the flight appears even at every scale.
    const along = Math.abs(to.scale / from.scale - 1) < 1e-3 ? eased : (1 / from.scale - 1 / scale) / (1 / from.scale - 1 / to.scale);
    this.look = part === 1 ? to : { x: from.x + (to.x - from.x) * along, y: from.y + (to.y - from.y) * along, scale };
    if (part === 1) this.flight = null;
    return true;
  }
}
