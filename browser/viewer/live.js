// Builds the live parts of the documentation: scripts that are no modules, so that they run from a folder without a
// server, too. Usage: live.js FOLDER. KINESPHERE_PACKAGE names the folder of the built npm package, KINESPHERE_SMALL the
// small module.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = fileURLToPath(new URL(".", import.meta.url));
const folder = resolve(process.argv[2]);
mkdirSync(folder, { recursive: true });
await build({
  entryPoints: [join(here, "src/site/live.ts")],
  outfile: join(folder, "live.js"),
  bundle: true,
  format: "iife",
  target: "es2022",
  minify: true,
  // The package's own modules and the file system of Node.js are not for these pages, which say what to load.
  define: { "import.meta.url": '"https://kinesphere.invalid/"' },
  external: ["node:*"],
  alias: { kinesphere: join(resolve(process.env.KINESPHERE_PACKAGE), "dist/index.js") },
  logLevel: "warning",
});
const packed = gzipSync(readFileSync(process.env.KINESPHERE_SMALL), { level: 9 });
writeFileSync(join(folder, "kinesphere-small.js"), `globalThis.kinesphereSmall="${packed.toString("base64")}";\n`);
