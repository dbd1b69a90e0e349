// A list of buttons that follows data, and does not move entries away from a pointer.

export class KeyedList<T> {
  private readonly items = new Map<string, { entry: HTMLLIElement; button: HTMLButtonElement; update: (value: T) => void }>();

  /** `make` fills a new button, and returns the function that updates it. */
  constructor(private readonly list: HTMLElement, private readonly make: (button: HTMLButtonElement, key: string) => (value: T) => void) {}

  show(values: readonly T[], keyOf: (value: T) => string): void {
    const wanted = new Map(values.map((value) => [keyOf(value), value]));
    for (const [key, { entry }] of this.items) {
      if (wanted.has(key)) continue;
      entry.remove();
      this.items.delete(key);
    }
    // Entries do not move while a pointer is over the list, or the focus in it.
    const mayMove = !this.list.matches(":hover, :focus-within");
    let next: Element | null = this.list.firstElementChild;
    for (const [key, value] of wanted) {
      let item = this.items.get(key);
      if (item === undefined) {
        const entry = document.createElement("li");
        const button = document.createElement("button");
        button.type = "button";
        entry.append(button);
        item = { entry, button, update: this.make(button, key) };
        this.items.set(key, item);
        this.list.insertBefore(entry, mayMove ? next : null);
      } else if (item.entry === next) {
        next = next.nextElementSibling;
      } else if (mayMove) {
        this.list.insertBefore(item.entry, next);
      }
      item.update(value);
    }
  }

  button(key: string): HTMLButtonElement | undefined {
    return this.items.get(key)?.button;
  }
}

/** Adds a part of `parent` and returns the function that sets its text; texts are never interpreted as HTML. */
export function part(parent: HTMLElement, className: string): (text: string) => void {
  const element = document.createElement("span");
  element.className = className;
  parent.append(element);
  return (text) => {
    if (element.textContent !== text) element.textContent = text;
  };
}
