// The page: what it shows, and what keys, buttons and files do.
import { KinesphereError, load } from "kinesphere";
import { Color } from "three";
import { along, bright, dark, type Palette, placeOfDuration, placesOfSizes, safeDurations } from "./colours.ts";
import { Hand } from "./hand.ts";
import { Hud, type Times } from "./hud.ts";
import { focusOn, Overlays } from "./overlays.ts";
import { Legend } from "./legend.ts";
import { type Link, linkOf, readLink } from "./link.ts";
import { Pair } from "./pair.ts";
import { makePanel } from "./panel.ts";
import { Recording } from "./recording.ts";
import { sceneAbout, sceneKeys, scenes, setUp } from "./scenes/list.ts";
import { readTable, type TrackTable } from "./scenes/track_table.ts";
import { type Colouring, firstSettings } from "./settings.ts";
import type { Shown, ReportedEvent } from "./shown.ts";
import { Simulation } from "./simulation.ts";
import { Stage } from "./stage.ts";
import { Timeline } from "./timeline.ts";
import { applyTheme, calmQuery, darkQuery, type Theme } from "./theme.ts";
import "./base.css";
import "./style.css";

/** Milliseconds that the engine may take for one picture; the rest of the work is left for the next. */
const engineBudget = 14;
/** Maximum seconds between two pictures that simulated time follows. */
const longestFrame = 0.05;

const element = <E extends HTMLElement>(id: string): E => document.querySelector<E>(`#${id}`)!;

const settings = firstSettings();
const hud = new Hud();
const legend = new Legend();
try {
  await load();
} catch (error) {
  hud.say(`The library could not be loaded. ${(error as Error).message}`);
  throw error;
}
let stage: Stage;
try {
  stage = new Stage(element<HTMLCanvasElement>("picture"));
} catch (error) {
  hud.say(`Nothing can be drawn: the browser offers no WebGL 2. ${(error as Error).message}`);
  throw error;
}
const overlays = new Overlays(stage.scene);
let palette: Palette = dark;
let shown: Shown;
let sizePlaces: Float64Array = new Float64Array(0);
let reported: ReportedEvent[] = [];
const times: Times = { engine: 0, drawing: 0, frame: 0 };
const hand = new Hand(stage, () => shown, () => (shown instanceof Simulation && shown.canBePushed ? shown : null),
  (place) => pair.toggle(shown.idOf(place)));
const pair = new Pair((time) => seek(time), () => {
  document.body.classList.toggle("has-pair", pair.ids.length > 0);
  leaveFree();
});
/** The time that a link or the timeline asks for, until it is reached. */
let goal: number | null = null;
const timeline = new Timeline((time) => seek(time));
/** The tracks that the server was given, or that were dropped. */
let opened: TrackTable | null = null;
/** A link to a moment of a file that is not open yet. */
let awaited: Link | null = null;

function show(next: Shown): void {
  hand.release();
  shown?.free();
  shown = next;
  goal = null;
  sizePlaces = placesOfSizes(shown.radii());
  reported = [];
  stage.show(shown);
  overlays.show(shown);
  pair.show(shown);
  hud.show(shown);
  hud.update(shown, times, settings.overlays.busiest);
  legend.update(shown, settings, palette);
  leaveFree();
  stage.lookFromFront();
}

/** On a phone the picture is between the numbers and the legend. */
function leaveFree(): void {
  const box = (id: string) => element(id).getBoundingClientRect();
  // The legend may be empty, and then has no place, and the chosen pair may have it.
  const legendBox = pair.ids.length > 0 ? box("pair") : element("legend").childElementCount > 0 ? box("legend") : null;
  if (matchMedia("(max-width: 720px) and (orientation: portrait)").matches)
    stage.leaveFree({ left: 0, top: box("hud").bottom, right: 0, bottom: innerHeight - (legendBox ?? box("transport")).top });
  else if (matchMedia("(max-height: 500px) and (orientation: landscape)").matches)
    stage.leaveFree({ left: box("hud").right, top: 0, right: legendBox === null ? 0 : innerWidth - legendBox.left,
                      bottom: innerHeight - box("transport").top });
  else stage.leaveFree({ left: 0, top: 0, right: 0, bottom: 0 });
}

/** The earlier choice stays if the scene cannot be made. */
let chosen = { ...settings };
/** The speed of the scene that a recording has taken the place of. */
let speedOfScene: number | null = null;
function restart(): void {
  hud.hideMessage();
  settings.speed = speedOfScene ?? settings.speed;
  speedOfScene = null;
  try {
    const { scene: name, bodies, seed } = settings;
    show(new Simulation(setUp({ name, bodies, seed }, opened), sceneAbout(name)));
    settings.bodies = shown.radii().length;
    chosen = { ...settings };
  } catch (error) {
    const { scene, bodies, seed, speed } = chosen;
    Object.assign(settings, { scene, bodies, seed, speed });
    sayError(error);
  }
  refreshPanel();
}

function chooseScene(): void {
  const { bodies, speed, evidence = false } = sceneAbout(settings.scene);
  speedOfScene = null;
  pair.choose([]);
  settings.bodies = bodies;
  settings.speed = speed;
  settings.overlays.evidence = evidence;
  setPlaying(true);
  restart();
}

function repaint(): void {
  const isDark = applyTheme(settings.theme);
  palette = isDark ? dark : bright;
  stage.paint(palette);
  overlays.paint(palette, isDark);
  pair.repaint();
}

function sayError(error: unknown): void {
  hud.say(error instanceof Error ? error.message : String(error));
}

function setPlaying(playing: boolean): void {
  settings.playing = playing;
  element("play").setAttribute("aria-label", playing ? "Pause" : "Play");
  document.querySelector("#play-shape")!.setAttribute("d", playing ? "M7 5h4v14H7zM13 5h4v14h-4z" : "M7 4.5l12 7.5-12 7.5z");
}

/** Runs a call of the engine; an error is shown, and stops the play. */
function attempt(action: () => ReportedEvent[] | void): void {
  const start = performance.now();
  try {
    reported.push(...(action() ?? []));
  } catch (error) {
    setPlaying(false);
    sayError(error);
  }
  times.engine += 0.1 * (performance.now() - start - times.engine);
}

/** Stops, and goes to a time: back at once, ahead as fast as the engine can. */
function seek(time: number): void {
  setPlaying(false);
  hand.release();
  goal = time;
  if (time < shown.time) goBack(() => shown.rewind(time));
}

/** Throws are not repeated on the way back. */
function goBack(action: () => void): void {
  attempt(action);
  if (shown instanceof Simulation && shown.wasPushed) pair.forgetFuture();
}

/** The name of the file that is shown; null for a scene. */
function fileName(): string | null {
  if (shown instanceof Recording) return shown.title;
  return settings.scene === "crowd" ? opened?.name ?? null : null;
}

/** Shows what a link says; a link that says nothing changes nothing. */
function follow(link: Link): void {
  const { settings: chosen, overlays: on, time, camera, pair: ids, file } = link;
  awaited = file === null || file === fileName() ? null : link;
  if (awaited !== null) {
    if (!leadsToServed() || isServed) hud.tell(`The link leads to a moment of ${file!}. Drop this file on the page to see it.`);
    return;
  }
  if (chosen.scene !== undefined) {
    settings.scene = chosen.scene;
    chooseScene();
  }
  Object.assign(settings, chosen);
  if (on !== null) for (const name of Object.keys(settings.overlays) as (keyof typeof settings.overlays)[]) settings.overlays[name] = on.includes(name);
  if (chosen.bodies !== undefined || chosen.seed !== undefined) restart();
  repaint();
  if (ids !== null) {
    const missing = ids.find((id) => shown.placeOf(id) === null);
    if (missing !== undefined) throw new RangeError(`The link's pair has a body ${missing}, which is not here`);
    pair.choose(ids);
  }
  if (camera !== null) stage.lookAs(camera);
  if (time !== null) seek(time);
  refreshPanel();
}

const openedMark = "opened";
/** True if the address leads to a file of the page's server. */
const leadsToServed = (): boolean => location.hash.slice(1).split("&")[0] === openedMark;

function followAddress(): void {
  const text = location.hash.slice(1).replace(new RegExp(`^${openedMark}(&|$)`), "");
  if (text !== "") followIfRight(() => readLink(text));
}

/** Follows a link, or says what is wrong with it. */
function followIfRight(link: () => Link): void {
  try {
    follow(link());
  } catch (error) {
    sayError(error);
  }
}

/** Goes on with a link that led to a file which is shown now. */
function followAwaited(): void {
  const link = awaited;
  if (link !== null && link.file === fileName()) followIfRight(() => link);
}

async function copyLink(): Promise<void> {
  const address = new URL(location.href);
  const file = fileName();
  const link = linkOf(settings, { time: shown.time, camera: stage.cameraPlace, chosen: pair.ids, file });
  address.hash = file !== null && isServed ? `${openedMark}&${link}` : link;
  try {
    await navigator.clipboard.writeText(address.href);
    hud.tell(shown instanceof Simulation && shown.wasPushed ? "Copied. The link leads to this time of the scene as it would be without your throws."
      : file === null ? "Copied: the link leads to this moment."
      : isServed ? "Copied: the link leads to this moment as long as this page is served."
      : `Copied: the link leads to this moment where ${file} is dropped on the page.`);
  } catch {
    hud.tell(address.href);
  }
}

function savePicture(): void {
  stage.render();
  const link = document.createElement("a");
  link.download = `kinesphere-${shown.title.toLowerCase().replace(/[^a-z0-9]+/g, "-")}-${shown.time.toFixed(3)}.png`;
  link.href = stage.canvas.toDataURL("image/png");
  link.click();
}

const next = () => {
  goal = null;
  setPlaying(false);
  attempt(() => {
    const events = shown.nextEvent();
    pair.follow(events);
    return events;
  });
  hud.update(shown, times, settings.overlays.busiest);
};
const back = () => {
  goal = null;
  hand.release();
  goBack(() => shown.back(1));
  hud.update(shown, times, settings.overlays.busiest);
};

/** The first bytes of each recording of a world. */
const recordingMark = "Kinerc\r\n";

function openRecording(name: string, bytes: ArrayBuffer): void {
  try {
    const recording = new Recording(name, new Uint8Array(bytes));
    pair.choose([]);
    show(recording);
    hud.hideMessage();
    // A scene may be in slow motion; nothing is known of a recording.
    speedOfScene ??= settings.speed;
    settings.speed = 1;
    refreshPanel();
    setPlaying(true);
    followAwaited();
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    hud.say(error instanceof KinesphereError ? `${name} cannot be shown. ${message}` : message);
  }
}

/** Shows tracks as they were recorded, as fast as they were. */
function openTracks(table: TrackTable): void {
  opened = table;
  settings.scene = "crowd";
  chooseScene();
  settings.speed = 1;
  refreshPanel();
  followAwaited();
}

async function openFile(file: File | undefined): Promise<void> {
  if (file === undefined) return;
  isServed = false;
  const bytes = await file.arrayBuffer();
  const begin = String.fromCharCode(...new Uint8Array(bytes.slice(0, recordingMark.length)));
  if (begin === recordingMark) return openRecording(file.name, bytes);
  let table: TrackTable;
  try {
    table = readTable(file.name, new TextDecoder().decode(bytes));
  } catch (error) {
    return hud.say(`${file.name} cannot be shown: ${(error as Error).message}. This page opens recordings of worlds and simple ` +
      `tables of positions; kinesphere view ${file.name} shows all tables and messages.`);
  }
  openTracks(table);
}

/** True once the page shows a file of its server. */
let isServed = false;

/** Opens the files that `kinesphere view FILE` serves with the page; its address has #opened then. */
async function openServed(): Promise<void> {
  const served = async (name: string): Promise<Response> => {
    const response = await fetch(`opened/${name}`);
    if (!response.ok) throw new Error(`${name} could not be fetched: ${response.status} ${response.statusText}`);
    return response;
  };
  try {
    const files = await (await served("files.json")).json() as { recording: string | null; tracks: string | null };
    isServed = true;
    if (files.recording !== null) openRecording(files.recording, await (await served("recording")).arrayBuffer());
    if (files.tracks === null) return;
    openTracks(await (await served("tracks.json")).json() as TrackTable);
    if (awaited !== null) follow(awaited);
  } catch (error) {
    sayError(error);
  }
}

const panel = makePanel(settings, { chooseScene, restart, repaint, openFile: () => element("file").click(), chooseNearest: () => pair.chooseNearest() });
const refreshPanel = () => panel.controllersRecursive().forEach((controller) => controller.updateDisplay());

const cycle = <T>(values: readonly T[], value: T): T => values[(values.indexOf(value) + 1) % values.length]!;

const keys: Record<string, () => void> = {
  " ": () => { goal = null; setPlaying(!settings.playing); },
  ".": next,
  ",": back,
  r: restart,
  k: () => void copyLink(),
  p: savePicture,
  v: () => stage.lookFromFront(),
  n: () => pair.chooseNearest(),
  escape: () => pair.choose([]),
  c: () => void (settings.colouring = cycle<Colouring>(["size", "asked", "safe"], settings.colouring)),
  b: () => void (settings.overlays.bounds = !settings.overlays.bounds),
  l: () => void (settings.overlays.certificates = !settings.overlays.certificates),
  t: () => {
    settings.theme = cycle<Theme>(["dark", "bright"], palette === dark ? "dark" : "bright");
    repaint();
  },
  "?": () => element<HTMLDialogElement>("help").showModal(),
  ...Object.fromEntries(scenes.map(({ name }, k) => [sceneKeys[k], () => viewer.choose(name)])),
};
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || element<HTMLDialogElement>("help").open) return;
  const target = event.target as HTMLElement;
  if (target.matches("input:not([type=range]), select, textarea") || (event.key === " " && target.matches("button"))) return;
  const action = keys[event.key.toLowerCase()];
  if (action === undefined) return;
  event.preventDefault();
  action();
  refreshPanel();
});
for (const [id, key] of [["restart", "r"], ["back", ","], ["play", " "], ["next", "."], ["copy-link", "k"], ["save-picture", "p"], ["help-open", "?"]] as const)
  element(id).addEventListener("click", keys[key]!);
element<HTMLInputElement>("file").addEventListener("change", (event) => {
  const input = event.target as HTMLInputElement;
  void openFile(input.files?.[0]);
  input.value = "";
});
addEventListener("dragover", (event) => {
  event.preventDefault();
  document.body.classList.add("dropping");
});
addEventListener("dragleave", (event) => {
  if (event.relatedTarget === null) document.body.classList.remove("dropping");
});
addEventListener("drop", (event) => {
  event.preventDefault();
  document.body.classList.remove("dropping");
  void openFile(event.dataTransfer?.files[0]);
});
darkQuery.addEventListener("change", repaint);
addEventListener("resize", leaveFree);
// A phone that is turned: the camera's place was chosen for the other way.
matchMedia("(orientation: portrait)").addEventListener("change", () => {
  leaveFree();
  stage.lookFromFront();
});

const colour = new Color();

function draw(seconds: number): void {
  const { overlays: on, colouring } = settings;
  const needsViews = on.probes || on.bounds || on.boxes || on.certificates || colouring !== "size";
  const views = needsViews ? shown.views() : null;
  const positions = shown.positions();
  const radii = shown.radii();
  // Bodies may be added and removed in a recording.
  if (sizePlaces.length !== radii.length) sizePlaces = placesOfSizes(radii);
  overlays.add(reported, shown, stage.extent.radius);
  reported = [];
  const { clientHeight } = stage.canvas;
  const pixels = (clientHeight * Math.min(devicePixelRatio, 2)) / (2 * Math.tan((stage.camera.fov * Math.PI) / 360));
  // What the engine knows of the chosen is not hidden by others.
  const chosen = pair.places;
  const focus = chosen.length > 0 && views !== null && (on.bounds || on.boxes || on.certificates) ? focusOn(shown, views, chosen) : null;
  overlays.update(shown, views, positions, settings, chosen, focus, seconds, calmQuery.matches, pixels);
  const safe = colouring === "safe" ? safeDurations(shown, views!) : null;
  const { time } = shown.view;
  stage.draw(positions, radii, shown.shapes(), shown.orientations(), focus, (body) => {
    if (body === hand.body) return colour.copy(palette.held);
    if (safe !== null) along(palette.times, placeOfDuration(safe[body]!), colour);
    else if (on.evidence && colouring === "size") colour.copy(palette.grey);
    else if (colouring === "asked") along(palette.times, placeOfDuration(time - views![body]!.reportTime), colour);
    else along(palette.sizes, sizePlaces[body]!, colour);
    const glow = overlays.glow[body] ?? 0;
    return glow > 0.01 ? colour.lerp(palette.probe, 0.4 * glow) : colour;
  });
  overlays.showPull(hand.body === null ? null : positions.subarray(3 * hand.body, 3 * hand.body + 3), hand.goal());
  stage.render();
}

let last = performance.now();
let hudTime = 0;

function frame(now: number): void {
  requestAnimationFrame(frame);
  const passed = Math.max((now - last) / 1000, 0);
  const seconds = Math.min(passed, longestFrame);
  times.frame += 0.1 * (now - last - times.frame);
  last = now;
  if (goal !== null) {
    const until = goal;
    attempt(() => pair.run(shown, until, performance.now() + engineBudget));
    if (shown.time >= Math.min(until, shown.endTime)) goal = null;
  } else if (settings.playing) {
    attempt(() => {
      hand.pull(settings.speed);
      return pair.run(shown, shown.time + seconds * settings.speed, performance.now() + engineBudget);
    });
    if (shown.time >= shown.endTime) setPlaying(false);
  } else if (hand.body !== null) {
    attempt(() => hand.pull(settings.speed));
  }
  const start = performance.now();
  draw(passed);
  times.drawing += 0.1 * (performance.now() - start - times.drawing);
  viewer.firstPicture ??= performance.now();
  viewer.pictures += 1;
  if (now - hudTime < 200) return;
  hudTime = now;
  timeline.update(shown);
  pair.update();
  hud.update(shown, times, settings.overlays.busiest);
  legend.update(shown, settings, palette);
}

/** For tests, and for the console. */
const viewer = {
  choose(name: string): void {
    settings.scene = name;
    chooseScene();
    refreshPanel();
  },
  get simulation(): Shown { return shown; },
  settings,
  stage,
  hand,
  pair,
  times,
  setPlaying,
  seek,
  restart,
  repaint,
  pictures: 0,
  /** Milliseconds from the start of the page's loading. */
  firstPicture: null as number | null,
};
declare global {
  interface Window { kinesphereViewer: typeof viewer }
}
window.kinesphereViewer = viewer;

repaint();
chooseScene();
requestAnimationFrame(frame);
followAddress();
addEventListener("hashchange", followAddress);
if (leadsToServed()) void openServed();
