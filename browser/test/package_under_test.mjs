// The built package, the native program, and what their tests share.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

function required(name) {
  const value = process.env[name];
  if (!value) throw new Error(`${name} must be set: see browser/test/run.sh`);
  return value;
}

export const packageFolder = required("KINESPHERE_PACKAGE");
export const kinesphere = await import(pathToFileURL(join(packageFolder, "dist/index.js")).href);

/** Returns the output of the native program. */
export function program(...options) {
  return execFileSync(required("KINESPHERE_PROGRAM"), options, { encoding: "utf8" }).trim();
}

/** Calls `action` with a new folder, and removes it afterwards. */
export function inFolder(action) {
  const folder = mkdtempSync(join(tmpdir(), "kinesphere-"));
  try {
    return action(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Expects that `action` throws a KinesphereError with this code, whose message has the text. */
export function refuses(action, code, text) {
  assert.throws(action, (error) => {
    assert.ok(error instanceof kinesphere.KinesphereError, `${error}`);
    assert.equal(error.code, code, error.message);
    assert.match(error.message, text);
    return true;
  });
}
