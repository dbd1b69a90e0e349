// What the user has chosen, kept by the browser from one visit to the next.
import type { Theme } from "../theme.ts";
import type { UnitChoice } from "./units.ts";

export interface Settings {
  units: UnitChoice;
  theme: Theme;
  names: boolean;
  /** Shows the reports that are needed so that no pair turns undecided. */
  needs: boolean;
  /** Order of the list of closest approaches. */
  order: "time" | "distance";
  /** Sound and notification of new pairs. */
  alarm: boolean;
}

const usual: Settings = { units: "field", theme: "system", names: true, needs: false, order: "time", alarm: false };
const allowed: { [Name in keyof Settings]: readonly Settings[Name][] } = {
  units: ["field", "metric"], theme: ["system", "dark", "bright"], names: [true, false], needs: [true, false],
  order: ["time", "distance"], alarm: [true, false],
};
const key = "kinesphere map";

/** Returns the kept settings; those that are absent or wrong are the usual ones. */
export function keptSettings(): Settings {
  const settings = { ...usual };
  try {
    const kept = JSON.parse(localStorage.getItem(key) ?? "{}") as Record<string, unknown>;
    for (const name of Object.keys(usual) as (keyof Settings)[])
      if ((allowed[name] as readonly unknown[]).includes(kept[name])) Object.assign(settings, { [name]: kept[name] });
  } catch {
    // The browser keeps nothing for pages, or something else is there.
  }
  return settings;
}

export function keepSettings(settings: Settings): void {
  try {
    localStorage.setItem(key, JSON.stringify(settings));
  } catch {
    // They last as long as the page.
  }
}
