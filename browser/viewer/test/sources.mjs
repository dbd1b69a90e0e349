// Sources of the pages for tests in Node.js, with the built package: KINESPHERE_PACKAGE names its folder, and PLAYWRIGHT
// that of playwright-core, beside which the tools of the pages lie.
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

/** Returns what a file of src/ exports, and `load` of the package that it uses. */
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
