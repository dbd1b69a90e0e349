// Dark or bright, on all pages.
export const themes = ["system", "dark", "bright"] as const;
export type Theme = (typeof themes)[number];

export const darkQuery = matchMedia("(prefers-color-scheme: dark)");
export const calmQuery = matchMedia("(prefers-reduced-motion: reduce)");

/** Gives the page's elements the colours of a theme. Returns true if it is dark. */
export function applyTheme(theme: Theme): boolean {
  const isDark = theme === "system" ? darkQuery.matches : theme === "dark";
  document.documentElement.dataset["theme"] = isDark ? "dark" : "bright";
  return isDark;
}
