// What is told of a folder, by what its gradus.toml says.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Copy, fixture, gradus } from "./gradus.mjs";

export function folders(at) {
  test("files that are not open are told of as the folder's gradus.toml says", async () => {
    const { editor, workbench } = at;
    const plant = join(workbench.folder, "plant");
    mkdirSync(plant);
    const settings = join(plant, "gradus.toml");
    const closed = new Copy(plant, "closed", fixture("fixtures/findings/double-coil.ladder"));
    const open = new Copy(plant, "open", fixture("fixtures/findings/quiet.ladder"));
    const found = JSON.parse(gradus("check", "--json", closed.ladder)).diagnostics;
    const warnings = found.filter(({ severity }) => severity === "warning");
    writeFileSync(settings, "diagnostics.workspace = true\n");
    await editor.open(open.ladder);
    await editor.findings("warning", warnings.length);
    // A mistake in it is told in it, and all else counts.
    const codes = JSON.stringify([...new Set(found.map(({ code }) => code))]);
    writeFileSync(settings, `diagnostics = { workspace = true, ignore = ${codes} }\ncolour = "red"\n`);
    await editor.findings("warning", 1);
    await editor.open(settings);
    await editor.underlined(settings, "warning").first().waitFor();
    await editor.picture("settings");
    writeFileSync(settings, `diagnostics = { workspace = true, ignore = ${codes} }\n`);
    await editor.findings("warning", 0);
  });
}
