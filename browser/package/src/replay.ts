// Replays of recordings.
import { Event, hexOf } from "./event.js";
import { Owned, theModule, type Value } from "./module.js";
import { requireBytes } from "./options.js";
import { eventAt } from "./records.js";
import { WorldView } from "./world.js";

/** A recording of a world, made here or by the program (`kinesphere run --record`). */
export class Replay extends Owned {
  private readonly view: ReplayedWorld;

  /** Throws KinesphereError for a damaged recording, or bytes that are no recording. */
  constructor(recording: Uint8Array) {
    requireBytes(recording, "recording", "Replay");
    super(theModule().handle("ks_replay_open", recording, recording.length, 0, 0), "ks_replay_destroy");
    this.view = new ReplayedWorld(this);
  }
  /** Repeats the next recorded advance, and returns its event if it had one. */
  advance(): Event | null {
    const { numbers, words } = this.read(eventAt, "ks_replay_advance");
    return words[eventAt.kind >> 2] === 0 ? null : new Event(numbers, words);
  }
  get finished(): boolean {
    return this.word("ks_replay_finished") !== 0;
  }
  /** Number of steps repeated so far, and of all steps. */
  get step(): number {
    return this.steps()[0];
  }
  get stepCount(): number {
    return this.steps()[1];
  }
  private steps(): [repeated: number, total: number] {
    const module = theModule();
    return module.with(() => {
      const at = module.room(8);
      this.check("ks_replay_steps", at, at + 4);
      return [module.i32[at >> 2]!, module.i32[(at + 4) >> 2]!];
    });
  }
  /** 16 hexadecimal digits of all outcomes so far: events, and the work that led to them. */
  get hash(): string {
    return hexOf(this.handle("ks_replay_hash"));
  }
  /** The world after the last step. */
  get world(): WorldView {
    return this.view;
  }
}

/** A copy of the world of a replay, which is made anew when it is looked at after another step. */
class ReplayedWorld extends WorldView {
  readonly #replay: Replay;
  #copy: WorldView | null = null;
  #step = -1;
  constructor(replay: Replay) {
    super(0, "");
    this.#replay = replay;
  }
  /** @internal */
  override get address(): Value {
    const { step, address } = this.#replay;
    if (this.#copy === null || step !== this.#step) {
      this.#copy?.free();
      this.#copy = new WorldView(theModule().handle("ks_replay_world", address), "ks_world_destroy");
      this.#step = step;
    }
    return this.#copy.address;
  }
  override free(): void {
    // The replay owns it.
  }
}
