// Words that mean something only in some places, and statements that end where they should.
import assert from "node:assert/strict";
import test from "node:test";
import { grammarOfLanguage, tokenize } from "./grammars.mjs";

/** The innermost scope of the first token of that text in each line. */
async function scopes(language, text, word) {
  const lines = tokenize(await grammarOfLanguage(language), text);
  return lines.map((tokens) =>
    tokens
      .find((token) => token.text.trim() === word)
      ?.scopes.at(-1)
      .replace(/\.gradus$/, ""),
  );
}

const cases = [
  ["gradus-ladder", "set before a name writes", "rung: s -> set alarm", "set", "keyword.other.write"],
  ["gradus-ladder", "a coil may be called set", "rung: s -> set, alarm", "set", "variable.other.coil"],
  ["gradus-ladder", "a contact may be called reset", "rung: reset -> alarm", "reset", "variable.other"],
  ["gradus-ladder", "rise before a parenthesis is an edge", "rung: rise(a) -> b", "rise", "support.function.edge"],
  ["gradus-ladder", "a variable may be called rise", "rung: rise*a -> b", "rise", "variable.other"],
  ["gradus-ladder", "Rung in capitals begins a rung", "RUNG: a -> b", "RUNG", "keyword.declaration.rung"],
  ["gradus-ladder", "a name that begins with a keyword is a name", "rung: rungs -> b", "rungs", "variable.other"],
  ["gradus-ladder", "a title is a string", 'rung "Fill": a -> b', '"Fill"', "string.quoted.double.title"],
  ["gradus-ladder", "a quoted name is a variable", 'rung: "my tag" -> b', '"my tag"', "variable.other.quoted"],
  ["gradus-ladder", "names of any script", "rung: Größe -> b", "Größe", "variable.other"],
  ["gradus-ladder", "an assignment's slash divides", "rung: a -> x := y / 2", "/", "keyword.operator.arithmetic"],
  ["gradus-ladder", "a coil's slash negates", "rung: a -> /b", "/", "keyword.operator.not"],
  ["gradus-ladder", "a time of several parts", "variable d : TIME = 1m30s", "1m30s", "constant.numeric.time"],
  ["gradus-ladder", "a number of another base", "constant most = 16#FF", "16#FF", "constant.numeric"],
  ["grafcet", "words in any case", "STEP p1", "STEP", "keyword.declaration.step"],
  ["grafcet", "a quoted word is a name", 't1: "for"*a |- @p1', '"for"', "variable.other.quoted"],
  ["grafcet", "on after an action is its moment", "p2: |- set a on deactivation", "on", "keyword.other.moment"],
  ["grafcet", "force all", "p2: |- force G1{*}", "*", "constant.language.situation"],
  ["grafcet", "time in a step", "t1: 5s/p1 |- @p2", "5s", "constant.numeric.time"],
  ["grafcet", "what was decided", "//! accept v1 -> v2 & h", "accept", "keyword.other.decision"],
  ["grafcet", "any other comment is a comment", "//! hello", "//! hello", undefined],
  ["gradus-scenario", "an expectation", "on s => off v1", "off", "keyword.other.event"],
  ["neutral-text", "a contact", "XIC(a)OTE(b);", "XIC", "support.function.contact"],
  ["neutral-text", "a coil", "XIC(a)OTE(b);", "OTE", "support.function.coil"],
  ["neutral-text", "an add-on instruction", "Jam(J1,a);", "Jam", "entity.name.function.box"],
  [
    "neutral-text",
    "a member of an array of the input image",
    "XIC(Local:1:I.Data[3].2);",
    "Local:1:I.Data[3].2",
    "variable.other",
  ],
];
for (const [language, what, text, word, scope] of cases) {
  test(`${language}: ${what}`, async () => assert.deepEqual(await scopes(language, text, word), [scope]));
}

test("an open parenthesis reaches no further than its rung", async () => {
  const text = "rung: (s + t\n\nrung: u -> v";
  assert.deepEqual(await scopes("gradus-ladder", text, "rung"), [
    "keyword.declaration.rung",
    undefined,
    "keyword.declaration.rung",
  ]);
});

test("a rung goes on until the next statement", async () => {
  const text = 'rung "Long":\n    a\n    * b\n    -> v1\noutput v1';
  assert.deepEqual(await scopes("gradus-ladder", text, "v1"), [
    undefined,
    undefined,
    undefined,
    "variable.other.coil",
    "variable.other.declaration",
  ]);
});

test("a list goes on after a comma", async () => {
  const text = "Step p1,\n     p2\nInput p2";
  assert.deepEqual(await scopes("grafcet", text, "p2"), [undefined, "entity.name.step", "variable.other"]);
});
