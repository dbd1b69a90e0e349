// The page in use.
import assert from "node:assert/strict";
import { before, test } from "node:test";

import { bodyInSight, browserForTests } from "./page.mjs";

const line = (x, y, count) => Array.from({ length: count }, (_, k) => [x + k, y, 0]).flat();
/** Two people who pass each other; the second arrives later and leaves earlier. */
const tracks = {
  name: "people.txt",
  plane: true,
  unit: "m",
  tracks: [
    { id: "anna", times: [10, 11, 12, 13, 14], positions: line(0, 0, 5) },
    { id: "berta", times: [11, 12, 13], positions: [3, 0.2, 0, 2, 0.2, 0, 1, 0.2, 0] },
  ],
};
const inBrowser = browserForTests({
  given: {
    "/opened/files.json": JSON.stringify({ recording: null, tracks: "people.txt" }),
    "/opened/tracks.json": JSON.stringify(tracks),
  },
});
const { complaints } = inBrowser;
let page;
before(async () => {
  page = await inBrowser.open();
});

test("it begins with what 60 Hz misses", async () => {
  await page.waitForFunction(() => window.kinesphereViewer.simulation.tally.missed > 3, null, { timeout: 60_000 });
  const seen = await page.evaluate(() => {
    const { simulation, settings } = window.kinesphereViewer;
    return { scene: settings.scene, contacts: simulation.tally.contacts, trails: simulation.trails.length,
             legend: Array.from(document.querySelectorAll("#legend li"), (item) => item.textContent) };
  });
  assert.equal(seen.scene, "missed");
  assert.ok(seen.contacts > 3);
  assert.equal(seen.trails, 40);
  for (const words of ["contact that 60 Hz misses", "trail", "where 60 Hz looks"]) assert.ok(seen.legend.includes(words), words);
  await page.keyboard.press("2");
});

const state = () => page.evaluate(() => {
  const { simulation, settings } = window.kinesphereViewer;
  return { time: simulation.time, hash: simulation.hash, playing: settings.playing, contacts: simulation.tally.contacts,
           violations: simulation.tally.violations, bodies: simulation.bodyCount };
});

test("the scene goes on by itself", async () => {
  const { time } = await state();
  await page.waitForFunction((time) => window.kinesphereViewer.simulation.time > time + 1.2, time, { timeout: 60_000 });
  const { contacts } = await state();
  assert.ok(contacts > 0);
});

test("the bodies that cost most are listed with a reason", async () => {
  await page.evaluate(() => { window.kinesphereViewer.settings.overlays.busiest = true; });
  await page.waitForFunction(() => document.querySelectorAll("#busiest tbody tr").length === 5, null, { timeout: 60_000 });
  const rows = await page.evaluate(() => Array.from(document.querySelectorAll("#busiest tbody tr"), (row) =>
    ({ cells: Array.from(row.cells, (cell) => cell.textContent), advice: row.title })));
  for (const { cells, advice } of rows) {
    assert.match(cells[0], /^\d+$/);
    assert.match(cells[2], /^(touching|narrow misses|loose limit|contacts|travel|changes)$/);
    assert.ok(advice.length > 40);
  }
  await page.evaluate(() => { window.kinesphereViewer.settings.overlays.busiest = false; });
  await page.waitForFunction(() => document.querySelector("#busiest").hidden);
});

test("a pause holds it", async () => {
  await page.keyboard.press("Space");
  const first = await state();
  assert.equal(first.playing, false);
  await page.waitForTimeout(300);
  assert.equal((await state()).time, first.time);
});

test("one event at a time", async () => {
  const first = await state();
  await page.keyboard.press(".");
  const second = await state();
  assert.ok(second.time > first.time);
  assert.notEqual(second.hash, first.hash);
});

test("a second back, and forward to the same hash", async () => {
  const first = await state();
  await page.keyboard.press(",");
  const earlier = await state();
  assert.ok(Math.abs(earlier.time - (first.time - 1)) < 1e-9);
  assert.notEqual(earlier.hash, first.hash);
  await page.evaluate((time) => void window.kinesphereViewer.simulation.run(time), first.time);
  assert.deepEqual(await state(), first);
});

test("a sphere is grabbed, follows the pointer, and is thrown", async () => {
  const grabbed = await bodyInSight(page, 5);
  assert.notEqual(grabbed, null);
  const speedOf = (body) => page.evaluate((body) => {
    const { velocity } = window.kinesphereViewer.simulation.view.body(body).reported;
    return Math.hypot(...velocity);
  }, body);
  const before = await speedOf(grabbed.body);
  await page.mouse.move(grabbed.x, grabbed.y);
  await page.mouse.down();
  assert.equal(await page.evaluate(() => window.kinesphereViewer.hand.body), grabbed.body);
  await page.keyboard.press("Space");
  await page.mouse.move(grabbed.x + 60, grabbed.y - 40, { steps: 4 });
  const { time } = await state();
  await page.waitForFunction((time) => window.kinesphereViewer.simulation.time > time + 0.1, time, { timeout: 60_000 });
  const fastest = await speedOf(grabbed.body);
  await page.mouse.up();
  assert.equal(await page.evaluate(() => window.kinesphereViewer.hand.body), null);
  assert.notEqual(fastest, before);
  const { playing, violations } = await state();
  assert.equal(playing, true);
  assert.equal(violations, 0);
});

test("nothing overlaps after that", async () => {
  await page.keyboard.press("Space");
  const least = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    const positions = simulation.positions();
    const radii = simulation.radii();
    let least = Infinity;
    for (let a = 0; a < radii.length; ++a)
      for (let b = 0; b < a; ++b)
        least = Math.min(least, Math.hypot(...[0, 1, 2].map((k) => positions[3 * a + k] - positions[3 * b + k])) -
          radii[a] - radii[b]);
    return least;
  });
  assert.ok(least > -1e-5, `two bodies overlap by ${-least}`);
});

/** Drops a file on the page, as a person would. */
const drop = (name, content) => page.evaluate(([name, content]) => {
  const files = new DataTransfer();
  files.items.add(new File([content], name));
  window.dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
}, [name, content]);

test("a broken file, tables that ask for more and messages are refused with a message, and the scene goes on", async () => {
  await page.keyboard.press("Space");
  for (const [name, content, expected] of [
    ["broken.rec", "Kinerc\r\n12345", /^broken\.rec cannot be shown\. .+/],
    ["ships.csv", "id,time,lat,lon\n1,0,0,0\n", /^ships\.csv cannot be shown: a table whose columns .+ kinesphere view ships\.csv shows all tables/],
    ["extra.csv", "id,t,x,y,vx\n1,0,0,0,0\n", /: a table whose columns/],
    ["one.csv", "id,time,x,y\n1,0,0,0\n", /: 1 is there at one time alone/],
    ["word.csv", "id,time,x,y\n1,0,0,far\n", /: line 2 has no number in its column y/],
    ["short.csv", "id;t;x;y\n1;0;0\n", /: line 2 has 3 cells, and the header 4/],
    ["back.csv", "id,t,x,y\n1,1,0,0\n1,1,0,0\n", /: line 3: 1 was there at this time/],
    ["gap.csv", "id,t,x,y\n1,0,0,0\n1,1,0,0\n1,2,0,0\n1,9,0,0\n", /: 1 pauses from 2 to 9/],
    ["none.csv", "id,t,x,y\n", /: a table without rows/],
    ["ais.nmea", "!AIVDM,1,1,,A,13u?etPv2;0n:dDPwUM1U1Cb069D,0*24\n", /^ais\.nmea cannot .+ kinesphere view ais\.nmea shows .+ messages/],
  ]) {
    await drop(name, content);
    await page.waitForFunction((name) => document.querySelector("#message:not([hidden]) #message-text")?.textContent.startsWith(name), name);
    assert.match(await page.textContent("#message-text"), expected);
  }
  const { time, playing } = await state();
  assert.equal(playing, true);
  await page.waitForFunction((time) => window.kinesphereViewer.simulation.time > time, time, { timeout: 60_000 });
});

test("a recording is shown to its end", async () => {
  const made = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    window.kinesphereViewer.settings.speed = 0.3;
    simulation.view.startRecording();
    const contacts = simulation.run(simulation.time + 0.5).filter(({ event }) => event.kind === "contact_begin").length;
    const files = new DataTransfer();
    files.items.add(new File([simulation.view.stopRecording()], "own.rec"));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
    return { contacts, time: simulation.time, bodies: simulation.bodyCount };
  });
  await page.waitForFunction(() => window.kinesphereViewer.simulation.title === "own.rec");
  const shown = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    simulation.run(Infinity);
    return { contacts: simulation.tally.contacts, time: simulation.time, bodies: simulation.bodyCount };
  });
  assert.deepEqual(shown, made);
  // It is shown as fast as it was, and the scene in its slow motion afterwards.
  const speed = () => page.evaluate(() => window.kinesphereViewer.settings.speed);
  assert.equal(await speed(), 1);
  await page.keyboard.press("r");
  assert.equal(await speed(), 0.3);
});

test("a throw while time stands still counts", async () => {
  await page.keyboard.press("r");
  await page.evaluate(() => window.kinesphereViewer.setPlaying(false));
  const grabbed = await bodyInSight(page, 5);
  await page.mouse.move(grabbed.x, grabbed.y);
  await page.mouse.down();
  await page.mouse.move(grabbed.x + 50, grabbed.y, { steps: 3 });
  const { time } = await state();
  const pulled = (body) => page.evaluate((body) => {
    const { simulation, stage } = window.kinesphereViewer;
    const right = stage.camera.position.clone().set(1, 0, 0).transformDirection(stage.camera.matrixWorld);
    const { velocity } = simulation.view.body(body).reported;
    return right.x * velocity[0] + right.y * velocity[1] + right.z * velocity[2];
  }, body);
  await page.waitForFunction(() => window.kinesphereViewer.hand.goal() !== null);
  await page.waitForTimeout(100);
  await page.mouse.up();
  assert.equal((await state()).time, time);
  await page.evaluate(() => void window.kinesphereViewer.simulation.run(window.kinesphereViewer.simulation.time + 1e-6));
  assert.ok((await pulled(grabbed.body)) > 10);
});

test("every scene can be chosen", async () => {
  const names = new Set();
  for (const key of "1234567890-=[") {
    await page.keyboard.press(key);
    const name = await page.evaluate(() => window.kinesphereViewer.simulation.title);
    await page.waitForFunction(() => window.kinesphereViewer.simulation.time > 0.02, null, { timeout: 60_000 });
    // All switches at once, with each way to colour.
    for (const colouring of ["asked", "safe", "size"]) {
      await page.evaluate((colouring) => {
        const { settings } = window.kinesphereViewer;
        settings.colouring = colouring;
        for (const overlay of Object.keys(settings.overlays)) settings.overlays[overlay] = colouring === "safe";
      }, colouring);
      const pictures = await page.evaluate(() => window.kinesphereViewer.pictures);
      await page.waitForFunction((count) => window.kinesphereViewer.pictures > count + 1, pictures, { timeout: 60_000 });
    }
    assert.equal(await page.evaluate(() => window.kinesphereViewer.simulation.view.audit()), null, name);
    names.add(name);
  }
  assert.equal(names.size, 13);
});

test("ten thousand bodies find room", async () => {
  for (const scene of ["paper1", "drones", "game"]) {
    const found = await page.evaluate((scene) => {
      const viewer = window.kinesphereViewer;
      Object.assign(viewer.settings, { scene, bodies: 10_000, seed: 1 });
      viewer.setPlaying(false);
      viewer.restart();
      return { bodies: viewer.simulation.bodyCount, scene: viewer.settings.scene, said: document.querySelector("#message").hidden ? "" :
        document.querySelector("#message-text").textContent };
    }, scene);
    assert.deepEqual(found, { bodies: 10_000, scene, said: "" });
  }
});

test("without a recording a crowd is made up", async () => {
  await page.keyboard.press("=");
  const { bodies, contacts, message } = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    simulation.run(30);
    return { bodies: simulation.bodyCount, contacts: simulation.tally.contacts, message: document.querySelector("#message").hidden };
  });
  assert.ok(bodies > 20 && contacts > 10, `${bodies} bodies, ${contacts} contacts`);
  assert.equal(message, true);
});

test("a piston is drawn as its shape, and no ball is where it is", async () => {
  await page.keyboard.press("-");
  const seen = await page.evaluate(() => {
    const { simulation, stage } = window.kinesphereViewer;
    const [[piston, shape], ...others] = simulation.shapes();
    let deepest = 0;
    for (let step = 0; step < 100; ++step) {
      simulation.run(simulation.time + 0.05);
      const positions = simulation.positions();
      for (let ball = 0; ball < piston; ++ball)
        deepest = Math.max(deepest, simulation.radii()[ball] + 0.2 - Math.abs(positions[3 * ball + 2] - positions[3 * piston + 2]));
    }
    return { shape, others: others.length, deepest, violations: simulation.tally.violations };
  });
  assert.deepEqual(seen.shape, { box: { lower: [-4.95, -4.95, -0.2], upper: [4.95, 4.95, 0.2] } });
  assert.equal(seen.others, 0);
  assert.equal(seen.violations, 0);
  assert.ok(seen.deepest < 1e-5, `${seen.deepest}`);
});

test("rigid bodies are drawn as they turn: parts touch at each contact", async () => {
  await page.keyboard.press("[");
  const seen = await page.evaluate(() => {
    const { simulation, setPlaying } = window.kinesphereViewer;
    setPlaying(false);
    /** How far a part reaches along a direction, as it is drawn. */
    const reachOf = (body, part, direction) => {
      const [kind, { centre, a, b, points = centre === undefined ? [a, b] : [centre], radius }] =
        Object.entries(simulation.shapes().get(body).parts[part])[0];
      kinds.add(kind);
      const [x, y, z, w] = simulation.orientations().get(body);
      const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
      return radius + Math.max(...points.map((point) => {
        // v + 2 q x (q x v + w v)
        const inner = cross([x, y, z], point).map((c, k) => c + w * point[k]);
        const turned = cross([x, y, z], inner).map((c, k) => point[k] + 2 * c);
        return turned.reduce((sum, c, k) => sum + direction[k] * (c + simulation.positions()[3 * body + k]), 0);
      }));
    };
    const kinds = new Set();
    let contacts = 0, furthest = 0, turning = 0;
    while (contacts < 100) {
      for (const { event } of simulation.nextEvent()) {
        if (event.kind !== "contact_begin") continue;
        contacts += 1;
        // Convex parts touch where their supporting planes across the normal are one.
        furthest = Math.max(furthest, Math.abs(reachOf(event.first, event.firstPart, event.normal) +
                                               reachOf(event.second, event.secondPart, event.normal.map((c) => -c))));
        turning += Math.hypot(...simulation.view.rotation(event.first).angularVelocity) > 0;
      }
    }
    // Between events each body turns steadily, whether it is asked meanwhile or not.
    let jerk = 0, steady = 0;
    for (let step = 0; step < 50; ++step) {
      const [before, time] = [simulation.orientations(), simulation.time];
      const hit = new Set(simulation.run(time + 0.02).flatMap(({ event }) => [event.first, event.second]));
      for (const [body, now] of simulation.orientations()) {
        if (hit.has(body)) continue;
        steady += 1;
        const speed = Math.hypot(...simulation.view.rotation(body).angularVelocity);
        // The part of the turn from one quaternion to the other that is no real number is the sine of half its angle.
        const [[ax, ay, az, aw], [bx, by, bz, bw]] = [before.get(body), now];
        const sine = Math.hypot(aw * bx - ax * bw - ay * bz + az * by, aw * by - ay * bw - az * bx + ax * bz, aw * bz - az * bw - ax * by + ay * bx);
        jerk = Math.max(jerk, Math.abs(2 * Math.asin(sine) - 0.02 * speed));
      }
    }
    return { furthest, turning, jerk, steady, kinds: [...kinds].sort(), bodies: simulation.shapes().size, violations: simulation.tally.violations };
  });
  assert.equal(seen.bodies, 90);
  assert.deepEqual(seen.kinds, ["ball", "capsule", "hull"]);
  // What a loop misses is counted for balls alone.
  await page.waitForFunction(() => !document.querySelector("#legend").textContent.includes("misses"));
  assert.doesNotMatch(await page.evaluate(() => document.querySelector("#numbers").innerText), /missed/);
  assert.equal(seen.violations, 0);
  assert.ok(seen.turning > 20 && seen.steady > 2000);
  assert.ok(seen.furthest < 1e-4 && seen.jerk < 1e-6, JSON.stringify(seen));
});

test("a recording of rigid bodies shows their parts, and one can be thrown", async () => {
  const made = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    const before = simulation.time;
    simulation.setVelocity(0, [5, 0, 0]);
    simulation.view.startRecording();
    simulation.run(simulation.time + 0.5);
    const files = new DataTransfer();
    files.items.add(new File([simulation.view.stopRecording()], "turning.rec"));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
    return { passed: simulation.time - before, shapes: [...simulation.shapes()],
             turned: [...simulation.orientations().values()] };
  });
  await page.waitForFunction(() => window.kinesphereViewer.simulation.title === "turning.rec");
  const shown = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    simulation.run(Infinity);
    return { shapes: [...simulation.shapes()], turned: [...simulation.orientations().values()] };
  });
  assert.deepEqual(shown.shapes, made.shapes);
  made.turned.forEach((turn, body) => turn.forEach((part, k) => assert.ok(Math.abs(part - shown.turned[body][k]) < 1e-9)));
  await page.keyboard.press("r");
});

for (const [width, height] of [[390, 844], [844, 390], [360, 640], [768, 1024], [1024, 768], [1440, 900]]) {
  test(`at ${width} x ${height} nothing is cut, and the parts of the page leave each other room`, async () => {
    page = await inBrowser.open("", { viewport: { width, height }, hasTouch: width < 1000, isMobile: width < 1000 });
    const seen = await page.evaluate(() => {
      const box = (id) => document.querySelector(id).getBoundingClientRect();
      const parts = ["#hud", "#panel", "#legend", "#transport"].map((id) => [id, box(id)]);
      const overlaps = parts.flatMap(([one, a], k) => parts.slice(0, k).filter(([, b]) =>
        a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom).map(([other]) => `${one} ${other}`));
      const outside = parts.filter(([, { left, top, right, bottom }]) =>
        left < 0 || top < 0 || right > innerWidth + 0.5 || bottom > innerHeight + 0.5).map(([id]) => id);
      const cut = Array.from(document.querySelectorAll("#hud *, #panel *, #legend *"))
        .filter((part) => part.children.length === 0 && part.clientWidth > 0 && part.scrollWidth > part.clientWidth + 1 &&
                          getComputedStyle(part).overflow !== "visible").map((part) => part.textContent);
      const small = matchMedia("(pointer: coarse)").matches ? Array.from(document.querySelectorAll("button, select"), (part) => [part, part.getBoundingClientRect()])
        .filter(([, { width, height }]) => width > 0 && Math.min(width, height) < 43.5).map(([part]) => part.textContent) : [];
      return { overlaps, outside, cut, small };
    });
    assert.deepEqual(seen, { overlaps: [], outside: [], cut: [], small: [] });
  });
}

test("back on a wide page", async () => {
  page = await inBrowser.open();
  await page.evaluate(() => window.kinesphereViewer.setPlaying(false));
});

test("drones are warned before they touch, and alarms are undone by going back", async () => {
  await page.keyboard.press("9");
  await page.keyboard.press("Space");
  const seen = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    const reported = simulation.run(20).map(({ event }) => event);
    const before = { ...simulation.tally, near: [...simulation.near].length, hash: simulation.hash };
    simulation.back(5);
    const between = { ...simulation.tally };
    simulation.run(20);
    const warned = new Set();
    let early = true;
    for (const { kind, first, second, distance } of reported) {
      if (kind === "sensor_enter" && distance === 20) warned.add(`${first} ${second}`);
      if (kind === "contact_begin" || distance === 6) early &&= warned.has(`${first} ${second}`);
    }
    return { before, between, again: { ...simulation.tally, near: [...simulation.near].length, hash: simulation.hash }, early };
  });
  assert.ok(seen.early && seen.before.warnings > 20 && seen.before.alarms > 0);
  assert.ok(seen.between.warnings < seen.before.warnings);
  assert.deepEqual(seen.again, seen.before);
  assert.equal(seen.before.violations, 0);
});

test("no ball of the game passes through another, though a loop would miss many", async () => {
  await page.keyboard.press("0");
  const { tally, hash, again, deepest } = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    let deepest = 0;
    const radius = simulation.radii()[0];
    for (let frame = 1; frame <= 60; ++frame) {
      simulation.run(simulation.time + 1 / 90);
      const positions = simulation.positions();
      for (let a = 0; a < positions.length; a += 3)
        for (let b = 0; b < a; b += 3)
          deepest = Math.max(deepest, 2 * radius -
            Math.hypot(positions[a] - positions[b], positions[a + 1] - positions[b + 1], positions[a + 2] - positions[b + 2]));
    }
    const { hash, time, tally } = simulation;
    const counts = { ...tally };
    simulation.back(0.4);
    simulation.run(time);
    return { tally: counts, hash, again: simulation.hash, deepest };
  });
  assert.ok(tally.missed > 20 && tally.violations === 0);
  assert.ok(deepest <= 1.001e-4, `${deepest}`);
  assert.equal(again, hash);
});

test("tracks that are served are shown: people come, pass each other and go", async () => {
  page = await inBrowser.open("#opened");
  await page.waitForFunction(() => window.kinesphereViewer.simulation.title === "people.txt");
  const seen = await page.evaluate(() => {
    const { simulation, setPlaying, hand } = window.kinesphereViewer;
    setPlaying(false);
    simulation.back(100);
    const counts = [simulation.bodyCount];
    const reported = [];
    for (const time of [11.5, 13.5, Infinity]) {
      reported.push(...simulation.run(time).map(({ event }) => [event.kind, event.time]));
      counts.push(simulation.bodyCount);
    }
    return { counts, reported, time: simulation.time, end: simulation.endTime, canBePushed: simulation.canBePushed };
  });
  assert.deepEqual(seen.counts, [1, 2, 1, 0]);
  assert.equal(seen.end, 14);
  assert.equal(seen.time, 14);
  assert.equal(seen.canBePushed, false);
  // The two pass at 12 s, 0.2 m aside, with 2 m/s: nearer than 0.5 m while |2 t| < sqrt(0.25 - 0.04).
  const half = Math.sqrt(0.21) / 2;
  assert.deepEqual(seen.reported.map(([kind]) => kind), ["contact_begin", "contact_end"]);
  assert.ok(Math.abs(seen.reported[0][1] - (12 - half)) < 1e-4 && Math.abs(seen.reported[1][1] - (12 + half)) < 1e-4, `${seen.reported}`);
});

test("a link leads to a moment of served tracks, and says if another file is served", async () => {
  page = await inBrowser.open("#opened&file=people.txt&t=12.5&pair=0,1");
  await page.waitForFunction(() => window.kinesphereViewer.simulation.time === 12.5);
  assert.deepEqual(await page.evaluate(() => window.kinesphereViewer.pair.ids), [0, 1]);
  assert.equal(await page.textContent("#pair-least"), "closest: 0.2 m at 12 s");
  assert.equal(await page.isHidden("#message"), true);
  page = await inBrowser.open("#opened&file=others.txt&t=12.5");
  await page.waitForSelector("#message:not([hidden])");
  assert.match(await page.textContent("#message-text"), /^The link leads to a moment of others\.txt\. Drop/);
});

test("a table that is dropped is shown, with its own name and speed", async () => {
  await page.evaluate(() => { window.kinesphereViewer.settings.speed = 0.3; });
  const rows = Array.from({ length: 20 }, (_, k) => `anna;${k / 2};${k / 2};0;1\r\nberta;${k / 2};${9 - k / 2};0.2;1`);
  await drop("two.csv", `\uFEFFID;Time;x;y;z\r\n${rows.join("\r\n")}\r\n`);
  await page.waitForFunction(() => window.kinesphereViewer.simulation.title === "two.csv");
  const { reported, speed, playing, title, bodies } = await page.evaluate(() => {
    const { simulation, settings } = window.kinesphereViewer;
    const bodies = simulation.bodyCount;
    return { reported: simulation.run(Infinity).map(({ event }) => event.kind), speed: settings.speed, playing: settings.playing,
             title: document.querySelector("#title").textContent, bodies };
  });
  assert.deepEqual([reported, speed, playing, title, bodies], [["contact_begin", "contact_end"], 1, true, "two.csv", 2]);
});

test("the page has complained of nothing, and asked nobody else", () => {
  assert.deepEqual(complaints, []);
});
