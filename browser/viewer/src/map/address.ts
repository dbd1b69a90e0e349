// The chosen track or pair in the address of the page.
import type { Chosen } from "./chart.ts";

/** Returns the part of an address behind its #: the ids of the chosen, and which separation of the pair. */
export function addressOf({ track, pair }: Pick<Chosen, "track" | "pair">): string {
  if (track !== null) return `${new URLSearchParams({ track })}`;
  if (pair === null) return "";
  const [first, second, level] = JSON.parse(pair) as [string, string, number];
  return `${new URLSearchParams([["pair", first], ["pair", second], ["level", `${level}`]])}`;
}

/** Reads it; what is wrong chooses nothing. */
export function chosenOf(text: string): Pick<Chosen, "track" | "pair"> {
  const read = new URLSearchParams(text);
  const [first, second] = read.getAll("pair");
  const level = Number(read.get("level") ?? 0);
  return { track: read.get("track"), pair: first === undefined || second === undefined || !Number.isInteger(level) ? null : JSON.stringify([first, second, level]) };
}
