// A watch that serves the map, and what tests ask of its page. The program is KINESPHERE_PROGRAM.
import { spawn } from "node:child_process";
import { createInterface } from "node:readline";

/** A watch of a stream that lasts until `end`: of JSON lines unless the options name another format. */
export class Watch {
  constructor(...options) {
    const usual = [...(options.includes("--format") ? [] : ["--format", "jsonl"]), ...(options.includes("--serve") ? [] : ["--serve", "0"])];
    this.process = spawn(process.env.KINESPHERE_PROGRAM, ["watch", "--quiet", ...usual, ...options], { stdio: ["pipe", "ignore", "pipe"] });
    this.address = new Promise((resolve) => createInterface(this.process.stderr).once("line",
      (line) => resolve(/http:\S+/.exec(line)[0])));
  }
  write(text) {
    this.process.stdin.write(text);
  }
  report(...reports) {
    for (const report of reports) this.write(`${JSON.stringify(report)}\n`);
  }
  /** Ends the stream; returns the exit code. */
  end() {
    const gone = new Promise((done) => this.process.once("exit", done));
    this.process.stdin.end();
    return gone;
  }
}

export const at = (id, stamp, x, y, velocity = [0, 0, 0]) => ({ id, stamp, position: [x, y, 0], velocity });

/** Returns colours of the picture at places of the screen. Range: 0 to 255. */
export const coloursAt = (page, places) => page.evaluate((places) => {
  const canvas = document.querySelector("#picture");
  const { data, width } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const ratio = width / canvas.clientWidth;
  return places.map(([x, y]) => 4 * (Math.floor(y * ratio) * width + Math.floor(x * ratio))).map((at) => [...data.slice(at, at + 3)]);
}, places);
/** Returns a colour of the map, from the style sheet. */
export const namedColour = (page, name) => page.evaluate((name) => {
  const text = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16));
}, name);
export const difference = (a, b) => Math.max(...a.map((value, k) => Math.abs(value - b[k])));

/** Returns the texts of elements, with usual blanks. */
export const texts = (page, selector) => page.$$eval(selector, (found) => found.map((each) => each.textContent.replaceAll("\u00a0", " ")));
export const number = (page, name) => page.textContent(`#numbers [data-name="${name}"] dd`);
/** The browser reports every unanswered request. */
export const isNoMissingServer = (complaint) => !complaint.startsWith("Failed to load resource: net::ERR_CONNECTION");
/** Resolves when the picture is up to date: no flight is going on. */
export const isDrawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
