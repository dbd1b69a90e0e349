// The units of a stream's field, or metric ones.
import { digits } from "../numbers.ts";
import type { WatchState } from "./state.ts";

/** `plain` is the stream's own unit, which has no name. */
export type UnitKind = "air" | "sea" | "metric" | "plain";

/** What the user wants: the units of the stream's field, or metric ones. */
export type UnitChoice = "field" | "metric";

const nauticalMile = 1852;
const foot = 0.3048;
const knot = nauticalMile / 3600;
/** TCAS shows an arrow from this vertical speed on. Unit: metres per second. */
const airArrow = 500 * foot / 60;

const grouped = (value: number): string => Math.round(value).toLocaleString("en");

/** Returns the units of the stream's field. Lengths of a stream with x and y are metres if a separation says so. */
export function fieldOf({ format, geographic, dimensions, separations }: WatchState): UnitKind {
  const has = (unit: string) => separations.some(({ name }) => new RegExp(`\\d${unit}(:|$)`).test(name));
  if (geographic !== true) return ["m", "km", "NM", "ft"].some(has) ? "metric" : "plain";
  if (format === "readsb" || format === "sbs" || format === "opensky") return "air";
  if (format === "ais" || format === "nmea") return "sea";
  if (has("NM") || has("ft")) return dimensions === 2 ? "sea" : "air";
  return "metric";
}

export class Units {
  constructor(readonly kind: UnitKind) {}

  /** Returns the text of a horizontal distance; null has no limit. */
  length(length: number | null): string {
    if (length === null) return "any";
    switch (this.kind) {
      case "plain":
        return digits(length, 3);
      case "air":
        return length < 0.9995 * nauticalMile ? metresText(length) : `${digits(length / nauticalMile, 3)} NM`;
      case "sea": {
        if (length < 0.0995 * nauticalMile) return metresText(length);
        const miles = length / nauticalMile;
        return `${miles < 9.995 ? miles.toFixed(2) : digits(miles, 3)} NM`;
      }
      case "metric":
        return metresText(length);
    }
  }

  /** Returns the text of a horizontal distance and how far it may be off, in one unit if that is readable: 129 m ± 40. */
  lengthWithin(length: number, error: number | null): string {
    if (error === null) return this.length(length);
    const [text, off] = [this.length(length), this.length(Number(error.toPrecision(2)))];
    const [number, unit] = off.split(" ");
    return `${text} ± ${unit === undefined || text.endsWith(` ${unit}`) ? number : off}`;
  }

  /** Returns the text of a vertical distance; null has no limit. */
  height(height: number | null): string {
    if (height === null || this.kind !== "air") return this.kind === "plain" ? this.length(height) : height === null ? "any" : metresText(height);
    return `${grouped(height / foot)} ft`;
  }

  /** Returns a flight level, or an altitude. */
  altitude(altitude: number): string {
    if (this.kind === "plain") return digits(altitude, 3);
    if (this.kind !== "air") return `${grouped(altitude)} m`;
    const hundreds = Math.round(altitude / foot / 100);
    return hundreds >= 100 ? `FL${hundreds}` : `${grouped(100 * hundreds)} ft`;
  }

  speed(speed: number): string {
    if (this.kind === "plain") return digits(speed, 3);
    if (this.kind === "metric") return `${digits(speed, 3)} m/s`;
    const knots = speed / knot;
    return `${this.kind === "sea" && knots < 99.95 ? knots.toFixed(1) : knots.toFixed(0)} kt`;
  }

  climb(speed: number): string {
    return this.kind === "air" ? `${grouped(Math.round(speed / foot * 60 / 10) * 10)} ft/min` : this.speed(speed);
  }

  /**
   * Returns how much higher the other of two is, and whether it rises or sinks relative to the one: in hundreds of feet
   * as TCAS has it, or a height with its sign.
   */
  above(difference: number, rate: number): string {
    const sign = difference < 0 ? "−" : "+";
    if (this.kind === "air") {
      const hundreds = Math.round(Math.abs(difference) / foot / 100);
      const arrow = Math.abs(rate) < airArrow ? "" : rate < 0 ? "↓" : "↑";
      return `${hundreds === 0 ? "" : sign}${hundreds.toString().padStart(2, "0")}${arrow}`;
    }
    const text = this.height(Math.abs(difference));
    const arrow = Math.abs(rate) < (this.kind === "plain" ? 1e-9 : 0.5) ? "" : rate < 0 ? " ↓" : " ↑";
    return `${/[1-9]/.test(text) ? sign : ""}${text}${arrow}`;
  }

  /** The unit in which a bar of at most this length is round, in lengths. */
  unitOfBar(longest: number): number {
    const least = this.kind === "air" ? nauticalMile : this.kind === "sea" ? 0.1 * nauticalMile : Infinity;
    return longest >= least ? nauticalMile : 1;
  }
}

function metresText(length: number): string {
  if (length >= 9995) return `${digits(length / 1000, 3)} km`;
  return `${length >= 99.5 ? length.toFixed(0) : digits(length, 3)} m`;
}
