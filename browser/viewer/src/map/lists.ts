// The lists next to the map: numbers, closest approaches, report requests, and all about the chosen track.
import { DistanceChart } from "../distance_chart.ts";
import { inksOf } from "../inks.ts";
import { Numbers, put, whole } from "../numbers.ts";
import { KeyedList, part } from "./keyed_list.ts";
import { distanceNow, type PairHistory } from "./pair_history.ts";
import { compareByDistance, compareByTime, type DrawnPair, knowsHeight, labelOf, type Scene } from "./scene.ts";
import type { Settings } from "./settings.ts";
import type { Need, StreamTime } from "./state.ts";
import { durationBetween, durationText, placeText, secondsOf, rangeText, shownName, timeText, unbroken, velocityText, whenText } from "./text.ts";
import { Units } from "./units.ts";

const element = (id: string): HTMLElement => document.querySelector<HTMLElement>(`#${id}`)!;

/** Maximum shown entries of a list; the rest are counted. */
const mostShown = 100;

/** Seconds without progress of time after which the page says so. */
const longestQuiet = 10;

/** Reasons for skipped reports, by their names in the state. */
const refusals = ["too_old", "ahead", "outside", "no_position", "no_height", "no_bound", "malformed"];

export interface ListActions {
  choosePair(key: string): void;
  chooseTrack(id: string): void;
}

export class Lists {
  units = new Units("plain");
  /** The track whose pairs are the only ones in the list; null for all. */
  only: string | null = null;
  private readonly numbers = new Numbers(element("numbers"));
  private readonly time = this.numbers.row("time", "Time of the stream; red with how long it has stood still");
  private readonly tracks = this.numbers.row("tracks", "Tracks that are watched");
  private readonly within = this.numbers.row("within", "Pairs and separations that are certainly within");
  private readonly predicted = this.numbers.row("predicted", "Pairs and separations that are predicted");
  private readonly undecided = this.numbers.row("undecided", "Pairs and separations that the reports leave open");
  private readonly needed = this.numbers.row("needed", "Tracks whose reports are needed next");
  private readonly reports = this.numbers.row("reports", "Reports that were taken; repeated ones and those refused are not");
  private readonly alerts = this.numbers.row("alerts", "Lines that the watch has written");
  private readonly pairs: KeyedList<DrawnPair>;
  private readonly needs: KeyedList<Need>;
  private scene: Scene | null = null;
  private latest: { time: StreamTime | null; seenAt: number } = { time: null, seenAt: performance.now() };

  private readonly chart = new DistanceChart(element("details-chart") as HTMLCanvasElement);

  constructor(private readonly actions: ListActions, private readonly settings: Settings, private readonly history: PairHistory) {
    this.within.row.classList.add("within");
    this.predicted.row.classList.add("predicted");
    this.undecided.row.classList.add("undecided");
    this.needed.row.classList.add("need");
    this.pairs = new KeyedList(element("pairs"), (button, key) => this.makePair(button, key));
    this.needs = new KeyedList(element("needs"), (button, key) => this.makeNeed(button, key));
  }

  show(scene: Scene, chosenTrack: string | null, chosenPair: string | null): void {
    this.scene = scene;
    this.showNumbers(scene);
    const pairs = this.shownPairs;
    showCounted("pairs", pairs.length);
    this.pairs.show(pairs.slice(0, mostShown), ({ key }) => key);
    if (pairs.length === 0) element("pairs-more").textContent = scene.state.time === null ? "No report has come yet."
      : scene.pairs.length > 0 ? `No pair of ${labelOf(scene, this.only!)} is predicted or open.` : "No pair is predicted, and all tracks are certainly apart.";
    element("needs-section").hidden = !this.settings.needs;
    if (this.settings.needs) {
      showCounted("needs", scene.needs.length);
      this.needs.show(scene.needs.slice(0, mostShown), ({ track }) => track);
      if (scene.state.time !== null && scene.needs.length === 0) element("needs-more").textContent = "No report is needed yet.";
    }
    this.showChosen(chosenTrack, chosenPair);
  }

  showChosen(track: string | null, pair: string | null): void {
    for (const button of document.querySelectorAll("#lists li button[aria-pressed='true']")) button.setAttribute("aria-pressed", "false");
    if (pair !== null) this.pairs.button(pair)?.setAttribute("aria-pressed", "true");
    if (track !== null) this.needs.button(track)?.setAttribute("aria-pressed", "true");
    this.showOnly(track);
    element("details").hidden = track === null && pair === null;
    this.chart.canvas.hidden = pair === null;
    if (this.scene === null) return;
    if (track !== null) this.showDetails(this.scene, track);
    else if (pair !== null) this.showPair(this.scene, pair);
  }

  /** The pairs of the list, in its order. */
  get shownPairs(): DrawnPair[] {
    const pairs = (this.scene?.pairs ?? []).filter(({ ids }) => this.only === null || ids.includes(this.only));
    return pairs.sort(this.settings.order === "time" ? compareByTime : compareByDistance);
  }

  /** Returns the track whose pairs alone can be listed: the listed one, else the chosen one, else the own one. */
  onlyCandidate(chosenTrack: string | null): string | null {
    return this.only ?? chosenTrack ?? this.scene?.state.own ?? null;
  }

  /** Returns what an alarm says about a pair. */
  wordsOf(drawn: DrawnPair): { title: string; text: string } {
    const [one, other] = this.labelsOf(drawn);
    return { title: `${drawn.concern === "within" ? "Within" : "Predicted"}: ${one} – ${other}`, text: `${shownName(drawn.pair.separation)}; ${this.approachLine(drawn)}` };
  }

  private showOnly(chosenTrack: string | null): void {
    const candidate = this.onlyCandidate(chosenTrack);
    const button = element("only");
    button.hidden = candidate === null;
    button.setAttribute("aria-pressed", String(this.only !== null));
    button.textContent = candidate === null || this.scene === null ? "" : `only ${labelOf(this.scene, candidate)}`;
    for (const order of ["time", "distance"] as const) element(`order-${order}`).setAttribute("aria-pressed", String(this.settings.order === order));
  }

  private showNumbers({ state, pairs, needs }: Scene): void {
    const { counts } = state;
    element("about").textContent = shownName(state.stream);
    const { text, date } = timeText(state.time);
    if (state.time !== this.latest.time) this.latest = { time: state.time, seenAt: performance.now() };
    const stillFor = (performance.now() - this.latest.seenAt) / 1000;
    put(this.time, text, stillFor < longestQuiet ? date : `for ${durationText(stillFor)}`);
    this.time.row.classList.toggle("bad", stillFor >= longestQuiet);
    const stale = state.tracks.filter((track) => track.stale).length;
    put(this.tracks, whole.format(state.tracks.length), stale > 0 ? `${whole.format(stale)} stale` : "");
    const count = (is: (pair: DrawnPair) => boolean) => whole.format(pairs.filter(is).length);
    put(this.within, count(({ pair }) => pair.verdict === "within"), "");
    put(this.predicted, count(({ isPredicted }) => isPredicted), "");
    put(this.undecided, count(({ pair }) => pair.verdict === "undecided"), "");
    this.needed.row.hidden = !this.settings.needs;
    put(this.needed, whole.format(needs.length), "");
    const refused = refusals.reduce((sum, name) => sum + (counts[name] ?? 0), 0);
    put(this.reports, whole.format(counts["reports"] ?? 0), refused > 0 ? `${whole.format(refused)} refused` : "");
    const contradictions = counts["contradictions"] ?? 0;
    put(this.alerts, whole.format(counts["alerts"] ?? 0), contradictions > 0 ? `${whole.format(contradictions)} contradiction${contradictions === 1 ? "" : "s"}` : "");
  }

  private labelsOf({ ids: [one, other] }: DrawnPair): [string, string] {
    return this.scene === null ? [one, other] : [labelOf(this.scene, one), labelOf(this.scene, other)];
  }

  private makePair(button: HTMLButtonElement, key: string): (drawn: DrawnPair) => void {
    const ids = document.createElement("span");
    ids.className = "ids";
    button.append(ids);
    const first = part(ids, "");
    part(ids, "between")("–");
    const second = part(ids, "");
    const concern = part(ids, "verdict");
    const approach = part(button, "approach");
    const distance = part(button, "said");
    const times = part(button, "said");
    button.setAttribute("aria-pressed", "false");
    button.addEventListener("click", () => this.actions.choosePair(key));
    return (drawn) => {
      button.className = drawn.concern;
      button.title = `${drawn.ids.map(shownName).join(" and ")}: go there. The closest approach is that of two who go straight on.`;
      const labels = this.labelsOf(drawn);
      first(labels[0]);
      second(labels[1]);
      concern(drawn.concern);
      approach(unbroken(this.approachLine(drawn)));
      distance(unbroken(this.distanceLine(drawn)));
      times(unbroken(this.timesLine(drawn)));
    };
  }

  private approachLine({ approach, pair }: DrawnPair): string {
    if (approach === null) return pair.closest_distance === null ? "" : "closest now";
    const { above, distance, error, seconds } = approach;
    return `CPA ${this.units.lengthWithin(distance, error)}${above === null ? "" : `, ${this.units.above(above, 0)}`} · in ${durationText(seconds)}`;
  }

  /** Returns the present distance: horizontal, or what the separation measures, and vertical. */
  private distanceLine({ pair: { distance: [lower, upper] }, above }: DrawnPair): string {
    return `now ${rangeText(lower ?? 0, upper, this.units)}${above === null ? "" : ` · ${this.units.above(above.difference, above.rate)}`}`;
  }

  private timesLine({ pair, isPredicted }: DrawnPair): string {
    const now = this.scene?.state.time ?? null;
    const since = pair.since === null || now === null ? "from the start" : `for ${durationBetween(pair.since, now)}`;
    const parts = [shownName(pair.separation)];
    if (pair.verdict === "apart") parts.push(since);
    if (pair.verdict === "undecided") parts.push(`${isPredicted ? "undecided " : ""}${since}`);
    if (pair.verdict === "within") parts.push(since, `certain ${pair.until === null || now === null ? "for ever" : `for ${durationBetween(now, pair.until)} more`}`);
    if (this.settings.needs && pair.ask_by !== null && this.scene !== null)
      parts.push(`ask ${labelOf(this.scene, pair.ask)} ${pair.verdict === "undecided" ? "now" : whenText(pair.ask_by, now)}`);
    return parts.join(" · ");
  }

  private makeNeed(button: HTMLButtonElement, id: string): (need: Need) => void {
    const ids = document.createElement("span");
    ids.className = "ids";
    button.append(ids);
    const name = part(ids, "");
    const by = part(ids, "verdict");
    const other = part(button, "said");
    button.className = "need";
    button.setAttribute("aria-pressed", "false");
    button.addEventListener("click", () => this.actions.chooseTrack(id));
    return (need) => {
      name(labelOf(this.scene!, need.track));
      by(whenText(need.by, this.scene?.state.time ?? null));
      other(`because of ${labelOf(this.scene!, need.other)}`);
    };
  }

  private showDetails(scene: Scene, id: string): void {
    const { state, tracks, pairs } = scene;
    const { units } = this;
    const drawn = tracks.get(id);
    element("details-title").textContent = labelOf(scene, id);
    const rows: [string, string][] = [];
    if (drawn === undefined) {
      rows.push(["", "It has left: nothing was heard of it for too long."]);
    } else {
      const { track, need } = drawn;
      const isFlat = state.dimensions === 2;
      if (track.name !== null) rows.push(["id", shownName(id)]);
      if (id === state.own) rows.push(["", "The own one: only its pairs are watched."]);
      rows.push(["last report", `${whenText(track.stamp, state.time)}${track.stale ? ", stale since" : ""}`]);
      if (track.places.length > 1) rows.push(["", `Reports contradict each other: it is in one of ${track.places.length} places.`]);
      for (const place of track.places) {
        const [horizontal, vertical] = place.radius;
        const hasNoHeight = isFlat || !knowsHeight(place, state);
        rows.push(["place", placeText(place, units, hasNoHeight)]);
        rows.push(["bound", `within ${units.length(horizontal)} of there${isFlat ? "" : hasNoHeight ? ", at any height" : `, ${units.height(vertical)} in height`}`]);
        rows.push(["velocity", velocityText(place, units, hasNoHeight)]);
      }
      if (need !== null && this.settings.needs) rows.push(["needed", `${whenText(need.by, state.time)}, because of ${labelOf(scene, need.other)}`]);
      for (const { pair, concern } of pairs) {
        if (pair.first !== id && pair.second !== id) continue;
        rows.push([concern, `${labelOf(scene, pair.first === id ? pair.second : pair.first)}, ${shownName(pair.separation)}`]);
      }
    }
    showRows(rows);
  }

  /** Shows the distance of a pair over time: as far as it was seen, and as it is expected. */
  private showPair(scene: Scene, key: string): void {
    const { units } = this;
    const [first, second] = JSON.parse(key) as [string, string, number];
    const drawn = scene.pairs.find((pair) => pair.key === key);
    const labels = drawn === undefined ? [labelOf(scene, first), labelOf(scene, second)] : this.labelsOf(drawn);
    element("details-title").textContent = labels.join(" – ");
    const rows: [string, string][] = [];
    const curve = this.history.of(key);
    const time = scene.state.time === null ? null : secondsOf(scene.state.time);
    const distance = drawn === undefined ? null : distanceNow(drawn);
    const now = time === null || distance === null ? null : { time, distance };
    const approach = drawn?.approach ?? null;
    if (drawn === undefined) rows.push(["", "No approach of the two is predicted now, and they are certainly apart."]);
    else rows.push(["now", `${units.length(distance)}, certainly ${this.distanceLine(drawn).slice("now ".length)}`]);
    if (curve?.least != null) rows.push(["closest so far", `${units.length(curve.least.distance)} at ${timeText(curve.least.time).text}`]);
    if (drawn !== undefined && approach !== null) rows.push(["expected", this.approachLine(drawn)]);
    showRows(rows);
    this.chart.canvas.hidden = curve === null;
    if (curve === null || time === null) return;
    const expected = approach === null ? null : { time: time + approach.seconds, distance: approach.distance, error: approach.error };
    const separation = scene.state.separations.find(({ name }) => name === drawn?.pair.separation);
    this.chart.canvas.setAttribute("aria-label", `Distance of ${labels.join(" and ")} over time; ${rows.map((row) => row.join(" ")).join("; ")}`);
    this.chart.inks = inksOf(this.chart.canvas);
    this.chart.draw(curve, {
      span: [curve.line[0]!.time, Math.max(expected?.time ?? time, time, curve.line[0]!.time + 1)], now, expected,
      lines: separation === undefined ? [] : [{ distance: separation.horizontal, words: units.length(separation.horizontal) }],
    }, { length: (length) => units.length(length), unitOf: (longest) => units.unitOfBar(longest), time: (at) => timeText(at).text });
  }
}

function showRows(rows: readonly (readonly [string, string])[]): void {
  element("details-rows").replaceChildren(...rows.map(([name, value]) => {
    const row = document.createElement("div");
    const term = document.createElement("dt");
    const description = document.createElement("dd");
    term.textContent = name;
    description.textContent = value;
    row.append(term, description);
    return row;
  }));
}

/** Shows the number of all entries, and of those that a list leaves out. */
function showCounted(list: string, count: number): void {
  element(`${list}-count`).textContent = count > 0 ? whole.format(count) : "";
  element(`${list}-more`).textContent = count > mostShown ? `and ${whole.format(count - mostShown)} more` : "";
}
