// What a person reads at a coil, in text and inside XML.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Copy, cases, fixture, realFile } from "./gradus.mjs";

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
