// Processes and a browser for the tests of the dashboard: a daemon on a partition of its own, the server, Debian's
// Chromium without a screen.

import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

const programs = resolve(process.env.ADSTAR_PROGRAMS ?? "build/release");
export const page_directory = resolve(process.env.ADSTAR_PAGE ?? "build/release/service/dashboard/page");
export const shots = process.env.ADSTAR_SHOTS ?? join(tmpdir(), "adstar-shots");
export const browser_path = process.env.ADSTAR_CHROMIUM ?? "/usr/bin/chromium";

/// Ends the test as skipped, for ctest.
export function requireBrowser() {
  for (const file of [browser_path, join(page_directory, "node_modules/playwright-core/package.json")]) {
    if (!existsSync(file)) {
      console.error(`skipped: ${file} is not there; deploy/install-deps.sh --tests installs what is needed`);
      process.exit(77);
    }
  }
}

export async function openBrowser() {
  const { chromium } = createRequire(join(page_directory, "package.json"))("playwright-core");
  return chromium.launch({
    executablePath: browser_path,
    args: [
      ...(process.getuid() === 0 ? ["--no-sandbox"] : []),
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      // Software all the way: emulated GPU rasterisation of what is no WebGL costs most.
      "--disable-gpu-rasterization",
      "--disable-accelerated-2d-canvas",
    ],
  });
}

export const partition = `dashboard-test-${process.pid}`;
const directory = mkdtempSync(join(tmpdir(), "adstar-dashboard-"));
const children = new Set();
process.on("exit", () => {
  children.forEach((child) => child.kill("SIGKILL"));
  rmSync(directory, { recursive: true, force: true });
});

function start(program, words) {
  const child = spawn(join(programs, program), words, { stdio: ["ignore", "pipe", "pipe"] });
  children.add(child);
  child.text = "";
  child.stdout.on("data", (data) => (child.text += data));
  child.stderr.on("data", (data) => (child.text += data));
  child.ended = new Promise((resolve) =>
    child.on("exit", (code) => {
      children.delete(child);
      resolve(code);
    }),
  );
  return child;
}

export async function until(what, holds, timeout_ms = 30_000) {
  const begun = Date.now();
  while (Date.now() - begun < timeout_ms) {
    if (await holds()) {
      return;
    }
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  throw new Error(`not within ${timeout_ms / 1000} s: ${what}`);
}

export function startDaemon(scene) {
  const file = join(directory, `scene${Math.random()}.toml`);
  writeFileSync(file, scene);
  return start("adstard", [file]);
}

export async function stop(child, signal = "SIGINT") {
  child.kill(signal);
  return child.ended;
}

/// With `url` and `port`.
export async function startDashboard({ port = 0, more = [] } = {}) {
  const child = start("adstar", ["dashboard", "--partition", partition, "--port", String(port), ...more]);
  await until("the dashboard listens", () => /http:\/\/\S+/.test(child.text) || child.exitCode !== null);
  const found = /http:\/\/127\.0\.0\.1:(\d+)\//.exec(child.text);
  if (found === null) {
    throw new Error(`adstar dashboard: ${child.text}`);
  }
  child.url = found[0];
  child.port = Number(found[1]);
  return child;
}

/// A request with whatever head; {status, headers, text}.
export function ask(port, path, { method = "GET", headers = {}, body } = {}) {
  return new Promise((resolve, reject) => {
    const sent = request({ host: "127.0.0.1", port, path, method, headers: { ...headers, ...(body ? { "Content-Length": Buffer.byteLength(body) } : {}) } }, (answer) => {
      let text = "";
      answer.on("data", (data) => (text += data));
      answer.on("end", () => resolve({ status: answer.statusCode, headers: answer.headers, text }));
    });
    sent.on("error", reject);
    sent.end(body);
  });
}

/// The first frame of /events for which `holds`.
export function frameOf(port, query = "", holds = () => true) {
  return new Promise((resolve, reject) => {
    const sent = request({ host: "127.0.0.1", port, path: `/events${query}` }, (answer) => {
      let text = "";
      answer.on("data", (data) => {
        text += data;
        const events = text.split("\n\n");
        text = events.pop();
        for (const event of events) {
          const frame = JSON.parse(event.slice("data: ".length));
          if (holds(frame)) {
            sent.destroy();
            resolve(frame);
            return;
          }
        }
      });
    });
    sent.on("error", reject);
    sent.end();
  });
}

export function tumbling(more = "") {
  return `[simulation]
step = "2ms"
duration = "endless"
pace = "clock"
[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
[[spacecraft.torque]]
model = "commanded"
name = "body"
frame = "body"
max_torque_n_m = [1.0, 1.0, 1.0]
[telemetry]
attitude_hz = 20
momentum_hz = 20
[service]
name = "fly"
[budget]
step = "500us"
wake_up = "1ms"
admission = "warn"
[dds]
partition = "${partition}"
interface = "lo"
${more}`;
}
