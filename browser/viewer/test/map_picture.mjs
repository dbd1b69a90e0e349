// Makes the picture of the map in docs/watch.md: ships off the mouth of the Elbe, of which two are predicted to pass each
// other within a quarter of a mile. The variables are those of page.mjs and watch.mjs. No test.
// Usage: node --test map_picture.mjs, with KINESPHERE_PICTURE=FILE.png
import { after, describe, test } from "node:test";

import { browserForTests } from "./page.mjs";
import { isDrawn, Watch } from "./watch.mjs";

const inBrowser = browserForTests({
  viewport: { width: 1200, height: 700 }, graphics: [],
  isReady: () => window.kinesphereMap?.scene?.pairs.length > 0 && window.kinesphereMap.coastSize > 0,
});
const ships = [
  ["211234560", "SEUTE DEERN", 53.979, 8.3, 13, 92], ["219001234", "MAERSK EINDHOVEN", 53.9735, 8.62, 16, 271],
  ["244660000", "VOX MAXIMA", 53.92, 8.42, 10, 60], ["211999990", "HELGOLAND", 54.06, 8.2, 18, 140],
  ["257000002", "NORDLYS", 54.05, 8.6, 11, 205], ["211500100", "PILOT ELBE", 53.94, 8.66, 8, 285],
  ["211500200", "", 54.02, 8.45, 0, 0],
];
/** Returns the rows of all ships, so many seconds after noon. */
const rows = (seconds) => ships.map(([mmsi, name, lat, lon, knots, course]) => {
  const degrees = knots * seconds / 3600 / 60;
  const angle = course * Math.PI / 180;
  const place = [lat + degrees * Math.cos(angle), lon + degrees * Math.sin(angle) / Math.cos(lat * Math.PI / 180)];
  return `${mmsi},2026-03-01T12:00:${String(seconds).padStart(2, "0")},${place.map((each) => each.toFixed(6)).join(",")},${knots},${course},511,${name}\n`;
}).join("");

describe("the map", () => {
  const watch = new Watch("--format", "ais", "--separation", "sphere:0.5NM:30min");
  after(() => watch.process.kill());

  test("picture", async () => {
    watch.write("MMSI,BaseDateTime,LAT,LON,SOG,COG,Heading,VesselName\n");
    for (let seconds = 0; seconds < 60; seconds += 10) watch.write(rows(seconds));
    const page = await inBrowser.open(await watch.address, { reducedMotion: "reduce", colorScheme: "light" });
    await isDrawn(page);
    await page.screenshot({ path: process.env.KINESPHERE_PICTURE });
  });
});
