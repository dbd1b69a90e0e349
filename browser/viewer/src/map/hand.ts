// Pointers on the map: drag, zoom with the wheel or two fingers, choose.
import type { View } from "./view.ts";

export interface HandActions {
  /** Called when the user has moved the view. */
  moved(): void;
  chooseAt(x: number, y: number, isFinger: boolean): void;
  hoverAt(x: number, y: number): void;
}

/** A pointer that moves less than this many pixels has clicked. */
const stillness = 5;

export function followPointers(canvas: HTMLCanvasElement, view: View, actions: HandActions): void {
  const pointers = new Map<number, { x: number; y: number }>();
  let way = 0;

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (pointers.size === 1) way = 0;
    else way = Infinity;
    canvas.classList.add("holding");
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (before === undefined) return actions.hoverAt(event.clientX, event.clientY);
    const after = { x: event.clientX, y: event.clientY };
    pointers.set(event.pointerId, after);
    way += Math.hypot(after.x - before.x, after.y - before.y);
    if (way < stillness) return;
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other === undefined) {
      view.pan(after.x - before.x, after.y - before.y);
    } else {
      const distance = (from: { x: number; y: number }) => Math.max(Math.hypot(from.x - other.x, from.y - other.y), 1);
      view.pan((after.x - before.x) / 2, (after.y - before.y) / 2);
      view.zoom(distance(after) / distance(before), (after.x + other.x) / 2, (after.y + other.y) / 2);
    }
    actions.moved();
  });
  const release = (event: PointerEvent) => {
    if (!pointers.delete(event.pointerId)) return;
    canvas.classList.toggle("holding", pointers.size > 0);
    if (event.type === "pointerup" && way < stillness) actions.chooseAt(event.clientX, event.clientY, event.pointerType === "touch");
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("pointerleave", () => actions.hoverAt(-Infinity, -Infinity));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / 100 : event.deltaY / 3;
    view.zoom(Math.exp(-0.25 * Math.max(-3, Math.min(3, lines))), event.clientX, event.clientY);
    actions.moved();
  }, { passive: false });
}
