// A built page in a browser, or its sources in Node.js: KINESPHERE_VIEWER names its folder, KINESPHERE_PACKAGE that of the npm
// package, CHROMIUM the browser's program, and PLAYWRIGHT, if it is not found otherwise, the folder of playwright-core.
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize, resolve } from "node:path";
import { after } from "node:test";
import { pathToFileURL } from "node:url";

const folders = {
  "/": resolve(process.env.KINESPHERE_VIEWER ?? new URL("../dist", import.meta.url).pathname),
  "/package/": resolve(process.env.KINESPHERE_PACKAGE ?? new URL("../../package", import.meta.url).pathname),
};
const playwright = process.env.PLAYWRIGHT;
const { chromium } = await import(
  playwright === undefined ? "playwright-core" : pathToFileURL(resolve(playwright, "index.mjs")).href);

const kinds = {
  ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".css": "text/css", ".json": "application/json",
  ".wasm": "application/wasm", ".svg": "image/svg+xml",
};
const policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; " +
  "connect-src 'self'; img-src 'self' data:; font-src data:";

/** Returns the bytes of a file of one of the folders, or of a text of the test; undefined if there is none. */
async function bytesOf(path, given, site) {
  if (path in given) return given[path];
  const root = path.startsWith("/package/") ? "/package/" : "/";
  const name = path === "/" ? "index.html" : path.slice(root.length);
  return readFile(join(site ?? folders[root], normalize(name))).catch(() => undefined);
}

/** Serves the page, or a `site`, on this machine; `given` has the texts of further paths. */
async function serve(given, site) {
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, "http://localhost");
    const bytes = await bytesOf(pathname, given, site);
    const kind = kinds[pathname === "/" ? ".html" : extname(pathname)] ?? "application/octet-stream";
    response.writeHead(bytes === undefined ? 404 : 200, { "content-type": kind, ...(site === undefined && { "content-security-policy": policy }) });
    response.end(bytes);
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return server;
}

/** WebGL options without a graphics card. */
const softwareGraphics = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const hasViewerDrawn = () => window.kinesphereViewer?.firstPicture != null;

/**
 * A browser that is there for the tests of a file. `open()` loads the page, here or at another server's address, and
 * waits until `isReady` is true there: of the viewer, for its first picture.
 * `complaints` is whatever pages complained of, and addresses that they asked for elsewhere; `graphics` are options
 * of the browser. `open(where, { prepare })` runs a function in the page before its own code. `site` is a folder to
 * serve in place of the viewer, without the viewer's policy of what a page may load.
 */
export function browserForTests({ given = {}, site, viewport = { width: 900, height: 700 }, isReady = hasViewerDrawn, graphics = softwareGraphics } = {}) {
  const found = { complaints: [], page: undefined, address: undefined, open: undefined };
  let server;
  let browser;
  let current;
  const start = async () => {
    server = await serve(given, site);
    found.address = `http://127.0.0.1:${server.address().port}/`;
    browser = await chromium.launch({
      executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
      args: ["--no-sandbox", ...graphics],
    });
  };
  after(async () => {
    await browser?.close();
    server?.close();
  });
  found.open = async (where = "", { prepare, ...options } = {}) => {
    if (browser === undefined) await start();
    await current?.close();
    const page = await browser.newPage({ viewport, colorScheme: "dark", ...options });
    page.on("pageerror", (error) => found.complaints.push(error.message));
    page.on("console", (message) => {
      if (message.type() === "error") found.complaints.push(message.text());
    });
    if (prepare !== undefined) await page.addInitScript(prepare);
    const address = /^(http|file):/.test(where) ? where : found.address + where;
    page.on("request", (request) => {
      const url = request.url();
      if (!url.startsWith(new URL("/", address).href) && !url.startsWith("data:")) found.complaints.push(url);
    });
    await page.goto(address);
    await page.waitForFunction(isReady, null, { timeout: 60_000 });
    current = found.page = page;
    return page;
  };
  return found;
}

let axe;
/** Returns what breaks a rule of axe-core so that somebody is shut out, and where; `only` names rules, all if there are none. */
export async function seriousFlaws(page, only = []) {
  axe ??= await readFile(resolve(playwright, "../axe-core/axe.min.js"), "utf8");
  await page.evaluate(axe);
  const { violations } = await page.evaluate((only) => window.axe.run(document, {
    resultTypes: ["violations"], ...(only.length > 0 && { runOnly: only }),
  }), only);
  return violations.filter(({ impact }) => impact === "serious" || impact === "critical").flatMap(({ id, nodes }) =>
    nodes.slice(0, 3).map(({ target, any }) => `${id}: ${target} ${any[0]?.message ?? ""}`));
}

/** Returns a body larger than `least` that can be grabbed, and the place of its centre on the page. */
export function bodyInSight(page, least) {
  return page.evaluate((least) => {
    const { simulation, stage, hand } = window.kinesphereViewer;
    const positions = simulation.positions();
    const radii = simulation.radii();
    const { width, height } = stage.canvas.getBoundingClientRect();
    for (let body = 0; body < radii.length; ++body) {
      const place = stage.camera.position.clone().fromArray(positions, 3 * body).project(stage.camera);
      const x = ((place.x + 1) / 2) * width;
      const y = ((1 - place.y) / 2) * height;
      if (document.elementFromPoint(x, y) !== stage.canvas || x < 340 || x > width - 300) continue;
      if (hand.bodyAt(x, y) === body && radii[body] > least) return { body, x, y };
    }
    return null;
  }, least);
}

/** Returns what a file of src/ exports, and `load` of the package that it uses. The pages' tools lie beside playwright-core. */
export async function importSource(file) {
  const tools = resolve(process.env.PLAYWRIGHT, "..");
  const { build } = await import(pathToFileURL(join(tools, "esbuild/lib/main.js")).href);
  const source = new URL(`../src/${file}`, import.meta.url).pathname;
  const folder = await mkdtemp(join(tmpdir(), "kinesphere-"));
  const outfile = join(folder, "source.mjs");
  const kinesphere = pathToFileURL(join(resolve(process.env.KINESPHERE_PACKAGE), "dist/index.js")).href;
  try {
    await build({
      stdin: { contents: `export * from ${JSON.stringify(source)}; export { load } from "kinesphere";`, resolveDir: folder },
      bundle: true, format: "esm", platform: "node", outfile, logLevel: "error",
      plugins: [{ name: "package", setup: (made) => made.onResolve({ filter: /^kinesphere$/ }, () => ({ path: kinesphere, external: true })) }],
    });
    return await import(pathToFileURL(outfile).href);
  } finally {
    await rm(folder, { recursive: true });
  }
}
