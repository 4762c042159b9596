// The dashboard in a real browser, over a live daemon. ADSTAR_PROGRAMS: where adstar and adstard are; ADSTAR_PAGE: where the
// page was built; ADSTAR_SHOTS: where pictures go.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { connect } from "node:net";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";

import { startFakeHour } from "./fake_hour.mjs";
import { ask, frameOf, openBrowser, page_directory, partition, requireBrowser, shots, startDaemon, startDashboard, stop, tumbling, until } from "./support.mjs";

requireBrowser();
mkdirSync(shots, { recursive: true });

let browser;
before(async () => (browser = await openBrowser()));
after(async () => browser?.close());

/// A page whose complaints are kept.
async function open(url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  page.complaints = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text())) {
      page.complaints.push(message.text());
    }
  });
  page.on("pageerror", (error) => page.complaints.push(String(error)));
  await page.goto(url);
  return page;
}

const tile = (page, name) => page.locator(`#tile-${name} strong`).textContent();
const number = (text) => Number(text.replaceAll("−", "-").replaceAll(",", ""));
const cell = async (page, row, column) => number(await page.locator("#motion-numbers tbody tr").nth(row).locator("td").nth(column).textContent());
const stepOf = async (page) => number(/step ([\d,]+)/.exec(await page.locator("#motion-line").textContent())?.[1] ?? "NaN");

describe("over a live daemon", () => {
  let daemon, dashboard, page;
  before(async () => {
    daemon = startDaemon(tumbling());
    dashboard = await startDashboard();
    page = await open(dashboard.url);
    await until("the page shows telemetry", async () => (await stepOf(page)) > 0);
  });
  after(async () => {
    await page?.context().close();
    await stop(dashboard);
    await stop(daemon);
  });

  test("numbers move, and are those of the stream", async () => {
    const [step, omega] = [await stepOf(page), await cell(page, 2, 0)];
    await until("the step rises", async () => (await stepOf(page)) > step + 500);
    assert.notEqual(await cell(page, 2, 0), omega);
    const frame = await frameOf(dashboard.port);
    for (const axis of [0, 1, 2]) {
      // No torque: H_I stands still.
      assert.ok(Math.abs((await cell(page, 0, axis)) - frame.spacecraft.H_I_n_m_s[axis]) < 1e-6);
    }
    assert.ok(frame.spacecraft.step > step);
  });

  test("the spacecraft is drawn where the stream says", async () => {
    const frame = await frameOf(dashboard.port);
    const drawn = await page.evaluate(() => window.adstar.attitude());
    const dot = Math.abs(drawn.reduce((sum, c, i) => sum + c * frame.spacecraft.q_IB[i], 0));
    assert.ok(dot > Math.cos(0.35), `drawn ${drawn}, told ${frame.spacecraft.q_IB}`);
    const before = await page.evaluate(() => window.adstar.drawn());
    await until("more pictures", async () => (await page.evaluate(() => window.adstar.drawn())) > before + 10);
  });

  test("tells at a glance that momentum is held and all is resolved", async () => {
    await until("status came", async () => (await tile(page, "momentum")) === "held");
    assert.equal(await tile(page, "unresolved"), "none");
    assert.match(await tile(page, "beat"), /keeping|slipping|NOT KEEPING/);
    assert.equal(await page.locator("#timing tbody tr").count(), 4);
  });

  test("only shows: the form is off, and a command is refused", async () => {
    assert.ok(await page.locator("#pulse button").isDisabled());
    const body = JSON.stringify({ spacecraft: "sat1", actuator: "body", torque_n_m: [0, 0, 0.1], duration_s: 1 });
    const headers = { Origin: dashboard.url.slice(0, -1), "Content-Type": "application/json" };
    const answer = await ask(dashboard.port, "/command", { method: "POST", headers, body });
    assert.equal(answer.status, 403);
    assert.match(answer.text, /--allow-commands/);
    assert.equal((await frameOf(dashboard.port)).services[0].commands_received, 0);
  });

  test("a page of another site gets nothing", async () => {
    const foreign = { Origin: "http://example.org" };
    for (const path of ["/", "/events", "/fleet", "/metrics", "/about"]) {
      assert.equal((await ask(dashboard.port, path, { headers: foreign })).status, 403, path);
    }
    assert.equal((await ask(dashboard.port, "/", { headers: { Host: `example.org:${dashboard.port}` } })).status, 403);
    assert.equal((await ask(dashboard.port, "/fleet", { headers: { "Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "cors" } })).status, 403);
  });

  test("what a refused request carries is not taken for another one", async () => {
    const inner = `POST /command HTTP/1.1\r\nHost: 127.0.0.1:${dashboard.port}\r\nContent-Length: 0\r\n\r\n`;
    const answer = await ask(dashboard.port, "/command", { method: "POST", headers: { Origin: "http://example.org", "Content-Type": "text/plain" }, body: inner });
    assert.equal(answer.status, 403);
    assert.equal(answer.headers.connection, "close");
  });

  test("every answer has the policy, and no script stands in the page", async () => {
    const answer = await ask(dashboard.port, "/");
    assert.match(answer.headers["content-security-policy"], /script-src 'self';/);
    assert.doesNotMatch(answer.headers["content-security-policy"], /unsafe/);
    assert.equal(answer.headers["x-content-type-options"], "nosniff");
    assert.doesNotMatch(answer.text, /<script(?![^>]*src=)|<style| style=| on\w+=/);
  });

  test("readers that stand still cost no memory", async () => {
    const resident_kb = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${dashboard.pid}/status`, "utf8"))[1]);
    const before_kb = resident_kb();
    const readers = Array.from({ length: 6 }, () => {
      const socket = connect(dashboard.port, "127.0.0.1").on("error", () => {});
      socket.pause();
      socket.write(`GET /events HTTP/1.1\r\nHost: 127.0.0.1:${dashboard.port}\r\n\r\n`);
      return socket;
    });
    await page.waitForTimeout(6000);
    assert.equal((await ask(dashboard.port, "/metrics")).status, 200);
    assert.ok(resident_kb() - before_kb < 10_000, `${before_kb} to ${resident_kb()} kB`);
    readers.forEach((socket) => socket.destroy());
  });

  test("metrics count steps", async () => {
    const steps = async () => Number(/^adstar_steps_total\{service="fly"\} (\d+)$/m.exec((await ask(dashboard.port, "/metrics")).text)[1]);
    const first = await steps();
    await until("more steps", async () => (await steps()) > first);
  });

  test("promtool has nothing against the metrics", async (context) => {
    const { error, status, stderr } = spawnSync("promtool", ["check", "metrics"], { input: (await ask(dashboard.port, "/metrics")).text, encoding: "utf8" });
    if (error !== undefined) {
      context.skip("promtool (Debian: prometheus) is not installed");
      return;
    }
    assert.equal(status, 0, stderr);
  });

  test("survives the daemon's restart", async () => {
    await stop(daemon, "SIGKILL");
    await until("it says so", async () => ["silent", "no daemon"].includes(await tile(page, "beat")));
    const before = await stepOf(page);
    daemon = startDaemon(tumbling());
    await until("the new run is followed", async () => {
      const step = await stepOf(page);
      return step > 0 && (step < before || before === 0 || Number.isNaN(before)) && /keeping|slipping|KEEPING/.test(await tile(page, "beat"));
    });
  });

  test("survives its own server's restart", async () => {
    const port = dashboard.port;
    await stop(dashboard);
    await until("it says so", async () => (await tile(page, "server")) === "lost");
    dashboard = await startDashboard({ port });
    await until("it is live again", async () => (await tile(page, "server")) === "live");
    // What the browser itself says of a server that is away is no fault of the page.
    page.complaints = page.complaints.filter((text) => !/net::ERR_/.test(text));
  });

  test("nothing was against the policy, nothing failed", () => assert.deepEqual(page.complaints, []));
});

describe("with --allow-commands", () => {
  let daemon, dashboard, page;
  before(async () => {
    daemon = startDaemon(tumbling());
    dashboard = await startDashboard({ more: ["--allow-commands"] });
    page = await open(dashboard.url);
    await until("the form is on", () => page.locator("#pulse button").isEnabled());
  });
  after(async () => {
    await page?.context().close();
    await stop(dashboard);
    await stop(daemon);
  });

  test("a pulse goes by keyboard alone, and its verdict comes", async () => {
    await page.locator("#pulse select").focus();
    for (const text of ["0", "0.02", "0.05", "0.5"]) {
      await page.keyboard.press("Tab");
      await page.keyboard.type(text);
    }
    await page.keyboard.press("Enter");
    const answer = page.locator("#pulse-answer");
    await until("the verdict", async () => /applied by 'fly'/.test(await answer.textContent()));
    assert.match(await answer.textContent(), /torque \[0, 0.02, 0.05\] N m/);
    await until("the table has it", async () => /✓ applied/.test(await page.locator("#verdicts tbody tr").first().textContent()));
    const metrics = (await ask(dashboard.port, "/metrics")).text;
    assert.match(metrics, /adstar_verdicts_total\{service="fly",verdict="applied"\} 1/);
  });

  test("wrong commands are told what is wrong", async () => {
    const send = (body, type = "application/json", origin = dashboard.url.slice(0, -1)) =>
      ask(dashboard.port, "/command", { method: "POST", headers: { Origin: origin, "Content-Type": type }, body });
    assert.equal((await send("{")).status, 400);
    assert.match((await send('{"spacecraft":"sat1","actuator":"body","torque_n_m":[0,0],"duration_s":1}')).text, /three numbers/);
    assert.equal((await send("{}", "text/plain")).status, 403);
    assert.equal((await send("{}", "application/json", "http://example.org")).status, 403);
    assert.match((await send('{"spacecraft":"sat1","actuator":"nose","torque_n_m":[0,0,1],"duration_s":1}')).text, /unknown_actuator|no actuator|actuator/);
  });

  for (const scheme of ["light", "dark"]) {
    for (const width of [1280, 390]) {
      test(`fits ${width} pixels, ${scheme}`, async () => {
        const shown = await open(dashboard.url, { viewport: { width, height: 844 }, colorScheme: scheme });
        await until("telemetry", async () => (await stepOf(shown)) > 0);
        await shown.waitForTimeout(6000);
        await shown.screenshot({ path: join(shots, `${width}-${scheme}.png`), fullPage: true });
        const beyond = await shown.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        assert.ok(beyond <= 0, `${beyond} pixels too wide`);
        assert.deepEqual(shown.complaints, []);
        await shown.context().close();
      });
    }
  }

  test("Ctrl-C ends the server, whoever still follows", async () => {
    assert.equal(await stop(dashboard), 0);
  });
});

describe("a fleet of 10,000", () => {
  let daemon, dashboard, page;
  before(async () => {
    daemon = startDaemon(fleet(10_000));
    dashboard = await startDashboard();
    page = await open(dashboard.url);
    await until("the table is full", async () => /^10,000 spacecraft/.test(await page.locator("#fleet-count").textContent()), 60_000);
  });
  after(async () => {
    await page?.context().close();
    await stop(dashboard);
    await stop(daemon);
  });

  test("has only the rows in sight in the page", async () => {
    assert.ok((await page.locator(".grid-row").count()) < 60);
  });

  test("sorts, filters and is chosen from by keyboard", async () => {
    const first = () => page.locator('.grid-row[aria-rowindex="1"] .name').textContent();
    const name = await first();
    await page.locator('[data-key="name"] button').click();
    await until("descending", async () => (await first()) !== name);
    await page.locator("#fleet-filter").fill(name);
    await until("filtered", async () => (await first()) === name);
    await page.locator("#fleet .grid-table").focus();
    await page.keyboard.press("Enter");
    await until("it is watched", async () => (await page.locator("#watched-title").textContent()).includes(name));
    assert.equal((await frameOf(dashboard.port, `?spacecraft=${name}`)).spacecraft.name, name);
    await page.locator("#fleet-filter").fill("");
    await page.locator("#fleet .grid-table").focus();
    await page.keyboard.press("End");
    await page.keyboard.press("PageUp");
    await page.locator("#fleet-card").screenshot({ path: join(shots, "fleet.png") });
    assert.deepEqual(page.complaints, []);
  });
});

describe("timing", () => {
  test("how often a part took how long stands over those times", async (context) => {
    const fake = await startFakeHour(join(page_directory, "dist"), 1000);
    context.after(() => fake.close());
    const page = await open(fake.url);
    const pathsOf = (kind) => page.evaluate((kind) => [...document.querySelectorAll(`#timing svg[role=img] path.${kind}`)].map((path) => path.getAttribute("d")), kind);
    let drawn = [];
    await until("each part has its columns", async () => (drawn = await pathsOf("often")).length === 4 && drawn[0].split("M").length > 20);
    const grid = await pathsOf("grid");
    const [least_x, most_x] = [grid[0], grid.at(-1)].map((line) => Number(/M([\d.]+)/.exec(line)[1]));
    const ns = (x) => 1e2 * (1e9 / 1e2) ** ((x - least_x) / (most_x - least_x));
    for (const path of drawn) {
      const columns = [...path.matchAll(/M([\d.]+),[\d.]+v-([\d.]+)H([\d.]+)V/g)].map(([, from, height, to]) => ({ from: ns(Number(from)), height: Number(height), to: ns(Number(to)) }));
      const tallest = columns.reduce((a, b) => (b.height > a.height ? b : a));
      // 45 and 54 of 32 parts of the octave that begins at 2^15 ns.
      assert.ok(Math.abs(tallest.from / 46_080 - 1) < 1e-6 && Math.abs(tallest.to / 55_296 - 1) < 1e-6, JSON.stringify(tallest));
      for (const [i, { height, to }] of columns.slice(0, -1).entries()) {
        const next = columns[i + 1];
        assert.ok(Math.abs(next.from / to - 1) < 1e-6, `a gap at ${to} ns`);
        assert.ok(next.from <= tallest.from ? next.height >= height : next.height <= height, `${height}, then ${next.height} at ${to} ns`);
      }
    }
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  });
});

describe("an hour of data", () => {
  test("stays under 50 MB", async (context) => {
    const fake = await startFakeHour(join(page_directory, "dist"));
    context.after(() => fake.close());
    const page = await open(fake.url);
    await until("the hour is there", async () => (await page.evaluate(() => window.adstar.samples())) >= 36_000, 120_000);
    await page.locator('#window input[value="3600"]').check();
    await page.waitForTimeout(3000);
    await until("the view knows how often it may be drawn", async () => page.evaluate(() => window.adstar.settled()), 60_000);
    const session = await page.context().newCDPSession(page);
    await session.send("HeapProfiler.collectGarbage");
    const heap = await session.send("Runtime.getHeapUsage");
    const buffers = heap.backingStorageSize ?? 0;
    const used_mb = (heap.usedSize + buffers) / 1e6;
    await session.send("Performance.enable");
    const busy_s = async () => (await session.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration").value;
    const busy_before_s = await busy_s();
    const frames = await page.evaluate(
      () =>
        new Promise((resolve) => {
          const times = [], drawn = window.adstar.drawn();
          const frame = (now) => {
            times.push(now);
            if (now - times[0] < 5000) {
              requestAnimationFrame(frame);
            } else {
              const gaps = times.slice(1).map((t, i) => t - times[i]).sort((a, b) => a - b);
              resolve({ count: gaps.length, fps: (1000 * gaps.length) / (now - times[0]), p95_ms: gaps[Math.floor(gaps.length * 0.95)], pictures: (1000 * (window.adstar.drawn() - drawn)) / (now - times[0]) });
            }
          };
          requestAnimationFrame(frame);
        }),
    );
    const busy_ms = (1000 * ((await busy_s()) - busy_before_s)) / frames.count;
    console.log(
      `an hour of data: ${used_mb.toFixed(1)} MB of heap and buffers; main thread ${busy_ms.toFixed(1)} ms a frame; ` +
        `${frames.fps.toFixed(1)} frames/s, p95 ${frames.p95_ms.toFixed(1)} ms, with every pixel drawn by the processor; ` +
        `${frames.pictures.toFixed(1)} pictures of the spacecraft a second`,
    );
    await page.screenshot({ path: join(shots, "hour.png") });
    assert.ok(used_mb < 50, `${used_mb} MB`);
    await page.context().close();
  });
});

function fleet(count) {
  return `[simulation]
step = "100ms"
[[spacecraft]]
name = "cube{:05}"
count = ${count}
seed = 2026
inertia_body_kg_m2 = { min = [0.030, 0.030, 0.010], max = [0.036, 0.036, 0.020] }
attitude_body_to_inertial = "uniform"
angular_velocity_body_rad_s = { min = [-0.1, -0.1, -0.1], max = [0.1, 0.1, 0.1] }
[telemetry]
fleet_hz = 1
spacecraft = ["cube00000"]
[budget]
admission = "warn"
[dds]
partition = "${partition}"
interface = "lo"
`;
}
