// A sphere that is dragged about at random for a minute: nothing overlaps, and violations are shown.
import assert from "node:assert/strict";
import { before, test } from "node:test";

import { bodyInSight, browserForTests } from "./page.mjs";

const inBrowser = browserForTests();
let page;
before(async () => {
  page = await inBrowser.open();
});

/** Drags the sphere for a number of simulated seconds, 60 pictures each, and checks each picture. */
function drag(settings) {
  return page.evaluate(({ seconds, seed, pointerId }) => {
    const { simulation, stage, hand } = window.kinesphereViewer;
    const { canvas } = stage;
    const tolerance = simulation.view.definition.contactTolerance;
    let state = seed;
    const random = () => {
      state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
      return state / 2 ** 32;
    };
    const radii = simulation.radii();
    const from = { x: canvas.clientWidth / 2, y: canvas.clientHeight / 2 };
    const to = { ...from };
    const result = { deepest: 0, reported: 0, contacts: 0, held: 0, way: 0, violations: 0, findings: [] };
    const body = hand.body;
    const start = simulation.time;
    let before = simulation.positions().slice(3 * body, 3 * body + 3);
    for (let picture = 0; picture < 60 * seconds; ++picture) {
      // A new goal three times a second, and the pointer on its way there.
      if (picture % 20 === 0) {
        to.x = canvas.clientWidth * random();
        to.y = canvas.clientHeight * random();
      }
      from.x += 0.2 * (to.x - from.x);
      from.y += 0.2 * (to.y - from.y);
      canvas.dispatchEvent(new PointerEvent("pointermove", { pointerId, clientX: from.x, clientY: from.y }));
      hand.pull(1);
      for (const { event } of simulation.run(start + (picture + 1) / 60)) {
        result.reported += 1;
        if (event.kind === "contact_begin" && (event.first === body || event.second === body)) result.contacts += 1;
        if (event.kind === "bound_violation") result.violations += 1;
      }
      if (hand.body === body) result.held += 1;
      const positions = simulation.positions();
      for (let a = 0; a < radii.length; ++a) {
        for (let b = 0; b < a; ++b) {
          const x = positions[3 * a] - positions[3 * b];
          const y = positions[3 * a + 1] - positions[3 * b + 1];
          const z = positions[3 * a + 2] - positions[3 * b + 2];
          const sum = radii[a] + radii[b];
          const squared = x * x + y * y + z * z;
          if (squared < sum * sum) result.deepest = Math.max(result.deepest, sum - Math.sqrt(squared));
        }
      }
      const place = positions.slice(3 * body, 3 * body + 3);
      result.way += Math.hypot(place[0] - before[0], place[1] - before[1], place[2] - before[2]);
      before = place;
      if (picture % 60 === 59) {
        const finding = simulation.view.audit();
        if (finding !== null) result.findings.push(finding);
      }
    }
    return { ...result, tolerance, extent: stage.extent.radius };
  }, settings);
}

for (const [scene, seconds, bodies, seed] of [["paper1", 60, 300, 1], ["gas", 10, 400, 2], ["pile", 10, 200, 3], ["game", 10, 150, 4]]) {
  test(`${scene}: dragged at random for ${seconds} s (seed ${seed})`, async () => {
    await page.evaluate(({ scene, bodies, seed }) => {
      const viewer = window.kinesphereViewer;
      Object.assign(viewer.settings, { scene, bodies, seed });
      viewer.restart();
      viewer.setPlaying(false);
      viewer.simulation.run(1);
    }, { scene, bodies, seed });
    const grabbed = await bodyInSight(page, 0);
    assert.notEqual(grabbed, null);
    // A real button, so that the pointer is held; the test sets its further way.
    await page.evaluate(() => void (window.pointer = new Promise((known) =>
      document.addEventListener("pointerdown", (event) => known(event.pointerId), { capture: true, once: true }))));
    await page.mouse.move(grabbed.x, grabbed.y);
    await page.mouse.down();
    const pointerId = await page.evaluate(() => window.pointer);
    const result = await drag({ seconds, seed, pointerId });
    await page.mouse.up();
    assert.equal(result.held, 60 * seconds, "the sphere was let go");
    assert.ok(result.way > 5 * result.extent, `the sphere was dragged ${result.way}`);
    assert.ok(result.contacts > 5, `${result.contacts} contacts of the sphere`);
    assert.ok(result.deepest <= 1.001 * result.tolerance, `two overlap by ${result.deepest}`);
    assert.equal(result.violations, 0);
    assert.deepEqual(result.findings, []);
  });
}

test("a broken promise is shown", async () => {
  const reported = await page.evaluate(() => {
    const viewer = window.kinesphereViewer;
    Object.assign(viewer.settings, { scene: "paper1", bodies: 50, seed: 1 });
    viewer.restart();
    viewer.setPlaying(false);
    const { simulation } = viewer;
    simulation.run(1);
    // Without a call of the world.
    const { motion } = simulation.scene;
    motion.setVelocity(7, simulation.time, [900, 0, 0]);
    return simulation.run(simulation.time + 5).filter(({ event }) => event.kind === "bound_violation").length;
  });
  assert.ok(reported > 0);
  const shown = () => page.textContent('#numbers [data-name="broken promises"] dd');
  await page.waitForFunction(() => document.querySelector('#numbers [data-name="broken promises"]').classList.contains("bad"));
  assert.equal(await shown(), String(reported));
});
