// Tracks in a file. Tables that say all by themselves are read here; `kinesphere view FILE` reads all others, and asks.

/** Also the content of opened/tracks.json, which `kinesphere view FILE` serves. */
export interface TrackTable {
  name: string;
  /** All heights are the same, and told as 0. */
  plane: boolean;
  /** Unit of positions, if it is known. */
  unit: string | null;
  tracks: { id: string; times: number[]; positions: number[] }[];
}

const names = { id: ["id"], t: ["t", "time"], x: ["x"], y: ["y"], z: ["z"] };

/** Gaps of more steps than that, of which half are shorter than one, are no motion but absence. */
const longestGap = 2.5;

/**
 * Reads a table of positions: one header with the columns id, t (or time, in seconds), x, y and, in space, z, and no others,
 * with `,` `;` or tab between; rows of an id in the order of time, without pauses; plain numbers. Throws an Error that says what
 * is otherwise.
 */
export function readTable(name: string, text: string): TrackTable {
  const lines = text.replace(/^\uFEFF/, "").split(/\r?\n/);
  const separator = [";", ",", "\t"].find((each) => lines[0]!.includes(each)) ?? ",";
  const header = lines[0]!.split(separator).map((cell) => cell.trim().toLowerCase());
  const find = (key: keyof typeof names) => header.findIndex((cell) => names[key].includes(cell));
  const [id, t, x, y, z] = [find("id"), find("t"), find("x"), find("y"), find("z")];
  if ([id, t, x, y].includes(-1) || header.length !== (z === -1 ? 4 : 5))
    throw new Error("a table whose columns are not id, t, x, y, or also z");
  const tracks = new Map<string, { id: string; times: number[]; positions: number[] }>();
  const heights = new Set<number>();
  for (const [k, line] of lines.entries()) {
    if (k === 0 || line === "") continue;
    const cells = line.split(separator).map((cell) => cell.trim());
    const numberIn = (column: number): number => {
      if (!/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(cells[column] ?? "")) throw new Error(`line ${k + 1} has no number in its column ${header[column]}`);
      return Number(cells[column]);
    };
    if (cells.length !== header.length) throw new Error(`line ${k + 1} has ${cells.length} cells, and the header ${header.length}`);
    const track = tracks.get(cells[id]!) ?? { id: cells[id]!, times: [], positions: [] };
    tracks.set(track.id, track);
    const time = numberIn(t);
    if (time <= (track.times.at(-1) ?? -Infinity)) throw new Error(`line ${k + 1}: ${track.id} was there at this time, or later, before`);
    track.times.push(time);
    const height = z === -1 ? 0 : numberIn(z);
    heights.add(height);
    track.positions.push(numberIn(x), numberIn(y), height);
  }
  for (const { id, times } of tracks.values()) {
    if (times.length < 2) throw new Error(`${id} is there at one time alone`);
    const steps = times.slice(1).map((time, k) => time - times[k]!);
    const step = [...steps].sort((a, b) => a - b)[steps.length >> 1]!;
    const gap = steps.findIndex((each) => each > longestGap * step);
    if (gap !== -1) throw new Error(`${id} pauses from ${times[gap]} to ${times[gap + 1]}`);
  }
  if (tracks.size === 0) throw new Error("a table without rows");
  const plane = heights.size === 1;
  // A world of two dimensions is at height 0.
  if (plane) for (const { positions } of tracks.values()) for (let at = 2; at < positions.length; at += 3) positions[at] = 0;
  return { name, plane, unit: null, tracks: [...tracks.values()] };
}
