// A workspace that lies on no disk, as a repository that is opened without a checkout: only what
// needs no language server works there, and nothing complains.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { Editor } from "./editor.mjs";
import { cases, fixture } from "./gradus.mjs";
import { startWorkbench, until } from "./workbench.mjs";

const vsce = fileURLToPath(new URL("../../../editors/vscode/node_modules/@vscode/vsce/vsce", import.meta.url));

export function virtual(vsix) {
  test("in a virtual workspace colours work, and no server is missed", async () => {
    const scratch = mkdtempSync(join(tmpdir(), "gradus-memory-"));
    let workbench;
    try {
      const memory = packaged(scratch);
      workbench = await startWorkbench(vsix, { further: [memory], folder: "memory:/workspace" });
      const editor = new Editor(workbench.page);
      const { page } = workbench;
      await page.getByRole("treeitem", { name: "tank.ladder" }).dblclick();
      await editor.text("/workspace/tank.ladder").waitFor();
      const language = page.locator("#status\\.editor\\.mode", { hasText: "Ladder" });
      await language.waitFor();
      // A keyword and a name differ in colour, so the grammar is at work.
      const line = editor.text("/workspace/tank.ladder").locator(".view-line", { hasText: "program" }).first();
      await until("colours", async () => (await line.locator("span[class*=mtk]").count()) > 1);
      await editor.goTo(3, 1);
      assert.equal(await editor.noHover(), true);
      assert.equal(await editor.verdict.count(), 0);
      await editor.openPalette("Gradus: ");
      const offered = await editor.offered();
      assert.ok(offered.some((name) => name.includes("Show the Log")), offered.join("\n"));
      assert.ok(!offered.some((name) => /Accept|Restart|Spec/.test(name)), offered.join("\n"));
      await editor.keys.press("Escape");
      assert.equal(await page.locator(".notification-list-item").count(), 0);
      await editor.picture("virtual");
    } finally {
      await workbench?.stop();
      rmSync(scratch, { recursive: true, force: true });
    }
  });
}

/** The extension that makes the workspace, with a ladder in it. */
function packaged(scratch) {
  const source = join(scratch, "memory");
  cpSync(fileURLToPath(new URL("memory", import.meta.url)), source, { recursive: true });
  cpSync(fixture(cases.neutralization.file), join(source, "files/tank.ladder"));
  const out = join(scratch, "memory.vsix");
  const options = ["package", "--no-dependencies", "--allow-missing-repository", "--skip-license", "--out", out];
  const { status, stderr } = spawnSync(process.execPath, [vsce, ...options], { cwd: source, encoding: "utf8" });
  assert.equal(status, 0, stderr);
  return out;
}
