// The map of streams of the air, of the sea and of a plane: units, names, closest approaches, coast, alarm, phones.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";

import { browserForTests } from "./page.mjs";
import { coloursAt, difference, isDrawn, isNoMissingServer, namedColour, number, texts, Watch } from "./watch.mjs";

const inBrowser = browserForTests({
  viewport: { width: 1200, height: 800 },
  graphics: [],
  isReady: () => window.kinesphereMap?.scene?.tracks.size > 0 && window.kinesphereMap.pictures > 0,
});
const calmly = { reducedMotion: "reduce" };
/** Counts what the page asks the browser for and shows, before any of its code runs. */
const countedNotifications = () => {
  window.asked = 0;
  window.notifications = [];
  window.Notification = class extends EventTarget {
    static permission = "default";
    static requestPermission = async () => {
      window.asked += 1;
      return (window.Notification.permission = "granted");
    };
    constructor(title, options) {
      super();
      window.notifications.push({ title, ...options });
    }
    close() {}
  };
};

const second = 1 / 3600;
const metresPerDegree = 111_200;
/** Returns latitude and longitude of a place so many metres east and north of 53.6° N 8.2° E. */
const near = (east, north) => ({ lat: 53.6 + north / metresPerDegree, lon: 8.2 + east / metresPerDegree / Math.cos(53.6 * Math.PI / 180) });

describe("a stream of the air", () => {
  const watch = new Watch("--format", "readsb", "--separation", "cylinder:5NM:1000ft:5min", "--only", "predicted,within");
  after(() => watch.process.kill());
  let page;
  const start = 1_700_000_000;
  /** RYR1AB and DLH4TK cross after 160 s, the latter 500 ft higher and sinking; KLM35Q comes at 120 s. */
  const document = (t) => {
    const plane = (hex, flight, east, north, speed, track, alt, rate) => ({
      hex, flight, ...near(east, north), alt_baro: alt, gs: speed * 3600 / 1852, track, baro_rate: rate, rc: 186, nac_v: 2, sil: 3, seen_pos: 0,
    });
    const aircraft = [
      plane("4ca1fa", "RYR1AB  ", 250 * (t - 160), 0, 250, 90, 35_000, 0),
      plane("3c6586", "DLH4TK  ", 600, 230 * (t - 160), 230, 0, 35_500 - 10 * t, -600),
      plane("3c0002", "        ", 60_000, 40_000, 100, 270, 3420, 0),
      ...t >= 4 ? [plane("484001", "KLM35Q", -60_000, 240 * (t - 130), 240, 0, 38_000, 0), plane("484002", "TRA8", -59_000, 240 * (130 - t), 240, 180, 38_000, 0)] : [],
    ];
    return `${JSON.stringify({ now: start + t, aircraft })}\n`;
  };
  const shows = (t) => page.waitForFunction((time) => window.kinesphereMap.scene.state.time === time, start + t);

  before(async () => {
    for (let t = 0; t <= 3; ++t) watch.write(document(t));
    page = await inBrowser.open(await watch.address, { ...calmly, prepare: countedNotifications });
    await page.waitForFunction(() => window.kinesphereMap.scene.pairs.length > 0 && window.kinesphereMap.coastSize > 0);
    await isDrawn(page);
  });

  test("has callsigns, flight levels, feet, knots and nautical miles, or metric units", async () => {
    const state = await page.evaluate(() => window.kinesphereMap.scene.state);
    assert.deepEqual(state.tracks.map(({ id, name }) => [id, name]).sort(), [["3c0002", null], ["3c6586", "DLH4TK"], ["4ca1fa", "RYR1AB"]]);
    await page.fill("#find-text", "ryr1");
    await page.keyboard.press("Enter");
    assert.equal(await page.textContent("#details-title"), "RYR1AB");
    const details = await page.textContent("#details-rows");
    assert.match(details, /4ca1fa/);
    assert.match(details, /E, FL350/);
    assert.match(details, /within \d{3} m of there, \d{3} ft in height/);
    assert.match(details, /48[56] kt to 090°/);
    await page.fill("#find-text", "3c0002");
    await page.keyboard.press("Enter");
    assert.equal(await page.textContent("#details-title"), "3c0002");
    assert.match(await page.textContent("#details-rows"), /E, 3,400 ft/);
    await page.keyboard.press("Escape");
    assert.match(await page.textContent("#scale-text"), /^\d+ NM$/);
    await page.keyboard.press("u");
    assert.match(await page.textContent("#details-rows"), /E, 1,042 m.*100 m\/s/s);
    assert.match(await page.textContent("#scale-text"), /^\d+ km$/);
    await page.reload();
    await page.waitForFunction(() => window.kinesphereMap.scene?.tracks.size > 0);
    assert.match(await page.textContent("#scale-text"), /^\d+ km$/, "the browser keeps it");
    await page.keyboard.press("u");
  });

  test("a predicted pair has distance, vertical distance and time of its closest approach", async () => {
    assert.equal(await number(page, "predicted"), "1");
    const [pair] = await texts(page, "#pairs li");
    assert.match(pair, /^DLH4TK–RYR1ABpredictedCPA \d{3} m ± \d+( m)?, [+]11 · in 2 min 3\d s/);
    // RYR1AB is 500 ft lower than DLH4TK, which sinks by 600 ft/min.
    assert.match(pair, /now 28[.]\d to 2\d[.]\d NM · −05↑/);
  });

  test("both ways and places are drawn", async () => {
    await page.click("#pairs li button");
    await isDrawn(page);
    const { ends, middle, ways } = await page.evaluate(() => {
      const { scene: { pairs: [{ places, approach }] }, view } = window.kinesphereMap;
      const screen = ({ x, y }) => view.toScreen(x, y);
      const [a, b] = approach.places.map(screen);
      const between = (p, q, part) => [p[0] + (q[0] - p[0]) * part, p[1] + (q[1] - p[1]) * part];
      return {
        ends: [a, b], middle: between(a, b, 0.5),
        ways: [0, 1].map((k) => Array.from({ length: 80 }, (_, step) => between(screen(places[k]), screen(approach.places[k]), 0.3 + step / 160))),
      };
    });
    const colour = await namedColour(page, "predicted");
    const isColoured = (found) => difference(found, colour) < 60;
    for (const way of ways) assert.ok((await coloursAt(page, way)).filter(isColoured).length > 10, "a dotted way");
    for (const [x, y] of ends) {
      const around = Array.from({ length: 25 }, (_, k) => [x - 6 + (k % 5) * 3, y - 6 + Math.floor(k / 5) * 3]);
      assert.ok((await coloursAt(page, around)).some(isColoured), "a place");
    }
    const square = Array.from({ length: 25 }, (_, k) => [middle[0] - 2 + k % 5, middle[1] - 2 + Math.floor(k / 5)]);
    assert.ok((await coloursAt(page, square)).some(isColoured), "the line between");
  });

  test("the coast is there: sea off Wangerooge, land at Bremen", async () => {
    await page.evaluate(() => window.kinesphereMap.view.zoom(0.4));
    await page.keyboard.press("-");
    await isDrawn(page);
    const places = await page.evaluate(() => [[7.57, 54.07], [9.27, 53.07], [8.57, 52.87]].map(([lon, lat]) => {
      const { plane, view } = window.kinesphereMap;
      return view.toScreen(...plane.toPlane(lon, lat));
    }));
    const [sea, ...land] = await coloursAt(page, places);
    assert.ok(difference(sea, await namedColour(page, "ground")) <= 2, `${sea}`);
    for (const colour of land) assert.ok(difference(colour, await namedColour(page, "land")) <= 2, `${colour}`);
  });

  test("the coast is right also where the opposite point of the earth is land", async () => {
    // China is opposite to Argentina, and its coast turns the other way round on the plane.
    const [land, sea] = await page.evaluate(async () => {
      const map = window.kinesphereMap;
      const own = map.scene.state;
      map.show({ ...own, origin: { lon: -62, lat: -34, radius: 5e5 }, tracks: [], pairs: [], predictions: [], needed: [] });
      map.view.look = { x: 0, y: 0, scale: 1e-4 };
      map.redraw();
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      const canvas = document.querySelector("#picture");
      const found = [[-61.3, -33.1], [-47.3, -41.3]].map(([lon, lat]) => {
        const [x, y] = map.view.toScreen(...map.plane.toPlane(lon, lat));
        return [...canvas.getContext("2d").getImageData(Math.round(x), Math.round(y), 1, 1).data.slice(0, 3)];
      });
      map.show(own);
      return found;
    });
    assert.ok(difference(land, await namedColour(page, "land")) <= 2, `land: ${land}`);
    assert.ok(difference(sea, await namedColour(page, "ground")) <= 2, `sea: ${sea}`);
  });

  test("nothing sounds and nobody is asked, but after a click", async () => {
    const said = () => page.evaluate(() => ({ asked: window.asked, sounded: window.kinesphereMap.alarm.sounded, shown: window.notifications.length }));
    assert.deepEqual(await said(), { asked: 0, sounded: 0, shown: 0 });
    assert.equal(await page.getAttribute("#alarm", "aria-pressed"), "false");
    await page.click("#alarm");
    await page.waitForFunction(() => document.querySelector("#alarm").title.includes("notifications"));
    assert.deepEqual(await said(), { asked: 1, sounded: 1, shown: 0 }, "the pair was there before");
    for (let t = 4; t <= 8; ++t) watch.write(document(t));
    await shows(8);
    await page.waitForFunction(() => window.notifications.length > 0);
    const [{ title, body }, ...others] = await page.evaluate(() => window.notifications);
    assert.deepEqual(others, []);
    assert.equal(title, "Predicted: KLM35Q – TRA8");
    assert.match(body, /CPA (9|10)\d\d m ± \d+, 00/);
    assert.equal((await said()).sounded, 2);
    await page.reload();
    await page.waitForFunction(() => window.kinesphereMap.scene?.tracks.size > 0);
    assert.equal(await page.getAttribute("#alarm", "aria-pressed"), "true", "the browser keeps it");
    assert.deepEqual(await said(), { asked: 0, sounded: 0, shown: 0 });
    await page.keyboard.press("a");
    assert.equal(await page.getAttribute("#alarm", "aria-pressed"), "false");
  });

  test("closest approaches are sorted by time or distance, for all or for one track", async () => {
    const names = async () => (await texts(page, "#pairs .ids")).map((text) => text.replace("predicted", ""));
    assert.deepEqual(await names(), ["KLM35Q–TRA8", "DLH4TK–RYR1AB"]);
    await page.click("#order-distance");
    assert.deepEqual(await names(), ["DLH4TK–RYR1AB", "KLM35Q–TRA8"]);
    await page.fill("#find-text", "TRA8");
    await page.keyboard.press("Enter");
    await page.click("#only");
    assert.deepEqual(await names(), ["KLM35Q–TRA8"]);
    await page.keyboard.press("p");
    assert.match(await page.evaluate(() => window.kinesphereMap.chosen.pair), /484001/);
    await page.click("#only");
    assert.equal((await names()).length, 2);
    await page.click("#order-time");
    assert.deepEqual(inBrowser.complaints, []);
  });
});

describe("a stream of the sea", () => {
  const watch = new Watch("--format", "ais", "--separation", "sphere:0.5NM:12min", "--own", "211234560");
  after(() => watch.process.kill());
  const hostile = "<img src=x onerror=window.wasRun=1>";
  let page;
  before(async () => {
    watch.write("MMSI,BaseDateTime,LAT,LON,SOG,COG,Heading,VesselName\n");
    for (let t = 0; t < 30; t += 5) {
      const ship = (mmsi, name, east, north, knots, course) => {
        const { lat, lon } = near(east + knots * 1852 * second * t * Math.sin(course * Math.PI / 180), north + knots * 1852 * second * t * Math.cos(course * Math.PI / 180));
        watch.write(`${mmsi},2026-03-01T12:00:${String(t).padStart(2, "0")},${lat.toFixed(6)},${lon.toFixed(6)},${knots},${course},511,${name}\n`);
      };
      ship(211234560, "SEUTE DEERN", -4000, 500, 12, 90);
      ship(219001234, "MAERSK EINDHOVEN", 4000, 0, 12, 270);
      ship(244660000, hostile, -3000, 700, 10, 200);
      ship(257000001, "", 9000, 9000, 5, 0);
    }
    page = await inBrowser.open(await watch.address, { ...calmly, viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    await page.waitForFunction(() => window.kinesphereMap.scene.pairs.length > 0);
  });

  test("has ships' names, nautical miles and the own ship", async () => {
    assert.equal(await page.evaluate(() => window.kinesphereMap.scene.state.own), "211234560");
    const pairs = await texts(page, "#pairs li");
    assert.ok(pairs.some((text) => /^SEUTE DEERN–MAERSK EINDHOVENpredictedCPA 0[.]2\d NM ± [\d.]+( m)? · in \d+ min.*now 4[.]\d\d to 4[.]\d\d NM/s.test(text)), pairs.join("; "));
    assert.equal(await page.textContent("#only"), "only SEUTE DEERN");
    await page.fill("#find-text", "seute");
    await page.keyboard.press("Enter");
    assert.match(await page.textContent("#details-rows"), /12[.]0 kt to 090°/);
    await page.click("#details-close");
  });

  test("a name is nothing but text", async () => {
    await page.fill("#find-text", "onerror");
    await page.keyboard.press("Enter");
    assert.equal(await page.textContent("#details-title"), hostile);
    assert.ok((await texts(page, "#pairs .ids")).some((text) => text.includes(hostile)));
    assert.equal(await page.evaluate(() => document.images.length), 0);
    assert.equal(await page.evaluate(() => window.wasRun), undefined);
  });

  for (const [way, size] of [["upright", { width: 390, height: 844 }], ["sideways", { width: 844, height: 390 }]]) {
    test(`a phone ${way} has room for fingers, and all in sight`, async () => {
      await page.setViewportSize(size);
      await isDrawn(page);
      const small = await page.evaluate(() => [...document.querySelectorAll("button, input, select")].map((each) => [each, each.getBoundingClientRect()])
        .filter(([, { width, height }]) => width > 0 && (width < 43.5 || height < 43.5)).map(([{ id, textContent }, { width, height }]) => `${id} ${textContent} ${width} x ${height}`));
      assert.deepEqual(small, []);
      const { scroll, transport, lists, hud } = await page.evaluate(() => ({
        scroll: document.documentElement.scrollWidth,
        ...Object.fromEntries(["transport", "lists", "hud"].map((id) => [id, document.querySelector(`#${id}`).getBoundingClientRect().toJSON()])),
      }));
      assert.equal(scroll, size.width);
      const isApart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
      assert.ok(isApart(transport, lists) && isApart(transport, hud) && isApart(lists, hud));
      assert.ok(transport.left >= 0 && transport.right <= size.width && transport.bottom <= size.height);
    });
  }

  test("settings can be touched", async () => {
    await page.tap("#settings-open");
    await page.check("#set-needs");
    await page.selectOption("#set-units", "metric");
    await page.tap("#settings form button");
    assert.equal(await page.isVisible("#needs-section"), true);
    assert.match((await texts(page, "#pairs li")).join("; "), /CPA [45]\d\d m/);
    assert.deepEqual(inBrowser.complaints, []);
  });
});

describe("a stream with x, y and z", () => {
  const watch = new Watch("--separation", "sphere:15:40s", "--acceleration", "0.5", "--largest-speed", "12", "--position-error", "1", "--velocity-error", "0.2");
  after(() => watch.process.kill());

  test("has its own unit, no coast, and names if they are given", async () => {
    for (let t = 0; t < 5; ++t)
      watch.report({ id: "1", name: "Anna", stamp: t, position: [-100 + 4 * t, 0, 20], velocity: [4, 0, 0] },
                   { id: "2", stamp: t, position: [100 - 4 * t, 8, 24 + 0.2 * t], velocity: [-4, 0, 0.2] });
    const page = await inBrowser.open(await watch.address, calmly);
    await page.waitForFunction(() => window.kinesphereMap.scene.pairs.length > 0);
    assert.match((await texts(page, "#pairs li"))[0], /^Anna–2predictedCPA \d([.]\d+)? ± \d([.]\d+)?, [+](9|8[.]9\d?) · in 2\d s.*now 1\d\d to 1\d\d · [+]4[.]\d+ ↑/s);
    assert.match(await page.textContent("#scale-text"), /^\d+$/);
    await page.keyboard.press("u");
    assert.match(await page.textContent("#scale-text"), /^\d+$/, "nothing says that it is metres");
    assert.equal(await page.evaluate(() => window.kinesphereMap.coastSize), 0);
    assert.equal(await watch.end(), 0);
    assert.deepEqual(inBrowser.complaints.filter(isNoMissingServer), []);
  });
});
