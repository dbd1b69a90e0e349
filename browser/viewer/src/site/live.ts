// The live parts of the documentation: each element with data-live names one.
import { DiscsDemo } from "./discs_demo.ts";
import { loadLibrary } from "./library.ts";
import { TwoBodies } from "./two_bodies.ts";

/** For tests, and for the console. */
const live: { discs?: DiscsDemo; twoBodies?: TwoBodies } = {};
declare global {
  interface Window { kinesphereLive: typeof live }
}
window.kinesphereLive = live;

const placed = (name: string) => document.querySelector<HTMLElement>(`[data-live='${name}']`);

async function bringToLife(): Promise<void> {
  const [discs, twoBodies, note] = [placed("discs"), placed("two-bodies"), placed("note")];
  try {
    await loadLibrary();
    if (discs !== null)
      live.discs = new DiscsDemo({ discs, numbers: placed("numbers")!, controls: placed("controls")!, legend: placed("legend")! });
    if (twoBodies !== null) live.twoBodies = new TwoBodies(twoBodies);
    note?.remove();
    // Browsers load no modules from a folder of files.
    if (location.protocol === "file:")
      document.querySelector("a[href='viewer/index.html']")?.replaceWith("In three dimensions: the viewer, where a server has these files, as python3 -m http.server does");
  } catch (error) {
    if (note !== null) note.textContent = `A still picture: ${(error as Error).message}.`;
    throw error;
  }
}

void bringToLife();
