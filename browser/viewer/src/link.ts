// The address of a moment: scene, seed, time, camera, switches and chosen pair. Runs are equal to the last bit, so whoever opens it
// sees the same. Of a file that was opened it has the name; the file has to be there, too.
import { scenes } from "./scenes/list.ts";
import { type Colouring, colourings, ranges, type Settings } from "./settings.ts";
import { type Theme, themes } from "./theme.ts";

/** What a link says; what it leaves out is as the page has it. */
export interface Link {
  settings: Partial<Omit<Settings, "overlays" | "playing">>;
  /** The switches that are on. */
  overlays: readonly (keyof Settings["overlays"])[] | null;
  /** Simulated time to go to, and to stay at. */
  time: number | null;
  /** The place of the camera, and the place that it looks at. */
  camera: readonly number[] | null;
  /** Ids of the chosen pair. */
  pair: readonly [number, number] | null;
  /** Name of the file that the scene is from. */
  file: string | null;
}

/** What a link says beside the settings. */
export interface Moment {
  time: number;
  camera: readonly number[];
  /** Ids of the chosen bodies. */
  chosen: readonly number[];
  file: string | null;
}

export function linkOf(settings: Settings, { time, camera, chosen, file }: Moment): string {
  const { scene, bodies, seed, speed, colouring, theme, overlays } = settings;
  const on = Object.entries(overlays).filter(([, isOn]) => isOn).map(([name]) => name);
  const parts = { ...(file === null ? { scene, bodies, seed } : { file: encodeURIComponent(file) }),
                  t: time.toFixed(6), speed, colour: colouring, theme, show: on.join(","),
                  camera: camera.map((place) => Number(place.toPrecision(6))).join(","),
                  ...(chosen.length === 2 && { pair: chosen.join(",") }) };
  return Object.entries(parts).map(([name, value]) => `${name}=${value}`).join("&");
}

/** Reads the part of an address behind its #. Throws an error that names what is wrong. */
export function readLink(text: string): Link {
  const link: Link = { settings: {}, overlays: null, time: null, camera: null, pair: null, file: null };
  for (const [name, value] of new URLSearchParams(text)) {
    const read = readers[name];
    if (read === undefined) throw new RangeError(`The link has an unknown part: ${name}`);
    read(link, value);
  }
  return link;
}

const readers: Readonly<Record<string, (link: Link, value: string) => void>> = {
  scene: (link, value) => { link.settings.scene = oneOf("scene", value, scenes.map(({ name }) => name)); },
  bodies: (link, value) => { link.settings.bodies = whole("bodies", value, ...ranges.bodies); },
  seed: (link, value) => { link.settings.seed = whole("seed", value, ...ranges.seed); },
  speed: (link, value) => { link.settings.speed = number("speed", value, ...ranges.speed); },
  t: (link, value) => { link.time = number("t", value, -1e12, 1e12); },
  colour: (link, value) => { link.settings.colouring = oneOf<Colouring>("colour", value, colourings); },
  theme: (link, value) => { link.settings.theme = oneOf<Theme>("theme", value, themes); },
  show: (link, value) => {
    link.overlays = value.split(",").filter((name) => name !== "").map((name) => oneOf("show", name, overlayNames));
  },
  camera: (link, value) => {
    link.camera = value.split(",").map((part) => number("camera", part, -1e9, 1e9));
    if (link.camera.length !== 6) throw new RangeError(`The link's camera must be six numbers, but is ${value}`);
  },
  pair: (link, value) => {
    const [first, second, ...more] = value.split(",").map((part) => whole("pair", part, 0, 2 ** 31));
    if (first === undefined || second === undefined || first === second || more.length > 0)
      throw new RangeError(`The link's pair must be two different numbers of bodies, but is ${value}`);
    link.pair = [first, second];
  },
  file: (link, value) => { link.file = value; },
};
const overlayNames: readonly (keyof Settings["overlays"])[] =
  ["contacts", "evidence", "trails", "probes", "bounds", "boxes", "cells", "certificates", "busiest"];

function oneOf<T extends string>(name: string, value: string, known: readonly T[]): T {
  const found = known.find((one) => one === value);
  if (found === undefined) throw new RangeError(`The link's ${name} must be one of ${known.join(", ")}, but is ${value}`);
  return found;
}

function number(name: string, value: string, least: number, most: number, _step?: number): number {
  const read = value.trim() === "" ? NaN : Number(value);
  if (!(read >= least && read <= most)) throw new RangeError(`The link's ${name} must be a number from ${least} to ${most}, but is ${value}`);
  return read;
}

function whole(name: string, value: string, least: number, most: number, _step?: number): number {
  const read = number(name, value, least, most);
  if (!Number.isInteger(read)) throw new RangeError(`The link's ${name} must be a whole number, but is ${value}`);
  return read;
}
