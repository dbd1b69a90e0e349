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
    trails: boolean;
    probes: boolean;
    bounds: boolean;
    boxes: boolean;
    cells: boolean;
    certificates: boolean;
    busiest: boolean;
  };
}

export const firstSettings = (): Settings => ({
  scene: "missed",
  bodies: 160,
  seed: 1,
  speed: 0.1,
  playing: true,
  colouring: "size",
  theme: "system",
  overlays: { contacts: true, trails: true, probes: true, bounds: false, boxes: false, cells: false, certificates: false, busiest: false },
});
