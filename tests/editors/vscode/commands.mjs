// The commands of the palette, and the item in the status bar.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { Copy, cases, fixture, realFile } from "./gradus.mjs";
import { until } from "./workbench.mjs";

const { neutralization, real } = cases;

export function commands(at) {
  const newTank = (name) => new Copy(at.workbench.folder, name, fixture(neutralization.file));

  test("the spec is created, and the status bar says that it is in step", async () => {
    const { editor } = at;
    const tank = newTank("convert");
    await editor.open(tank.ladder);
    await editor.verdictIs(/no spec/);
    await editor.run("Gradus: Create the Spec or Bring It up to Date");
    await editor.text(tank.spec).waitFor();
    await editor.verdictIs(/in step/);
    await editor.saveAll();
    assert.equal(tank.read(tank.spec), tank.specWith());
    await editor.picture("in-step");
  });

  test("all handovers are accepted at once", async () => {
    const { editor } = at;
    const tank = newTank("handovers");
    await editor.open(tank.ladder);
    await editor.run("Gradus: Accept All Handovers");
    await editor.text(tank.spec).waitFor();
    await editor.isDirty(tank.spec);
    await editor.saveAll();
    assert.equal(tank.read(tank.spec), tank.specWith("--accept", "handover"));
  });

  test("all that sequences show is accepted at once", async () => {
    const { editor } = at;
    const tank = newTank("witnessed");
    await editor.open(tank.ladder);
    await editor.verdictIs(/no spec/);
    await editor.run("Gradus: Accept All That Sequences Show");
    await editor.text(tank.spec).waitFor();
    await editor.isDirty(tank.spec);
    await editor.saveAll();
    assert.equal(tank.read(tank.spec), tank.specWith("--accept", "witnessed"));
  });

  test("the conditions of all coils are shown", async () => {
    const { editor } = at;
    const tank = newTank("conditions");
    await editor.open(tank.ladder);
    await editor.run("Gradus: Show the Conditions of All Coils");
    await editor.text(`${tank.ladder}.txt`).waitFor();
    await editor.shows(`${tank.ladder}.txt`, "Open valve v1");
  });

  test("sequences are searched, and the hover tells in which a state was seen to follow", async () => {
    const { editor } = at;
    const tank = newTank("searched");
    await editor.open(tank.ladder);
    await editor.goTo(...tank.place("(v2 +", 1));
    await editor.run("Gradus: Search for Sequences That Show What Follows What");
    await editor.hover("seen after: on s; on ls2");
  });

  const export_ = realFile(real.file);
  test("the ladder of a real L5X export is shown as text", { skip: export_ ? false : "no corpus" }, async () => {
    const { editor, workbench } = at;
    const belt = new Copy(workbench.folder, "text", export_);
    await editor.open(belt.ladder);
    await editor.run("Gradus: Open the Ladder of an XML File as Text");
    await editor.text(`${belt.ladder}.ladder`).waitFor();
    await editor.shows(`${belt.ladder}.ladder`, "program ");
    await editor.picture("ladder-of-xml");
  });

  test("a report for a bug names the versions", async () => {
    const { editor } = at;
    const tank = newTank("report");
    await editor.open(tank.ladder);
    await editor.verdictIs(/no spec/);
    await editor.run("Gradus: Write a Report for a Bug");
    await until("an untitled report", () => editor.holds(/extension \d+\.\d+\.\d+/));
  });

  test("commands about a ladder are not offered where there is none", async () => {
    const { editor } = at;
    await editor.openPalette("Gradus: ");
    const offered = await editor.offered();
    assert.ok(offered.some((name) => name.includes("Restart the Language Server")), offered.join("\n"));
    assert.ok(!offered.some((name) => name.includes("Accept All Handovers")), offered.join("\n"));
    await editor.keys.press("Escape");
  });
}
