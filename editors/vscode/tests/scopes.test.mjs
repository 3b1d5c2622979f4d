// Every text of fixtures/ in the colours it gets. What comes out lies in tests/scopes, one
// file a text; `UPDATE=1 npm test` writes them anew, to be read as carefully as code.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import test from "node:test";
import { fileURLToPath } from "node:url";
import { grammarOf, grammarOfLanguage, show, tokenize } from "./grammars.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));
const fixtures = join(here, "../../../fixtures");

/** Texts that are known by no ending, and those that are broken on purpose. */
const pasted = { "rockwell/pasted.txt": "neutral-text" };
const broken = [
  "ladder/errors.ladder",
  "ladder/layout.ladder",
  "ladder/layout.formatted.ladder",
  "rockwell/cut.L5K",
  "rockwell/pasted.txt",
];

const files = [fixtures, join(here, "texts")].flatMap((folder) =>
  readdirSync(folder, { recursive: true }).map((name) => ({
    path: join(folder, name),
    name: relative(folder, join(folder, name)),
  })),
);

let coloured = 0;
for (const { path, name } of files) {
  // Made to be refused, not to be read.
  if (name.startsWith("hostile")) continue;
  const grammar = pasted[name] ? await grammarOfLanguage(pasted[name]) : await grammarOf(name);
  if (!grammar) continue;
  coloured += 1;
  test(`colours of ${name}`, () => {
    const lines = tokenize(grammar, readFileSync(path, "utf8"));

    for (const { text, scopes } of lines.flat()) {
      assert.ok(!scopes.some((scope) => scope.startsWith("invalid")), `${text} has ${scopes.join(" ")}`);
      if (text.trim() === "" || broken.includes(name)) continue;
      assert.ok(!/^(source|meta)\./.test(scopes.at(-1)), `${text} has no colour: ${scopes.join(" ")}`);
    }

    const expected = join(here, "scopes", `${name.replaceAll(/[/\\]/g, ".")}.txt`);
    const found = `${show(lines)}\n`;
    if (process.env.UPDATE === "1") {
      mkdirSync(join(here, "scopes"), { recursive: true });
      writeFileSync(expected, found);
    }
    assert.equal(existsSync(expected) ? readFileSync(expected, "utf8") : "", found);
  });
}

test("the fixtures of every notation are found", () => {
  assert.ok(coloured >= 20, `only ${coloured} texts were coloured`);
});
