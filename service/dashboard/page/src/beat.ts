// Whether a daemon keeps its beat, from what its counters did in the last seconds.

import type { Service } from "./frame";

export type Mood = "good" | "warn" | "bad" | "idle";

export interface Judgement {
  mood: Mood;
  word: string;
  more: string;
}

const kWindow_ms = 10_000;
export const kSilent_s = 3;

interface Look {
  at_ms: number;
  step: number;
  late: number;
  missed: number;
}

export class Beat {
  private looks: Look[] = [];
  private run = "";

  judge(service: Service | undefined, now_ms: number): Judgement {
    if (service === undefined) {
      return { mood: "bad", word: "no daemon", more: "is adstard running, on this domain and partition?" };
    }
    if (service.age_s > kSilent_s) {
      return { mood: "bad", word: "silent", more: `nothing heard for ${service.age_s.toFixed(0)} s` };
    }
    if (service.state !== "running") {
      const mood = service.state === "halted" || service.state === "stopped" ? "bad" : "idle";
      return { mood, word: service.state, more: "the clock stands" };
    }
    const timing = service.timing;
    if (timing === undefined) {
      return { mood: "idle", word: "running", more: "no timing yet" };
    }
    const run = `${service.name}\n${service.run}`;
    if (run !== this.run) {
      this.run = run;
      this.looks = [];
    }
    if (timing.step !== this.looks.at(-1)?.step) {
      this.looks.push({ at_ms: now_ms, step: timing.step, late: timing.late_beats, missed: timing.missed_beats }); // prettier-ignore
    }
    while (this.looks.length > 2 && now_ms - this.looks[1]!.at_ms > kWindow_ms) {
      this.looks.shift();
    }
    const first = this.looks[0]!, last = this.looks.at(-1)!; // prettier-ignore
    const beats = last.step - first.step;
    const late = last.late - first.late;
    const missed = last.missed - first.missed;
    if (service.pace !== "clock") {
      return { mood: "good", word: "running", more: `pace ${service.pace}: bound to no clock` };
    }
    if (late === 0 && missed === 0) {
      return { mood: "good", word: "keeping", more: `${beats.toLocaleString("en")} beats, none late` };
    }
    const more = `${late} late, ${missed} missed of ${(beats + missed).toLocaleString("en")}`;
    return (late + missed) * 100 > beats
      ? { mood: "bad", word: "NOT KEEPING", more }
      : { mood: "warn", word: "slipping", more };
  }
}
