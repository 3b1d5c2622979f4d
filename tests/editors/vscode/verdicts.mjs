// Whether the spec does what the ladder does, found out while the spec is edited: the finding,
// its actions, the lens and the item in the status bar, and the trace of a difference.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Copy, cases, fixture, gradus } from "./gradus.mjs";
import { until } from "./workbench.mjs";

const { neutralization } = cases;

export function verdicts(at) {
  /** A copy of the tank in a folder of its own, the sequence drawn by hand beside it, without the rule of a label. */
  const newTank = (name, without) => {
    const folder = join(at.workbench.folder, name);
    mkdirSync(folder);
    writeFileSync(join(folder, "gradus.toml"), "verify.enable = true\n");
    const tank = new Copy(folder, name, fixture(neutralization.file));
    const lines = readFileSync(fixture(neutralization.sequence), "utf8").split("\n");
    const kept = lines.filter((line) => !line.startsWith(`${without}:`));
    writeFileSync(tank.spec, kept.join("\n"));
    return tank;
  };

  test("a difference is found, and a rule about the plant excludes it", async () => {
    const { editor } = at;
    const tank = newTank("excluded", "e1");
    await editor.open(tank.spec);
    await editor.hasLens(tank.spec, "different after 2 scans: h, m");
    await editor.verdictIs(/different/);
    await editor.picture("verdict-different");
    const action = readFileSync(tank.spec, "utf8").split("\n").indexOf("Xh: |- h");
    await editor.goTo(action + 1, 8);
    await editor.act(/ls1 is on whenever ls2 is/);
    await editor.verdictIs(/equivalent/);
    await editor.goTo(1, 1);
    await editor.hasLens(tank.spec, "equivalent under 7 rules");
    await editor.saveAll();
    assert.match(readFileSync(tank.spec, "utf8"), /^e1: ls2 \|- ls1 {2}\/\/ ls1 is on whenever ls2 is$/m);
    assert.match(gradus("verify", tank.ladder, tank.spec), /^equivalent: 8 outputs equal/);
  });

  test("the trace of a difference is shown, follows the spec, and becomes a scenario", async () => {
    const { editor } = at;
    const tank = newTank("traced", "e6");
    // What was seen at the plant tells which rules may be facts.
    const table = readFileSync(fixture("fixtures/neutralization/table-2.scenario"), "utf8");
    writeFileSync(join(at.workbench.folder, "traced/seen.scenario"), table.replace("neutralization.ladder", "traced.ladder"));
    await editor.open(tank.spec);
    await editor.hasLens(tank.spec, "different after 4 scans: v1");
    await editor.run("Gradus: Verify That the Spec Does What the Ladder Does");
    await editor.shows(`${tank.spec}.txt`, "different (scan): v1 differs after 4 scans");
    await editor.picture("verdict-trace");
    await editor.focus(tank.spec);
    const action = readFileSync(tank.spec, "utf8").split("\n").indexOf("Xv1: |- v1");
    await editor.goTo(action + 1, 9);
    await editor.act(/Add this trace as a scenario/);
    const scenario = join(at.workbench.folder, "traced/traced-trace.scenario");
    const isWritten = () => existsSync(scenario) && readFileSync(scenario, "utf8").includes("\nfor traced.ladder, traced.grafcet\n");
    // The editor saves what it writes into files that are not open.
    await until("the scenario is written", isWritten);
    // On the ladder alone it passes: what it expects is what the ladder does.
    gradus("simulate", tank.ladder, scenario);
    await editor.act(/s is off in the scan after one with v3 on/);
    await editor.shows(`${tank.spec}.txt`, "equivalent: 8 outputs equal");
  });
}
