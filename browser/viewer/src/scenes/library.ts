// The built-in scenes of the library.
import { KinesphereError, Scene, World } from "kinesphere";
import { MovedScene, type SceneChoice, type Setup } from "./live_scene.ts";

export function ofLibrary({ name, bodies, seed }: SceneChoice): Setup {
  const scene = roomy(name, bodies, seed);
  const world = new World(scene.definition);
  const motion = scene.motion();
  const radii = scene.radii;
  world.addMotion(motion, radii);
  return { scene: new MovedScene(world, motion, scene), radii };
}

/** Returns a larger box than the scene's own, a tenth of it filled, if the bodies do not fit into that. */
function roomy(name: string, bodies: number, seed: number): Scene {
  try {
    return new Scene(name, { bodies, seed });
  } catch (error) {
    if (error instanceof KinesphereError && error.argument === "bodies") return new Scene(name, { bodies, seed, packing: 0.1 });
    throw error;
  }
}
