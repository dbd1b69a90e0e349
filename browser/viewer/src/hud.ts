// The numbers at the edge of the picture, and messages.
import { BusiestTable, busiestShown } from "./busiest.ts";
import { Numbers, put, whole } from "./numbers.ts";
import { countsMissed, type Shown } from "./shown.ts";

/** Means over the last pictures, in milliseconds. */
export interface Times {
  engine: number;
  drawing: number;
  /** Time from one picture to the next. */
  frame: number;
}

function short(count: number): string {
  return count < 100_000 ? whole.format(count) : `${(count / 1000).toFixed(0)}k`;
}

export class Hud {
  private readonly title = document.querySelector<HTMLElement>("#title")!;
  private readonly about = document.querySelector<HTMLElement>("#about")!;
  private readonly message = document.querySelector<HTMLElement>("#message")!;
  private readonly messageText = document.querySelector<HTMLElement>("#message-text")!;
  private readonly numbers = new Numbers(document.querySelector<HTMLElement>("#numbers")!);
  private readonly busiest = new BusiestTable();
  private readonly time = this.numbers.row("time", "Simulated seconds");
  private readonly contacts = this.numbers.row("contacts", "Contacts of two bodies, each reported at its exact time");
  private readonly missed = this.numbers.row("missed by 60 Hz", "Contacts that a loop which looks 60 times per second would not see");
  private readonly crossings = this.numbers.row("crossings", "Flights through the zone, each reported");
  private readonly alarms = this.numbers.row("alarms", "Pairs that may have been too near to each other; none comes late");
  private readonly probes = this.numbers.row("states asked", "Per second of simulated time; a loop asks every body 60 times");
  private readonly engine = this.numbers.row("engine", "Time of the library for one picture");
  private readonly drawing = this.numbers.row("drawing", "Time of the page for one picture, and pictures per second");
  private readonly violations = this.numbers.row("broken promises", "Bodies that moved as they had promised not to");
  private readonly hash = this.numbers.row("hash", "Of all events so far: the same for every run of the scene, here and in the native library");

  constructor() {
    document.querySelector("#message-close")!.addEventListener("click", () => this.hideMessage());
  }

  show(shown: Shown): void {
    this.title.textContent = shown.title;
    this.about.textContent = shown.about;
    this.crossings.row.hidden = shown.zone === null;
    this.alarms.row.hidden = shown.alarms === null;
    this.missed.row.hidden = !countsMissed(shown);
  }

  update(shown: Shown, times: Times, showBusiest: boolean): void {
    const { tally, bodyCount } = shown;
    put(this.time, `${shown.time.toFixed(3)} s`, `${whole.format(bodyCount)} bodies`);
    put(this.contacts, short(tally.contacts), tally.wallContacts > 0 ? `+ ${short(tally.wallContacts)} at walls` : "");
    const share = tally.contacts === 0 ? 0 : tally.missed / tally.contacts;
    put(this.missed, short(tally.missed), tally.contacts === 0 ? "" : `${(100 * share).toFixed(share > 0 && share < 0.1 ? 1 : 0)} %`);
    this.missed.row.classList.toggle("bad", tally.missed > 0);
    if (shown.zone !== null)
      put(this.crossings, short(tally.crossings), `a loop sees ${short(tally.crossings - tally.missedCrossings)}`);
    if (shown.alarms !== null) put(this.alarms, short(tally.alarms), `${short(tally.warnings)} warnings`);
    const asked = shown.probesPerSecond;
    const ofLoop = 60 * bodyCount;
    put(this.probes, `${short(asked)} /s`, `60 Hz: ${short(ofLoop)}`);
    put(this.engine, `${times.engine.toFixed(2)} ms`, "per picture");
    put(this.drawing, `${times.drawing.toFixed(2)} ms`, times.frame > 0 ? `${(1000 / times.frame).toFixed(0)} fps` : "");
    put(this.violations, short(tally.violations), "");
    this.violations.row.classList.toggle("bad", tally.violations > 0);
    put(this.hash, shown.hash, "");
    this.busiest.update(showBusiest ? shown.busiest(busiestShown) : null);
  }

  /** Shows a message that is no error. */
  tell(text: string): void {
    this.say(text);
    this.message.classList.add("told");
  }
  /** Shows an error message. */
  say(text: string): void {
    this.message.classList.remove("told");
    this.messageText.textContent = text;
    this.message.hidden = false;
  }
  hideMessage(): void {
    this.message.hidden = true;
  }
}
