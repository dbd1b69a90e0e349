// The colours of pictures in a plane: those of the page, which follow its dark switch.

/** A stroke or a fill for each meaning. Their values are custom properties, --live-NAME, in docs/assets/site.css and base.css. */
const names = ["paper", "frame", "ink", "quiet", "body", "other", "probe", "contact", "missed", "sure"] as const;
export type Ink = (typeof names)[number];
export type Inks = Readonly<Record<Ink, string>>;

export function inksOf(element: Element): Inks {
  const style = getComputedStyle(element);
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--live-${name}`).trim()])) as Inks;
}

/** Calls `paint` with the colours, now and whenever the page turns dark or bright. */
export function followInks(element: Element, paint: (inks: Inks) => void): void {
  const repaint = () => paint(inksOf(element));
  new MutationObserver(repaint).observe(document.body, { attributes: true, attributeFilter: ["data-md-color-scheme"] });
  repaint();
}
