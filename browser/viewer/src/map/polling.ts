// Fetches the state of the watch repeatedly.
import type { WatchState } from "./state.ts";

/** Milliseconds from one request to the next, while there are answers. */
const interval = 1000;
const longestWait = 15_000;
const patience = 10_000;

export interface Lost {
  /** Time of the first unanswered request. */
  since: Date;
  reason: string;
}

export class Polling {
  private lost: Lost | null = null;
  private wait = interval;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isAsking = false;

  /** `lose` is called for each unanswered request. */
  constructor(private readonly address: string, private readonly show: (state: WatchState) => void, private readonly lose: (lost: Lost) => void) {}

  /** Fetches now, and continues. */
  async ask(): Promise<void> {
    if (this.isAsking) return;
    this.isAsking = true;
    clearTimeout(this.timer);
    const start = performance.now();
    const state = await this.fetched();
    const taken = performance.now() - start;
    this.isAsking = false;
    // A slow state is fetched less often.
    this.wait = state !== null ? Math.max(interval - taken, 2 * taken) : Math.min(Math.max(2 * this.wait, interval), longestWait);
    this.timer = setTimeout(() => void this.ask(), this.wait);
    if (state !== null) this.show(state);
    else this.lose(this.lost!);
  }

  private async fetched(): Promise<WatchState | null> {
    try {
      const response = await fetch(this.address, { cache: "no-store", signal: AbortSignal.timeout(patience) });
      if (!response.ok) throw new Error(`it answers ${response.status} ${response.statusText}`);
      const state = await response.json() as WatchState;
      this.lost = null;
      return state;
    } catch (error) {
      // Without a server the browser gives no reason that helps a person.
      this.lost = { since: this.lost?.since ?? new Date(), reason: error instanceof TypeError ? "" : (error as Error).message };
      return null;
    }
  }
}
