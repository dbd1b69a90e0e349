// The picture: coast, graticule, bounds, tracks, pairs, closest approaches, names.
import { Coast } from "./coast.ts";
import type { EarthPlane } from "./earth.ts";
import { graticule } from "./graticule.ts";
import { type Approach, type Concern, type DrawnPair, type DrawnTrack, knowsHeight, placesOf, type Scene, type Spot } from "./scene.ts";
import type { Place } from "./state.ts";
import { durationText, shortName } from "./text.ts";
import { Units } from "./units.ts";
import type { View } from "./view.ts";

/** The colours of a theme, from the style sheet. */
const colourNames = ["ground", "land", "shore", "grid", "grid-ink", "track", "stale", "undecided", "predicted", "within", "need", "chosen", "ink"] as const;
export type Colours = Record<(typeof colourNames)[number], string>;

export function coloursOfPage(): Colours {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(colourNames.map((name) => [name, style.getPropertyValue(`--${name}`).trim()])) as Colours;
}

export interface Chosen {
  track: string | null;
  /** The key of a pair. */
  pair: string | null;
  hovered: string | null;
}

const font = "12px system-ui, sans-serif";
const smallFont = "11px system-ui, sans-serif";
const mostNames = 400;
const fullTurn = 2 * Math.PI;

/** Seconds that the lines ahead of tracks may stand for. */
const lookAheads = [1200, 600, 300, 120, 60, 30, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1];

const kinds = ["stale", "track", "undecided", "predicted", "within"] as const;
type Kind = (typeof kinds)[number];
const kindOf = ({ track, concern }: DrawnTrack): Kind => (track.stale ? "stale" : concern ?? "track");
/** Order in which names find room. */
const ranks: Record<Concern, number> = { within: 1, predicted: 2, undecided: 3 };
/** Maximum pairs with a text at their lines. */
const mostTexts = 40;

export class Chart {
  colours: Colours = coloursOfPage();
  /** Seconds that lines extend ahead of tracks. */
  lookAhead = 0;
  /** The texts of the latest picture, and the rectangles that they cover; no two of them overlap. */
  readonly labels: { text: string; x: number; y: number; width: number; height: number }[] = [];
  showNames = true;
  showNeeds = false;
  units = new Units("plain");
  readonly coast: Coast;
  private dotSize = 3.5;
  /** About how many pixels lie between neighbours. */
  private room = Infinity;
  /** Pixels of the screen in one of the page. */
  private ratio = 1;
  private readonly stamps = new Map<string, HTMLCanvasElement>();
  private readonly context: CanvasRenderingContext2D;
  private readonly widths = new Map<string, number>();

  /** `redraw` is called when there is more to be drawn. */
  constructor(readonly canvas: HTMLCanvasElement, redraw: () => void) {
    this.coast = new Coast(redraw);
    this.context = canvas.getContext("2d", { alpha: false })!;
  }

  /** Sets the canvas to its size on the page. Returns true if that has changed. */
  resize(view: View): boolean {
    const ratio = Math.min(devicePixelRatio, 2);
    if (ratio !== this.ratio) this.stamps.clear();
    this.ratio = ratio;
    const { clientWidth, clientHeight } = this.canvas;
    view.width = clientWidth;
    view.height = clientHeight;
    const [width, height] = [Math.round(clientWidth * ratio), Math.round(clientHeight * ratio)];
    if (this.canvas.width === width && this.canvas.height === height) return false;
    Object.assign(this.canvas, { width, height });
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return true;
  }

  draw(view: View, scene: Scene | null, plane: EarthPlane | null, chosen: Chosen): void {
    const { context, colours } = this;
    context.fillStyle = colours.ground;
    context.fillRect(0, 0, view.width, view.height);
    const taken = new Taken();
    this.labels.length = 0;
    this.room = roomOf(view, scene);
    this.dotSize = this.room < 12 ? 1.8 : this.room < 30 ? 2.7 : 3.5;
    if (plane !== null) this.coast.draw(context, view, plane, colours);
    this.drawGrid(view, plane, taken);
    if (scene === null) return;
    const chosenPair = scene.pairs.find(({ key }) => key === chosen.pair) ?? null;
    const byKind: Record<Kind, DrawnTrack[]> = { stale: [], track: [], undecided: [], predicted: [], within: [] };
    for (const drawn of scene.tracks.values()) byKind[kindOf(drawn)].push(drawn);
    for (const kind of kinds) this.drawBounds(view, byKind[kind], colours[kind]);
    this.drawSeparations(view, scene, chosen, taken);
    this.drawPairs(view, scene.pairs, chosenPair);
    this.drawLookAhead(view, scene);
    this.drawApproaches(view, scene.pairs, chosenPair);
    for (const kind of kinds) this.drawDots(view, byKind[kind], kind);
    if (this.showNeeds) this.drawNeeds(view, scene);
    this.drawChosen(view, scene, chosen, chosenPair);
    const texts = chosenPair === null ? scene.pairs : [chosenPair, ...scene.pairs.filter((pair) => pair !== chosenPair)];
    const dots = dotsOf(view, scene);
    this.drawTexts(view, texts.slice(0, mostTexts), taken, dots);
    if (this.showNames) this.drawNames(view, scene, chosen, chosenPair, taken, dots);
  }

  private drawGrid(view: View, plane: EarthPlane | null, taken: Taken): void {
    const { context, colours } = this;
    const lines = graticule(view, plane);
    context.strokeStyle = colours.grid;
    context.lineWidth = 1;
    context.beginPath();
    for (const { points } of lines) {
      for (let k = 0; k < points.length; k += 2) {
        const [x, y] = view.toScreen(points[k]!, points[k + 1]!);
        if (k === 0) context.moveTo(x, y);
        else context.lineTo(x, y);
      }
    }
    context.stroke();
    context.font = smallFont;
    context.fillStyle = colours["grid-ink"];
    context.textBaseline = "alphabetic";
    const atX = view.insets.left + 6;
    const atY = view.height - view.insets.bottom;
    for (const { points, upright, label } of lines) {
      const at = upright ? crossing(view, points, 1, atY) : crossing(view, points, 0, atX);
      if (at === null) continue;
      const [x, y] = upright ? [at + 4, atY] : [atX, at - 4];
      if (x < view.insets.left || x > view.width - view.insets.right - 40 || y < view.insets.top + 10 || y > view.height - 4) continue;
      if (this.takeFor(label, taken, x, y - 11, this.widthOf(label), 13)) context.fillText(label, x, y);
    }
  }

  /** Draws circle by circle: browsers are slow at paths of many overlapping ones. */
  private drawBounds(view: View, tracks: DrawnTrack[], colour: string): void {
    const { context } = this;
    const largest = 0.3 * Math.min(...view.free);
    context.fillStyle = context.strokeStyle = colour;
    context.lineWidth = 1;
    for (const { track } of tracks) {
      for (const place of track.places) {
        const pixels = (place.radius[0] ?? 0) * view.look.scale;
        if (pixels < 2.5) continue;
        const [x, y] = view.toScreen(place.x, place.y);
        if (isFar(view, x, y, pixels)) continue;
        context.beginPath();
        context.arc(x, y, pixels, 0, fullTurn);
        // Large ones would tint most of the picture.
        const isLarge = pixels > largest;
        context.globalAlpha = isLarge ? 0.3 : 0.6;
        context.stroke();
        context.globalAlpha = 0.1;
        if (!isLarge) context.fill();
      }
    }
    context.globalAlpha = 1;
  }

  /** Draws the separations around the chosen track: a track inside is within one. */
  private drawSeparations(view: View, scene: Scene, chosen: Chosen, taken: Taken): void {
    const { context, colours } = this;
    const drawn = scene.tracks.get(chosen.track ?? "");
    if (drawn === undefined) return;
    context.strokeStyle = colours.chosen;
    context.fillStyle = colours.chosen;
    context.font = smallFont;
    context.lineWidth = 1;
    context.setLineDash([2, 4]);
    for (const { horizontal, name } of scene.state.separations) {
      const pixels = horizontal * view.look.scale;
      if (pixels < 6 || pixels > 2 * (view.width + view.height)) continue;
      for (const place of drawn.track.places) {
        const [x, y] = view.toScreen(place.x, place.y);
        context.beginPath();
        context.arc(x, y, pixels, 0, fullTurn);
        context.stroke();
        if (pixels <= 24) continue;
        const [text, width] = [shortName(name), this.widthOf(shortName(name))];
        if (this.takeFor(text, taken, x - width / 2, y - pixels - 15, width, 13)) context.fillText(text, x - width / 2, y - pixels - 4);
      }
    }
    context.setLineDash([]);
  }

  /** Draws undecided pairs over pairs within: with several separations a pair may be both. */
  private drawPairs(view: View, pairs: DrawnPair[], chosenPair: DrawnPair | null): void {
    const { context, colours } = this;
    const path = (drawn: DrawnPair) => {
      if (drawn.places !== null) addLine(context, view, drawn.places[0], drawn.places[1]);
    };
    if (chosenPair !== null && chosenPair.pair.verdict !== "apart") {
      // A light band with a dark one inside: two lines, one on each side of the pair's own.
      context.beginPath();
      path(chosenPair);
      for (const [colour, width] of [[colours.chosen, 11], [colours.ground, 8]] as const) {
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.stroke();
      }
    }
    for (const verdict of ["within", "undecided"] as const) {
      const those = pairs.filter(({ pair, places }) => pair.verdict === verdict && places !== null && lineInSight(view, ...places) !== null);
      // Many lines are fainter and thinner, so that what lies below them is seen.
      const strength = Math.max(0.3, Math.min(1, 300 / those.length));
      context.beginPath();
      those.forEach(path);
      context.strokeStyle = colours[verdict];
      context.globalAlpha = strength;
      context.lineWidth = (verdict === "within" ? 3.5 : 2) * Math.sqrt(strength);
      context.setLineDash(verdict === "within" ? [] : [6, 4]);
      context.stroke();
    }
    context.globalAlpha = 1;
    context.setLineDash([]);
  }

  /** Draws where predicted pairs, and the chosen one, come closest if they go straight on: both ways, both places, and the line between. */
  private drawApproaches(view: View, pairs: DrawnPair[], chosenPair: DrawnPair | null): void {
    const { context, colours } = this;
    const drawn = pairs.filter((pair) => pair.isPredicted || pair === chosenPair);
    // Many are fainter, so that what lies below them is seen.
    context.globalAlpha = Math.max(0.3, Math.min(1, 60 / drawn.length));
    for (const pair of drawn) {
      const { places, approach, concern } = pair;
      if (places === null || approach === null) continue;
      context.strokeStyle = colours[concern];
      context.beginPath();
      for (const k of [0, 1] as const) addLine(context, view, places[k], approach.places[k]);
      context.lineWidth = 1.5;
      context.setLineDash([2, 4]);
      context.stroke();
      context.setLineDash([]);
      context.beginPath();
      addLine(context, view, ...approach.places);
      if (pair === chosenPair) {
        context.strokeStyle = colours.chosen;
        context.lineWidth = 7;
        context.stroke();
        context.strokeStyle = colours[concern];
      }
      context.lineWidth = 3;
      context.stroke();
      context.lineWidth = 1.5;
      context.fillStyle = colours.ground;
      for (const { x, y } of approach.places) {
        const [atX, atY] = view.toScreen(x, y);
        if (isFar(view, atX, atY, 8)) continue;
        context.beginPath();
        context.moveTo(atX, atY - 6);
        for (const [dx, dy] of [[6, 0], [0, 6], [-6, 0]] as const) context.lineTo(atX + dx, atY + dy);
        context.closePath();
        context.fill();
        context.stroke();
      }
    }
    context.globalAlpha = 1;
  }

  /** Writes distance and time to go at closest approaches, and vertical distances at the lines of open pairs. */
  private drawTexts(view: View, pairs: readonly DrawnPair[], taken: Taken, dots: Taken): void {
    const { context, colours, units } = this;
    context.font = smallFont;
    context.lineJoin = "round";
    context.textBaseline = "middle";
    for (const drawn of pairs) {
      const { places, approach, isPredicted, concern } = drawn;
      if (places === null) continue;
      if (approach !== null && (isPredicted || drawn === pairs[0]))
        this.write(view, approach.places, `CPA ${approachText(approach, units)}`, colours[concern], taken, dots, places);
      if (drawn.above !== null && drawn.pair.verdict !== "apart")
        this.write(view, places, units.above(drawn.above.difference, drawn.above.rate), colours[drawn.pair.verdict], taken, dots);
    }
    context.textBaseline = "alphabetic";
  }

  /** Writes a text beside the middle of a line, if there is room and no dot; best where it hides no way to `ends`. */
  private write(view: View, [one, other]: readonly [Spot, Spot], text: string, colour: string, taken: Taken, dots: Taken, ends: readonly Spot[] = []): void {
    const { context, colours } = this;
    const [x, y] = view.toScreen((one.x + other.x) / 2, (one.y + other.y) / 2);
    if (isFar(view, x, y, 0)) return;
    const width = this.widthOf(text);
    const ways = ends.map((end) => view.toScreen(end.x, end.y)).map(([endX, endY]) => [(endX - x) / Math.hypot(endX - x, endY - y), (endY - y) / Math.hypot(endX - x, endY - y)] as const);
    /** Cosine of the angle to the nearest way. */
    const hidden = ([, , sideX, sideY]: readonly [number, number, number, number]): number =>
      Math.max(-1, ...ways.map(([wayX, wayY]) => wayX * sideX + wayY * sideY));
    const spots: (readonly [number, number, number, number])[] =
      [[10, 0, 1, 0], [-10 - width, 0, -1, 0], [-width / 2, -19, 0, -1], [-width / 2, 19, 0, 1], [14, 17, 0.9, 0.4], [14, -17, 0.9, -0.4]];
    const far = farSpots(width).map(([dx, dy]) => [dx, dy, 0, Math.sign(dy)] as const);
    const spot = [...spots.sort((a, b) => hidden(a) - hidden(b)), ...far]
      .find(([dx, dy]) => isBetweenPanels(view, x + dx, width) && dots.isFree(x + dx, y + dy - 7, width, 14) &&
        this.takeFor(text, taken, x + dx - 2, y + dy - 7, width + 4, 14));
    if (spot === undefined) return;
    context.strokeStyle = colours.ground;
    context.lineWidth = 3.5;
    context.strokeText(text, x + spot[0], y + spot[1]);
    context.fillStyle = colour;
    context.fillText(text, x + spot[0], y + spot[1]);
  }

  private drawLookAhead(view: View, scene: Scene): void {
    const { context, colours } = this;
    let fastest = 0;
    for (const { track } of scene.tracks.values())
      for (const { velocity } of track.places) fastest = Math.max(fastest, Math.hypot(velocity[0], velocity[1]));
    // Longer lines would hide dense tracks.
    const most = Math.max(10, Math.min(70, this.room));
    this.lookAhead = fastest === 0 ? 0 : lookAheads.find((seconds) => fastest * seconds * view.look.scale <= most) ?? 0;
    if (this.lookAhead === 0) return;
    context.beginPath();
    for (const { track } of scene.tracks.values()) {
      if (track.stale) continue;
      for (const { x, y, velocity } of track.places) {
        const [fromX, fromY] = view.toScreen(x, y);
        if (isFar(view, fromX, fromY, most)) continue;
        context.moveTo(fromX, fromY);
        context.lineTo(...view.toScreen(x + velocity[0] * this.lookAhead, y + velocity[1] * this.lookAhead));
      }
    }
    context.strokeStyle = colours.track;
    context.globalAlpha = 0.8;
    context.lineWidth = 1.5;
    context.stroke();
    context.globalAlpha = 1;
  }

  /** Joins the possible places of one track. */
  private drawDots(view: View, tracks: DrawnTrack[], kind: Kind): void {
    const { context, colours } = this;
    const colour = colours[kind];
    const isHollow = kind === "stale";
    const isOpen = kind !== "stale" && kind !== "track";
    context.beginPath();
    for (const { track: { places } } of tracks) {
      for (let k = 1; k < places.length; ++k) addLine(context, view, places[k - 1]!, places[k]!);
    }
    context.strokeStyle = colour;
    context.lineWidth = 1;
    context.setLineDash([1, 3]);
    context.stroke();
    context.setLineDash([]);
    // A track of an open pair must be visible in a crowd, too.
    const size = isOpen ? Math.max(this.dotSize, 3) : this.dotSize;
    const dot = this.stamp(`dot ${colour} ${isHollow} ${size}`, size + 2, (stamp) => {
      stamp.arc(0, 0, size, 0, fullTurn);
      stamp.fillStyle = isHollow ? colours.ground : colour;
      stamp.strokeStyle = isHollow ? colour : colours.ground;
      stamp.lineWidth = size < 2 ? 0.5 : 1.3;
      stamp.fill();
      stamp.stroke();
    });
    for (const { track } of tracks) for (const place of track.places) this.print(dot, view, place);
  }

  /** Draws four corners around the tracks with report requests. */
  private drawNeeds(view: View, scene: Scene): void {
    const { colours } = this;
    const half = 9;
    const corner = 5;
    const corners = this.stamp(`need ${colours.need}`, half + 2, (stamp) => {
      for (const [signX, signY] of [[-1, -1], [1, -1], [1, 1], [-1, 1]] as const) {
        stamp.moveTo(signX * half, signY * (half - corner));
        stamp.lineTo(signX * half, signY * half);
        stamp.lineTo(signX * (half - corner), signY * half);
      }
      stamp.strokeStyle = colours.need;
      stamp.lineWidth = 2;
      stamp.stroke();
    });
    for (const { track, need } of scene.tracks.values())
      if (need !== null) for (const place of track.places) this.print(corners, view, place);
  }

  private drawChosen(view: View, scene: Scene, chosen: Chosen, chosenPair: DrawnPair | null): void {
    const { context, colours } = this;
    const ids = new Set([chosen.track, chosen.hovered, chosenPair?.pair.first, chosenPair?.pair.second]);
    context.strokeStyle = colours.ink;
    context.lineWidth = 1.5;
    // The own ship or aircraft has the two circles of a radar.
    for (const place of scene.tracks.get(scene.state.own ?? "")?.track.places ?? []) {
      const [x, y] = view.toScreen(place.x, place.y);
      context.beginPath();
      context.arc(x, y, 10, 0, fullTurn);
      context.stroke();
    }
    context.strokeStyle = colours.chosen;
    for (const id of ids) {
      const drawn = scene.tracks.get(id ?? "");
      for (const place of drawn?.track.places ?? []) {
        const [x, y] = view.toScreen(place.x, place.y);
        context.beginPath();
        context.arc(x, y, 7, 0, fullTurn);
        context.lineWidth = id === chosen.track ? 2.5 : 1.5;
        context.stroke();
      }
    }
  }

  /** Draws the names of the most important tracks first, while there is room. */
  private drawNames(view: View, scene: Scene, chosen: Chosen, chosenPair: DrawnPair | null, taken: Taken, dots: Taken): void {
    const { context, colours } = this;
    const important = new Set([chosen.track, chosen.hovered, chosenPair?.pair.first, chosenPair?.pair.second, scene.state.own]);
    const rank = ({ track, concern, need }: DrawnTrack) =>
      important.has(track.id) ? 0 : concern !== null ? ranks[concern] : need !== null && this.showNeeds ? 4 : track.stale ? 6 : 5;
    const inSight: { drawn: DrawnTrack; x: number; y: number; rank: number }[] = [];
    for (const drawn of scene.tracks.values()) {
      const place = drawn.track.places[0];
      if (place === undefined) continue;
      const [x, y] = view.toScreen(place.x, place.y);
      if (!isFar(view, x, y, 0)) inSight.push({ drawn, x, y, rank: rank(drawn) });
    }
    inSight.sort((a, b) => a.rank - b.rank);
    context.font = font;
    context.lineJoin = "round";
    context.textBaseline = "middle";
    const first = scene.state.tracks[0]?.places[0]?.z;
    // In a crowd names alone are more readable.
    const hasHeights = this.room > 25 && scene.state.dimensions === 3 && scene.state.tracks.some(({ places }) => places.some(({ z }) => z !== first));
    let left = mostNames;
    for (const { drawn, x, y, rank } of inSight) {
      if (--left < 0) break;
      const name = shortName(drawn.label);
      const place = drawn.track.places[0]!;
      const height = hasHeights && knowsHeight(place, scene.state) ? `  ${this.units.altitude(place.alt ?? place.z)}` : "";
      const width = this.widthOf(name) + (height === "" ? 0 : this.widthOf(height));
      const sides = headingOf(drawn, chosenPair) > 0 ? [-12 - width, 12] as const : [12, -12 - width] as const;
      const near: (readonly [number, number])[] = [[sides[0], 0], [-width / 2, -19], [-width / 2, 19], [sides[1], 0], [10, -14], [10, 14]];
      // Important names go farther for room, with a line to their dots; others must not hide a dot.
      const far = rank < 3 ? farSpots(width) : [];
      const spot = [...near, ...far].filter(([dx]) => isBetweenPanels(view, x + dx, width))
        .find(([dx, dy]) => (rank < 3 || dots.isFree(x + dx, y + dy - 7, width, 14)) && this.takeFor(name, taken, x + dx, y + dy - 7, width, 14));
      if (spot === undefined) continue;
      const [atX, atY] = [x + spot[0], y + spot[1]];
      if (far.includes(spot)) {
        context.strokeStyle = colours["grid-ink"];
        context.lineWidth = 1;
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(Math.max(atX, Math.min(x, atX + width)), atY - 7 * Math.sign(spot[1]));
        context.stroke();
      }
      context.strokeStyle = colours.ground;
      context.lineWidth = 3;
      context.strokeText(name + height, atX, atY);
      context.fillStyle = drawn.track.stale ? colours.stale : colours.ink;
      context.fillText(name, atX, atY);
      if (height === "") continue;
      context.fillStyle = colours["grid-ink"];
      context.fillText(height, atX + this.widthOf(name), atY);
    }
    context.textBaseline = "alphabetic";
  }

  /**
   * A small picture that is drawn once, and printed often; its centre is at 0, and it reaches `half` pixels in each
   * direction.
   */
  private stamp(key: string, half: number, draw: (context: CanvasRenderingContext2D) => void): HTMLCanvasElement {
    let stamp = this.stamps.get(key);
    if (stamp === undefined) {
      const ratio = this.ratio;
      stamp = Object.assign(document.createElement("canvas"), { width: 2 * Math.ceil(half) * ratio, height: 2 * Math.ceil(half) * ratio });
      const context = stamp.getContext("2d")!;
      context.scale(ratio, ratio);
      context.translate(Math.ceil(half), Math.ceil(half));
      context.beginPath();
      draw(context);
      this.stamps.set(key, stamp);
    }
    return stamp;
  }
  private print(stamp: HTMLCanvasElement, view: View, { x, y }: Place): void {
    const [atX, atY] = view.toScreen(x, y);
    const size = stamp.width / this.ratio;
    if (!isFar(view, atX, atY, size)) this.context.drawImage(stamp, atX - size / 2, atY - size / 2, size, size);
  }

  /** Takes a rectangle for a text. Returns false, without taking it, if a part is taken already. */
  private takeFor(text: string, taken: Taken, x: number, y: number, width: number, height: number): boolean {
    if (!taken.take(x, y, width, height)) return false;
    this.labels.push({ text, x, y, width, height });
    return true;
  }

  /** Width in pixels, in the context's font. */
  private widthOf(text: string): number {
    const key = `${this.context.font} ${text}`;
    let width = this.widths.get(key);
    if (width === undefined) {
      if (this.widths.size > 10_000) this.widths.clear();
      width = this.context.measureText(text).width;
      this.widths.set(key, width);
    }
    return width;
  }
}

/** Returns the squares of the dots of all tracks. */
function dotsOf(view: View, scene: Scene): Taken {
  const dots = new Taken();
  for (const { x, y } of placesOf(scene.tracks.values())) {
    const [atX, atY] = view.toScreen(x, y);
    if (!isFar(view, atX, atY, 0)) dots.occupy(atX - 4, atY - 4, 8, 8);
  }
  return dots;
}

/** Returns places of a text of this width above and below its dot, the nearest first. */
function farSpots(width: number): (readonly [number, number])[] {
  return [34, 50, 66, 82].flatMap((dy) => ([-width / 2, 10, -10 - width] as const)
    .flatMap((dx) => ([[dx, -dy], [dx, dy]] as const)));
}

/**
 * Returns the side of a track, right (> 0) or left, on which its name would hide the partner in the chosen pair, or the
 * line ahead.
 */
function headingOf({ track: { id, places } }: DrawnTrack, pair: DrawnPair | null): number {
  if (pair?.places != null && (pair.pair.first === id || pair.pair.second === id))
    return (pair.places[1].x - pair.places[0].x) * (pair.pair.first === id ? 1 : -1);
  return places[0]?.velocity[0] ?? 0;
}

/** Returns the distance of neighbours, in pixels, if the visible tracks were spread evenly over the picture. */
function roomOf(view: View, scene: Scene | null): number {
  let inSight = 0;
  for (const { x, y } of placesOf(scene?.tracks.values() ?? [])) if (!isFar(view, ...view.toScreen(x, y), 0)) ++inSight;
  const [width, height] = view.free;
  return Math.sqrt(width * height / inSight);
}

/** Returns distance and how far it may be off, vertical distance and time to go. */
export function approachText({ distance, error, above, seconds }: Approach, units: Units): string {
  const vertical = above === null ? "" : `, ${units.above(above, 0)}`;
  return `${units.lengthWithin(distance, error)}${vertical} · ${durationText(seconds)}`;
}

/** Returns true if a text that begins there is not covered by the panels at the sides. */
const isBetweenPanels = (view: View, x: number, width: number): boolean =>
  x >= view.insets.left && x + width < view.width - view.insets.right;

function isFar(view: View, x: number, y: number, margin: number): boolean {
  return x < -margin || y < -margin || x > view.width + margin || y > view.height + margin;
}

/** Returns the visible part of a line between two places, as two places of the screen; null if there is none. */
function lineInSight(view: View, from: Spot, to: Spot): [[number, number], [number, number]] | null {
  const a = view.toScreen(from.x, from.y);
  const b = view.toScreen(to.x, to.y);
  const margin = 20;
  let [first, last] = [0, 1];
  for (const axis of [0, 1] as const) {
    const way = b[axis] - a[axis];
    const limits = [-margin - a[axis], (axis === 0 ? view.width : view.height) + margin - a[axis]] as const;
    if (way === 0 && (limits[0] > 0 || limits[1] < 0)) return null;
    if (way === 0) continue;
    first = Math.max(first, Math.min(limits[0] / way, limits[1] / way));
    last = Math.min(last, Math.max(limits[0] / way, limits[1] / way));
  }
  if (first > last) return null;
  const at = (part: number): [number, number] => [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part];
  return [at(first), at(last)];
}

/** Adds only the visible part: the dashes of a line that goes far beyond would take a browser long. */
function addLine(context: CanvasRenderingContext2D, view: View, from: Spot, to: Spot): void {
  const line = lineInSight(view, from, to);
  if (line === null) return;
  context.moveTo(...line[0]);
  context.lineTo(...line[1]);
}

/**
 * Returns the place at which a line of points crosses a horizontal (axis 1) or vertical (axis 0) line of the screen;
 * null if it does not.
 */
function crossing(view: View, points: number[], axis: 0 | 1, at: number): number | null {
  for (let k = 2; k < points.length; k += 2) {
    const before = view.toScreen(points[k - 2]!, points[k - 1]!);
    const after = view.toScreen(points[k]!, points[k + 1]!);
    if ((before[axis] - at) * (after[axis] - at) > 0 || before[axis] === after[axis]) continue;
    const part = (at - before[axis]) / (after[axis] - before[axis]);
    return before[1 - axis]! + part * (after[1 - axis]! - before[1 - axis]!);
  }
  return null;
}

/** Parts of the screen that text covers, in squares. */
class Taken {
  private readonly squares = new Set<number>();

  /** Takes a rectangle. Returns false, without taking it, if a part is taken already. */
  take(x: number, y: number, width: number, height: number): boolean {
    if (!this.isFree(x, y, width, height)) return false;
    this.occupy(x, y, width, height);
    return true;
  }
  isFree(x: number, y: number, width: number, height: number): boolean {
    for (const square of squaresOf(x, y, width, height)) if (this.squares.has(square)) return false;
    return true;
  }
  occupy(x: number, y: number, width: number, height: number): void {
    for (const square of squaresOf(x, y, width, height)) this.squares.add(square);
  }
}

function* squaresOf(x: number, y: number, width: number, height: number): Iterable<number> {
  const [columns, rows] = [8, 7];
  for (let row = Math.floor(y / rows); row <= Math.floor((y + height) / rows); ++row)
    for (let column = Math.floor(x / columns); column <= Math.floor((x + width) / columns); ++column)
      yield row * 65536 + column;
}
