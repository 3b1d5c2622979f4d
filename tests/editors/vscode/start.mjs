// How the server is found and what is said when it cannot be run: once, with a button that
// leads on, and never by starting it for ever.
import assert from "node:assert/strict";
import { chmodSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, test } from "node:test";
import { Copy, cases, fixture, gradus } from "./gradus.mjs";
import { startWorkbench, until } from "./workbench.mjs";
import { Editor } from "./editor.mjs";

const { neutralization } = cases;

export function start(at, vsix) {
  afterEach(() => setServer(at.workbench.folder, undefined));

  const newTank = (name) => new Copy(at.workbench.folder, name, fixture(neutralization.file));

  test("a path that leads nowhere is said once, with the way to the setting; mending it starts the server", async () => {
    const { editor, workbench } = at;
    await editor.open(newTank("nowhere").ladder);
    await editor.verdictIs(/no spec/);
    setServer(workbench.folder, "/nowhere/gradus");
    await editor.told(/gradus\.server\.path names \/nowhere\/gradus/);
    await editor.picture("no-server");
    await editor.open(newTank("nowhere-2").ladder);
    assert.equal(await editor.tellings(/names \/nowhere/), 1);
    await editor.answer(/names \/nowhere/, "Open the Setting");
    await editor.showsSetting("gradus.server.path");
    await editor.keys.press("Escape");
    setServer(workbench.folder, undefined);
    await editor.verdictIs(/no spec/);
  });

  test("a file that cannot be run is told from one that can", async () => {
    const { editor, workbench } = at;
    const file = join(workbench.folder, "not-executable");
    writeFileSync(file, "#!/bin/sh\nexec sleep 1000\n");
    chmodSync(file, 0o644);
    await editor.open(newTank("not-executable").ladder);
    await editor.verdictIs(/no spec/);
    setServer(workbench.folder, file);
    await editor.told(/not-executable, which is no file that can be run/);
    await editor.clearMessages();
    setServer(workbench.folder, undefined);
    await editor.verdictIs(/no spec/);
  });

  test("a program that is no language server is started once", async () => {
    const { editor, workbench } = at;
    const { path, starts } = program(workbench.folder, "no-server", "exit 0");
    await editor.open(newTank("no-server").ladder);
    await editor.verdictIs(/no spec/);
    setServer(workbench.folder, path);
    await editor.told(/language server did not start/);
    await editor.open(newTank("no-server-2").ladder);
    assert.equal(starts(), 1);
    assert.equal(await editor.tellings(/language server/), 1);
    await editor.picture("no-language-server");
    await editor.answer(/language server/, "Show the Log");
    assert.equal(await editor.tellings(/server/), 0);
    await editor.logIsOpen("Gradus");
    await editor.keys.press("Control+j");
    setServer(workbench.folder, undefined);
    await editor.verdictIs(/no spec/);
  });

  test("a server that keeps dying is given up, and started again by the button", async () => {
    const { editor, workbench } = at;
    const dies = join(workbench.folder, "dies");
    writeFileSync(dies, "");
    // It answers as it should, and then dies, as long as a file says so.
    const { path, starts } = program(
      workbench.folder,
      "dying",
      `if [ -e ${dies} ]; then (sleep 1; kill -9 $$) & fi\nexec ${realServer(workbench)} "$@"`,
    );
    await editor.open(newTank("dying").ladder);
    await editor.verdictIs(/no spec/);
    setServer(workbench.folder, path);
    await editor.told(/keeps ending/);
    await editor.open(newTank("dying-2").ladder);
    assert.equal(starts(), 5);
    assert.equal(await editor.tellings(/language server/), 1);
    rmSync(dies);
    await editor.answer(/keeps ending/, "Restart");
    await editor.verdictIs(/no spec/);
    setServer(workbench.folder, undefined);
    await editor.verdictIs(/no spec/);
  });

  test("the walkthrough leads to an example, to its conditions and to its spec", async () => {
    const { editor, workbench } = at;
    const path = join(workbench.folder, "neutralization.ladder");
    await editor.runAndPick("Welcome: Open Walkthrough...", "From a ladder to its Grafcet");
    await editor.step("Open a ladder program").waitFor();
    await editor.picture("walkthrough");
    await editor.press("Save and open an example");
    await editor.saveAs(path);
    await editor.text(path).waitFor();
    assert.equal(readFileSync(path, "utf8"), readFileSync(fixture(neutralization.file), "utf8"));
    await editor.verdictIs(/no spec/);
    const walkOn = async (step, button) => {
      await editor.runAndPick("Welcome: Open Walkthrough...", "From a ladder to its Grafcet");
      await editor.step(step).click();
      await editor.press(button);
    };
    await walkOn("Ask a coil what it does", "Show the conditions of all coils");
    await editor.shows(`${path}.txt`, "Open valve v1");
    await editor.open(path);
    await walkOn("Accept what follows what", "Accept all handovers");
    await editor.isDirty(join(workbench.folder, "neutralization.grafcet"));
    await editor.saveAll();
    const spec = readFileSync(join(workbench.folder, "neutralization.grafcet"), "utf8");
    assert.equal(spec, gradus("convert", path, "-o", "-", "--accept", "handover"));
  });

  test("in a folder that nobody trusts, its own settings say nothing about the server", async () => {
    const workbench = await startWorkbench(vsix, { trusted: false });
    try {
      const editor = new Editor(workbench.page);
      const { path, starts } = program(workbench.folder, "evil", "exit 0");
      setServer(workbench.folder, path);
      const tank = new Copy(workbench.folder, "untrusted", fixture(neutralization.file));
      await editor.open(tank.ladder);
      await editor.verdictIs(/no spec/);
      await editor.goTo(...tank.place("-> v2", 3));
      const said = await editor.hover(neutralization.hover.shows[0]);
      assert.ok(said.includes(neutralization.hover.shows[0]), said);
      assert.equal(starts(), 0);
      await editor.picture("untrusted");
    } finally {
      await workbench.stop();
    }
  });
}

/** Has the folder's own settings name the server, or no longer. */
function setServer(folder, path) {
  mkdirSync(join(folder, ".vscode"), { recursive: true });
  const settings = path === undefined ? {} : { "gradus.server.path": path };
  writeFileSync(join(folder, ".vscode/settings.json"), JSON.stringify(settings));
}

/** The executable inside the extension. */
function realServer({ extensions }) {
  const own = readdirSync(extensions).find((name) => name.includes("gradus"));
  return join(extensions, own, "server/gradus");
}

/** A shell script that counts how often it is started. */
function program(folder, name, script) {
  const [path, log] = [join(folder, name), join(folder, `${name}.starts`)];
  writeFileSync(path, `#!/bin/sh\necho x >> ${log}\n${script}\n`);
  chmodSync(path, 0o755);
  const starts = () => (existsSync(log) ? readFileSync(log, "utf8").split("\n").length - 1 : 0);
  return { path, starts };
}
