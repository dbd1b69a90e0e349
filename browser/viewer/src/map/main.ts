// The map of a watch: fetches its state, and shows it.
import { applyTheme, calmQuery, darkQuery, type Theme } from "../theme.ts";
import { addressOf, chosenOf } from "./address.ts";
import { Alarm } from "./alarm.ts";
import { Chart, type Chosen, coloursOfPage } from "./chart.ts";
import { EarthPlane } from "./earth.ts";
import { scaleBar } from "./graticule.ts";
import { followPointers } from "./hand.ts";
import { Lists } from "./lists.ts";
import { PairHistory } from "./pair_history.ts";
import { type Lost, Polling } from "./polling.ts";
import { boundsOf, labelOf, placesOf, type Scene, sceneOf, type Spot } from "./scene.ts";
import { keepSettings, keptSettings, type Settings } from "./settings.ts";
import type { WatchState } from "./state.ts";
import { durationText, timeText } from "./text.ts";
import { fieldOf, Units } from "./units.ts";
import { View } from "./view.ts";
import "../base.css";
import "./style.css";

const element = <E extends HTMLElement>(id: string): E => document.querySelector<E>(`#${id}`)!;

const canvas = element<HTMLCanvasElement>("picture");
const settings = keptSettings();
const chart = new Chart(canvas, redraw);
const view = new View();
const chosen: Chosen = { track: null, pair: null, hovered: null };
let scene: Scene | null = null;
let plane: EarthPlane | null = null;
/** True if the view follows the tracks, until the user moves it. */
let isFollowing = true;

const pairHistory = new PairHistory();
const lists = new Lists({ choosePair, chooseTrack: (id) => chooseTrack(id, true) }, settings, pairHistory);
const alarm = new Alarm({ wordsOf: (pair) => lists.wordsOf(pair), choose: choosePair });

// Drawing.

let isDue = false;
function redraw(): void {
  if (isDue) return;
  isDue = true;
  requestAnimationFrame((now) => {
    isDue = false;
    const isFlying = view.fly(now);
    const start = performance.now();
    chart.draw(view, scene, plane, chosen);
    map.pictures += 1;
    map.drawing = performance.now() - start;
    showScale();
    if (isFlying) redraw();
  });
}

function showScale(): void {
  const { length, pixels } = scaleBar(view.look.scale, 150, chart.units);
  element("scale-bar").style.width = `${pixels}px`;
  element("scale-text").textContent = scene === null ? "" : chart.units.length(length).replace(/\.00(?= )|(?<=\.\d)0(?= )/, "");
  element("look-ahead").textContent = chart.lookAhead > 0 ? `; line: straight on for ${chart.lookAhead < 60 ? `${chart.lookAhead} s` : durationText(chart.lookAhead)}` : "";
}

function repaint(): void {
  applyTheme(settings.theme);
  chart.colours = coloursOfPage();
  lists.showChosen(chosen.track, chosen.pair);
  redraw();
}

function resize(): void {
  const panel = (id: string) => element(id).getBoundingClientRect();
  const isNarrow = innerWidth <= 720;
  const gap = 12;
  view.insets = isNarrow
    ? { left: gap, right: gap, top: panel("hud").bottom + gap, bottom: innerHeight - panel("transport").top + gap }
    : { left: panel("hud").right + gap, right: innerWidth - panel("lists").left + gap, top: gap, bottom: innerHeight - panel("transport").top + gap };
  chart.resize(view);
  if (isFollowing) fit(false);
  redraw();
}

// The view.

/** Returns the smallest width of the plane to show: about that of the bounds and separations. */
function leastWidth(): number {
  let width = 0;
  for (const { horizontal } of scene?.state.separations ?? []) width = Math.max(width, 2 * horizontal);
  return width;
}

function fly(ids: readonly string[], margin: number, others: readonly Spot[] = []): boolean {
  const bounds = boundsOf([...placesOf(ids.map((id) => scene?.tracks.get(id))), ...others]);
  if (bounds === null) return false;
  view.flyTo(view.lookAt(bounds, margin), calmQuery.matches ? 0 : 0.35);
  redraw();
  return true;
}

function follow(on: boolean): void {
  isFollowing = on;
  element("fit").setAttribute("aria-pressed", String(on));
}

function fit(isSmooth: boolean): void {
  follow(true);
  const bounds = scene === null ? null : boundsOf(placesOf(scene.tracks.values()));
  if (bounds === null) return;
  view.flyTo(view.lookAt(bounds, leastWidth()), isSmooth && !calmQuery.matches ? 0.35 : 0);
  redraw();
}

function zoom(factor: number): void {
  view.zoom(factor);
  follow(false);
  redraw();
}
function pan(x: number, y: number): void {
  view.pan(x, y);
  follow(false);
  redraw();
}

// The selection.

function showChosen(): void {
  lists.showChosen(chosen.track, chosen.pair);
  redraw();
  const address = addressOf(chosen);
  history.replaceState(null, "", address === "" ? location.pathname + location.search : `#${address}`);
}

/** What the address leads to, until it is there. */
let awaited = chosenOf(location.hash.slice(1));

/** Goes to what the address leads to, if it is there. */
function followAddress(): void {
  const { track, pair } = awaited;
  if (pair !== null && scene?.pairs.some(({ key }) => key === pair)) choosePair(pair);
  else if (track !== null && scene?.tracks.has(track)) chooseTrack(track, true);
  else return;
  awaited = { track: null, pair: null };
}
addEventListener("hashchange", () => {
  awaited = chosenOf(location.hash.slice(1));
  followAddress();
});

function chooseTrack(id: string | null, isToBeSeen: boolean): void {
  chosen.track = id;
  chosen.pair = null;
  showChosen();
  if (id === null || !isToBeSeen) return;
  follow(false);
  // Keeps the scale, unless that shows too little of the surroundings.
  const [width, height] = view.free;
  fly([id], Math.max(leastWidth() * 2, Math.min(width, height) / view.look.scale * 0.8));
}

function choosePair(key: string): void {
  const drawn = scene?.pairs.find((each) => each.key === key);
  if (drawn === undefined) return;
  chosen.pair = key;
  chosen.track = null;
  showChosen();
  // On a phone the details are above the list, which scrolls with them.
  element("lists").scrollTop = 0;
  follow(false);
  fly(drawn.ids, leastWidth(), drawn.approach?.places);
}

function nextPair(): void {
  const pairs = lists.shownPairs;
  if (pairs.length === 0) return;
  const at = pairs.findIndex(({ key }) => key === chosen.pair);
  choosePair(pairs[(at + 1) % pairs.length]!.key);
}

/** Returns the track with the dot nearest to a place of the screen, if one is near; a finger is wider than a mouse. */
function trackAt(x: number, y: number, isFinger = false): string | null {
  let nearest: string | null = null;
  let least = isFinger ? 24 : 14;
  for (const [id, { track }] of scene?.tracks ?? []) {
    for (const place of track.places) {
      const [atX, atY] = view.toScreen(place.x, place.y);
      const distance = Math.hypot(atX - x, atY - y);
      if (distance >= least) continue;
      least = distance;
      nearest = id;
    }
  }
  return nearest;
}

function pairAt(x: number, y: number, isFinger = false): string | null {
  for (const { key, places } of scene?.pairs ?? []) {
    if (places === null) continue;
    const [a, b] = places.map((place) => view.toScreen(place.x, place.y)) as [[number, number], [number, number]];
    const length2 = (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2;
    const part = length2 === 0 ? 0 : Math.max(0, Math.min(1, ((x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1])) / length2));
    if (Math.hypot(a[0] + part * (b[0] - a[0]) - x, a[1] + part * (b[1] - a[1]) - y) < (isFinger ? 16 : 6)) return key;
  }
  return null;
}

followPointers(canvas, view, {
  moved: () => {
    follow(false);
    redraw();
  },
  chooseAt: (x, y, isFinger) => {
    chosen.track = trackAt(x, y, isFinger);
    chosen.pair = chosen.track === null ? pairAt(x, y, isFinger) : null;
    showChosen();
  },
  hoverAt: (x, y) => {
    const hovered = trackAt(x, y);
    canvas.classList.toggle("pointing", hovered !== null || pairAt(x, y) !== null);
    if (hovered === chosen.hovered) return;
    chosen.hovered = hovered;
    redraw();
  },
});

element("find").addEventListener("submit", (event) => {
  event.preventDefault();
  const wanted = element<HTMLInputElement>("find-text").value.trim().toLowerCase();
  const tracks = [...scene?.tracks ?? []];
  const found = wanted === "" ? [] : tracks.filter(([id, { label }]) => id.toLowerCase().includes(wanted) || label.toLowerCase().includes(wanted));
  const [id] = found.find(([each, { label }]) => each.toLowerCase() === wanted || label.toLowerCase() === wanted) ?? found[0] ?? [];
  element("find-answer").textContent = wanted === "" ? "" : found.length === 0 ? "No track is called so."
    : found.length > 1 ? `${found.length} tracks; this is ${labelOf(scene!, id!)}` : "";
  if (id !== undefined) chooseTrack(id, true);
});

// Settings.

/** Applies all settings to the page, and keeps them. */
function applySettings(): void {
  keepSettings(settings);
  const field = scene === null ? "plain" : fieldOf(scene.state);
  chart.units = lists.units = new Units(settings.units === "metric" && field !== "plain" ? "metric" : field);
  chart.showNames = settings.names;
  chart.showNeeds = settings.needs;
  for (const name of ["names", "needs"] as const) element<HTMLInputElement>(`set-${name}`).checked = settings[name];
  for (const name of ["units", "theme"] as const) element<HTMLSelectElement>(`set-${name}`).value = settings[name];
  element("needs-legend").hidden = !settings.needs;
  element("alarm").setAttribute("aria-pressed", String(alarm.isOn));
  element("alarm").title = `Sound and notification of new pairs (A). ${alarm.text}`;
  element("alarm-text").textContent = alarm.text;
  if (scene !== null) lists.show(scene, chosen.track, chosen.pair);
  repaint();
}

function set<Name extends keyof Settings>(name: Name, value: Settings[Name]): void {
  settings[name] = value;
  applySettings();
}

/** Call it in answer to the user alone. */
function switchAlarm(): void {
  if (alarm.isOn) alarm.turnOff();
  else void alarm.turnOn().then(applySettings);
  set("alarm", alarm.isOn);
}

element("set-units").addEventListener("change", (event) => set("units", (event.target as HTMLSelectElement).value as Settings["units"]));
element("set-theme").addEventListener("change", (event) => set("theme", (event.target as HTMLSelectElement).value as Theme));
for (const name of ["names", "needs"] as const)
  element(`set-${name}`).addEventListener("change", (event) => set(name, (event.target as HTMLInputElement).checked));
for (const order of ["time", "distance"] as const) element(`order-${order}`).addEventListener("click", () => set("order", order));
element("only").addEventListener("click", () => {
  lists.only = lists.only === null ? lists.onlyCandidate(chosen.track) : null;
  if (scene !== null) lists.show(scene, chosen.track, chosen.pair);
});

// Keys and buttons.

const step = 80;
const keys: Record<string, () => void> = {
  arrowleft: () => pan(step, 0),
  arrowright: () => pan(-step, 0),
  arrowup: () => pan(0, step),
  arrowdown: () => pan(0, -step),
  "+": () => zoom(1.5),
  "=": () => zoom(1.5),
  "-": () => zoom(1 / 1.5),
  f: () => fit(true),
  p: nextPair,
  "/": () => element("find-text").focus(),
  a: switchAlarm,
  n: () => set("names", !settings.names),
  r: () => set("needs", !settings.needs),
  s: () => element<HTMLDialogElement>("settings").showModal(),
  t: () => set("theme", document.documentElement.dataset["theme"] === "dark" ? "bright" : "dark"),
  u: () => set("units", settings.units === "field" ? "metric" : "field"),
  escape: () => chooseTrack(null, false),
  "?": () => element<HTMLDialogElement>("help").showModal(),
};
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]") !== null) return;
  const target = event.target as HTMLElement;
  if (target.matches("input")) {
    if (event.key === "Escape") canvas.focus();
    return;
  }
  // Lists scroll with arrows.
  if (event.key.startsWith("Arrow") && target.closest("#lists") !== null) return;
  const action = keys[event.key.toLowerCase()];
  if (action === undefined) return;
  event.preventDefault();
  action();
});
for (const [id, key] of [["zoom-in", "+"], ["zoom-out", "-"], ["fit", "f"], ["alarm", "a"], ["settings-open", "s"], ["help-open", "?"], ["details-close", "escape"]] as const)
  element(id).addEventListener("click", keys[key]!);
darkQuery.addEventListener("change", repaint);
new ResizeObserver(resize).observe(canvas);

// The state.

function planeOf({ origin }: WatchState): EarthPlane | null {
  if (origin === null) return null;
  return plane?.longitude === origin.lon && plane.latitude === origin.lat ? plane : new EarthPlane(origin.lon, origin.lat);
}

/** After a restart of the watch, possibly on another stream, the selection and the view may be gone. */
function meetAgain({ tracks, pairs }: Scene): void {
  if (chosen.track !== null && !tracks.has(chosen.track)) chosen.track = null;
  if (chosen.pair !== null && !pairs.some(({ key }) => key === chosen.pair)) chosen.pair = null;
  if (lists.only !== null && !tracks.has(lists.only)) lists.only = null;
  const { left, right, bottom, top } = view.bounds;
  if (![...placesOf(tracks.values())].some(({ x, y }) => x > left && x < right && y > bottom && y < top)) follow(true);
}

function show(state: WatchState): void {
  const isFirst = scene === null || scene.tracks.size === 0;
  const wasLost = !element("lost").hidden;
  element("lost").hidden = true;
  document.body.classList.remove("lost");
  scene = sceneOf(state);
  pairHistory.take(scene, chosen.pair);
  plane = planeOf(state);
  const bounds = boundsOf(placesOf(scene.tracks.values()));
  if ((isFirst || wasLost) && bounds !== null) meetAgain(scene);
  if (chart.units.kind === "plain" || isFirst || wasLost) applySettings();
  else lists.show(scene, chosen.track, chosen.pair);
  alarm.take(scene.pairs);
  if (isFollowing && bounds !== null && (isFirst || !view.suits(bounds, leastWidth()))) fit(!isFirst);
  followAddress();
  map.states += 1;
  redraw();
}

function lose({ since, reason }: Lost): void {
  const clock = since.toLocaleTimeString("en-GB");
  const last = scene === null ? "" : ` What is shown is its state at ${timeText(scene.state.time).text} of the stream.`;
  const text = `The stream has ended, or the watch cannot be reached, since ${clock}${reason === "" ? "" : ` (${reason})`}.${last}`;
  const place = element("lost");
  place.hidden = false;
  if (place.textContent !== text) place.textContent = text;
  document.body.classList.add("lost");
  if (scene === null) element("about").textContent = "No state has come yet.";
}

/** For tests, and for the console. */
const map = {
  get scene(): Scene | null { return scene; },
  get plane(): EarthPlane | null { return plane; },
  view,
  chosen,
  settings,
  alarm,
  get coastSize(): number { return chart.coast.size; },
  get labels() { return chart.labels; },
  /** Shows another state than the watch's. */
  show,
  redraw,
  pictures: 0,
  states: 0,
  /** Duration of the last drawing. Unit: milliseconds. */
  drawing: 0,
};
declare global {
  interface Window { kinesphereMap: typeof map }
}
window.kinesphereMap = map;

if (settings.alarm) alarm.restore();
applySettings();
resize();
const polling = new Polling("state.json", show, lose);
void polling.ask();
// A hidden page has not fetched the state for a while.
document.addEventListener("visibilitychange", () => {
  if (!document.hidden) void polling.ask();
});
