// A server that plays the dashboard's part: the page's files, and an hour of frames at once, then ten a second.

import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".txt": "text/plain" };

export function frameAt(i) {
  const t = i / 10;
  const wave = (period, phase) => Math.sin((2 * Math.PI * t) / period + phase);
  const quantiles = { count: i, p50_ns: 40e3, p99_ns: 90e3, p99_9_ns: 400e3, max_ns: 2e6, budget_ns: 1e6, over_budget: 2,
    quarter_octaves: Array.from({ length: 90 }, (_, k) => (k < 22 || k > 52 ? 0 : Math.round(i / 1.5 ** Math.abs(31 - k)))) };
  const half = 0.3 * t;
  return {
    watched: "sat1",
    spacecraft: {
      name: "sat1", service: "fake", step: i, time_s: t, age_s: 0,
      q_IB: [Math.cos(half), 0, 0, Math.sin(half)],
      omega_B_rad_s: [0.5 * wave(7, 0), 0.8 * wave(7, 1), 0.1 * wave(3, 2)],
      H_I_n_m_s: [0.4165, 0.9072, 0.0577],
      Pi_B_n_m_s: [wave(7, 0), wave(7, 1), wave(3, 2)],
      momentum_residual_I_n_m_s: [1e-17 * wave(100, 0), 1e-17, 0],
      energy_j: 0.47, work_j: 0, energy_residual_j: 1e-16 * wave(300, 0), flags: 0,
    },
    actuators: ["body"],
    services: [{
      name: "fake", age_s: 0, run: "1/0", state: "running", step: i, time_s: t, step_length_ns: 1e6, pace: "clock",
      scheme: "coadjoint_rk4", spacecraft: 1, unresolved_spacecraft: 0, worst_momentum_residual_relative: 1e-16,
      commands_received: 0, commands_refused: 0, commands_lost: 0, verdicts_lost: 0, telemetry_lost: 0, bridge_restarts: 0,
      timing: {
        step: i, time_ns: t * 1e9, wake_up_lateness: quantiles, command_phase: quantiles, step_phase: quantiles,
        hand_over_phase: quantiles, late_beats: 0, late_after_work: 0, late_after_loss: 0, late_after_sleep: 0, missed_beats: 0,
        caught_up_beats: 0, overruns: 0, behind_wall_ns: 0, fifo_scheduling: true, memory_locked: true, cpu_pinned: false,
      },
    }],
    verdicts: [],
  }; // prettier-ignore
}

export async function startFakeHour(dist, samples = 36_000) {
  const server = createServer(async (request, response) => {
    const path = request.url.split("?")[0];
    if (path === "/events") {
      response.writeHead(200, { "Content-Type": "text/event-stream" });
      for (let i = 0; i < samples; ++i) {
        if (!response.write(`data: ${JSON.stringify(frameAt(i))}\n\n`)) {
          await new Promise((resolve) => response.once("drain", resolve));
        }
      }
      let i = samples;
      const timer = setInterval(() => response.write(`data: ${JSON.stringify(frameAt(i++))}\n\n`), 100);
      response.on("close", () => clearInterval(timer));
      return;
    }
    if (path === "/fleet" || path === "/about") {
      response.writeHead(200, { "Content-Type": "application/json" });
      response.end(path === "/about" ? '{"commands_allowed":false,"place":"an hour at once"}' : '{"spacecraft":0,"name":[],"service":[],"time_s":[],"rate_rad_s":[],"momentum_n_m_s":[],"energy_j":[],"energy_residual_j":[],"flags":[]}');
      return;
    }
    try {
      const file = join(dist, path === "/" ? "index.html" : path.slice(1));
      response.writeHead(200, { "Content-Type": types[extname(file)] ?? "text/plain" });
      response.end(readFileSync(file));
    } catch {
      response.writeHead(404);
      response.end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.closeAllConnections() ?? server.close() };
}
