// The coasts of the map, made when the pages are built: the land of Natural Earth 1:10m (public domain; npm package
// world-atlas), simplified and packed. src/map/coast.ts reads the result.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { gzipSync } from "node:zlib";
import { feature } from "topojson-client";
import { filter, filterWeight, presimplify, simplify, sphericalRingArea, sphericalTriangleArea } from "topojson-simplify";

/**
 * Areas of triangles and islands that are left out. Unit: square kilometres. It trades the size of the file (180 kB)
 * for the length of the corners of the coast, some kilometres.
 */
const leastArea = 3;
/** Beyond these latitudes, where few are watched, areas are left out that are so many times larger. */
const [south, north, polarFactor] = [-48, 66, 30];
const earthRadius = 6371;
/** Positions are multiples of this. Unit: degrees. */
const step = 0.005;

/** Returns the rings of the land: each is closed, with the land on its right, and holes are marked. */
function landRings() {
  const file = createRequire(import.meta.url).resolve("world-atlas/land-10m.json");
  const least = leastArea / earthRadius ** 2;
  const factorAt = ([, latitude]) => (latitude < south || latitude > north ? polarFactor : 1);
  const triangle = (points) => sphericalTriangleArea(points) / factorAt(points[1]);
  let land = simplify(presimplify(JSON.parse(readFileSync(file, "utf8")), triangle), least);
  land = filter(land, filterWeight(land, least, (ring, isInner) => sphericalRingArea(ring, isInner) / factorAt(ring[0])));
  const polygons = feature(land, land.objects.land).features.flatMap(({ geometry: { type, coordinates } }) =>
    type === "Polygon" ? [coordinates] : coordinates);
  return polygons.flatMap((rings) => rings.map((points, k) => ({ points, isHole: k > 0 })));
}

/**
 * Returns the bytes of the rings, compressed by gzip. Each ring is 2 * (number of points) + (1 for a hole), then the
 * steps from point to point east and north, from 0, 0 at first, as 2 * n if n >= 0, else -2 * n - 1. Numbers have seven
 * bits in each byte, the lowest first; the highest bit of a byte says that more follow.
 */
export function packedCoast() {
  const bytes = [];
  const put = (number) => {
    for (; number > 127; number = Math.floor(number / 128)) bytes.push(number % 128 + 128);
    bytes.push(number);
  };
  const putSigned = (number) => put(number < 0 ? -2 * number - 1 : 2 * number);
  for (const { points, isHole } of landRings()) {
    const rounded = points.map((point) => point.map((degrees) => Math.round(degrees / step)));
    const kept = rounded.filter(([x, y], k) => k === 0 || x !== rounded[k - 1][0] || y !== rounded[k - 1][1]);
    if (kept.length < 4) continue;
    put(2 * kept.length + Number(isHole));
    let [lastX, lastY] = [0, 0];
    for (const [x, y] of kept) {
      putSigned(x - lastX);
      putSigned(y - lastY);
      [lastX, lastY] = [x, y];
    }
  }
  return gzipSync(Uint8Array.from(bytes), { level: 9 });
}

/** Plugin of vite: the module `virtual:coast` has the address of the file and the length of a step. */
export function coast() {
  const id = "virtual:coast";
  return {
    name: "coast",
    apply: "build",
    resolveId: (source) => (source === id ? `\0${id}` : null),
    load(loaded) {
      if (loaded !== `\0${id}`) return null;
      const file = this.emitFile({ type: "asset", name: "coast.bin", source: packedCoast() });
      return `export const address = import.meta.ROLLUP_FILE_URL_${file};\nexport const step = ${step};\n`;
    },
  };
}
