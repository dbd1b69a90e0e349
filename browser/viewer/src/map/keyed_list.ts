// A list of buttons on the page that follows data, and lets a person click what is about to move.

export class KeyedList<T> {
  private readonly items = new Map<string, { entry: HTMLLIElement; button: HTMLButtonElement; update: (value: T) => void }>();

  /** `make` fills a new button, and returns what changes it. */
  constructor(private readonly list: HTMLElement, private readonly make: (button: HTMLButtonElement, key: string) => (value: T) => void) {}

  show(values: readonly T[], keyOf: (value: T) => string): void {
    const wanted = new Map(values.map((value) => [keyOf(value), value]));
    for (const [key, { entry }] of this.items) {
      if (wanted.has(key)) continue;
      entry.remove();
      this.items.delete(key);
    }
    // Entries do not move while somebody points at the list, or has the focus in it.
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

/** A part of `parent` whose text is set later; texts are never taken for anything else. */
export function part(parent: HTMLElement, className: string): (text: string) => void {
  const element = document.createElement("span");
  element.className = className;
  parent.append(element);
  return (text) => {
    if (element.textContent !== text) element.textContent = text;
  };
}
