// The live picture of the first page: discs whose bounds grow until they are asked, and what a loop of 60 Hz misses.
import { type DiscsChoice, discsEnd } from "../scenes/discs.ts";
import type { Simulation } from "../simulation.ts";
import { calmQuery } from "../theme.ts";
import { drawAsLoop, drawDiscs, looksUntil } from "./discs_picture.ts";
import { button, copyButton, make, slider } from "./elements.ts";
import { FlatPicture } from "../flat_picture.ts";
import { followInks } from "../inks.ts";
import { newSimulation, type WholeRun, wholeRun } from "./whole_run.ts";

/** Simulated seconds in a second. */
const speed = 0.1;
/** Seconds for which the end of a run stays. */
const endShown = 3;
/** The boxes of the two shapes: for wide pages, and for phones. */
const shapes = { wide: { width: 24, height: 9 }, tall: { width: 12, height: 9 } } as const;
type Shape = keyof typeof shapes;

/** What the address says: the same for everybody, as runs are equal to the last bit. */
interface Moment {
  shape: Shape;
  seed: number;
  /** Null if nothing is said: the run begins, and plays. */
  time: number | null;
  view: DiscsView;
}
/** What is seen: what Kinesphere finds, what a loop of 60 Hz does, or both beside each other. */
type DiscsView = "all" | "loop" | "both";

const largestSeed = 9999;

function momentOf(address: URL): Moment {
  const { searchParams } = address;
  const seed = Number(searchParams.get("seed") ?? NaN);
  const time = Number(searchParams.get("t") ?? NaN);
  const shape = searchParams.get("shape");
  return {
    shape: shape === "wide" || shape === "tall" ? shape : matchMedia("(max-width: 720px)").matches ? "tall" : "wide",
    seed: Number.isInteger(seed) && seed >= 1 && seed <= largestSeed ? seed : 4,
    time: time >= 0 && time <= discsEnd ? time : null,
    view: (["loop", "both"] as const).find((view) => view === searchParams.get("view")) ?? "all",
  };
}

/** Elements of the page, by what goes into them. */
export type Places = Readonly<Record<"discs" | "numbers" | "controls" | "legend", HTMLElement>>;

export class DiscsDemo {
  readonly moment: Moment;
  simulation: Simulation;
  run: WholeRun;
  playing = false;
  private ended = 0;
  private last = 0;
  private inSight = true;
  private readonly canvas = make("canvas", { role: "img", class: "live-canvas" });
  private readonly loopCanvas = make("canvas", { role: "img", class: "live-canvas", "aria-label": "The same as a loop of 60 Hz sees it" });
  private readonly picture: FlatPicture;
  /** Beside the other one, if both are seen. */
  private readonly loopPicture: FlatPicture;
  private readonly views = make("div", { class: "live-views" });
  private readonly play = button("Pause", () => this.setPlaying(!this.playing));
  private readonly loop = button("As 60 Hz sees it", () => this.see(this.moment.view === "loop" ? "all" : "loop"));
  private readonly both = button("Side by side", () => this.see(this.moment.view === "both" ? "all" : "both"));
  private readonly timeline = slider("Time", [0, discsEnd, 0.001], 0, (time) => { this.setPlaying(false); this.goTo(time); });
  private readonly marks = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  private readonly cells: Record<"found" | "seen" | "missed" | "asked" | "looks", HTMLElement>;

  /** Fills elements of the page. */
  constructor({ discs: place, numbers, controls, legend: legendPlace }: Places) {
    this.moment = momentOf(new URL(location.href));
    this.simulation = newSimulation(this.choice);
    this.run = wholeRun(this.choice);
    const { width, height } = shapes[this.moment.shape];
    const picture = (canvas: HTMLCanvasElement) => {
      canvas.style.aspectRatio = `${width} / ${height}`;
      return new FlatPicture(canvas, { left: 0, bottom: 0, right: width, top: height });
    };
    [this.picture, this.loopPicture] = [picture(this.canvas), picture(this.loopCanvas)];
    this.canvas.setAttribute("aria-label", "Discs bounce in a box, ten times slower than they are. A ring around each, where it must " +
      "be, grows until the disc is asked. Contacts are marked; those that a loop of 60 Hz misses keep a ring with a cross.");
    this.cells = fillNumbers(numbers);
    legendPlace.replaceChildren(legend());
    this.marks.setAttribute("class", "live-marks");
    this.marks.setAttribute("aria-hidden", "true");
    this.views.append(make("figure", {}, this.canvas, make("figcaption", {}, "Kinesphere")),
                      make("figure", { class: "live-loop" }, this.loopCanvas, make("figcaption", {}, "60 Hz")));
    place.replaceChildren(this.views);
    controls.replaceChildren(make("div", { class: "live-timeline" }, rowNames(), this.marks, this.timeline.row), this.buttons());
    followInks(place, (inks) => {
      this.picture.inks = this.loopPicture.inks = inks;
      this.draw();
    });
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    new IntersectionObserver(([seen]) => { this.inSight = seen!.isIntersecting; }).observe(this.canvas);
    this.markContacts();
    this.see(this.moment.view);
    this.goTo(this.moment.time ?? (calmQuery.matches ? 1 : 0));
    this.setPlaying(this.moment.time === null && !calmQuery.matches);
    requestAnimationFrame((now) => this.frame(now));
  }

  /** The address of what is seen now. */
  get address(): string {
    const { shape, seed, view } = this.moment;
    const address = new URL(location.href);
    address.search = new URLSearchParams({ shape, seed: `${seed}`, t: this.simulation.time.toFixed(4), ...(view !== "all" && { view }) }).toString();
    address.hash = "";
    return address.href;
  }

  setPlaying(playing: boolean): void {
    if (playing && this.simulation.time >= discsEnd) this.goTo(0);
    this.playing = playing;
    this.ended = 0;
    this.play.textContent = playing ? "Pause" : "Play";
  }

  goTo(time: number): void {
    if (time < this.simulation.time) this.simulation.back(this.simulation.time - time);
    this.simulation.run(time);
    this.draw();
  }

  /** Goes on to the next contact of two discs, and stays there. */
  next(): void {
    this.setPlaying(false);
    const next = this.run.contacts.find(({ time, ofTwo }) => ofTwo && time > this.simulation.time);
    this.goTo(next?.time ?? 0);
  }

  see(view: DiscsView): void {
    this.moment.view = this.views.dataset["view"] = view;
    this.loop.setAttribute("aria-pressed", `${view === "loop"}`);
    this.both.setAttribute("aria-pressed", `${view === "both"}`);
    this.draw();
  }

  /** Begins another run. */
  choose(seed: number): void {
    this.moment.seed = seed;
    this.simulation.free();
    this.simulation = newSimulation(this.choice);
    this.run = wholeRun(this.choice);
    this.markContacts();
    this.goTo(0);
  }

  private get choice(): DiscsChoice {
    return { ...shapes[this.moment.shape], seed: this.moment.seed };
  }

  private buttons(): HTMLElement {
    const another = () => { this.choose(this.moment.seed % largestSeed + 1); this.setPlaying(!calmQuery.matches); };
    return make("div", { class: "live-buttons" }, this.play, button("Next contact", () => this.next()), this.loop, this.both,
                button("Another run", another), copyButton("Copy link", () => this.address));
  }

  /** Draws a line for each contact: above those that are found here, below those that a loop sees. */
  private markContacts(): void {
    this.marks.setAttribute("viewBox", `0 0 ${discsEnd} 2`);
    this.marks.setAttribute("preserveAspectRatio", "none");
    const line = (time: number, from: number, to: number) => `M${time.toFixed(4)} ${from}V${to}`;
    const pairs = this.run.contacts.filter(({ ofTwo }) => ofTwo);
    const path = (name: string, marks: string[]) => `<path class="${name}" d="${marks.join("")}"/>`;
    this.marks.innerHTML =
      path("found", pairs.filter(({ missed }) => !missed).map(({ time }) => line(time, 0.1, 0.9) + line(time, 1.1, 1.9))) +
      path("missed", pairs.filter(({ missed }) => missed).map(({ time }) => line(time, 0.1, 0.9)));
  }

  private frame(now: number): void {
    requestAnimationFrame((later) => this.frame(later));
    const passed = Math.min((now - this.last) / 1000, 0.05);
    this.last = now;
    if (!this.playing || !this.inSight) return;
    if (this.simulation.time >= discsEnd) {
      this.ended += passed;
      if (this.ended < endShown) return;
      this.ended = 0;
      this.choose(this.moment.seed % largestSeed + 1);
    }
    this.goTo(Math.min(this.simulation.time + speed * passed, discsEnd));
  }

  private draw(): void {
    if (this.picture.inks === null || this.canvas.clientWidth === 0) return;
    (this.moment.view === "loop" ? drawAsLoop : drawDiscs)(this.picture, this.simulation, this.run);
    if (this.moment.view === "both") drawAsLoop(this.loopPicture, this.simulation, this.run);
    const { time, tally, view } = this.simulation;
    this.timeline.input.value = `${time}`;
    this.timeline.output.textContent = `${time.toFixed(3)} s`;
    const { found, seen, missed, asked, looks } = this.cells;
    found.textContent = tally.contacts.toLocaleString("en");
    seen.textContent = (tally.contacts - tally.missed).toLocaleString("en");
    missed.textContent = tally.missed.toLocaleString("en");
    asked.textContent = view.counters.probes.toLocaleString("en");
    looks.textContent = looksUntil(time, this.simulation.radii().length).toLocaleString("en");
  }
}

/** Makes the table of numbers; returns the places of those that change. */
function fillNumbers(place: HTMLElement): DiscsDemo["cells"] {
  const cell = (name: string) => make("td", { "data-number": name });
  const cells = { found: cell("found"), seen: cell("seen"), missed: cell("missed"), asked: cell("asked"), looks: cell("looks") };
  const row = (words: string, ...row: Node[]) => make("tr", {}, make("th", { scope: "row" }, words), ...row);
  const heads = ["Kinesphere", "60 Hz"].map((words) => make("th", { scope: "col" }, words));
  place.replaceChildren(make("table", { class: "live-table" },
    make("caption", {}, "Ten times slower than it is"),
    make("thead", {}, make("tr", {}, make("td"), ...heads)),
    make("tbody", {}, row("contacts found", cells.found, cells.seen), row("missed", make("td", {}, "0"), cells.missed),
         row("states asked", cells.asked, cells.looks))));
  return cells;
}

/** What the two rows of lines above the slider are. */
function rowNames(): HTMLElement {
  return make("div", { class: "live-rows", "aria-hidden": "true" }, make("span", {}, "all"), make("span", {}, "60 Hz"));
}

function legend(): HTMLElement {
  const entries: [string, string][] = [
    ['<circle class="bound" cx="12" cy="12" r="10"/><circle class="disc" cx="12" cy="12" r="6"/>', "bound: where a disc must be. It grows"],
    ['<circle class="disc" cx="12" cy="12" r="10"/><circle class="probe" cx="12" cy="12" r="5"/>', "asked just now: the bound shrinks to the disc"],
    ['<circle class="contact" cx="12" cy="12" r="9"/>', "contact"],
    ['<circle class="missed" cx="12" cy="12" r="10"/><path class="missed" d="m7 7 10 10m0-10L7 17"/>', "contact that a loop of 60 Hz misses"],
    ['<path class="trail" d="M0 12h24"/><path class="look" d="M1 8h8v8H1zm14 0h8v8h-8z"/>', "where such a loop looks"],
  ];
  const list = make("ul", { class: "live-legend" });
  list.innerHTML = entries.map(([drawing, words]) =>
    `<li><svg viewBox="0 0 24 24" aria-hidden="true">${drawing}</svg>${words}</li>`).join("");
  return list;
}
