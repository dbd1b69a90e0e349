// The package in the form of `npm pack`, installed into an empty folder without a network.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { inFolder, packageFolder } from "./package_under_test.mjs";

const program = `
import { load, RandomForces, World } from "kinesphere";
await load();
const positions = Float64Array.from({ length: 300 }, (_, k) => (k * 37) % 100);
const motion = new RandomForces({ positions }, { accelerationLimits: 20 });
const world = new World({ box: { lower: [0, 0, 0], upper: [100, 100, 100] } });
world.addMotion(motion, 2);
let contacts = 0;
for (const event of world.run(10, { motion, respond: { restitution: 1 } }))
  if (event.kind === "contact_begin") ++contacts;
console.log(contacts > 0 && world.time === 10 ? "it works" : "it does not");
`;

const typed = `
import { BodyMap, type Event, load, Monitor, type Separation, type TrackReport, type Verdict, World } from "kinesphere";
await load({ simd: false });
const world: World = new World({ dimensions: 2 });
const id: number = world.add({ position: [0, 0, 0], velocity: new Float32Array(3) });
const first: Event | null = world.advance(1, (ids: Float64Array, time: number, states: Float64Array) => {
  states.fill(time * ids.length);
});
if (first?.kind === "contact_begin" && first.second !== null) world.remove(first.second);
// @ts-expect-error: a kind that is none
if (first?.kind === "collision") world.remove(id);
const level: Separation = { cylinder: { horizontal: 5, vertical: 1, lookAhead: 60 } };
const monitor = new Monitor({ classes: [{ accelerationLimit: 1 }], separations: [{ levels: [level] }] });
const report: TrackReport = { timestamp: 0, position: [0, 0, 0], velocity: new Float32Array(3), positionError: { horizontal: 1, vertical: 2 } };
monitor.report(7, report);
monitor.reportAll({ ids: [8], timestamps: 0, positions: new Float64Array(3), velocities: [0, 0, 0], positionErrors: { horizontal: [1], vertical: 2 } });
const verdict: Verdict | null = monitor.advance(1, (tracks, time) => Array.from(tracks, () => ({ ...report, timestamp: time })))?.verdict ?? null;
const sum: number = monitor.answer(7, 8).closestDistance + (new BodyMap().find(id)?.number ?? 0);
// @ts-expect-error: a verdict that is none
if (verdict === "near") console.log(sum);
// @ts-expect-error: a key that is none
monitor.report(7, { ...report, postion: [0, 0, 0] });
// @ts-expect-error: a shape that is none
const wrong: Separation = { ball: { distance: 5 } };
`;

test("npm install of the packed file, followed by a ten-line program, works offline", () => {
  inFolder((folder) => {
    const npm = (...options) =>
      execFileSync("npm", [...options, "--offline", "--no-audit", "--no-fund", "--silent"], { cwd: folder, encoding: "utf8" });
    const packed = npm("pack", packageFolder).trim();
    writeFileSync(join(folder, "package.json"), "{}");
    npm("install", join(folder, packed));
    writeFileSync(join(folder, "program.mjs"), program);
    assert.equal(execFileSync("node", ["program.mjs"], { cwd: folder, encoding: "utf8" }).trim(), "it works");

    writeFileSync(join(folder, "typed.mts"), typed);
    const compiler = join(packageFolder, "node_modules/typescript/bin/tsc");
    const options = ["--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "--lib", "es2022"];
    execFileSync("node", [compiler, ...options, "typed.mts"], { cwd: folder, stdio: ["ignore", 2, 2] });
  });
});
