// The chosen pair: its distance over time in scenes, dropped tables and recordings, its link, and the ways of tracks.
import assert from "node:assert/strict";
import { before, describe, test } from "node:test";

import { bodyInSight, browserForTests, importSource } from "./page.mjs";
import { isDrawn } from "./watch.mjs";

/** Rows of bodies that go straight on, from `begin` on: the first meets the others at 5 s. */
function table() {
  const rows = ["id,t,x,y"];
  const add = (id, begin, end, place) => {
    for (let k = 0; begin + 0.4 * k <= end; ++k) rows.push(`${id},${(begin + 0.4 * k).toFixed(1)},${place(begin + 0.4 * k).join(",")}`);
  };
  add("anna", 0, 10, (t) => [t, 0]);
  add("berta too", 1, 9, (t) => [10 - t, 0.3]);
  add("clara", 20, 24, (t) => [t - 15, 3]);
  return rows.join("\n");
}

describe("the curve of a pair", () => {
  let made;
  before(async () => {
    made = { ...await importSource("pair_curve.ts"), ...await importSource("scenes/track_table.ts") };
    Object.assign(made, { simulation: await importSource("simulation.ts"), list: await importSource("scenes/list.ts") });
    await made.simulation.load();
  });
  const simulationOf = (choice, opened = null) =>
    new made.simulation.Simulation(made.list.setUp(choice, opened), made.list.sceneAbout(choice.name));
  const close = (found, expected, tolerance) => assert.ok(Math.abs(found - expected) < tolerance, `${found}, not ${expected}`);

  test("is known of two tracks from the begin, with its smallest value", () => {
    const shown = simulationOf({ name: "crowd", bodies: 10_000, seed: 1 }, made.readTable("three.csv", table()));
    const curve = new made.PairCurve(shown, 0, 1);
    assert.equal(curve.isKnown, true);
    assert.equal(shown.nameOf(1), "berta too");
    close(curve.least.time, 5, 1e-6);
    close(curve.least.distance, 0.3, 1e-9);
    assert.deepEqual([curve.line[0].time, curve.line.at(-1).time], [1, 9]);
    for (const { time, distance } of curve.line) close(distance, Math.hypot(10 - 2 * time, 0.3), 1e-9);
    // Two that are never there together have no distance.
    const apart = new made.PairCurve(shown, 0, 2);
    assert.deepEqual([apart.line.length, apart.least, apart.now], [0, null, null]);
  });

  test("of a scene is what has been seen, within limits that are certain, and least at a contact", () => {
    const shown = simulationOf({ name: "gas", bodies: 60, seed: 3 });
    let pair;
    while (pair === undefined)
      pair = shown.nextEvent().find(({ event }) => event.kind === "contact_begin")?.event;
    shown.rewind(0);
    const curve = new made.PairCurve(shown, pair.first, pair.second);
    for (let k = 1; k * 0.01 < pair.time + 0.1; ++k) curve.follow(shown.run(k * 0.01));
    close(curve.least.time, pair.time, 1e-9);
    close(curve.least.distance, shown.radii()[pair.first] + shown.radii()[pair.second], 1e-6);
    assert.ok(curve.limits.length > 5);
    for (const { time, lower, upper } of curve.limits) {
      const look = curve.line.find((each) => each.time === time);
      assert.ok(lower <= look.distance + 1e-9 && look.distance <= upper + 1e-9, `${lower}, ${look.distance}, ${upper}`);
    }
    // The same part again changes nothing, and after a throw it is forgotten.
    const looks = curve.line.length;
    shown.rewind(0);
    curve.follow(shown.run(0.02));
    assert.equal(curve.line.length, looks);
    curve.cutAfter(0.02);
    assert.ok(curve.line.length <= 3 && curve.least.time <= 0.02);
  });

  test("two that fly past each other between two looks are seen at their closest", () => {
    const shown = { ways: [], time: 0, box: null, periodic: [], shapes: () => new Map([[0, null]]), placeOf: (id) => id,
                    positions() { return Float64Array.of(0, 0.05, 0, 100 * (this.time - 0.0234), 0, 0); } };
    const curve = new made.PairCurve(shown, 0, 1);
    for (let k = 0; k < 10; ++k) {
      shown.time = 0.01 * k;
      curve.follow([]);
    }
    close(curve.least.time, 0.0234, 1e-6);
    close(curve.least.distance, 0.05, 1e-6);
  });

  test("a scene goes back to its begin, however long it has run, and on to the same events", () => {
    const shown = simulationOf({ name: "gas", bodies: 20, seed: 4 });
    shown.run(1);
    const { hash } = shown;
    shown.run(200);
    const late = shown.hash;
    assert.equal(shown.firstTime, 0);
    shown.back(199);
    assert.deepEqual([shown.time, shown.hash], [1, hash]);
    shown.run(150);
    shown.back(3);
    shown.run(200);
    assert.equal(shown.hash, late);
  });
});

const inBrowser = browserForTests({ viewport: { width: 1280, height: 800 } });
const allowed = { permissions: ["clipboard-read", "clipboard-write"] };
const drop = (page, name, content) => page.evaluate(([name, content]) => {
  const files = new DataTransfer();
  files.items.add(new File([typeof content === "string" ? content : Uint8Array.from(content)], name));
  window.dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
}, [name, content]);
const isShown = (page, title) => page.waitForFunction((title) => window.kinesphereViewer.simulation.title === title, title);
const arrived = (page, time) =>
  page.waitForFunction((time) => Math.abs(window.kinesphereViewer.simulation.time - time) < 1e-6, time, { timeout: 60_000 });
const chosen = (page) => page.evaluate(() => window.kinesphereViewer.pair.ids);
const message = (page) => page.textContent("#message-text");
async function copied(page) {
  await page.evaluate(() => navigator.clipboard.writeText(""));
  await page.keyboard.press("k");
  await page.waitForFunction(() => navigator.clipboard.readText().then((text) => text !== ""));
  return page.evaluate(() => navigator.clipboard.readText());
}
/** Goes to a time, and stays there. */
async function goTo(page, time) {
  await page.evaluate((time) => window.kinesphereViewer.seek(time), time);
  await arrived(page, time);
}
/** Returns the place of a body on the page. */
const placeOf = (page, body) => page.evaluate((body) => {
  const { simulation, stage } = window.kinesphereViewer;
  const place = stage.camera.position.clone().fromArray(simulation.positions(), 3 * body).project(stage.camera);
  return [((place.x + 1) / 2) * innerWidth, ((1 - place.y) / 2) * innerHeight];
}, body);

describe("a dropped table", () => {
  let page;
  let link;
  before(async () => {
    page = await inBrowser.open("", allowed);
    await drop(page, "three & more.csv", table());
    await isShown(page, "three & more.csv");
  });

  test("two that are clicked have their distance over time, and its smallest value", async () => {
    await goTo(page, 4);
    await page.mouse.click(...await placeOf(page, 0));
    assert.equal(await page.textContent("#pair-title"), "anna");
    assert.match(await page.textContent("#pair-now"), /Choose another one/);
    await page.mouse.click(...await placeOf(page, 1));
    assert.deepEqual(await chosen(page), [0, 1]);
    assert.equal(await page.textContent("#pair-title"), "anna – berta too");
    assert.match(await page.textContent("#pair-now"), /^Distance of the centres now: 2.02/);
    assert.equal(await page.textContent("#pair-least"), "closest: 0.3 at 5 s");
    assert.match(await page.getAttribute("#pair-chart", "aria-label"), /^Distance of anna and berta too over time; closest: 0.3 at 5 s$/);
  });

  test("a click on the curve leads there, and the smallest value to its moment", async () => {
    await page.click("#pair-least");
    await arrived(page, 5);
    const box = await page.locator("#pair-chart").boundingBox();
    await page.mouse.click(box.x + 0.75 * box.width, box.y + 50);
    await page.waitForFunction(() => window.kinesphereViewer.simulation.time > 6);
    const time = await page.evaluate(() => window.kinesphereViewer.simulation.time);
    assert.ok(time < 8, `${time}`);
    await page.mouse.click(box.x + 2, box.y + 50);
    await arrived(page, 0);
  });

  test("its tracks leave their ways, as far as they have come", async () => {
    const inked = async (trails, time) => {
      await page.evaluate((trails) => { window.kinesphereViewer.settings.overlays.trails = trails; }, trails);
      await goTo(page, time);
      await isDrawn(page);
      return page.evaluate(() => {
        const { stage, simulation } = window.kinesphereViewer;
        let points = 0;
        // Lines of one colour each: ways so far, and lately.
        stage.scene.traverse((object) => {
          if (object.isLineSegments && object.visible && !object.material.vertexColors && object.parent === stage.scene) points += object.geometry.drawRange.count;
        });
        return { points, time: simulation.time };
      });
    };
    await page.keyboard.press("Escape");
    assert.deepEqual(await chosen(page), []);
    const [early, late, end] = [await inked(true, 3.05), await inked(true, 8), await inked(true, 23.9)];
    assert.ok(early.points > 10 && late.points > 1.5 * early.points && end.points > late.points, JSON.stringify([early, late, end]));
    assert.equal((await inked(false, 8)).points, 0);
    await page.evaluate(() => { window.kinesphereViewer.settings.overlays.trails = true; });
  });

  test("the link has the pair and the file, and waits for it elsewhere", async () => {
    await goTo(page, 4.5);
    await page.keyboard.press("n");
    assert.deepEqual(await chosen(page), [0, 1]);
    link = await copied(page);
    assert.match(await message(page), /three & more\.csv is dropped/);
    assert.match(link, /#file=three%20%26%20more\.csv&t=4\.500000&.*&pair=0,1$/);
    page = await inBrowser.open(link);
    assert.match(await message(page), /^The link leads to a moment of three & more\.csv\. Drop this file/);
    await drop(page, "three & more.csv", table());
    await arrived(page, 4.5);
    assert.deepEqual(await chosen(page), [0, 1]);
    assert.equal(await page.evaluate(() => window.kinesphereViewer.settings.playing), false);
    // Another file than that of the link goes its own way.
    page = await inBrowser.open(link);
    await drop(page, "other.csv", table());
    await isShown(page, "other.csv");
    assert.deepEqual(await chosen(page), []);
  });

  for (const [width, height] of [[390, 844], [844, 390], [1024, 768], [1440, 900]])
    test(`its panel covers nothing else at ${width} by ${height}`, async () => {
      page = await inBrowser.open("", { viewport: { width, height }, hasTouch: width < 900, isMobile: width < 900 });
      await drop(page, "three.csv", table());
      await isShown(page, "three.csv");
      await goTo(page, 4);
      await page.keyboard.press("n");
      const boxes = await page.evaluate(() => ["hud", "panel", "transport", "pair", "legend"].map((id) => document.querySelector(`#${id}`))
        .filter((each) => getComputedStyle(each).display !== "none")
        .map((each) => ({ id: each.id, ...each.getBoundingClientRect().toJSON() })));
      for (const [k, a] of boxes.entries())
        for (const b of boxes.slice(k + 1))
          assert.ok(a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top, `${a.id} and ${b.id}: ${JSON.stringify([a, b])}`);
      for (const { id, left, right, top, bottom } of boxes) assert.ok(left >= 0 && right <= width && top >= 0 && bottom <= height, id);
    });
});

describe("other scenes", () => {
  test("a click on a sphere chooses it, and pushes nothing", async () => {
    const page = await inBrowser.open("#scene=gas&bodies=60&t=0.5");
    await arrived(page, 0.5);
    const found = await bodyInSight(page, 0);
    await page.mouse.move(found.x, found.y);
    await page.mouse.down();
    // However long that takes here, it is a short press.
    await page.evaluate(() => {
      const { hand } = window.kinesphereViewer;
      hand.press.time = Infinity;
      hand.pull(1);
    });
    await page.mouse.up();
    assert.deepEqual(await chosen(page), [found.body]);
    const moved = await page.evaluate(() => {
      const { simulation, setPlaying } = window.kinesphereViewer;
      setPlaying(true);
      return simulation.wasPushed;
    });
    assert.equal(moved, false);
    await page.mouse.click(5, 790);
    assert.deepEqual(await chosen(page), [found.body]);
  });

  test("a link with a pair shows its distance from the begin on", async () => {
    const page = await inBrowser.open("#scene=missed&bodies=100&seed=2&t=0.5&pair=3,17", allowed);
    await arrived(page, 0.5);
    assert.deepEqual(await chosen(page), [3, 17]);
    await page.waitForFunction(() => document.querySelector("#pair-least").textContent.startsWith("closest so far"));
    assert.match(await copied(page), /&pair=3,17$/);
    const least = await page.evaluate(() => {
      const [, text] = /at (.*) s/.exec(document.querySelector("#pair-least").textContent);
      document.querySelector("#pair-least").click();
      return Number(text);
    });
    await page.waitForFunction((time) => Math.abs(window.kinesphereViewer.simulation.time - time) < 1e-3, least);
    await page.keyboard.press("r");
    assert.deepEqual(await chosen(page), [3, 17], "a restart keeps it");
    await page.keyboard.press("3");
    assert.deepEqual(await chosen(page), [], "another scene does not");
  });

  test("what is certain of a distance is told", async () => {
    const page = await inBrowser.open("#scene=paper1&bodies=60&t=0.5&pair=3,17");
    await arrived(page, 0.5);
    await page.waitForFunction(() => /^Distance of the centres now: [\d.]+, certainly [\d.]+ to [\d.]+$/.test(document.querySelector("#pair-now").textContent));
  });

  test("what the engine knows is drawn near the chosen alone, with all others as shadows", async () => {
    const drawn = (page) => page.evaluate(() => {
      const { stage, simulation } = window.kinesphereViewer;
      const count = (spheres) => {
        const { ball } = spheres.object.visible ? spheres.object.geometry.attributes : {};
        return ball === undefined ? 0 : Array.from({ length: ball.count }, (_, k) => ball.getW(k)).filter((radius) => radius > 0).length;
      };
      return { bodies: count(stage.bodies), ghosts: count(stage.ghosts), all: simulation.radii().length };
    });
    const page = await inBrowser.open("#scene=gas&bodies=300&t=0.5&show=certificates&pair=3,17");
    await arrived(page, 0.5);
    await isDrawn(page);
    const { bodies, ghosts, all } = await drawn(page);
    assert.ok(bodies >= 2 && bodies < 60, `${bodies}`);
    assert.equal(bodies + ghosts, all);
    for (const change of [() => { window.kinesphereViewer.settings.overlays.certificates = false; }, () => {
      window.kinesphereViewer.settings.overlays.certificates = true;
      window.kinesphereViewer.pair.choose([]);
    }]) {
      await page.evaluate(change);
      await isDrawn(page);
      assert.deepEqual(await drawn(page), { bodies: all, ghosts: 0, all });
    }
  });

  test("a wrong pair in a link is named", async () => {
    for (const [link, said] of [
      ["pair=3", /The link's pair must be two different numbers of bodies, but is 3/],
      ["pair=3,3", /two different numbers/],
      ["pair=3,x", /The link's pair must be a number from 0/],
      ["scene=missed&bodies=20&pair=3,900", /The link's pair has a body 900, which is not here/],
    ]) {
      const page = await inBrowser.open(`#${link}`);
      assert.match(await message(page), said);
      assert.deepEqual(await chosen(page), []);
    }
  });

  test("a recording has its own title, pairs, and a link to its file", async () => {
    const page = await inBrowser.open("#scene=gas&bodies=50&t=0.25", allowed);
    await arrived(page, 0.25);
    const bytes = await page.evaluate(() => {
      const { simulation } = window.kinesphereViewer;
      simulation.view.startRecording();
      simulation.run(2);
      return Array.from(simulation.view.stopRecording());
    });
    await drop(page, "own.rec", bytes);
    await isShown(page, "own.rec");
    assert.equal(await page.textContent("#title"), "own.rec");
    await goTo(page, 1);
    await page.keyboard.press("n");
    const ids = await chosen(page);
    assert.equal(ids.length, 2);
    await goTo(page, 1.5);
    const limits = await page.evaluate(() => {
      const { pair } = window.kinesphereViewer;
      pair.update();
      return document.querySelector("#pair-least").textContent;
    });
    assert.match(limits, /^closest so far: [\d.]+ at 1(\.\d+)? s$/);
    assert.match(await copied(page), new RegExp(`#file=own\\.rec&t=1\\.500000&.*&pair=${ids.join(",")}$`));
  });
});

test("the page has complained of nothing, and asked nobody else", () => {
  assert.deepEqual(inBrowser.complaints, []);
});
