// The form that sends a torque pulse, where the server allows it.

import { find, make, mark, say } from "./dom";
import type { About, Frame } from "./frame";

export class PulseForm {
  private readonly form = find<HTMLFormElement>("#pulse");
  private readonly fields = find<HTMLFieldSetElement>("#pulse-fields");
  private readonly answer = find<HTMLOutputElement>("#pulse-answer");
  private readonly actuators = this.form.elements.namedItem("actuator") as HTMLSelectElement;
  private allowed = false;
  private listed = "";

  constructor() {
    this.form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.send();
    });
  }

  introduce(about: About): void {
    this.allowed = about.commands_allowed;
    if (!this.allowed) {
      say(this.answer, "Read-only. `adstar dashboard --allow-commands` lets this form command.");
    } else if (this.answer.textContent?.startsWith("Read-only")) {
      say(this.answer, "");
    }
  }

  show(frame: Frame): void {
    this.input("spacecraft").value = frame.watched;
    const key = frame.actuators.join("\n");
    if (key !== this.listed) {
      this.listed = key;
      this.actuators.replaceChildren(...frame.actuators.map((text) => make("option", { text })));
    }
    const usable = this.allowed && frame.actuators.length > 0;
    if (this.fields.disabled === usable) {
      this.fields.disabled = !usable;
    }
    if (this.allowed && frame.actuators.length === 0 && frame.watched !== "") {
      say(this.answer, `${frame.watched} has no actuator that takes commands.`);
    }
  }

  private input(name: string): HTMLInputElement {
    return this.form.elements.namedItem(name) as HTMLInputElement;
  }

  private async send(): Promise<void> {
    const numbers = ["x", "y", "z", "duration"].map((name) => this.input(name).valueAsNumber);
    if (numbers.some((value) => !Number.isFinite(value))) {
      this.tell("bad", "✕ not sent: every field needs a number");
      return;
    }
    const [x, y, z, duration_s] = numbers;
    this.tell("idle", "… sent, waiting for the verdict");
    try {
      const response = await fetch("/command", {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({
          spacecraft: this.input("spacecraft").value,
          actuator: this.actuators.value,
          torque_n_m: [x, y, z],
          duration_s,
        }),
      });
      const { verdict, sentence } = (await response.json()) as { verdict: string; sentence: string };
      const good = response.ok && ["applied", "accepted"].includes(verdict);
      const warn = response.ok && ["applied_late", "clamped", "superseded"].includes(verdict);
      this.tell(good ? "good" : warn ? "warn" : "bad", `${good ? "✓" : warn ? "▲" : "✕"} ${sentence}`);
    } catch {
      this.tell("bad", "✕ no answer: is `adstar dashboard` still running?");
    }
  }

  private tell(mood: string, text: string): void {
    mark(this.answer, "data-mood", mood);
    say(this.answer, text);
  }
}
