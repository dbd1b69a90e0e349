// The slider of time, as far back as the history reaches and as far as time has come.
import type { Shown } from "./shown.ts";

export class Timeline {
  private readonly input = document.querySelector<HTMLInputElement>("#timeline")!;
  private shown: Shown | null = null;
  private latest = 0;

  constructor(seek: (time: number) => void) {
    this.input.addEventListener("input", () => seek(this.input.valueAsNumber));
  }

  update(shown: Shown): void {
    if (shown !== this.shown) this.latest = 0;
    this.shown = shown;
    this.latest = Math.max(this.latest, shown.time);
    const { firstTime, endTime, time } = shown;
    this.input.min = `${firstTime}`;
    this.input.max = `${Number.isFinite(endTime) ? endTime : Math.max(this.latest, firstTime + 1e-3)}`;
    this.input.value = `${time}`;
    this.input.setAttribute("aria-valuetext", `${time.toFixed(3)} seconds`);
  }
}
