// The library for live pages: the small module, in a script, since scripts alone are loaded from a folder without a server.
import { load } from "kinesphere";

declare global {
  /** The module in WebAssembly, compressed by gzip, in base64: what kinesphere-small.js sets. */
  var kinesphereSmall: string | undefined;
}

/** The folder of this script. */
const folder = new URL(".", (document.currentScript as HTMLScriptElement).src);

/** Loads the library, once. Throws an error that says what is missing. */
export async function loadLibrary(): Promise<void> {
  if (typeof WebAssembly !== "object") throw new Error("this browser has no WebAssembly");
  if (typeof DecompressionStream !== "function") throw new Error("this browser is too old: it has no DecompressionStream");
  if (globalThis.kinesphereSmall === undefined) await loadScript("kinesphere-small.js");
  const packed = Uint8Array.from(atob(globalThis.kinesphereSmall!), (letter) => letter.charCodeAt(0));
  const bytes = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  await load({ source: await new Response(bytes).arrayBuffer() });
}

function loadScript(name: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = new URL(name, folder).href;
    script.onload = () => resolve();
    script.onerror = () => reject(new Error(`${name} could not be fetched`));
    document.head.append(script);
  });
}
