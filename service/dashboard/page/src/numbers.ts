// The motion in numbers, frame and unit beside each.

import { find, make, say } from "./dom";
import { fixed, small } from "./format";
import type { Motion, Triple } from "./frame";

const kRows: [string, (motion: Motion) => Triple][] = [
  ["H_I [N m s]", (motion) => motion.H_I_n_m_s],
  ["Pi_B [N m s]", (motion) => motion.Pi_B_n_m_s],
  ["omega_B [rad/s]", (motion) => motion.omega_B_rad_s],
];

export class Numbers {
  private readonly cells: HTMLElement[][] = [];
  private readonly line = make("p", { class: "quiet mono", id: "motion-line" });

  constructor() {
    const body = find<HTMLElement>("#motion-numbers tbody");
    for (const [name] of kRows) {
      const cells = [0, 1, 2].map(() => make("td"));
      this.cells.push(cells);
      body.append(make("tr", {}, make("th", { scope: "row", text: name }), ...cells));
    }
    find("#motion-numbers").after(this.line);
  }

  show(motion: Motion | null): void {
    kRows.forEach(([, triple], r) => {
      const values = motion === null ? [null, null, null] : triple(motion);
      values.forEach((value, c) => say(this.cells[r]![c]!, fixed(value)));
    });
    say(this.line, motion === null
      ? "no telemetry of this spacecraft"
      : `step ${motion.step.toLocaleString("en")}, t ${fixed(motion.time_s, 3)} s, ` +
        `E ${fixed(motion.energy_j)} J, E − E_0 − W ${small(motion.energy_residual_j)} J, ` +
        `q_IB (w x y z) ${motion.q_IB.map((c) => fixed(c, 4)).join(" ")}`); // prettier-ignore
  }
}
