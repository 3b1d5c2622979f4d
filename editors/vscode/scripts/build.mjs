// Bundles the extension into dist/extension.js, the one file that the editor loads,
// and brings the example program along.
import { copyFileSync, mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = new URL("..", import.meta.url);
const at = (path) => fileURLToPath(new URL(path, here));

await build({
  entryPoints: [at("src/extension.ts")],
  outfile: at("dist/extension.js"),
  bundle: true,
  platform: "node",
  format: "cjs",
  target: "node20",
  external: ["vscode"],
  minify: true,
  sourcemap: "linked",
  sourcesContent: false,
  logLevel: "warning",
});

mkdirSync(at("examples"), { recursive: true });
copyFileSync(at("../../fixtures/neutralization/neutralization.ladder"), at("examples/neutralization.ladder"));
