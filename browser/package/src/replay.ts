// Replays of recordings.
import { Event } from "./event.js";
import { Owned, theModule } from "./module.js";
import { requireBytes } from "./options.js";
import { WorldView } from "./world.js";

/** A recording of a world, made here or by the program (`kinesphere run --record`). */
export class Replay extends Owned {
  private readonly view: ReplayedWorld;

  /** Throws KinesphereError for a damaged recording, or bytes that are no recording. */
  constructor(recording: Uint8Array) {
    const module = theModule();
    requireBytes(recording, "recording", "Replay");
    super(module.with((scratch) =>
      module.require(module.call("replay_open", scratch.bytes(recording), recording.length))), "replay_free");
    this.view = new ReplayedWorld(this);
  }
  /** Repeats the next recorded advance, and returns its event if it had one. */
  advance(): Event | null {
    const module = theModule();
    const result = module.call("replay_advance", this.address);
    if (result < 0) throw module.error();
    return result === 0 ? null : new Event(module.answer());
  }
  get finished(): boolean {
    return theModule().call("replay_finished", this.address) !== 0;
  }
  /** Number of steps repeated so far, and of all steps. */
  get step(): number {
    return theModule().call("replay_step", this.address);
  }
  get stepCount(): number {
    return theModule().call("replay_step_count", this.address);
  }
  /** 16 hexadecimal digits of all outcomes so far: events, and the work that led to them. */
  get hash(): string {
    const module = theModule();
    module.call("replay_hash", this.address);
    const [low, high] = module.answer();
    return high!.toString(16).padStart(8, "0") + low!.toString(16).padStart(8, "0");
  }
  /** The world after the last step. */
  get world(): WorldView {
    return this.view;
  }
}

class ReplayedWorld extends WorldView {
  readonly #replay: Replay;
  constructor(replay: Replay) {
    super(0, "");
    this.#replay = replay;
  }
  /** @internal */
  override get address(): number {
    return theModule().call("replay_world", this.#replay.address);
  }
  override free(): void {
    // The replay owns it.
  }
}
