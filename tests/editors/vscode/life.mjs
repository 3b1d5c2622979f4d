// The server's life: it is the one inside the extension, it can be restarted, and it is
// started again when it dies.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { Copy, cases, fixture } from "./gradus.mjs";
import { until } from "./workbench.mjs";

const { neutralization } = cases;

export function life(at) {
  const opened = async (name) => {
    const tank = new Copy(at.workbench.folder, name, fixture(neutralization.file));
    await at.editor.open(tank.ladder);
    await at.editor.verdictIs(/no spec/);
    return tank;
  };

  test("the server is restarted by a command and knows the open files", async () => {
    const { editor } = at;
    await opened("restart");
    const [before] = servers(at.workbench);
    await editor.run("Gradus: Restart the Language Server");
    await until("another server", () => servers(at.workbench).length === 1 && servers(at.workbench)[0] !== before);
    await editor.verdictIs(/no spec/);
  });

  test("a server that dies is started again", async () => {
    const { editor } = at;
    await opened("crash");
    const [before] = servers(at.workbench);
    process.kill(before, "SIGKILL");
    await until("another server", () => servers(at.workbench).some((id) => id !== before));
    await editor.verdictIs(/no spec/);
  });

  test("nothing was asked of any other machine", () => {
    assert.deepEqual([...at.workbench.refused], []);
  });
}

/** Processes that run the executable inside the extension of this workbench. */
function servers({ extensions }) {
  return readdirSync("/proc")
    .filter((name) => /^\d+$/.test(name))
    .map(Number)
    .filter((id) => {
      try {
        const [program] = readFileSync(`/proc/${id}/cmdline`, "utf8").split("\0");
        return program.startsWith(extensions) && program.endsWith("/server/gradus");
      } catch {
        return false; // gone since it was listed
      }
    });
}
