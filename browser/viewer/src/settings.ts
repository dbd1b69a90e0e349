// The settings of the page.
import type { Theme } from "./theme.ts";

export type Colouring = "size" | "asked" | "safe";

export interface Settings {
  scene: string;
  bodies: number;
  seed: number;
  speed: number;
  playing: boolean;
  colouring: Colouring;
  theme: Theme;
  overlays: {
    contacts: boolean;
    /** Contacts that a loop misses stay marked, and spheres are grey beneath. */
    evidence: boolean;
    trails: boolean;
    probes: boolean;
    bounds: boolean;
    boxes: boolean;
    cells: boolean;
    certificates: boolean;
    busiest: boolean;
  };
}

/** What numbers may be: the least, the most, and the step between two. */
export const ranges = { speed: [0.02, 5, 0.01], bodies: [10, 10_000, 1], seed: [1, 1000, 1] } as const;
export const colourings: readonly Colouring[] = ["size", "asked", "safe"];

export const firstSettings = (): Settings => ({
  scene: "missed",
  bodies: 160,
  seed: 1,
  speed: 0.1,
  playing: true,
  colouring: "size",
  theme: "system",
  overlays: { contacts: true, evidence: true, trails: true, probes: true, bounds: false, boxes: false, cells: false, certificates: false, busiest: false },
});
