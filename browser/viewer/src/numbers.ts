// Rows of numbers with their names.
export interface Row {
  value: HTMLElement;
  note: HTMLElement;
  row: HTMLElement;
}

export const whole = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });

/** Returns a number with at most so many digits that are not leading zeros. */
export const digits = (value: number, most: number): string =>
  value.toLocaleString("en", { maximumSignificantDigits: most, useGrouping: false });

export class Numbers {
  constructor(private readonly list: HTMLElement) {}

  /** Adds a row below the others; `hint` explains it. */
  row(label: string, hint: string): Row {
    const row = document.createElement("div");
    row.className = "row";
    row.title = hint;
    const name = document.createElement("dt");
    name.textContent = label;
    const value = document.createElement("dd");
    const note = document.createElement("dd");
    note.className = "note";
    row.append(name, value, note);
    row.dataset["name"] = label;
    this.list.append(row);
    return { value, note, row };
  }
}

export function put(row: Row, value: string, note: string): void {
  if (row.value.textContent !== value) row.value.textContent = value;
  if (row.note.textContent !== note) row.note.textContent = note;
}
