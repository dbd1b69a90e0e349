// What the page costs here, for docs/browser.md: time to the first picture, and what a picture takes. The variables are
// those of page.mjs. No test: what it prints is worth something only where nothing else runs.
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
      // An empty page tells what drawing alone costs here.
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
