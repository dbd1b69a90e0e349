// Names, times, lengths and places in words.
import { digits } from "../numbers.ts";
import type { Place, StreamTime } from "./state.ts";
import type { Units } from "./units.ts";

/** Invisible characters, and characters that change the direction of text. */
const unseen = /[\u0000-\u001f\u007f-\u009f\u00ad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;

/** Returns an id for display: any text of the stream stays one name in one line. */
export function shownName(id: string): string {
  const name = id.replace(unseen, "\ufffd");
  return name.trim() === "" ? "(no name)" : name;
}

export function shortName(id: string): string {
  const characters = [...shownName(id)];
  return characters.length > 20 ? `${characters.slice(0, 19).join("")}…` : characters.join("");
}

/** Returns seconds since 1970, or since the zero of the stream's own numbers; NaN for an invalid time. */
export function secondsOf(time: StreamTime): number {
  if (typeof time === "number") return time;
  // Dates without a zone are taken as UTC.
  return Date.parse(/(Z|[+-]\d\d:?\d\d)$/.test(time) ? time : `${time}Z`) / 1000;
}

export function durationText(seconds: number): string {
  if (seconds < 60) return `${seconds < 9.95 ? seconds.toFixed(1) : seconds.toFixed(0)} s`;
  const minutes = Math.floor(seconds / 60);
  const rest = Math.floor(seconds % 60);
  if (minutes < 60) return `${minutes} min${rest > 0 ? ` ${rest} s` : ""}`;
  return `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

export const durationBetween = (from: StreamTime, to: StreamTime): string => durationText(Math.max(secondsOf(to) - secondsOf(from), 0));

/** Returns the text of a duration before or after now. */
export function whenText(time: StreamTime | null, now: StreamTime | null): string {
  if (time === null || now === null) return "–";
  const seconds = secondsOf(time) - secondsOf(now);
  if (!Number.isFinite(seconds)) return "–";
  if (Math.abs(seconds) < 0.05) return "now";
  return seconds < 0 ? `${durationText(-seconds)} ago` : `in ${durationText(seconds)}`;
}

/** Returns the text of a time; the date of a date, or of seconds from 1970, is apart. */
export function timeText(time: StreamTime | null): { text: string; date: string } {
  if (time === null) return { text: "–", date: "" };
  if (typeof time === "number") {
    const isUnix = time > 5e8 && time < 4e9;
    return isUnix ? timeText(new Date(Math.round(time * 1000)).toISOString()) : { text: `${time.toFixed(1)} s`, date: "" };
  }
  const [, date, clock, tenths, zone] = /^(.*)T([\d:]+)(?:[.](\d)\d*)?(.*)$/.exec(time) ?? ["", "", time, undefined, ""];
  return { text: `${clock}.${tenths ?? "0"}`, date: `${date} ${zone === "Z" ? "UTC" : zone}`.trim() };
}

export function rangeText(lower: number, upper: number | null, units: Units): string {
  const [from, to] = [units.length(lower), units.length(upper)];
  const [number, unit] = from.split(" ");
  return unit !== undefined && to.endsWith(` ${unit}`) ? `${number} to ${to}` : `${from} to ${to}`;
}

/** Keeps numbers and their units in one line. */
export const unbroken = (text: string): string => text.replace(/(\d) (k?m|s|min|h|NM|ft|kt)\b/g, "$1\u00a0$2");

/** Returns degrees, minutes and seconds, as far as `step` (degrees) needs them. */
export function angleText(degrees: number, step: number, hemispheres: readonly [string, string]): string {
  const decimals = Math.max(0, Math.ceil(-Math.log10(step * 3600) - 1e-9));
  const seconds = Number((Math.abs(degrees) * 3600).toFixed(decimals));
  let text = `${Math.floor(seconds / 3600 + 1e-12)}°`;
  const minutes = Math.floor((seconds % 3600) / 60 + 1e-9);
  if (step < 1 - 1e-9) text += `${String(minutes).padStart(2, "0")}′`;
  if (step < 1 / 60 - 1e-9) text += `${(seconds - 60 * Math.floor(seconds / 60 + 1e-9)).toFixed(decimals).padStart(decimals > 0 ? decimals + 3 : 2, "0")}″`;
  return seconds === 0 || seconds === 648_000 ? text : text + hemispheres[degrees < 0 ? 1 : 0];
}

export const longitudeText = (degrees: number, step: number): string => angleText(degrees, step, ["E", "W"]);
export const latitudeText = (degrees: number, step: number): string => angleText(degrees, step, ["N", "S"]);

export function placeText(place: Place, units: Units, isFlat: boolean): string {
  if (place.lon !== undefined && place.lat !== undefined) {
    const height = isFlat ? "" : `, ${units.altitude(place.alt ?? 0)}`;
    return `${latitudeText(place.lat, 1 / 36_000)} ${longitudeText(place.lon, 1 / 36_000)}${height}`;
  }
  return (isFlat ? [place.x, place.y] : [place.x, place.y, place.z]).map((value) => digits(value, 6)).join(", ");
}

/** Returns speed, course and climb. */
export function velocityText({ velocity: [x, y, z] }: Place, units: Units, isFlat: boolean): string {
  const speed = Math.hypot(x, y);
  const course = (Math.atan2(x, y) * 180 / Math.PI + 360) % 360;
  const climb = isFlat || Math.abs(z) < 1e-9 ? "" : `, ${z < 0 ? "↓" : "↑"} ${units.climb(Math.abs(z))}`;
  return `${units.speed(speed)}${speed > 0 ? ` to ${(Math.round(course) % 360).toString().padStart(3, "0")}°` : ""}${climb}`;
}
