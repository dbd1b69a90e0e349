// A picture of things in a plane, on a canvas, in lengths of their world.
import type { Ink, Inks } from "./inks.ts";

/** How a line or an area is drawn. Widths and dashes are in pixels. */
export interface Pen {
  fill?: Ink;
  stroke?: Ink;
  width?: number;
  dash?: readonly number[];
  opacity?: number;
}

/** The part of a plane that is shown: x to the right, y up. */
export interface Extent {
  left: number;
  bottom: number;
  right: number;
  top: number;
}

export class FlatPicture {
  private readonly context: CanvasRenderingContext2D;
  /** Pixels that a length takes along x and y, and the place of the origin. */
  private scale = [1, 1];
  private origin = [0, 0];
  inks: Inks | null = null;
  font = "600 14px system-ui, sans-serif";

  /** With `stretched` the extent fills the canvas, and x and y have scales of their own. */
  constructor(readonly canvas: HTMLCanvasElement, public extent: Extent, private readonly stretched = false) {
    this.context = canvas.getContext("2d")!;
  }

  /** Begins a picture of the size that the canvas has now. */
  begin(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const density = Math.min(devicePixelRatio, 2);
    const [wide, high] = [Math.round(clientWidth * density), Math.round(clientHeight * density)];
    if (this.canvas.width !== wide || this.canvas.height !== high) Object.assign(this.canvas, { width: wide, height: high });
    const { left, bottom, right, top } = this.extent;
    const full = [clientWidth / (right - left), clientHeight / (top - bottom)];
    const least = Math.min(...full);
    this.scale = this.stretched ? full : [least, least];
    this.origin = [clientWidth / 2 - (this.scale[0]! * (left + right)) / 2, clientHeight / 2 + (this.scale[1]! * (bottom + top)) / 2];
    this.context.setTransform(density, 0, 0, density, 0, 0);
    this.context.clearRect(0, 0, clientWidth, clientHeight);
  }

  disc(x: number, y: number, radius: number, pen: Pen): void {
    this.path(pen, () => this.context.arc(this.x(x), this.y(y), Math.max(radius * this.scale[0]!, 0), 0, 2 * Math.PI));
  }
  rectangle(x0: number, y0: number, x1: number, y1: number, pen: Pen): void {
    this.path(pen, () => this.context.rect(this.x(x0), this.y(y1), this.x(x1) - this.x(x0), this.y(y0) - this.y(y1)));
  }
  line(points: readonly (readonly [number, number])[], pen: Pen): void {
    this.path(pen, () => points.forEach(([x, y], k) => {
      if (k === 0) this.context.moveTo(this.x(x), this.y(y));
      else this.context.lineTo(this.x(x), this.y(y));
    }));
  }
  /** A cross whose arms are `size` pixels long. */
  cross(x: number, y: number, size: number, pen: Pen): void {
    this.path(pen, () => {
      const [middleX, middleY] = [this.x(x), this.y(y)];
      for (const side of [-1, 1]) {
        this.context.moveTo(middleX - size, middleY - side * size);
        this.context.lineTo(middleX + size, middleY + side * size);
      }
    });
  }
  /** A ring of a size in pixels. */
  ring(x: number, y: number, size: number, pen: Pen): void {
    this.path(pen, () => this.context.arc(this.x(x), this.y(y), size, 0, 2 * Math.PI));
  }
  /** A square of a size in pixels. */
  square(x: number, y: number, size: number, pen: Pen): void {
    this.path(pen, () => this.context.rect(this.x(x) - size / 2, this.y(y) - size / 2, size, size));
  }
  /** A stroke is drawn around the letters. */
  text(x: number, y: number, words: string, pen: Pen & { align?: CanvasTextAlign }): void {
    this.context.font = this.font;
    this.context.textAlign = pen.align ?? "left";
    this.context.globalAlpha = pen.opacity ?? 1;
    if (pen.stroke !== undefined) {
      Object.assign(this.context, { strokeStyle: this.inks![pen.stroke], lineWidth: 5, lineJoin: "round" });
      this.context.setLineDash([]);
      this.context.strokeText(words, this.x(x), this.y(y));
    }
    this.context.fillStyle = this.inks![pen.fill ?? "ink"];
    this.context.fillText(words, this.x(x), this.y(y));
  }

  private x(x: number): number {
    return this.origin[0]! + this.scale[0]! * x;
  }
  private y(y: number): number {
    return this.origin[1]! - this.scale[1]! * y;
  }
  private path({ fill, stroke, width = 2, dash = [], opacity = 1 }: Pen, trace: () => void): void {
    const { context } = this;
    context.globalAlpha = opacity;
    context.beginPath();
    trace();
    if (fill !== undefined) {
      context.fillStyle = this.inks![fill];
      context.fill();
    }
    if (stroke === undefined) return;
    context.strokeStyle = this.inks![stroke];
    context.lineWidth = width;
    context.lineCap = "round";
    context.setLineDash(dash as number[]);
    context.stroke();
  }
}
