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
    probes: boolean;
    bounds: boolean;
    boxes: boolean;
    cells: boolean;
    certificates: boolean;
    busiest: boolean;
  };
}

export const firstSettings = (): Settings => ({
  scene: "paper1",
  bodies: 500,
  seed: 1,
  speed: 2,
  playing: true,
  colouring: "size",
  theme: "system",
  overlays: { contacts: true, probes: true, bounds: false, boxes: false, cells: false, certificates: false, busiest: false },
});
