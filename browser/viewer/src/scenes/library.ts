// The built-in scenes of the library.
import { Scene, World } from "kinesphere";
import { MovedScene, type SceneChoice, type Setup } from "./live_scene.ts";

export function ofLibrary({ name, bodies, seed }: SceneChoice): Setup {
  const scene = new Scene(name, { bodies, seed });
  const world = new World(scene.definition);
  const motion = scene.motion();
  const radii = scene.radii;
  world.addMotion(motion, radii);
  return { scene: new MovedScene(world, motion, scene), radii };
}
