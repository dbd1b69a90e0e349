// The panel of settings.
import GUI from "lil-gui";
import { scenes } from "./scenes/list.ts";
import { ranges, type Settings } from "./settings.ts";

export interface PanelActions {
  chooseScene(): void;
  restart(): void;
  repaint(): void;
  openFile(): void;
  chooseNearest(): void;
}

export function makePanel(settings: Settings, actions: PanelActions): GUI {
  const gui = new GUI({ title: "Settings", container: document.querySelector<HTMLElement>("#panel")! });
  gui.add(settings, "scene", Object.fromEntries(scenes.map(({ title, name }) => [title, name]))).name("scene").onChange(actions.chooseScene)
    .domElement.classList.add("scene");
  gui.add(settings, "speed", ...ranges.speed).name("speed");
  gui.add(settings, "bodies", ranges.bodies[0], ranges.bodies[1], 10).name("bodies").onFinishChange(actions.restart);
  gui.add(settings, "seed", ...ranges.seed).name("seed").onFinishChange(actions.restart);
  gui.add(settings, "colouring", { size: "size", "asked lately": "asked", "safe until": "safe" }).name("colour");
  const overlays = gui.addFolder("Show");
  overlays.add(settings.overlays, "contacts").name("contacts");
  overlays.add(settings.overlays, "evidence").name("missed ones stay");
  overlays.add(settings.overlays, "trails").name("trails");
  overlays.add(settings.overlays, "probes").name("who is asked");
  overlays.add(settings.overlays, "bounds").name("bounds");
  overlays.add(settings.overlays, "certificates").name("certificates");
  overlays.add(settings.overlays, "busiest").name("who costs most");
  overlays.add(settings.overlays, "boxes").name("boxes of bodies");
  overlays.add(settings.overlays, "cells").name("cells");
  gui.add(settings, "theme", ["system", "dark", "bright"]).onChange(actions.repaint);
  gui.add({ choose: actions.chooseNearest }, "choose").name("choose the nearest pair");
  gui.add({ open: actions.openFile }, "open").name("open a file …");
  if (matchMedia("(max-width: 1100px), (max-height: 500px)").matches) gui.close();
  return gui;
}
