// Elements of live pages.

type Attributes = Readonly<Record<string, string | (() => void)>>;

/** Makes an element. Attributes that are functions are called on clicks; children are elements and texts. */
export function make<Name extends keyof HTMLElementTagNameMap>(
  name: Name, attributes: Attributes = {}, ...children: (Node | string)[]): HTMLElementTagNameMap[Name] {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "string") made.setAttribute(key, value);
    else made.addEventListener("click", value);
  }
  made.append(...children);
  return made;
}

export function button(words: string, action: () => void): HTMLButtonElement {
  return make("button", { type: "button", class: "live-button", click: action }, words);
}

/** A slider with a label; `changed` is called as it moves. */
export function slider(label: string, [least, most, step]: readonly [number, number, number], value: number,
                       changed: (value: number) => void): { row: HTMLLabelElement; input: HTMLInputElement; output: HTMLOutputElement } {
  const input = make("input", { type: "range", min: `${least}`, max: `${most}`, step: `${step}` });
  input.value = `${value}`;
  input.addEventListener("input", () => changed(input.valueAsNumber));
  const output = make("output");
  return { row: make("label", { class: "live-slider" }, make("span", {}, label), input, output), input, output };
}

/** A button that copies an address to the clipboard, and says so for a while. */
export function copyButton(words: string, address: () => string): HTMLButtonElement {
  const made = button(words, () => void copy());
  const copy = async (): Promise<void> => {
    try {
      await navigator.clipboard.writeText(address());
      made.textContent = "Copied";
    } catch {
      prompt("The link to this moment", address());
    }
    setTimeout(() => { made.textContent = words; }, 1500);
  };
  return made;
}
