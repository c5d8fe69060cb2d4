// Builds what ships in src/shared/studio/shell: three classic scripts, onnxruntime's WebAssembly without
// and with WebGPU, the licences of both libraries. `npm ci && npm run build`.

import { build } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const shell = new URL("../src/shared/studio/shell/", import.meta.url);
const modules = new URL("node_modules/", import.meta.url);
const { outputFiles } = await build({
  entryPoints: { studio: "src/main.js", helper: "src/processor.js", graphics: "src/graphics.js" },
  outdir: "out", // nothing is put there
  bundle: true,
  write: false,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  // onnxruntime takes the glue code that it was bundled with where it comes from the page's own
  // origin, and makes up the address of a file that it never asks for. A page from a disk and a
  // worker made of text have neither, so both are given here.
  banner: { js: 'var studioAddress="studio://page/studio.js",studioOrigin="null";' },
  define: { "import.meta.url": "studioAddress", "location.origin": "studioOrigin" },
});
for (const { path, text } of outputFiles) {
  const script = text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--"), name = path.split(/[\\\\/]/u).pop();
  writeFileSync(new URL(name, shell), script);
  console.log(`${name} ${script.length} bytes`);
}
for (const [from, to] of [["", ""], [".asyncify", "-webgpu"]]) {
  const wasm = readFileSync(new URL(`onnxruntime-web/dist/ort-wasm-simd-threaded${from}.wasm`, modules));
  writeFileSync(new URL(`onnxruntime${to}.wasm.gz`, shell), gzipSync(wasm, { level: 9 }));
  console.log(`onnxruntime${to} ${wasm.length} bytes`);
}
const notices = ["three/LICENSE", "../licences/onnxruntime.txt"].map((name) => readFileSync(new URL(name, modules), "utf8"));
const licences = `three.js\n\n${notices[0]}\n\nonnxruntime\n\n${notices[1]}`;
writeFileSync(new URL("licences.txt.gz", shell), gzipSync(licences, { level: 9 }));
