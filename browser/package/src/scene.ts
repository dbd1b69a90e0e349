// The built-in scenes of the program `kinesphere`, with equal events, to the last bit.
import { type Definition, definitionOf } from "./definition.js";
import { Owned, theModule } from "./module.js";
import { Made, Motion } from "./motion.js";
import { checkKeys, type Keys } from "./options.js";
import { worldAt } from "./records.js";

/** Changes of the built-in scene; see `kinesphere run --help`. */
export interface SceneSettings {
  bodies?: number;
  seed?: number;
  seconds?: number;
  /** In (0, 1): the box is scaled until the bodies fill this part of it. */
  packing?: number;
  radiusMin?: number;
  radiusMax?: number;
  speedMin?: number;
  speedMax?: number;
  /** Limits of the acceleration. */
  limitMin?: number;
  limitMax?: number;
  restitution?: number;
  contactTolerance?: number;
}

/** Names of the settings, in the order of scene_create in browser/module/scene.cpp. */
const sceneKeys: Keys<SceneSettings> = {
  bodies: "number", seed: "number", seconds: "number", packing: "number", radiusMin: "number", radiusMax: "number", speedMin: "number", speedMax: "number",
  limitMin: "number", limitMax: "number", restitution: "number", contactTolerance: "number",
};
const sceneSettings = Object.keys(sceneKeys) as (keyof SceneSettings)[];

/** Returns "paper1" and so on. */
export function sceneNames(): string[] {
  const module = theModule();
  return Array.from({ length: module.call("scene_count") }, (_, k) => module.text(module.call("scene_name", k)));
}

/**
 *     const scene = new Scene("paper1", { bodies: 500 });
 *     const world = new World(scene.definition);
 *     const motion = scene.motion();
 *     world.addMotion(motion, scene.radii);
 *     world.run(scene.endTime, { motion, respond: scene });
 */
export class Scene extends Owned {
  constructor(readonly name: string, settings: SceneSettings = {}) {
    const names = sceneNames();
    const place = names.indexOf(name);
    if (place < 0) throw new RangeError(`Scene: name must be one of ${names.join(", ")}, but is ${name}`);
    checkKeys(settings, sceneKeys, "settings", "Scene");
    for (const key of ["bodies", "seed"] as const) {
      const value = settings[key];
      if (value !== undefined && !(Number.isInteger(value) && value >= 0 && value < 2 ** 32))
        throw new RangeError(`Scene: ${key} must be a whole number from 0 to 2^32 - 1, but is ${value}`);
    }
    const module = theModule();
    super(module.word("scene_create", place, sceneSettings.map((key) => settings[key] ?? NaN)), "scene_free");
  }

  get endTime(): number {
    return theModule().call("scene_end_time", this.address);
  }
  /** Radius of each body. */
  get radii(): Float64Array {
    return this.told("scene_radii");
  }
  /** The definition of the scene's world. */
  get definition(): Definition {
    return definitionOf(this.read(worldAt, "scene_definition"));
  }
  /** Returns a new motion of the bodies from the start. */
  motion(): Motion {
    return new Motion(new Made(theModule().call("scene_motion", this.address)));
  }
}
