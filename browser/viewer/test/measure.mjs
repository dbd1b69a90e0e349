// Measures the pages for docs/browser.md: time to the first picture, and the duration of a picture. The variables are
// those of page.mjs. No test: the results count only on an otherwise idle machine.
import { test } from "node:test";

import { browserForTests } from "./page.mjs";

const median = (numbers) => numbers.sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
const inBrowser = browserForTests({ viewport: { width: 1200, height: 800 } });

test("first picture", async () => {
  const times = [];
  for (let k = 0; k < 7; ++k) {
    const page = await inBrowser.open();
    times.push(await page.evaluate(() => window.kinesphereViewer.firstPicture));
  }
  console.log(`first picture after ${times.map((time) => time.toFixed(0)).join(", ")} ms: median ${median(times).toFixed(0)}`);
});

for (const [scene, bodies] of [["gas", 0], ["gas", 1000], ["gas", 10_000], ["paper1", 1000]]) {
  test(`${scene} with ${bodies} bodies`, async () => {
    const page = await inBrowser.open();
    const found = await page.evaluate(async ({ scene, bodies }) => {
      const viewer = window.kinesphereViewer;
      Object.assign(viewer.settings, { scene, bodies: Math.max(bodies, 10), seed: 1, speed: 1 });
      viewer.setPlaying(false);
      viewer.restart();
      // An empty page gives the cost of drawing alone.
      if (bodies === 0) viewer.stage.scene.clear();
      else viewer.setPlaying(true);
      const until = (seconds) => new Promise((done) => setTimeout(done, 1000 * seconds));
      await until(3);
      const { simulation, times } = viewer;
      const [pictures, time, start] = [viewer.pictures, simulation.time, performance.now()];
      await until(8);
      const seconds = (performance.now() - start) / 1000;
      return {
        pictures: (viewer.pictures - pictures) / seconds, engine: times.engine, drawing: times.drawing,
        pace: (simulation.time - time) / seconds, bodies: simulation.bodyCount,
      };
    }, { scene, bodies });
    if (found.bodies !== Math.max(bodies, 10)) throw new Error(`there are ${found.bodies} bodies`);
    console.log(`${scene}, ${bodies} bodies: ${found.pictures.toFixed(1)} pictures a second; of each ` +
                `${found.engine.toFixed(1)} ms in the engine, ${found.drawing.toFixed(1)} ms in the page's own program; ` +
                `${found.pace.toFixed(2)} simulated seconds a second`);
  });
}

/** Returns a state of a watch: tracks in a square, every third of them stale, and pairs of neighbours. */
function crowdedState(trackCount, pairCount) {
  // Equal at each call.
  let seed = 1;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  const tracks = Array.from({ length: trackCount }, (_, k) => ({
    id: `F${k}`, name: null, stamp: 0, stale: k % 3 === 0,
    places: [{ x: 5e5 * (random() - 0.5), y: 5e5 * (random() - 0.5), z: 300 * (k % 40), velocity: [400 * (random() - 0.5), 400 * (random() - 0.5), 0], radius: [4000 * random(), 100] }],
  }));
  const { x, y } = tracks[0].places[0];
  tracks.sort((a, b) => Math.hypot(a.places[0].x - x, a.places[0].y - y) - Math.hypot(b.places[0].x - x, b.places[0].y - y));
  const pairs = Array.from({ length: pairCount }, (_, k) => ({
    first: tracks[2 * k].id, second: tracks[2 * k + 1].id, separation: "cylinder:5NM:1000ft", level: 0, verdict: k % 10 === 0 ? "within" : "undecided", since: 0,
    distance: [1000, 9000], until: 20, closest_distance: 500, closest_time: 30, likely_time: k, ask: tracks[2 * k].id, ask_by: 12,
  }));
  return {
    time: 10, stream: "measured", format: "jsonl", own: null, geographic: false, dimensions: 3, origin: null, silence: 15, forget: 60, counts: { reports: 6000 },
    separations: [{ name: "cylinder:5NM:1000ft", shape: "cylinder", horizontal: 9260, vertical: 304.8 }], tracks, pairs, predictions: [],
    needed: pairs.map(({ first, second }) => ({ track: first, by: 12, other: second })),
  };
}

test("the map of a watch with 2000 tracks", async () => {
  const withMap = browserForTests({
    given: { "/state.json": JSON.stringify(crowdedState(2000, 270)) }, viewport: { width: 1440, height: 900 },
    graphics: [],
    isReady: () => window.kinesphereMap?.states > 0 && window.kinesphereMap.pictures > 0,
  });
  const page = await withMap.open("map.html");
  const found = await page.evaluate(async () => {
    const map = window.kinesphereMap;
    const median = (numbers) => numbers.sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
    const picture = () => new Promise((done) => requestAnimationFrame(done));
    const [own, between, showing] = [[], [], []];
    let last = performance.now();
    for (let k = 0; k < 100; ++k) {
      map.view.pan(k % 20 < 10 ? 4 : -4, 1);
      map.redraw();
      await picture();
      own.push(map.drawing);
      between.push(performance.now() - last);
      last = performance.now();
    }
    for (let k = 0; k < 20; ++k) {
      const start = performance.now();
      map.show(map.scene.state);
      showing.push(performance.now() - start);
      await picture();
    }
    return { own: median(own), between: median(between), showing: median(showing) };
  });
  console.log(`map of 2000 tracks and 270 pairs: ${(1000 / found.between).toFixed(0)} pictures a second while it moves; ` +
              `${found.own.toFixed(1)} ms in the page's own program for a picture, ${found.showing.toFixed(1)} ms for a new state`);
});
