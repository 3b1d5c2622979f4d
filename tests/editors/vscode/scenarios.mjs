// A scenario beside its ladder: findings while the ladder is typed in, the action that mends
// them, the table of scans, and a scan shown in the ladder.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Copy, cases, fixture, gradus } from "./gradus.mjs";
import { until } from "./workbench.mjs";

const held = "(s + v1)";

export function scenarios(at) {
  /** A copy of the tank with a scenario of its name beside it. */
  const newTank = (name) => {
    const tank = new Copy(at.workbench.folder, name, fixture(cases.neutralization.file));
    const scenario = join(at.workbench.folder, `${name}.scenario`);
    writeFileSync(scenario, "on s => only on v1\noff s => only\n");
    return { tank, scenario };
  };
  /** Has the valve v1 no longer hold itself, unsaved. */
  const breakLadder = async (tank) => {
    await at.editor.open(tank.ladder);
    await at.editor.goTo(...tank.place(held));
    await at.editor.replace(held.length, "s");
  };

  test("an expectation fails while the ladder is edited, and an action takes over what it does", async () => {
    const { editor } = at;
    const { tank, scenario } = newTank("expected");
    await editor.open(scenario);
    await editor.hasLens(scenario, "passes on the ladder");
    await breakLadder(tank);
    await editor.open(scenario);
    await editor.findings("error", 1);
    await editor.hasLens(scenario, "1 expectation not met on the ladder");
    await editor.goTo(2, 1);
    await editor.picture("scenario-fails");
    await editor.act(/Expect what the ladder does/);
    await editor.shows(scenario, "off s => only off v1");
    await editor.findings("error", 0);
    await editor.saveAll();
    assert.equal(readFileSync(scenario, "utf8"), "on s => only on v1\noff s => only off v1\n");
    const { diagnostics } = JSON.parse(gradus("check", "--json", scenario));
    assert.deepEqual(diagnostics, []);
  });

  test("the table of scans is shown, and follows the ladder", async () => {
    const { editor } = at;
    const { tank, scenario } = newTank("table");
    await editor.open(scenario);
    await editor.hasLens(scenario, "passes on the ladder");
    await editor.run("Gradus: Run the Scenario");
    await editor.shows(`${scenario}.txt`, "2 scans; all is as expected");
    await editor.picture("scenario-table");
    await breakLadder(tank);
    await editor.shows(`${scenario}.txt`, "1 expectation not met");
  });

  test("a scan is shown in the ladder and taken back", async () => {
    const { editor } = at;
    const { tank, scenario } = newTank("scan");
    await editor.open(scenario);
    await editor.hasLens(scenario, "passes on the ladder");
    await editor.goTo(1, 1);
    await editor.run("Gradus: Show the Scan at the Cursor in Ladder and Spec");
    await editor.open(tank.ladder);
    await editor.shows(tank.ladder, "●");
    await editor.picture("scan-in-ladder");
    await editor.run("Gradus: Hide the Scan");
    await until("no scan is shown", async () => !(await editor.holds(/●/)));
  });
}
