// The map of `kinesphere watch --serve` in use: the program, KINESPHERE_PROGRAM, reads a stream that stays open, and
// serves the page of KINESPHERE_VIEWER. KINESPHERE_PICTURE=FILE.png makes the picture of the map in docs/watch.md.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";

import { browserForTests, seriousFlaws } from "./page.mjs";
import { at, coloursAt, difference, isDrawn, isNoMissingServer, namedColour, number, texts, Watch } from "./watch.mjs";

const inBrowser = browserForTests({
  viewport: { width: 1200, height: 800 },
  graphics: [],
  isReady: () => window.kinesphereMap?.scene?.tracks.size > 0 && window.kinesphereMap.pictures > 0,
});
const { complaints } = inBrowser;

const hostile = `<img src=x onerror="window.wasRun = true">\u202e&amp;`;
/** The hostile id is shown as one name in one line. */
const shownHostile = `<img src=x onerror="window.wasRun = true">\ufffd&amp;`;

/** Returns the part of the line between two tracks, or of a piece in its middle, that has a colour. */
async function shareOfLine(page, first, second, name, part = 0.5) {
  await isDrawn(page);
  const ends = await page.evaluate((ids) => ids.map((id) => {
    const [place] = window.kinesphereMap.scene.tracks.get(id).track.places;
    return window.kinesphereMap.view.toScreen(place.x, place.y);
  }), [first, second]);
  const places = Array.from({ length: 60 }, (_, k) => [0, 1].map((axis) => ends[0][axis] + (ends[1][axis] - ends[0][axis]) * (0.5 + (k / 60 - 0.5) * part)));
  const colour = await namedColour(page, name);
  return (await coloursAt(page, places)).filter((found) => difference(found, colour) < 40).length / places.length;
}

const calmly = { reducedMotion: "reduce" };

describe("a stream with x and y", () => {
  const watch = new Watch("--dimensions", "2", "--separation", "sphere:30", "--acceleration", "1", "--position-error", "0.5",
                          "--velocity-error", "0.1", "--silence", "5");
  let page;
  before(async () => {
    watch.report(at("quiet", 0, 300, 100), at("far", 0, 0, -200), at("far", 6, 0, -200));
    watch.report(at(hostile, 6, 0, 100), at("near", 6, 20, 100));
    // The two are 34 apart, which is not certain to be more than 30 after two seconds without a report.
    watch.report(at("west", 6, -100, 0), at("east", 6, -66, 0));
    watch.report(at("split", 7, -200, 0), at("split", 7.5, -200, 90), at("far", 8, 0, -200));
    page = await inBrowser.open(await watch.address, calmly);
    await page.waitForFunction(() => window.kinesphereMap.scene.state.time === 8);
  });
  after(() => watch.process.kill());

  test("its numbers are those of the watch", async () => {
    assert.equal(await number(page, "time"), "8.0 s");
    assert.equal(await number(page, "tracks"), "7");
    assert.match(await page.textContent('#numbers [data-name="tracks"]'), /1 stale/);
    assert.equal(await number(page, "within"), "1");
    assert.equal(await number(page, "undecided"), "1");
    assert.equal(await number(page, "reports"), "10");
    assert.equal(await page.textContent("#about"), "standard input");
  });

  test("pairs are reported in words, and needs on request", async () => {
    const [within, undecided, ...others] = await texts(page, "#pairs li");
    assert.deepEqual(others, []);
    assert.match(within, /within.*now 1\d[.]?\d* to 2\d.*sphere:30/s);
    assert.match(within, /certain for/);
    assert.match(undecided, /^east–west.*undecided/s);
    assert.doesNotMatch(undecided, /ask/);
    assert.equal(await page.isHidden("#needs-section") && await page.isHidden('#numbers [data-name="needed"]'), true);
    await page.keyboard.press("r");
    assert.match((await texts(page, "#pairs li"))[1], /ask (east|west) now/);
    const needs = await texts(page, "#needs li");
    assert.ok(needs.some((text) => /^(east|west)now/.test(text)), needs.join("; "));
    assert.equal(await number(page, "needed"), String(needs.length));
  });

  test("a pair that is clicked is gone to, and drawn in the colour of its verdict", async () => {
    await page.click("#pairs li:nth-child(2) button");
    assert.equal(await page.getAttribute("#pairs li:nth-child(2) button", "aria-pressed"), "true");
    assert.ok(await shareOfLine(page, "west", "east", "undecided") > 0.4);
    await page.keyboard.press("p");
    assert.ok(await shareOfLine(page, hostile, "near", "within") > 0.9);
    assert.ok(await shareOfLine(page, hostile, "near", "undecided") < 0.1);
  });

  test("who is needed has corners", async () => {
    await page.keyboard.press("f");
    await isDrawn(page);
    const places = await page.evaluate(() => [...window.kinesphereMap.scene.tracks.values()].filter(({ need }) => need !== null)
      .map(({ track }) => window.kinesphereMap.view.toScreen(track.places[0].x, track.places[0].y)).map(([x, y]) => [x + 9, y + 7]));
    assert.ok(places.length > 0);
    const need = await namedColour(page, "need");
    for (const colour of await coloursAt(page, places)) assert.ok(difference(colour, need) < 60, `${colour}`);
    await page.keyboard.press("r");
    await isDrawn(page);
    for (const colour of await coloursAt(page, places)) assert.ok(difference(colour, need) >= 60, `${colour}`);
  });

  test("an id is nothing but text", async () => {
    assert.ok((await texts(page, "#pairs .ids")).some((text) => text.includes(shownHostile)));
    await page.fill("#find-text", "onerror");
    await page.keyboard.press("Enter");
    assert.equal(await page.textContent("#details-title"), shownHostile);
    assert.equal(await page.evaluate(() => document.images.length), 0);
    assert.equal(await page.evaluate(() => window.wasRun), undefined);
  });

  test("a track that is clicked, or found by the keyboard, tells all about itself", async () => {
    await page.keyboard.press("Escape");
    await page.keyboard.press("f");
    await isDrawn(page);
    const [x, y] = await page.evaluate(() => {
      const [place] = window.kinesphereMap.scene.tracks.get("quiet").track.places;
      return window.kinesphereMap.view.toScreen(place.x, place.y);
    });
    await page.mouse.click(x, y);
    assert.equal(await page.textContent("#details-title"), "quiet");
    assert.match(await page.textContent("#details-rows"), /8\.0 s ago, stale/);
    await page.keyboard.press("/");
    await page.keyboard.type("spl");
    await page.keyboard.press("Enter");
    assert.equal(await page.textContent("#details-title"), "split");
    assert.match(await page.textContent("#details-rows"), /in one of 2 places/);
    await page.keyboard.press("Escape");
    await page.keyboard.press("Escape");
    assert.equal(await page.isHidden("#details"), true);
  });

  test("keys move the map, and another theme paints it anew", async () => {
    const look = () => page.evaluate(() => ({ ...window.kinesphereMap.view.look }));
    const first = await look();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("+");
    const second = await look();
    assert.ok(second.x > first.x && second.scale > first.scale);
    assert.equal(await page.getAttribute("#fit", "aria-pressed"), "false");
    const ground = await namedColour(page, "ground");
    await page.keyboard.press("t");
    await isDrawn(page);
    assert.notDeepEqual(await namedColour(page, "ground"), ground);
    const [corner] = await coloursAt(page, [[600, 3]]);
    assert.ok(difference(corner, await namedColour(page, "ground")) < 30, `${corner}`);
    await page.keyboard.press("t");
  });

  test("it follows the stream", async () => {
    watch.report(at("west", 9, -140, 0), at("east", 9, -66, 0), at("far", 10, 0, -200));
    await page.waitForFunction(() => window.kinesphereMap.scene.state.time === 10);
    assert.equal(await number(page, "time"), "10.0 s");
  });

  test("nothing was complained of, and the end of the stream is reported", async () => {
    assert.deepEqual(complaints, []);
    assert.equal(await page.isHidden("#lost"), true);
    assert.equal(await watch.end(), 0);
    await page.waitForSelector("#lost:not([hidden])");
    assert.match(await page.textContent("#lost"), /^The stream has ended, or the watch cannot be reached, since \d\d:\d\d:\d\d\. What is shown is its state at 10\.0 s/);
    assert.deepEqual(complaints.filter(isNoMissingServer), []);
    complaints.length = 0;
  });
});

describe("a chosen pair", () => {
  const watch = new Watch("--dimensions", "2", "--separation", "sphere:30:60s", "--acceleration", "0.1", "--position-error", "1",
                          "--velocity-error", "0.1");
  after(() => watch.process.kill());
  let page;
  /** Two that pass each other at 20, nearest at 10 s. */
  const pass = (stamp) => watch.report(at("one & only", stamp, 10 * stamp, 0, [10, 0, 0]), at("other", stamp, 200 - 10 * stamp, 20, [-10, 0, 0]));
  const sees = (stamp) => page.waitForFunction((stamp) => window.kinesphereMap.scene?.state.time === stamp, stamp);

  test("has its distance over time, within what is certain, and what is expected", async () => {
    pass(0);
    pass(1);
    page = await inBrowser.open(await watch.address, calmly);
    await sees(1);
    await page.keyboard.press("p");
    assert.match(await page.textContent("#details-title"), /one & only – other|other – one & only/);
    for (const stamp of [2, 4, 5]) {
      pass(stamp);
      await sees(stamp);
    }
    const rows = await texts(page, "#details-rows dt, #details-rows dd");
    assert.equal(rows[0], "now");
    const [, distance, lower, upper] = /^([\d.]+), certainly ([\d.]+) to ([\d.]+)$/.exec(rows[1]).map(Number);
    assert.ok(lower < distance && distance < upper && Math.abs(distance - Math.hypot(100, 20)) < 1, rows[1]);
    assert.deepEqual(rows.slice(2), ["closest so far", "102 at 5.0 s", "expected", rows[5]]);
    assert.match(rows[5], /^CPA 20 ± .* · in 5.0 s$/);
    const seen = await page.evaluate(() => {
      const { width, height } = document.querySelector("#details-chart");
      const { data } = document.querySelector("#details-chart").getContext("2d").getImageData(0, 0, width, height);
      return { inked: data.filter((value, k) => k % 4 === 3 && value > 0).length / (width * height), label: document.querySelector("#details-chart").getAttribute("aria-label") };
    });
    assert.ok(seen.inked > 0.01, `${seen.inked}`);
    for (const theme of ["dark", "bright"]) {
      await page.evaluate((theme) => void (document.documentElement.dataset.theme = theme), theme);
      assert.deepEqual(await seriousFlaws(page), [], theme);
    }
    assert.match(seen.label, /^Distance of .* over time; now 10\d, certainly .*; closest so far 102 at 5\.0 s; expected CPA/);
  });

  test("stands in the address, which leads to it, also before it is one", async () => {
    const address = page.url();
    assert.match(address, /#pair=one\+%26\+only&pair=other&level=0$/);
    page = await inBrowser.open(address, calmly);
    await page.waitForFunction(() => window.kinesphereMap.chosen.pair === '["one & only","other",0]');
    page = await inBrowser.open(address.replace("other", "third"), calmly);
    await sees(5);
    assert.deepEqual(await page.evaluate(() => ({ ...window.kinesphereMap.chosen })), { track: null, pair: null, hovered: null });
    pass(6);
    watch.report(at("third", 7, 170, 0, [-10, 0, 0]), at("far", 8, 5000, 0));
    await page.waitForFunction(() => window.kinesphereMap.chosen.pair === '["one & only","third",0]');
    assert.equal(await page.isVisible("#details-chart"), true);
    await page.keyboard.press("Escape");
    assert.doesNotMatch(page.url(), /#/);
    assert.equal(await page.isVisible("#details"), false);
    await page.evaluate(() => { location.hash = "track=other"; });
    await page.waitForFunction(() => window.kinesphereMap.chosen.track === "other");
    assert.equal(await page.isVisible("#details-chart"), false);
    for (const wrong of ["pair=one", "pair=a&pair=b&level=x", "nothing", "track=nobody"]) {
      await page.evaluate((wrong) => { location.hash = wrong; }, wrong);
      await isDrawn(page);
      assert.equal(await page.evaluate(() => window.kinesphereMap.chosen.track), "other", wrong);
    }
    assert.equal(await watch.end(), 0);
    assert.deepEqual(complaints.filter(isNoMissingServer), []);
  });
});

describe("a stream with longitudes and latitudes", () => {
  const watch = new Watch("--separation", "cylinder:5NM:1000ft", "--origin", "60,10", "--radius", "500km", "--acceleration", "6",
                          "--largest-speed", "300", "--position-error", "50", "--velocity-error", "10");
  after(() => watch.process.kill());

  test("its places lie where the map's own graticule has them", async () => {
    for (const [id, lon, lat] of [["middle", 10, 60], ["north-east", 12, 61.5], ["west", 3, 59.5], ["south", 10.5, 56]])
      watch.report({ id, stamp: 1, lon, lat, alt: 1000 });
    const page = await inBrowser.open(await watch.address, calmly);
    await page.waitForFunction(() => window.kinesphereMap.scene.tracks.size === 4);
    const errors = await page.evaluate(() => {
      const { scene, plane } = window.kinesphereMap;
      return [...scene.tracks.values()].map(({ track: { places: [place] } }) => {
        const [x, y] = plane.toPlane(place.lon, place.lat);
        const [lon, lat] = plane.toEarth(place.x, place.y);
        return { metres: Math.hypot(x - place.x, y - place.y), degrees: Math.hypot(lon - place.lon, lat - place.lat) };
      });
    });
    for (const { metres, degrees } of errors) assert.ok(metres < 20 && degrees < 1e-3, JSON.stringify(errors));
    await isDrawn(page);
    assert.match(await page.textContent("#scale-text"), /^\d+ NM$/);
    assert.match(await page.textContent("#pairs-more"), /certainly apart/);
    await page.fill("#find-text", "north-east");
    await page.keyboard.press("Enter");
    assert.match(await page.textContent("#details-rows"), /61°30′00\.0″N 12°00′00\.0″E, 3,300 ft/);
  });

  test("its colours differ for the colour-blind, and from the ground", async () => {
    const page = inBrowser.page;
    for (const theme of ["dark", "bright"]) {
      await page.evaluate((theme) => void (document.documentElement.dataset.theme = theme), theme);
      const named = {};
      for (const name of ["ground", "land", "undecided", "predicted", "within", "need", "track", "stale"]) named[name] = await namedColour(page, name);
      for (const [name, colour] of Object.entries(named))
        if (name !== "ground" && name !== "land")
          for (const below of ["ground", "land"]) assert.ok(contrast(colour, named[below]) >= 3, `${theme}: ${name} on the ${below}`);
      for (const [sight, matrix] of Object.entries(sights)) {
        const seen = ["undecided", "within", "need", "predicted"].map((name) => lab(matrix, named[name]));
        for (const [a, b] of [[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [2, 3]])
          assert.ok(Math.hypot(...seen[a].map((value, k) => value - seen[b][k])) > 25, `${theme}, ${sight}: ${a} and ${b}`);
      }
    }
    assert.equal(await watch.end(), 0);
    assert.deepEqual(complaints.filter(isNoMissingServer), []);
  });
});

describe("a watch that is started again", () => {
  const options = ["--dimensions", "2", "--separation", "sphere:30", "--acceleration", "1", "--position-error", "0.5", "--velocity-error", "0.1"];
  const first = new Watch(...options);
  let second;
  after(() => [first, second].forEach((watch) => watch?.process.kill()));

  test("lines are seen whose ends are not, and another stream is shown from its begin", async () => {
    first.report(at("a", 100, 0, 0), at("b", 100, 20, 0), at("far", 101, 5000, 0));
    const address = await first.address;
    const page = await inBrowser.open(address, calmly);
    await page.waitForFunction(() => window.kinesphereMap.scene.state.time === 101);
    await page.keyboard.press("p");
    await page.evaluate(() => window.kinesphereMap.view.zoom(50));
    await page.evaluate(() => window.kinesphereMap.redraw());
    assert.ok(await shareOfLine(page, "a", "b", "within", 1e-3) > 0.9);
    assert.equal(await first.end(), 0);
    await page.waitForSelector("#lost:not([hidden])");
    second = new Watch(...options, "--serve", new URL(address).port);
    second.report(at("c", 1, 70_000, 70_000), at("d", 2, 70_500, 70_000), at("c", 3, 70_000, 70_000));
    await page.waitForFunction(() => window.kinesphereMap.scene.tracks.has("d"), null, { timeout: 20_000 });
    assert.equal(await page.isHidden("#lost"), true);
    assert.deepEqual(await page.evaluate(() => ({ ...window.kinesphereMap.chosen })), { track: null, pair: null, hovered: null });
    assert.equal(await page.getAttribute("#fit", "aria-pressed"), "true");
    const [x, y] = await page.evaluate(() => window.kinesphereMap.view.toScreen(70_250, 70_000));
    assert.ok(x > 300 && x < 900 && y > 0 && y < 800, `${x}, ${y}`);
    assert.equal(await second.end(), 0);
    assert.deepEqual(complaints.filter(isNoMissingServer), []);
  });
});

describe("a crowd", () => {
  const watch = new Watch("--dimensions", "2", "--separation", "sphere:30:60s", "--acceleration", "0.1", "--position-error", "10",
                          "--velocity-error", "0.1");
  after(() => watch.process.kill());

  test("no text covers another one, and important names find room", async () => {
    const crowd = (stamp) => Array.from({ length: 24 }, (_, k) => {
      const angle = 2 * Math.PI * k / 24;
      const way = 100 - 2 * stamp + 3 * (k % 4);
      return at(`vessel number ${k}`, stamp, way * Math.cos(angle), way * Math.sin(angle), [-2 * Math.cos(angle), -2 * Math.sin(angle), 0]);
    });
    watch.report(...crowd(0), ...crowd(5), ...crowd(10));
    const page = await inBrowser.open(await watch.address, calmly);
    await page.waitForFunction(() => window.kinesphereMap.scene.tracks.size === 24 && window.kinesphereMap.scene.state.predictions.length > 20);
    await page.click("#pairs li button");
    await isDrawn(page);
    const { labels, chosen } = await page.evaluate(() => {
      const { labels, scene, chosen } = window.kinesphereMap;
      return { labels: [...labels], chosen: scene.pairs.find(({ key }) => key === chosen.pair).ids };
    });
    assert.ok(labels.filter(({ text }) => /^CPA/.test(text)).length > 0 && labels.length > 12, JSON.stringify(labels));
    for (const id of chosen) assert.ok(labels.some(({ text }) => text === id), `${id} of the chosen pair has its name`);
    for (const [k, a] of labels.entries())
      for (const b of labels.slice(k + 1))
        assert.ok(a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y, JSON.stringify([a, b]));
    // Each place is known to ten.
    for (const { text } of labels.filter(({ text }) => /^CPA/.test(text))) assert.match(text, /^CPA [\d.]+ ± 2\d([.]\d)? · /);
  });

  for (const [width, height] of [[390, 844], [375, 667]])
    test(`on a phone of ${width} by ${height} the map has half of the screen, and nothing shines through its lists`, async () => {
      const { page } = inBrowser;
      await page.setViewportSize({ width, height });
      await isDrawn(page);
      for (const theme of ["dark", "bright"]) {
        const [hud, lists, background] = await page.evaluate((theme) => {
          document.documentElement.dataset.theme = theme;
          const box = (id) => document.querySelector(id).getBoundingClientRect();
          return [box("#hud").bottom, box("#lists").top, getComputedStyle(document.querySelector("#lists")).backgroundColor];
        }, theme);
        assert.ok(lists - hud >= 0.5 * height, `${theme}: ${lists - hud} of ${height}`);
        assert.match(background, /^rgb\(/, "opaque");
      }
      const covered = await page.evaluate(() => window.kinesphereMap.labels.filter(({ x, width }) => x < 0 || x + width > innerWidth));
      assert.deepEqual(covered, []);
    });

  test("nothing was complained of", async () => {
    assert.equal(await watch.end(), 0);
    assert.deepEqual(complaints.filter(isNoMissingServer), []);
  });
});

/** Transforms of linear red, green and blue for kinds of colour vision (Machado, Oliveira and Fernandes 2009). */
const sights = {
  usual: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
  tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
};
const linear = (colour) => colour.map((value) => value / 255).map((value) => value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
const product = (matrix, vector) => matrix.map((row) => row.reduce((sum, value, k) => sum + value * vector[k], 0));
const toXyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];

function contrast(a, b) {
  const [one, other] = [a, b].map((colour) => product(toXyz, linear(colour))[1] + 0.05);
  return Math.max(one, other) / Math.min(one, other);
}

function lab(matrix, colour) {
  const seen = product(matrix, linear(colour)).map((value) => Math.max(0, Math.min(1, value)));
  const [x, y, z] = product(toXyz, seen).map((value, k) => Math.cbrt(value / [0.9505, 1, 1.089][k]));
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

describe("the picture of docs/watch.md: two ships off the mouth of the Elbe are predicted to pass within a quarter of a mile", {
  skip: process.env.KINESPHERE_PICTURE === undefined && "KINESPHERE_PICTURE names no file",
}, () => {
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

  test("is made", async () => {
    const watch = new Watch("--format", "ais", "--separation", "sphere:0.5NM:30min");
    after(() => watch.process.kill());
    watch.write("MMSI,BaseDateTime,LAT,LON,SOG,COG,Heading,VesselName\n");
    for (let seconds = 0; seconds < 60; seconds += 10) watch.write(rows(seconds));
    const viewport = { width: 1200, height: 700 };
    const page = await inBrowser.open(await watch.address, { reducedMotion: "reduce", colorScheme: "light", viewport });
    await page.waitForFunction(() => window.kinesphereMap.scene.pairs.length > 0 && window.kinesphereMap.coastSize > 0);
    await isDrawn(page);
    await page.screenshot({ path: process.env.KINESPHERE_PICTURE });
  });
});
