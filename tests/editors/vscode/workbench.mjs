// A real VS Code: its server, as code-server carries it, and its workbench in a headless
// Chromium. One serves the whole suite. Nothing leaves the machine: the browser knows no
// other host than this one, and what it asked for all the same is reported.
import { spawn } from "node:child_process";
import { createWriteStream, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import http from "node:http";
import { createRequire } from "node:module";
import net from "node:net";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const editors = resolve(process.env.GRADUS_EDITORS ?? fileURLToPath(new URL("../../../target/editors", import.meta.url)));
const { chromium } = createRequire(join(editors, "vscode/node_modules/"))("playwright-core");
const node = join(editors, "bin/node");
const serverMain = join(editors, "bin/vscode-server.js");

export const artefacts = join(editors, "screenshots");

const userSettings = {
  "chat.disableAIFeatures": true,
  "editor.accessibilitySupport": "off",
  "editor.hover.delay": 100,
  "editor.minimap.enabled": false,
  "extensions.autoCheckUpdates": false,
  "extensions.ignoreRecommendations": true,
  "files.autoSave": "off",
  "git.enabled": false,
  // Cases count what is found in the files they open; others turn these on for folders of their own.
  "gradus.diagnostics.workspace": false,
  "gradus.verify.enable": false,
  "security.workspace.trust.startupPrompt": "never",
  "telemetry.telemetryLevel": "off",
  "update.mode": "none",
  "window.menuBarVisibility": "classic",
  "workbench.enableExperiments": false,
  "workbench.secondarySideBar.defaultVisibility": "hidden",
  "workbench.startupEditor": "none",
  "workbench.tips.enabled": false,
};

/**
 * Starts a workbench on a new, empty folder, or on the one with that address, with the extension
 * of that .vsix and `further` ones. A folder that is not `trusted` is one that nobody was asked about.
 * `stop` ends everything that was started and removes what was written.
 */
export async function startWorkbench(vsix, { trusted = true, further = [], folder: address } = {}) {
  const scratch = mkdtempSync(join(tmpdir(), "gradus-vscode-"));
  const folder = join(scratch, "workspace");
  const [data, user, extensions] = ["server", "user", "extensions"].map((name) => join(scratch, name));
  for (const path of [folder, join(user, "User"), extensions, artefacts]) mkdirSync(path, { recursive: true });
  writeFileSync(join(user, "User/settings.json"), JSON.stringify(userSettings));
  const places = [
    ...["--server-data-dir", data, "--user-data-dir", user, "--extensions-dir", extensions],
    "--accept-server-license-terms",
  ];
  // A home of its own: no settings, no gradus in PATH, nothing left behind.
  const env = {
    HOME: scratch,
    XDG_CONFIG_HOME: join(scratch, "config"),
    XDG_DATA_HOME: join(scratch, "data"),
    PATH: "/usr/local/bin:/usr/bin:/bin",
    LANG: "C.UTF-8",
    EXTENSIONS_GALLERY: "{}",
  };
  const kind = [trusted ? "" : "-untrusted", address === undefined ? "" : "-virtual"].join("");
  const log = createWriteStream(join(artefacts, `vscode${kind}.log`));
  const running = [];
  let browser;
  const stop = async () => {
    await browser?.close();
    await Promise.all(running.map(end));
    rmSync(scratch, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  };
  try {
    for (const package_ of [vsix, ...further]) await install(package_, places, env);
    const port = await freePort();
    const options = ["--without-connection-token", "--host", "127.0.0.1", "--port", String(port)];
    const quiet = ["--telemetry-level", "off", "--disable-telemetry", ...(trusted ? ["--disable-workspace-trust"] : [])];
    // A process group of its own, so that the extension host ends with it.
    const server = spawn(node, [serverMain, ...places, ...options, ...quiet], {
      env,
      detached: true,
      stdio: ["ignore", "pipe", "pipe"],
    });
    running.push(server);
    server.stdout.pipe(log, { end: false });
    server.stderr.pipe(log, { end: false });
    await until("VS Code's server answers", async () => (await status(port)) === 200, 30_000);

    browser = await chromium.launch({ executablePath: join(editors, "bin/chromium"), args: browserOptions });
    const context = await browser.newContext({ viewport: { width: 1360, height: 800 } });
    const refused = new Set();
    await context.route(
      (url) => url.protocol.startsWith("http") && url.hostname !== "127.0.0.1",
      (route) => {
        refused.add(new URL(route.request().url()).hostname);
        return route.abort();
      },
    );
    const page = await context.newPage();
    page.setDefaultTimeout(30_000);
    page.on("console", (message) => log.write(`console ${message.type()} ${message.text()}\n`));
    await page.goto(`http://127.0.0.1:${port}/?${new URLSearchParams({ folder: address ?? folder })}`);
    await page.locator(".monaco-workbench").waitFor({ timeout: 60_000 });
    await page.locator("#status\\.problems").waitFor({ timeout: 60_000 });
    return { page, folder, extensions, refused, stop };
  } catch (error) {
    await stop();
    throw error;
  }
}

const browserOptions = [
  ...["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync", "--disable-dev-shm-usage"],
  ...["--disable-background-networking", "--disable-component-update"],
  "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
];

/** Waits until a condition holds; says which one it was if it never does. */
export async function until(what, holds, milliseconds = 30_000) {
  const end = Date.now() + milliseconds;
  for (;;) {
    const found = await holds();
    if (found) return found;
    if (Date.now() > end) throw new Error(`waited ${milliseconds / 1000} s in vain: ${what}`);
    await new Promise((wake) => setTimeout(wake, 50));
  }
}

function install(vsix, places, env) {
  return new Promise((done, failed) => {
    let said = "";
    const child = spawn(node, [serverMain, ...places, "--install-extension", vsix], { env });
    for (const stream of [child.stdout, child.stderr]) stream.on("data", (text) => (said += text));
    child.on("error", failed);
    child.on("exit", (code) => (code === 0 ? done() : failed(new Error(`${vsix} cannot be installed:\n${said}`))));
  });
}

function status(port) {
  return new Promise((done) => {
    const request = http.get({ host: "127.0.0.1", port, path: "/version" }, (answer) => {
      answer.resume();
      done(answer.statusCode);
    });
    request.on("error", () => done(0));
  });
}

function freePort() {
  return new Promise((done) => {
    const server = net.createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => done(port));
    });
  });
}

/** Ends a process group that this module started: politely, then for good. */
async function end(child) {
  const gone = new Promise((done) => child.once("exit", done));
  const signal = (name) => {
    try {
      process.kill(-child.pid, name);
    } catch (error) {
      if (error.code !== "ESRCH") throw error;
    }
  };
  signal("SIGTERM");
  await Promise.race([child.exitCode === null ? gone : undefined, new Promise((wake) => setTimeout(wake, 5_000))]);
  signal("SIGKILL");
}
