// At a glance: words, a sign and a colour for each question, never a colour alone.

import { Beat, kSilent_s, type Judgement, type Mood } from "./beat";
import { make, mark, say } from "./dom";
import { clock, counted, small } from "./format";
import { length, UNRESOLVED, type Frame, type Service } from "./frame";

const kSign: Record<Mood, string> = { good: "✓", warn: "▲", bad: "✕", idle: "–" };
const kQuestions = ["Server", "Beat", "Momentum", "Unresolved", "Clock", "Losses"] as const;
type Question = (typeof kQuestions)[number];

export class Status {
  private readonly beat = new Beat();
  private readonly tiles = new Map<Question, { tile: Element; sign: Element; word: Element; more: Element }>();

  constructor(place: Element) {
    for (const question of kQuestions) {
      const sign = make("span", { class: "sign", "aria-hidden": "true" });
      const word = make("strong");
      const more = make("small");
      const tile = make("div", { class: "tile", id: `tile-${question.toLowerCase()}` },
        make("span", { class: "question", text: question }), make("span", {}, sign, word), more); // prettier-ignore
      place.append(tile);
      this.tiles.set(question, { tile, sign, word, more });
    }
  }

  show(frame: Frame | undefined, service: Service | undefined, silent_ms: number): void {
    const connected = silent_ms < kSilent_s * 1000;
    this.say("Server", connected
      ? { mood: "good", word: "live", more: "ten looks a second" }
      : { mood: "bad", word: "lost", more: "is `adstar dashboard` running? trying again" }); // prettier-ignore
    if (!connected) {
      const unknown: Judgement = { mood: "idle", word: "unknown", more: "what is shown is old" };
      kQuestions.slice(1).forEach((question) => this.say(question, unknown));
      return;
    }
    this.say("Beat", this.beat.judge(service, performance.now()));
    this.say("Momentum", momentum(frame, service));
    this.say("Unresolved", unresolved(frame, service));
    this.say("Clock", {
      mood: service?.state === "running" ? "good" : "idle",
      word: service?.time_s === undefined ? "–" : clock(frame?.spacecraft?.time_s ?? service.time_s),
      more: service === undefined ? "" : `${service.name}: ${service.state}, ${service.scheme ?? ""}`,
    });
    this.say("Losses", losses(service));
  }

  private say(question: Question, judgement: Judgement): void {
    const { tile, sign, word, more } = this.tiles.get(question)!;
    mark(tile, "data-mood", judgement.mood);
    say(sign, kSign[judgement.mood]);
    say(word, judgement.word);
    say(more, judgement.more);
  }
}

function momentum(frame: Frame | undefined, service: Service | undefined): Judgement {
  const worst = service?.worst_momentum_residual_relative;
  if (worst === undefined || worst === null) {
    return { mood: "idle", word: "unknown", more: "no status heard" };
  }
  const more = `worst residual ${small(worst)} of |H|` + watchedResidual(frame);
  if (worst < 1e-10) {
    return { mood: "good", word: "held", more };
  }
  return worst < 1e-6 ? { mood: "warn", word: "drifting", more } : { mood: "bad", word: "NOT HELD", more };
}

function watchedResidual(frame: Frame | undefined): string {
  const spacecraft = frame?.spacecraft;
  const residual = spacecraft ? length(spacecraft.momentum_residual_I_n_m_s) : NaN;
  return Number.isFinite(residual) ? `; here ${small(residual)} N m s` : "";
}

function unresolved(frame: Frame | undefined, service: Service | undefined): Judgement {
  const count = service?.unresolved_spacecraft;
  const here = ((frame?.spacecraft?.flags ?? 0) & UNRESOLVED) !== 0;
  if (count === undefined) {
    return { mood: "idle", word: "unknown", more: "no status heard" };
  }
  if (count === 0 && !here) {
    return { mood: "good", word: "none", more: `of ${counted(service?.spacecraft)} spacecraft` };
  }
  return {
    mood: "bad",
    word: `${counted(Math.max(count, here ? 1 : 0))} spacecraft`,
    more: here ? `${frame!.watched} among them: its step is too long` : "their step is too long",
  };
}

function losses(service: Service | undefined): Judgement {
  if (service?.commands_lost === undefined) {
    return { mood: "idle", word: "unknown", more: "no status heard" };
  }
  const lost = service.commands_lost + (service.verdicts_lost ?? 0) + (service.telemetry_lost ?? 0);
  const restarts = service.bridge_restarts ?? 0;
  return {
    mood: service.commands_lost + (service.verdicts_lost ?? 0) > 0 ? "bad" : lost + restarts > 0 ? "warn" : "good",
    word: lost === 0 ? "nothing lost" : `${counted(lost)} lost`,
    more: `${counted(service.commands_received)} commands, ${counted(service.commands_refused)} refused; ${counted(restarts)} bridge restarts`,
  };
}
