// The pages are made of static files with relative paths, so that they work in any folder of any server.
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { coast } from "./coast.js";

const here = fileURLToPath(new URL(".", import.meta.url));
// The folder of the built npm package, as it lies in the build folder of the preset "browser".
const library = resolve(here, process.env.KINESPHERE_PACKAGE ?? "../../build/browser/browser/package");

export default defineConfig({
  base: "./",
  plugins: [coast()],
  resolve: { alias: { kinesphere: resolve(library, "dist/index.js") } },
  server: { fs: { allow: [here, library] } },
  build: {
    target: "es2022",
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1000,
    rollupOptions: { input: { viewer: resolve(here, "index.html"), map: resolve(here, "map.html") } },
  },
});
