// The lists next to the map: numbers, open pairs, report requests, and all about the chosen track.
import { Numbers, put, whole } from "../numbers.ts";
import { KeyedList, part } from "./keyed_list.ts";
import type { DrawnPair, Scene } from "./scene.ts";
import type { Need, Pair, StreamTime } from "./state.ts";
import { durationBetween, durationText, lengthText, placeText, rangeText, shownName, timeText, unbroken, velocityText, whenText } from "./text.ts";

const element = (id: string): HTMLElement => document.querySelector<HTMLElement>(`#${id}`)!;

/** Maximum shown entries of a list; the rest are counted. */
const mostShown = 100;

/** Seconds without progress of time after which the page says so. */
const longestQuiet = 10;

/** Reasons for skipped reports, by their names in the state. */
const refusals = ["stale", "ahead", "outside", "no_position", "no_height", "no_bound", "malformed"];

export interface ListActions {
  choosePair(key: string): void;
  chooseTrack(id: string): void;
}

export class Lists {
  private readonly numbers = new Numbers(element("numbers"));
  private readonly time = this.numbers.row("time", "Time of the stream; red with how long it has stood still");
  private readonly tracks = this.numbers.row("tracks", "Tracks that are watched");
  private readonly within = this.numbers.row("within", "Pairs and separations that are certainly within");
  private readonly undecided = this.numbers.row("undecided", "Pairs and separations that the reports leave open");
  private readonly needed = this.numbers.row("needed", "Tracks whose reports are needed next");
  private readonly reports = this.numbers.row("reports", "Reports that were taken; repeated ones and those refused are not");
  private readonly alerts = this.numbers.row("alerts", "Lines that the watch has written");
  private readonly pairs: KeyedList<DrawnPair>;
  private readonly needs: KeyedList<Need>;
  private scene: Scene | null = null;
  private latest: { time: StreamTime | null; seenAt: number } = { time: null, seenAt: performance.now() };

  constructor(private readonly actions: ListActions) {
    this.within.row.classList.add("within");
    this.undecided.row.classList.add("undecided");
    this.needed.row.classList.add("need");
    this.pairs = new KeyedList(element("pairs"), (button, key) => this.makePair(button, key));
    this.needs = new KeyedList(element("needs"), (button, key) => this.makeNeed(button, key));
  }

  show(scene: Scene, chosenTrack: string | null, chosenPair: string | null): void {
    this.scene = scene;
    this.showNumbers(scene);
    showCounted("pairs", scene.pairs.length);
    this.pairs.show(scene.pairs.slice(0, mostShown), ({ key }) => key);
    showCounted("needs", scene.needs.length);
    this.needs.show(scene.needs.slice(0, mostShown), ({ track }) => track);
    if (scene.pairs.length === 0) element("pairs-more").textContent = scene.state.time === null ? "No report has come yet." : "All tracks are certainly apart.";
    if (scene.state.time !== null && scene.needs.length === 0) element("needs-more").textContent = "No report is needed yet.";
    this.showChosen(chosenTrack, chosenPair);
  }

  showChosen(track: string | null, pair: string | null): void {
    for (const button of document.querySelectorAll("#lists li button[aria-pressed='true']")) button.setAttribute("aria-pressed", "false");
    if (pair !== null) this.pairs.button(pair)?.setAttribute("aria-pressed", "true");
    if (track !== null) this.needs.button(track)?.setAttribute("aria-pressed", "true");
    element("details").hidden = track === null;
    if (track !== null && this.scene !== null) this.showDetails(this.scene, track);
  }

  private get isMetric(): boolean {
    return this.scene?.state.geographic === true;
  }

  private showNumbers({ state, pairs, needs }: Scene): void {
    const { counts } = state;
    element("about").textContent = shownName(state.stream);
    const { text, date } = timeText(state.time);
    if (state.time !== this.latest.time) this.latest = { time: state.time, seenAt: performance.now() };
    const stillFor = (performance.now() - this.latest.seenAt) / 1000;
    put(this.time, text, stillFor < longestQuiet ? date : `for ${durationText(stillFor)}`);
    this.time.row.classList.toggle("bad", stillFor >= longestQuiet);
    const silent = state.tracks.filter((track) => track.silent).length;
    put(this.tracks, whole.format(state.tracks.length), silent > 0 ? `${whole.format(silent)} silent` : "");
    const within = pairs.filter(({ pair }) => pair.verdict === "within").length;
    put(this.within, whole.format(within), "");
    put(this.undecided, whole.format(pairs.length - within), "");
    put(this.needed, whole.format(needs.length), "");
    const refused = refusals.reduce((sum, name) => sum + (counts[name] ?? 0), 0);
    put(this.reports, whole.format(counts["reports"] ?? 0), refused > 0 ? `${whole.format(refused)} refused` : "");
    const contradictions = counts["contradictions"] ?? 0;
    put(this.alerts, whole.format(counts["alerts"] ?? 0), contradictions > 0 ? `${whole.format(contradictions)} contradiction${contradictions === 1 ? "" : "s"}` : "");
  }

  private makePair(button: HTMLButtonElement, key: string): (drawn: DrawnPair) => void {
    const ids = document.createElement("span");
    ids.className = "ids";
    button.append(ids);
    const first = part(ids, "");
    part(ids, "between")("–");
    const second = part(ids, "");
    const verdict = part(ids, "verdict");
    const distance = part(button, "said");
    const times = part(button, "said");
    const next = part(button, "said");
    button.title = "Go there. The distance lies between these limits; the closest approach is that of two who go straight on.";
    button.setAttribute("aria-pressed", "false");
    button.addEventListener("click", () => this.actions.choosePair(key));
    return ({ pair }) => {
      button.className = pair.verdict;
      first(shownName(pair.first));
      second(shownName(pair.second));
      verdict(pair.verdict);
      distance(unbroken(this.distanceText(pair)));
      times(unbroken(this.timesText(pair)));
      next(unbroken(this.nextText(pair)));
    };
  }

  private distanceText({ separation, distance: [lower, upper] }: Pair): string {
    return `${shownName(separation)} · ${rangeText(lower ?? 0, upper, this.isMetric)}`;
  }

  private timesText(pair: Pair): string {
    const now = this.scene?.state.time ?? null;
    const since = pair.since === null || now === null ? "from the start" : `for ${durationBetween(pair.since, now)}`;
    if (pair.verdict === "undecided") return `${since} · ask ${shownName(pair.ask)} now`;
    return `${since} · certain ${pair.until === null || now === null ? "for ever" : `for ${durationBetween(now, pair.until)} more`}`;
  }

  private nextText(pair: Pair): string {
    const now = this.scene?.state.time ?? null;
    const parts: string[] = [];
    if (pair.verdict === "within" && pair.ask_by !== null) parts.push(`ask ${shownName(pair.ask)} ${whenText(pair.ask_by, now)}`);
    if (pair.closest_distance !== null) parts.push(`closest ${lengthText(pair.closest_distance, this.isMetric)} ${whenText(pair.closest_time, now)}`);
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
      name(shownName(need.track));
      by(whenText(need.by, this.scene?.state.time ?? null));
      other(`because of ${shownName(need.other)}`);
    };
  }

  private showDetails({ state, tracks, pairs }: Scene, id: string): void {
    element("details-title").textContent = shownName(id);
    const drawn = tracks.get(id);
    const rows: [string, string][] = [];
    if (drawn === undefined) {
      rows.push(["", "It has left: nothing was heard of it for too long."]);
    } else {
      const { track, need } = drawn;
      const isFlat = state.dimensions === 2;
      rows.push(["last report", `${whenText(track.stamp, state.time)}${track.silent ? ", silent since" : ""}`]);
      if (track.places.length > 1) rows.push(["", `Reports contradict each other: it is in one of ${track.places.length} places.`]);
      for (const place of track.places) {
        const [horizontal, vertical] = place.radius;
        rows.push(["place", placeText(place, isFlat)]);
        rows.push(["bound", `within ${lengthText(horizontal, this.isMetric)} of there${isFlat ? "" : `, ${lengthText(vertical, this.isMetric)} in height`}`]);
        rows.push(["velocity", velocityText(place, this.isMetric, isFlat)]);
      }
      if (need !== null) rows.push(["needed", `${whenText(need.by, state.time)}, because of ${shownName(need.other)}`]);
      for (const { pair } of pairs) {
        if (pair.first !== id && pair.second !== id) continue;
        rows.push([pair.verdict, `${shownName(pair.first === id ? pair.second : pair.first)}, ${shownName(pair.separation)}`]);
      }
    }
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
}

/** Shows the number of all entries, and of those that a list leaves out. */
function showCounted(list: string, count: number): void {
  element(`${list}-count`).textContent = count > 0 ? whole.format(count) : "";
  element(`${list}-more`).textContent = count > mostShown ? `and ${whole.format(count - mostShown)} more` : "";
}
