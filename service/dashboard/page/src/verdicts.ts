// Commands, the newest answer on top.

import { find, make } from "./dom";
import { fixed } from "./format";
import type { Verdict } from "./frame";

const kShown = 60;
const kGood = new Set(["applied", "accepted"]);
const kWarn = new Set(["applied_late", "clamped", "superseded"]);

function sign(verdict: string): string {
  return kGood.has(verdict) ? "✓" : kWarn.has(verdict) ? "▲" : "✕";
}

function mood(verdict: string): string {
  return kGood.has(verdict) ? "good" : kWarn.has(verdict) ? "warn" : "bad";
}

export class Verdicts {
  private readonly body = find<HTMLElement>("#verdicts tbody");
  private readonly none = find<HTMLElement>("#no-verdicts");
  private readonly table = find<HTMLElement>("#verdicts");
  private newest = 0;

  constructor() {
    this.table.hidden = true;
  }

  /// A new connection tells everything again, and a new server counts from 1.
  restart(): void {
    this.newest = 0;
    this.body.replaceChildren();
  }

  add(verdicts: Verdict[]): void {
    for (const verdict of verdicts) {
      if (verdict.number > this.newest) {
        this.newest = verdict.number;
        this.body.prepend(row(verdict));
      }
    }
    while (this.body.childElementCount > kShown) {
      this.body.lastElementChild!.remove();
    }
    this.table.hidden = this.body.childElementCount === 0;
    this.none.hidden = !this.table.hidden;
  }
}

function row(v: Verdict): HTMLElement {
  const word = v.verdict.replaceAll("_", " ") + (v.reason === "none" ? "" : `: ${v.reason.replaceAll("_", " ")}`);
  const refused = mood(v.verdict) === "bad";
  return make("tr", {},
    make("td", { text: fixed(v.time_s, 3) }),
    make("td", {}, make("span", { class: `verdict ${mood(v.verdict)}`, text: `${sign(v.verdict)} ${word}` })),
    make("td", { text: `${v.spacecraft} / ${v.actuator}` }),
    make("td", { class: "number", text: refused ? "–" : v.torque_applied_n_m.map((c) => fixed(c, 3)).join(" ") }),
    make("td", { class: "number", text: refused ? "–" : `${fixed(v.start_s, 3)} to ${fixed(v.end_s, 3)}` })); // prettier-ignore
}
