// What a person decides about a ladder, by keyboard, and the spec that comes of it. What
// is saved is compared with what the command line writes for the same decisions.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Copy, cases, fixture, gradus } from "./gradus.mjs";

const { neutralization } = cases;

export function decisions(at) {
  const newTank = (name) => new Copy(at.workbench.folder, name, fixture(neutralization.file));
  const together = /Accept v1 -> .*together/;

  test("v1 -> v2, h and m are accepted together, and the spec appears beside the ladder", async () => {
    const { editor } = at;
    const tank = newTank("accept");
    await editor.open(tank.ladder);
    await editor.goTo(...tank.place("-> v1", 3));
    await editor.act(together);
    // The spec is new, so it opens, and the cursor stays where it is.
    await editor.text(tank.spec).waitFor();
    await editor.isAt(...tank.place("-> v1", 3));
    assert.ok(await editor.text(tank.ladder).isVisible(), "the ladder has been covered");
    await editor.saveAll();
    assert.equal(tank.read(tank.spec), tank.specWith("--accept", neutralization.together.pair));
    assert.equal(tank.read(tank.ladder), tank.original);
    await editor.picture("accepted");
    await editor.goTo(...tank.place("(v2 +", 1));
    await editor.withoutSideBar(async () => {
      await editor.hover("Open valve v2");
      await editor.picture("beside");
    });
  });

  test("a spec that is open changes beside the ladder, and undo takes it back", async () => {
    const { editor } = at;
    const tank = newTank("undo");
    gradus("convert", tank.ladder);
    const before = tank.read(tank.spec);
    await editor.open(tank.ladder);
    await editor.run("Gradus: Open the Spec beside the Ladder");
    await editor.text(tank.spec).waitFor();
    await editor.focus(tank.ladder);
    await editor.goTo(...tank.place("-> v1", 3));
    await editor.act(together);
    await editor.isDirty(tank.spec);
    await editor.saveAll();
    assert.equal(tank.read(tank.spec), tank.specUpdated(before, "--accept", neutralization.together.pair));
    await editor.focus(tank.spec);
    await editor.keys.press("Control+z");
    await editor.isDirty(tank.spec);
    await editor.saveAll();
    assert.equal(tank.read(tank.spec), before);
  });

  test("a succession is rejected, and the spec remembers it", async () => {
    const { editor } = at;
    const tank = newTank("reject");
    gradus("convert", tank.ladder);
    await editor.open(tank.ladder);
    await editor.goTo(...tank.place("-> v1", 3));
    await editor.act(/Reject v1 -> v4/);
    await editor.isDirty(tank.spec);
    await editor.saveAll();
    assert.ok(tank.read(tank.spec).split("\n").includes(neutralization.rejected.decision), tank.read(tank.spec));
    // Nothing else of the spec may change, and the command line finds nothing to do.
    const rest = tank.read(tank.spec).split("\n").filter((line) => !line.startsWith("//!"));
    assert.equal(rest.join("\n").trimEnd(), tank.specWith().trimEnd());
  });

  test("a rung that is edited makes rules stale, and the light bulb mends them", async () => {
    const { editor } = at;
    const tank = newTank("stale");
    gradus("convert", tank.ladder, "--accept", neutralization.together.pair);
    await editor.open(tank.ladder);
    await editor.run("Gradus: Open the Spec beside the Ladder");
    await editor.text(tank.spec).waitFor();
    await editor.findings("warning", 0);
    // v1 is now closed by the upper level.
    await editor.focus(tank.ladder);
    await editor.goTo(...tank.place("/ls2                       -> v1", 1));
    await editor.replace("ls2".length, "ls3");
    await editor.verdictIs(/behind/);
    await editor.focus(tank.spec);
    await editor.nextFinding();
    await editor.underlined(tank.spec, "warning").first().waitFor();
    await editor.picture("stale");
    await editor.mendAll(/Take over what the ladder gives/);
    await editor.verdictIs(/in step/);
    await editor.saveAll();
    const edited = tank.original.replace("(s + v1) * /ls2 ", "(s + v1) * /ls3 ");
    assert.equal(tank.read(tank.ladder), edited);
    assert.deepEqual(tank.findings(), []);
    assert.equal(tank.read(tank.spec), tank.specWith("--accept", neutralization.together.pair));
  });

  test("the spec's next line is offered as ghost text, and Tab takes it", async () => {
    const { editor } = at;
    const tank = newTank("ghost");
    gradus("convert", tank.ladder);
    const before = tank.read(tank.spec);
    await editor.open(tank.spec);
    await editor.verdictIs(/in step/);
    await editor.keys.press("Control+End");
    await editor.keys.press("Enter");
    await editor.keys.type("//! acc");
    await editor.takeGhost(tank.spec, neutralization.together.decision);
    await editor.saveAll();
    const written = tank.read(tank.spec);
    assert.equal(written, `${before}\n${neutralization.together.decision}`);
    const updated = tank.specUpdated(before, "--accept", neutralization.together.pair);
    assert.equal(tank.specUpdated(`${written}\n`), updated);
  });

  test("a rename changes ladder and spec together", async () => {
    const { editor } = at;
    const tank = newTank("rename");
    gradus("convert", tank.ladder, "--accept", neutralization.together.pair);
    await editor.open(tank.ladder);
    await editor.goTo(...tank.place("-> v2", 3));
    await editor.rename("dose");
    await editor.isDirty(tank.ladder);
    await editor.saveAll();
    const renamed = tank.original
      .replace("output v2 ", "output dose ")
      .replace("(v2 + ls2", "(dose + ls2")
      .replace("-> v2", "-> dose");
    assert.equal(sameButBlanks(tank.read(tank.ladder)), sameButBlanks(renamed));
    assert.match(tank.read(tank.spec), /for dose\b/);
    assert.match(tank.read(tank.spec), /^\/\/! accept v1 -> dose & h & m$/m);
    assert.deepEqual(tank.findings(), []);
  });

  test("Windows line ends stay", async () => {
    const { editor } = at;
    const tank = newTank("crlf");
    writeFileSync(tank.ladder, tank.original.replaceAll("\n", "\r\n"));
    gradus("convert", tank.ladder);
    writeFileSync(tank.spec, tank.read(tank.spec).replaceAll(/\r?\n/g, "\r\n"));
    await editor.open(tank.ladder);
    await editor.goTo(...tank.place("-> v1", 3));
    await editor.act(together);
    await editor.isDirty(tank.spec);
    await editor.saveAll();
    const spec = tank.read(tank.spec);
    assert.ok(spec.includes(`${neutralization.together.decision}\r\n`), spec);
    assert.doesNotMatch(spec, /[^\r]\n/);
  });
}

/** Columns may be laid out anew; names may not differ. */
const sameButBlanks = (text) => text.replaceAll(/ +/g, " ");
