// Colours a text the way the editor does: with its own tokenizer and the grammars that
// package.json contributes.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import oniguruma from "vscode-oniguruma";
import textmate from "vscode-textmate";

const extension = new URL("../", import.meta.url);
const contributes = JSON.parse(readFileSync(new URL("package.json", extension), "utf8")).contributes;

const wasm = readFileSync(createRequire(import.meta.url).resolve("vscode-oniguruma/release/onig.wasm"));
await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));

const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async (scopeName) => {
    const grammar = contributes.grammars.find((grammar) => grammar.scopeName === scopeName);
    if (grammar === undefined) return null;
    return textmate.parseRawGrammar(readFileSync(new URL(grammar.path, extension), "utf8"), grammar.path);
  },
});

/** The grammar that the editor takes for a file of this name; undefined if none of the extension's. */
export async function grammarOf(fileName) {
  const language = contributes.languages.find((language) =>
    language.extensions?.some((ending) => fileName.toLowerCase().endsWith(ending.toLowerCase())),
  );
  const grammar = language && contributes.grammars.find((grammar) => grammar.language === language.id);
  return grammar && registry.loadGrammar(grammar.scopeName);
}

export const grammarOfLanguage = (id) =>
  registry.loadGrammar(contributes.grammars.find((grammar) => grammar.language === id).scopeName);

/** The tokens of each line: text and scopes, the outermost first. */
export function tokenize(grammar, text) {
  let state = textmate.INITIAL;
  return text.split(/\r\n|\r|\n/).map((line) => {
    const { tokens, ruleStack } = grammar.tokenizeLine(line, state);
    state = ruleStack;
    return tokens.map(({ startIndex, endIndex, scopes }) => ({ text: line.slice(startIndex, endIndex), scopes }));
  });
}

/** The innermost scope of each visible token, below its line. */
export function show(lines) {
  return lines
    .map((tokens) => {
      const line = `|${tokens.map(({ text }) => text).join("")}`.trimEnd();
      const scopes = tokens
        .filter(({ text }) => text.trim() !== "")
        .map(({ text, scopes }) => `    ${text.trim()}  ${scopes.at(-1).replace(/\.gradus$/, "")}`);
      return [line, ...scopes].join("\n");
    })
    .join("\n");
}
