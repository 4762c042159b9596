// node run.mjs: skips with 77 where there is no browser; `node --test` has no word for that.

import { spawnSync } from "node:child_process";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { requireBrowser } from "./support.mjs";

requireBrowser();
const test = join(dirname(fileURLToPath(import.meta.url)), "dashboard_test.mjs");
const { status } = spawnSync(process.execPath, ["--test-reporter=spec", "--test", test], { stdio: "inherit" });
process.exit(status ?? 1);
