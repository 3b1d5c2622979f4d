// What a person reads at a coil, in text and inside XML.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Copy, cases, fixture, realFile } from "./gradus.mjs";
import { until } from "./workbench.mjs";

const { neutralization, real } = cases;

export function hovers(at) {
  test("a coil of a ladder tells its conditions", async () => {
    const { editor, workbench } = at;
    const tank = new Copy(workbench.folder, "hover", fixture(neutralization.file));
    await editor.open(tank.ladder);
    await editor.goTo(...tank.place("-> v2", 3));
    const said = await editor.hover(neutralization.hover.shows[0]);
    for (const words of neutralization.hover.shows) assert.ok(said.includes(words), `no ${words} in:\n${said}`);
    await editor.picture("hover");
  });

  test("a contact's hover leads to the rung that drives it", async () => {
    const { editor, workbench } = at;
    const tank = new Copy(workbench.folder, "driven", fixture(neutralization.file));
    await editor.open(tank.ladder);
    await editor.goTo(...tank.place("/v3 * ls2", 1));
    await editor.followFromHover(/rung 2/);
    const [line] = tank.place("-> v3");
    await editor.isAt(line, 1);
  });

  test("a word in a hover leads to the page that explains it", async () => {
    const { editor, workbench } = at;
    const tank = new Copy(workbench.folder, "words", fixture(neutralization.file));
    await editor.open(tank.ladder);
    await editor.goTo(...tank.place("-> v2", 3));
    await editor.followFromHover(/^seal-in$/);
    await editor.previews("seal-in.md", "A coil seals itself in");
  });

  const export_ = realFile(real.file);
  test("a coil inside a real L5X export tells its conditions", { skip: export_ ? false : "no corpus" }, async () => {
    const { editor, workbench } = at;
    const belt = new Copy(workbench.folder, "real", export_);
    await editor.open(belt.ladder);
    await editor.goTo(...belt.place(real.hover.written, "OTE(".length));
    const said = await editor.hover(real.hover.shows[0]);
    for (const words of real.hover.shows) assert.ok(said.includes(words), `no ${words} in:\n${said}`);
    await editor.picture("hover-l5x");
  });

  test("a coil is told from a contact, and a state from other variables", async () => {
    const { editor, workbench } = at;
    const tank = new Copy(workbench.folder, "tokens", fixture(neutralization.file));
    await editor.open(tank.ladder);
    await editor.verdictIs(/no spec/);
    for (const [place, into, ...kinds] of [
      ["-> v2", 3, "coil", "state"],
      ["/ls3 * (/tl", 1, "contact"],
      ["/v3 *", 1, "contact", "interlock"],
    ]) {
      await editor.goTo(...tank.place(place, into));
      const told = await editor.tokenAtCursor();
      for (const kind of kinds) assert.match(told, new RegExp(`\\b${kind}\\b`), `at ${place}`);
    }
  });

  test("the page of a finding's code is shown beside it", async () => {
    const { editor, workbench } = at;
    const doubled = new Copy(workbench.folder, "doubled", fixture("fixtures/findings/double-coil.ladder"));
    await editor.open(doubled.ladder);
    await until("a finding", async () => (await editor.underlined(doubled.ladder, "warning").count()) > 0);
    await editor.nextFinding();
    await editor.act(/Explain G2002/);
    await editor.previews("G2002.md", "G2002");
  });

  test("XML that holds no ladder gets no findings, no hover and no status", async () => {
    const { editor, workbench } = at;
    const file = join(workbench.folder, "settings.xml");
    writeFileSync(file, '<?xml version="1.0"?>\n<settings><pump start="1">XIC(a)OTE(b);</pump></settings>\n');
    await editor.open(file);
    await editor.goTo(2, 32);
    assert.equal(await editor.noHover(), true);
    assert.equal(await editor.verdict.count(), 0);
    for (const severity of ["error", "warning", "info"]) assert.equal(await editor.underlined(file, severity).count(), 0);
  });
}
