/**
 * Where the language server is: where the setting says, else beside the extension, else in
 * PATH. A setting that leads nowhere is an error, not a reason to run something else.
 */
import { constants } from "node:fs";
import { access, stat } from "node:fs/promises";
import { homedir } from "node:os";
import { delimiter, join } from "node:path";

const fileName = process.platform === "win32" ? "gradus.exe" : "gradus";

export type Found = { readonly path: string; readonly from: "setting" | "extension" | "PATH" };
export type Missing = { readonly reason: string };

export async function findExecutable(setting: string, extensionFolder: string): Promise<Found | Missing> {
  const wanted = setting.trim();
  if (wanted !== "") {
    const path = wanted.replace(/^~(?=$|[/\\])/, homedir());
    if (await canBeRun(path)) return { path, from: "setting" };
    return { reason: `The setting gradus.server.path names ${path}, which is no file that can be run.` };
  }
  const bundled = join(extensionFolder, "server", fileName);
  if (await canBeRun(bundled)) return { path: bundled, from: "extension" };
  for (const folder of (process.env.PATH ?? "").split(delimiter)) {
    const path = join(folder, fileName);
    if (folder !== "" && (await canBeRun(path))) return { path, from: "PATH" };
  }
  return {
    reason:
      "This build of the extension comes without the gradus executable, and there is none in PATH. " +
      "Install it, or name it in the setting gradus.server.path.",
  };
}

async function canBeRun(path: string): Promise<boolean> {
  try {
    await access(path, constants.X_OK);
    return (await stat(path)).isFile();
  } catch {
    return false;
  }
}
