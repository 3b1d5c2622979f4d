// Packages the extension for this platform, with the language server inside:
//
//   npm run package                          -> gradus-linux-x64.vsix
//   GRADUS=path/to/gradus npm run package    with another executable than target/release/gradus
//   npm run package -- --out FILE            to another place
import { spawnSync } from "node:child_process";
import { chmodSync, copyFileSync, existsSync, mkdirSync, rmSync } from "node:fs";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const here = new URL("..", import.meta.url);
const at = (path) => fileURLToPath(new URL(path, here));

const windows = process.platform === "win32";
const executable = windows ? "gradus.exe" : "gradus";
const platform = `${process.platform}-${process.arch}`;

const { values } = parseArgs({ options: { out: { type: "string", default: at(`gradus-${platform}.vsix`) } } });
const out = resolve(values.out);

const built = process.env.GRADUS ? resolve(process.env.GRADUS) : at(`../../target/release/${executable}`);
if (!existsSync(built)) {
  console.error(
    `${built}: no such file. Build it with \`cargo build --release -p gradus\`, or say where it is in GRADUS.`,
  );
  process.exit(1);
}

rmSync(at("server"), { recursive: true, force: true });
mkdirSync(at("server"));
copyFileSync(built, at(`server/${executable}`));
chmodSync(at(`server/${executable}`), 0o755);
for (const licence of ["LICENSE-MIT", "LICENSE-APACHE"]) {
  copyFileSync(at(`../../${licence}`), at(licence));
}

const run = (script, ...options) => {
  const { status, error } = spawnSync(process.execPath, [script, ...options], { cwd: at("."), stdio: "inherit" });
  if (error) throw error;
  if (status !== 0) process.exit(status ?? 1);
};
run(at("scripts/build.mjs"));
// The bundle holds every dependency, so none is packaged.
run(
  at("node_modules/@vscode/vsce/vsce"),
  ...["package", "--no-dependencies", "--allow-missing-repository", "--skip-license"],
  ...["--target", platform, "--out", out],
);
