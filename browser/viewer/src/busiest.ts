// The table of the bodies that cost most probes, with the reasons.
import type { BusyBody } from "kinesphere";
import { whole } from "./numbers.ts";

/** Number of bodies in the table. */
export const busiestShown = 5;

function cell(row: HTMLTableRowElement, text: string): void {
  row.insertCell().textContent = text;
}

export class BusiestTable {
  private readonly table = document.querySelector<HTMLTableElement>("#busiest")!;
  private readonly rows = this.table.tBodies[0]!;

  /** Hides the table if `busiest` is null. */
  update(busiest: BusyBody[] | null): void {
    this.table.hidden = busiest === null;
    if (busiest === null) return;
    this.rows.replaceChildren();
    for (const busy of busiest) {
      const row = this.rows.insertRow();
      row.title = busy.advice;
      cell(row, `${busy.body}`);
      cell(row, whole.format(busy.probes));
      cell(row, busy.reason.replace("_", " "));
      cell(row, busy.accelerationLimit > 0 ? `${busy.accelerationLimit.toPrecision(2)} / ${busy.largestAcceleration.toPrecision(2)}` : "");
    }
  }
}
