// adstar dashboard: puts the parts of the page together.

import "./style.css";

import { find, make, say } from "./dom";
import { Fleet } from "./fleet";
import type { About, Frame, Service } from "./frame";
import { History } from "./history";
import { Numbers } from "./numbers";
import { Plots } from "./plots";
import { PulseForm } from "./pulse";
import { sceneIn } from "./scene";
import { Status } from "./status";
import { Stream } from "./stream";
import { TimingChart } from "./timing";
import { Verdicts } from "./verdicts";

const kPlots_ms = 250;
const kStatus_ms = 500;

const history = new History();
const status = new Status(find("#status"));
const scene = sceneIn(find<HTMLElement>("#scene"));
const numbers = new Numbers();
const plots = new Plots(find<HTMLElement>("#plots"), history);
const timing = new TimingChart(find<HTMLElement>("#timing"));
const verdicts = new Verdicts();
const pulse = new PulseForm();

let latest: Frame | undefined;

function serviceOf(frame: Frame | undefined): Service | undefined {
  const name = frame?.spacecraft?.service;
  return frame?.services.find((service) => service.name === name) ?? frame?.services[0];
}

function onFrame(frame: Frame): void {
  latest = frame;
  const service = serviceOf(frame);
  if (frame.spacecraft !== null) {
    history.add(frame.spacecraft, service?.run ?? "");
    scene?.show(frame.spacecraft);
  }
  numbers.show(frame.spacecraft);
  timing.show(service);
  verdicts.add(frame.verdicts);
  pulse.show(frame);
  fleet.setWatched(frame.watched);
  say(find("#watched-title"), frame.watched === "" ? "" : `· ${frame.watched}`);
  document.title = frame.watched === "" ? "adstar dashboard" : `${frame.watched} · adstar`;
}

async function introduce(): Promise<void> {
  try {
    const about = (await (await fetch("/about")).json()) as About;
    say(find("#place"), about.place);
    pulse.introduce(about);
  } catch {
    // The next connection asks again.
  }
}

const stream = new Stream(onFrame, () => {
  verdicts.restart();
  void introduce();
});
const fleet = new Fleet(find<HTMLElement>("#fleet"), (name) => stream.watch(name));
stream.watch("");

for (const input of document.querySelectorAll<HTMLInputElement>("#window input")) {
  input.addEventListener("change", () => plots.show(Number(input.value)));
}
for (const [name, text] of [
  ["x", "x_B"],
  ["y", "y_B"],
  ["z", "z_B"],
  ["momentum", "H_I, angular momentum"],
  ["rate", "omega, angular velocity"],
] as const) {
  const swatch = make("span", { class: `swatch ${name}`, "aria-hidden": "true" });
  find("#scene-legend").append(make("li", {}, swatch, document.createTextNode(text)));
}
for (const axis of ["x", "y", "z"] as const) {
  const line = make("span", { class: `line ${axis}`, "aria-hidden": "true" });
  const words = { x: "x, solid", y: "y, dashed", z: "z, dotted" };
  find("#plots-legend").append(make("li", {}, line, document.createTextNode(words[axis])));
}
window.setInterval(() => {
  if (!document.hidden) {
    plots.drawIfDue();
  }
}, kPlots_ms);
const showStatus = () =>
  status.show(latest, serviceOf(latest), performance.now() - stream.lastFrame_ms);
window.setInterval(showStatus, kStatus_ms);
showStatus();

// What the tests of this page look at.
Object.assign(window, {
  adstar: {
    attitude: () => scene?.attitude(),
    drawn: () => scene?.drawn ?? 0,
    settled: () => scene?.settled ?? true,
    samples: () => history.size,
  },
});
