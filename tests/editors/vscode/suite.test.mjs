// The extension in a real VS Code. Every case has files of its own and starts with no
// editor open; the workbench is one for all, as it is for a person.
import { after, afterEach, before, describe } from "node:test";
import { commands } from "./commands.mjs";
import { decisions } from "./decisions.mjs";
import { Editor } from "./editor.mjs";
import { folders } from "./folders.mjs";
import { hovers } from "./hovers.mjs";
import { life } from "./life.mjs";
import { scenarios } from "./scenarios.mjs";
import { start } from "./start.mjs";
import { verdicts } from "./verdicts.mjs";
import { virtual } from "./virtual.mjs";
import { startWorkbench } from "./workbench.mjs";

const vsix = process.env.GRADUS_VSIX;
if (!vsix) throw new Error("GRADUS_VSIX does not name the packaged extension; tests/editors/run sets it");

/** What the cases share; filled once the workbench is up. */
const at = {};

describe("VS Code", { timeout: 600_000 }, () => {
  before(async () => {
    at.workbench = await startWorkbench(vsix);
    at.editor = new Editor(at.workbench.page);
  });
  after(() => at.workbench?.stop());
  afterEach(async (context) => {
    if (context.passed === false) await at.editor.picture(`failed-${context.name.replaceAll(/\W+/g, "-")}`);
    await at.editor.closeEverything();
  });

  describe("hovers", () => hovers(at));
  describe("decisions", () => decisions(at));
  describe("commands", () => commands(at));
  describe("folders", () => folders(at));
  describe("scenarios", () => scenarios(at));
  describe("verdicts", () => verdicts(at));
  describe("start of the server", () => start(at, vsix));
  describe("virtual workspaces", () => virtual(vsix));
  describe("life of the server", () => life(at));
});
