// What the server tells of names beyond the protocol's own types and modifiers must be
// known to the editor, or it has no colour for it. The server's page lists it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

const at = (path) => readFileSync(new URL(path, import.meta.url), "utf8");
const { contributes } = JSON.parse(at("../package.json"));
const page = at("../../../docs/protocol.md");

test("types of names beyond the protocol's are contributed, and shown as variables at worst", () => {
  const [, said] = /Most types are the protocol's; (.*) are not/.exec(page) ?? [];
  const types = [...said.matchAll(/`(\w+)`/g)].map(([, id]) => id);
  assert.deepEqual(
    contributes.semanticTokenTypes.map(({ id, superType }) => [id, superType]),
    types.map((id) => [id, "variable"]),
  );
});

test("modifiers beyond the protocol's are contributed", () => {
  const modifiers = [...page.matchAll(/^\| `(\w+)` \|.*\(not the protocol's own\) \|$/gm)].map(([, id]) => id);
  assert.ok(modifiers.length > 0, "the page lists none");
  assert.deepEqual(
    contributes.semanticTokenModifiers.map(({ id }) => id),
    modifiers,
  );
});

test("each of them has a colour", () => {
  const [{ scopes }] = contributes.semanticTokenScopes;
  const types = contributes.semanticTokenTypes.map(({ id }) => id);
  const modifiers = contributes.semanticTokenModifiers.map(({ id }) => `*.${id}`);
  assert.deepEqual(Object.keys(scopes), [...types, ...modifiers]);
});
