// The command line as the judge: what an editor writes must be what the same decisions
// give in a terminal.
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, readFileSync, writeFileSync } from "node:fs";
import { extname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const repository = fileURLToPath(new URL("../../../", import.meta.url));
export const executable = resolve(process.env.GRADUS ?? join(repository, "target/release/gradus"));
export const corpus = resolve(process.env.GRADUS_CORPUS ?? join(repository, "../shared/corpus"));
export const cases = JSON.parse(readFileSync(new URL("../cases.json", import.meta.url), "utf8"));

export const fixture = (path) => join(repository, path);
/** A real file, or undefined where there is no corpus; CI must have one. */
export function realFile(path) {
  const file = join(corpus, path);
  if (existsSync(file)) return file;
  if (process.env.CI === "true") throw new Error(`${file}: no such file, and CI=true demands the corpus`);
  return undefined;
}

/** Runs a command that must end with 0, and returns what it printed. */
export function gradus(...options) {
  const { status, stdout, stderr, error } = spawnSync(executable, options, { encoding: "utf8" });
  if (error) throw error;
  if (status !== 0) throw new Error(`gradus ${options.join(" ")} ended with ${status}:\n${stderr}${stdout}`);
  return stdout;
}

/** A copy of a ladder of its own, under a name that no other case uses. */
export class Copy {
  constructor(folder, name, ladder) {
    this.ladder = join(folder, `${name}${extname(ladder)}`);
    this.spec = join(folder, `${name}.grafcet`);
    copyFileSync(ladder, this.ladder);
    this.original = this.read(this.ladder);
  }

  read(path) {
    return readFileSync(path, "utf8");
  }

  /** Line and column, counted from 1, of the first place that holds a text, so many characters into it. */
  place(text, into = 0) {
    const before = this.original.slice(0, this.original.indexOf(text) + into).split("\n");
    if (!this.original.includes(text)) throw new Error(`${this.ladder} does not hold ${text}`);
    return [before.length, before.at(-1).length + 1];
  }

  /** The spec that the command line writes for the ladder as it is saved. */
  specWith(...options) {
    return gradus("convert", this.ladder, "-o", "-", ...options);
  }

  /** What the command line makes of a spec that exists already. */
  specUpdated(spec, ...options) {
    const copy = `${this.spec}.copy`;
    writeFileSync(copy, spec);
    gradus("convert", this.ladder, "-o", copy, ...options);
    return this.read(copy);
  }

  /** What the command line finds in ladder and spec, as they are saved. */
  findings() {
    return JSON.parse(gradus("check", "--json", this.ladder, this.spec)).diagnostics.map(
      ({ code, message }) => `${code} ${message}`,
    );
  }
}
