// How often the view is drawn, over frame times made up: node --test thrift_test.mjs, with ADSTAR_PAGE where the page is built.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { test } from "node:test";

const page = process.env.ADSTAR_PAGE;
const { transformSync } = createRequire(join(page, "package.json"))("esbuild");
const { code } = transformSync(readFileSync(join(page, "src", "thrift.ts"), "utf8"), { loader: "ts", format: "esm" });
const { Thrift } = await import(`data:text/javascript,${encodeURIComponent(code)}`);

const kDisplay_ms = 1000 / 60;

/// A page seen for so long: a frame takes what the display does, or what the page and its share of a picture take.
function watch(thrift, seconds, page_ms, picture_ms, from_ms = 0) {
  let now_ms = from_ms;
  while (now_ms < from_ms + 1000 * seconds) {
    if (thrift.admits(now_ms)) {
      thrift.drew();
    }
    now_ms += Math.max(kDisplay_ms, page_ms(now_ms) + picture_ms(now_ms) / thrift.every);
  }
  return now_ms;
}
const always = (ms) => () => ms;

test("where a picture is cheap each frame has one", () => {
  const thrift = new Thrift();
  watch(thrift, 60, always(3), always(2));
  assert.equal(thrift.every, 1);
  assert.ok(thrift.settled);
});

test("where it takes two frames every third or so has one, and the page keeps its own", () => {
  const thrift = new Thrift();
  watch(thrift, 30, always(3), always(38));
  assert.ok(thrift.every >= 3 && thrift.every <= 4, `every ${thrift.every}`);
});

test("a start that was busy is forgotten", () => {
  const thrift = new Thrift();
  const then = watch(thrift, 3, (ms) => (ms < 1200 ? 25 : 25 - (ms - 1200) / 150), always(2));
  assert.ok(thrift.every > 1, "it looks as if the view was the cause");
  watch(thrift, 120, always(3), always(2), then);
  assert.equal(thrift.every, 1);
});

test("what becomes heavy later is drawn less from then on", () => {
  const thrift = new Thrift();
  const then = watch(thrift, 60, always(3), always(2));
  watch(thrift, 60, always(3), always(60), then);
  assert.ok(thrift.every >= 4, `every ${thrift.every}`);
});

test("the slowest get the most of it", () => {
  for (const picture_ms of [120, 400, 1500]) {
    const thrift = new Thrift();
    watch(thrift, 300, always(3), always(picture_ms));
    assert.ok(thrift.every >= 4, `a picture of ${picture_ms} ms: every ${thrift.every}`);
  }
});

test("a page that is slow by itself keeps its view", () => {
  const thrift = new Thrift();
  let drawn = 0, frames = 0, now_ms = 0;
  while (now_ms < 300_000) {
    const draws = thrift.admits(now_ms);
    if (draws) {
      thrift.drew();
    }
    drawn += draws ? 1 : 0;
    ++frames;
    now_ms += 40;
  }
  assert.ok(drawn > 0.9 * frames, `${drawn} pictures in ${frames} frames`);
});

test("what was found while the page had a lot to load is not for ever", () => {
  const thrift = new Thrift();
  const then = watch(thrift, 20, always(275), always(17));
  assert.equal(thrift.every, 1, "it was not the view");
  watch(thrift, 6, always(3), always(17), then);
  assert.equal(thrift.every, 2);
});

test("time in which nobody saw the page is no frame", () => {
  const thrift = new Thrift();
  let then = watch(thrift, 20, always(3), always(2));
  for (let i = 0; i < 50; ++i) {
    thrift.wake();
    then = watch(thrift, 1, always(3), always(2), then + 3_600_000);
  }
  assert.equal(thrift.every, 1);
});
