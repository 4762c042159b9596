// node embed.mjs DIRECTORY FILE.cpp: the files of the directory as bytes of the program.

import { readdirSync, statSync, writeFileSync } from "node:fs";
import { extname, join, relative, resolve, sep } from "node:path";

const types = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".svg": "image/svg+xml",
  ".txt": "text/plain; charset=utf-8",
};

const [directory, output] = process.argv.slice(2).map((argument) => resolve(argument));
const files = readdirSync(directory, { recursive: true })
  .map((name) => join(directory, name))
  .filter((file) => statSync(file).isFile())
  .sort();

const symbols = files.map((file, i) => `asm(".section .rodata\\n"
    ".balign 16\\n"
    ".globl adstar_page_${i}\\n.globl adstar_page_${i}_end\\n"
    "adstar_page_${i}: .incbin \\"${file}\\"\\n"
    "adstar_page_${i}_end:\\n"
    ".previous\\n");
extern "C" const char adstar_page_${i}[], adstar_page_${i}_end[];`);

const entries = files.map((file, i) => {
  const type = types[extname(file)];
  if (type === undefined) {
    throw new Error(`${file}: no content type for it; add one to embed.mjs`);
  }
  const path = "/" + relative(directory, file).split(sep).join("/");
  return `      {"${path}", "${type}", {adstar_page_${i}, size(adstar_page_${i}, adstar_page_${i}_end)}},`;
});

writeFileSync(
  output,
  `// Made by embed.mjs.
#include <array>
#include <cstddef>

#include "service/dashboard/server/page.hpp"

${symbols.join("\n")}

namespace adstar::dashboard {
namespace {
std::size_t size(const char* begin, const char* end) { return static_cast<std::size_t>(end - begin); }
}  // namespace

std::span<const PageFile> page_files() {
  static const std::array<PageFile, ${files.length}> files{{
${entries.join("\n")}
  }};
  return files;
}

}  // namespace adstar::dashboard
`,
);
