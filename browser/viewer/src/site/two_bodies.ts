// The lesson in two bodies: their promise is dragged, and time goes from step to step.
import { calmQuery } from "../theme.ts";
import { button, copyButton, make, slider } from "./elements.ts";
import { FlatPicture } from "../flat_picture.ts";
import { followInks } from "../inks.ts";
import { type Life, lifeEnd, lifeOf, type Moment, momentOf, type Step, trueAccelerations } from "./two_bodies_life.ts";
import { chartExtent, drawChart, drawPlane, planeExtent } from "./two_bodies_picture.ts";

const [leastLimit, mostLimit, firstLimit] = [0.2, 6, 1];
/** Seconds of the lesson in a second, while it plays and on the way to the next step. */
const [playSpeed, stepSpeed] = [0.5, 1.5];
const names = "AB";

function numberIn(address: URL, name: string, least: number, most: number, usual: number): number {
  const text = address.searchParams.get(name);
  const number = text === null ? NaN : Number(text);
  return number >= least && number <= most ? number : usual;
}

export class TwoBodies {
  limit: number;
  moment: Moment;
  life: Life;
  playing = false;
  /** Where time goes to by itself. */
  private goal: number | null = null;
  private last = 0;
  private readonly plane = new FlatPicture(make("canvas", { role: "img", class: "live-canvas live-plane" }), planeExtent);
  private readonly chart = new FlatPicture(make("canvas", { role: "img", class: "live-canvas live-chart" }), chartExtent, true);
  private readonly said = make("p", { class: "live-said", "aria-live": "polite" });
  private readonly facts = make("p", { class: "live-facts" });
  private readonly play = button("Play", () => this.setPlaying(!this.playing));
  private readonly limitSlider;
  private readonly timeSlider;

  constructor(place: HTMLElement) {
    const address = new URL(location.href);
    this.limit = numberIn(address, "limit", leastLimit, mostLimit, firstLimit);
    this.life = lifeOf(this.limit);
    this.moment = momentOf(this.limit, numberIn(address, "t", 0, lifeEnd, 1.2));
    this.limitSlider = slider("Promise", [leastLimit, mostLimit, 0.02], this.limit, (limit) => this.promise(limit));
    this.timeSlider = slider("Time", [0, lifeEnd, 0.001], this.moment.time, (time) => { this.stop(); this.goTo(time); });
    this.plane.canvas.setAttribute("aria-label", "Two discs that weave towards each other. Around each the ring of its bound, and the dashed box of its safe region");
    this.chart.canvas.setAttribute("aria-label", "The gap of the two over time, and below it what is certain of the gap, which falls until one of them is asked");
    place.replaceChildren(
      this.limitSlider.row, this.plane.canvas, this.facts, this.chart.canvas, this.timeSlider.row,
      make("div", { class: "live-buttons" }, button("Step back", () => this.step(-1)), button("Next step", () => this.step(1)), this.play,
           copyButton("Copy link", () => this.address)), this.said);
    followInks(place, (inks) => {
      this.plane.inks = this.chart.inks = inks;
      this.draw();
    });
    new ResizeObserver(() => this.draw()).observe(place);
    requestAnimationFrame((now) => this.frame(now));
  }

  /** The address of what is seen now. */
  get address(): string {
    const address = new URL(location.href);
    address.search = new URLSearchParams({ limit: this.limit.toFixed(2), t: this.moment.time.toFixed(4) }).toString();
    address.hash = "";
    return address.href;
  }

  /** Both promise another limit, from the start. */
  promise(limit: number): void {
    this.limit = limit;
    this.life = lifeOf(limit);
    this.goTo(this.moment.time);
  }

  goTo(time: number): void {
    this.moment = momentOf(this.limit, Math.min(Math.max(time, 0), lifeEnd));
    this.draw();
  }

  /** Goes to the next step, or the one before. */
  step(direction: 1 | -1): void {
    this.setPlaying(false);
    const from = this.goal ?? this.moment.time;
    const times = this.life.steps.map(({ time }) => time);
    const found = direction > 0 ? times.find((time) => time > from) : times.filter((time) => time < from).at(-1);
    const goal = found ?? (direction > 0 ? lifeEnd : 0);
    this.say(goal);
    if (direction > 0 && !calmQuery.matches) this.goal = goal;
    else this.goTo(goal);
  }

  setPlaying(playing: boolean): void {
    if (playing && this.moment.time >= lifeEnd) this.goTo(0);
    this.playing = playing;
    this.goal = playing ? lifeEnd : null;
    this.play.textContent = playing ? "Pause" : "Play";
  }

  private stop(): void {
    this.setPlaying(false);
    this.said.textContent = "";
  }

  private frame(now: number): void {
    requestAnimationFrame((later) => this.frame(later));
    const passed = Math.min((now - this.last) / 1000, 0.05);
    this.last = now;
    if (this.goal === null) return;
    const goal = this.goal;
    const time = Math.min(this.moment.time + (this.playing ? playSpeed : stepSpeed) * passed, goal);
    this.goTo(time);
    if (time < goal) return;
    if (this.playing) this.setPlaying(false);
    else this.goal = null;
  }

  private say(time: number): void {
    const steps = this.life.steps.filter((step) => step.time === time);
    const { due } = momentOf(this.limit, time);
    const then = time < lifeEnd ? ` Until ${due.toFixed(3)} s nothing can happen that is not known.` : "";
    this.said.textContent = `${time.toFixed(3)} s: ${steps.length === 0 ? "the end." : steps.map(words).join(" ")}${then}`;
  }

  private draw(): void {
    if (this.plane.inks === null || this.plane.canvas.clientWidth === 0) return;
    drawPlane(this.plane, this.moment);
    drawChart(this.chart, this.life, this.moment);
    const { time, due, probes } = this.moment;
    this.timeSlider.input.value = `${time}`;
    this.timeSlider.output.textContent = `${time.toFixed(3)} s`;
    this.limitSlider.output.textContent = `≤ ${this.limit.toFixed(2)}`;
    const broken = this.limit < Math.max(...trueAccelerations) ? " A accelerates more than that in truth: the promise is broken." : "";
    this.facts.textContent = `States asked so far: ${probes}; a loop at 60 Hz would have asked ${2 * Math.floor(60 * time + 1)} times. ` +
      `Next look in ${Math.max(due - time, 0).toFixed(3)} s.${broken}`;
  }
}

function words({ kind, body }: Step): string {
  switch (kind) {
    case "probe":
      return `${names[body!]} is asked where it is: its bound shrinks to it.`;
    case "begin":
      return "The contact begins.";
    case "end":
      return "The contact ends.";
    case "violation":
      return `${names[body!]} has accelerated more than it promised, and its limit is raised.`;
  }
}
