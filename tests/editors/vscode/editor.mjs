// What a person does in the workbench, by keyboard, and what a person sees there.
import { basename, join } from "node:path";
import { artefacts, until } from "./workbench.mjs";

/** The text of an element as it is read: VS Code draws blanks as no-break spaces. */
const plain = (text) => text.replaceAll("\u00a0", " ");

export class Editor {
  constructor(page) {
    this.page = page;
    this.keys = page.keyboard;
  }

  /** A key press can be lost to a widget that is just closing, so what it should do is looked for and the key pressed again. */
  async pressUntil(what, press, visible) {
    for (let attempt = 1; ; attempt++) {
      await press();
      try {
        await visible.waitFor({ timeout: 5_000 });
        return;
      } catch (error) {
        if (attempt === 4) throw new Error(`${what}: ${error.message}`);
        await this.keys.press("Escape");
      }
    }
  }

  /** Opens a file by its path. A text that the server made of one is offered too, under a longer name. */
  async open(path) {
    const input = this.page.locator(".quick-input-widget input.input");
    await this.pressUntil("open a file", () => this.keys.press("Control+p"), input);
    await input.fill(path);
    const rows = this.page.locator(".quick-input-list .monaco-list-row");
    const wanted = rows.filter({ has: this.page.getByText(basename(path), { exact: true }) });
    await wanted.first().waitFor();
    const focused = wanted.and(this.page.locator(".focused"));
    for (let left = await rows.count(); left > 0 && (await focused.count()) === 0; left--) {
      await this.keys.press("ArrowDown");
    }
    await focused.waitFor();
    await this.keys.press("Enter");
    await this.text(path).waitFor();
    await this.page.locator(".quick-input-widget").waitFor({ state: "hidden" });
  }

  async run(command) {
    await this.#command(command);
    await this.page.locator(".quick-input-widget").waitFor({ state: "hidden" });
  }

  /** Runs the first command in the palette, once that is the one that is wanted. */
  async #command(text) {
    const input = this.page.locator(".quick-input-widget input.input");
    await this.pressUntil(`run ${text}`, () => this.keys.press("F1"), input);
    await input.fill(`>${text}`);
    await this.page.locator(".quick-input-list .monaco-list-row.focused", { hasText: text }).waitFor();
    await this.keys.press("Enter");
  }

  /** The editor that shows a file, or the text that the server made of one. */
  text(path) {
    const uri = `${path.slice(path.lastIndexOf("/workspace/"))}`;
    return this.page
      .locator(`.editor-instance .monaco-editor[data-uri$="${uri}"], .editor-instance .monaco-editor[data-uri*="${uri}?"]`)
      .first();
  }

  /** Puts the cursor at a line and column, counted from 1, of the editor that has the focus. */
  async goTo(line, column) {
    const input = this.page.locator(".quick-input-widget input.input");
    await this.pressUntil("go to a line", () => this.keys.press("Control+g"), input);
    await input.fill(`:${line}:${column}`);
    await this.keys.press("Enter");
    await this.isAt(line, column);
  }

  async isAt(line, column) {
    await this.page.locator("#status\\.editor\\.selection", { hasText: `Ln ${line}, Col ${column}` }).waitFor();
  }

  /** Gives the focus to the editor of a file. */
  async focus(path) {
    await this.text(path).locator(".view-line").first().click();
  }

  /** Marks so many characters right of the cursor and types over them. */
  async replace(length, text) {
    for (let i = 0; i < length; i++) await this.keys.press("Shift+ArrowRight");
    await this.keys.type(text);
  }

  get #hover() {
    return this.page.locator(".monaco-hover:not(.hidden) .hover-contents");
  }

  async #askForHover() {
    await this.keys.press("Control+k");
    await this.keys.press("Control+i");
  }

  /** What the hover at the cursor says; asked for until it holds some words, since an analysis may be under way. */
  async hover(words) {
    await this.pressUntil(`a hover with ${words}`, () => this.#askForHover(), this.#hover.filter({ hasText: words }).first());
    return plain((await this.#hover.allInnerTexts()).join("\n"));
  }

  /** Goes where a link in the hover at the cursor leads. */
  async followFromHover(words) {
    const link = this.#hover.locator("a", { hasText: words }).first();
    await this.pressUntil(`a hover with a link ${words}`, () => this.#askForHover(), link);
    await link.click();
  }

  /** Whether the cursor's place has no hover, after the time that one would take. */
  async noHover() {
    await this.#askForHover();
    await this.page.waitForTimeout(1_000);
    return (await this.#hover.count()) === 0;
  }

  /** What the editor's own inspector says of the name at the cursor. */
  async tokenAtCursor() {
    const inspector = this.page.locator(".token-inspect-widget");
    await this.run("Developer: Inspect Editor Tokens and Scopes");
    await inspector.filter({ hasText: "semantic token type" }).waitFor();
    const said = plain(await inspector.innerText());
    await this.keys.press("Escape");
    await inspector.waitFor({ state: "hidden" });
    return said;
  }

  /** Takes the ghost text behind the cursor, once it makes the line that is wanted. */
  async takeGhost(path, line) {
    const ghost = this.text(path).locator('[class*="ghost-text"]');
    await ghost.first().waitFor();
    await this.shows(path, line);
    await this.keys.press("Tab");
    await until("the ghost text is taken", async () => (await ghost.count()) === 0);
  }

  /** Waits until a rendered page holds a text. */
  async previews(name, text) {
    await this.page.locator(".tab", { hasText: name }).waitFor();
    await until(`the page ${name} holds ${text}`, async () => {
      const frames = this.page.frames().filter((frame) => frame !== this.page.mainFrame());
      const texts = frames.map((frame) => frame.evaluate(() => document.body?.innerText ?? "").catch(() => ""));
      return (await Promise.all(texts)).some((shown) => shown.includes(text));
    });
  }

  /** Opens the light bulb's menu at the cursor, and takes the first action whose title matches. */
  async act(title) {
    const rows = this.page.locator(".action-widget .monaco-list-row.action");
    const wanted = rows.filter({ hasText: title });
    await this.pressUntil(`offer ${title}`, () => this.keys.press("Control+."), wanted.first());
    const focused = this.page.locator(".action-widget .monaco-list-row.action.focused");
    for (let i = await rows.count(); i > 0; i--) {
      if (title.test(plain(await focused.innerText()))) break;
      await this.keys.press("ArrowDown");
    }
    const chosen = plain(await focused.innerText());
    if (!title.test(chosen)) throw new Error(`${title} cannot be reached by the keyboard; the last was ${chosen}`);
    await this.keys.press("Enter");
    await rows.first().waitFor({ state: "hidden" });
    return chosen;
  }

  /** How many findings of that severity there are, as the status bar counts them. */
  async #count(severity) {
    const label = (await this.page.locator("#status\\.problems").getAttribute("aria-label")) ?? "";
    return Number(new RegExp(`${severity}s?: (\\d+)`, "i").exec(label)?.[1] ?? 0);
  }

  async findings(severity, count) {
    await until(`${count} findings: ${severity}`, async () => (await this.#count(severity)) === count);
  }

  /** Goes to the next finding of the file that has the focus. The key does nothing while there is none. */
  async nextFinding() {
    const told = this.page.locator(".peekview-widget, .marker-widget").first();
    await this.pressUntil("go to the next finding", () => this.keys.press("F8"), told);
    await this.keys.press("Escape");
  }

  /** Applies the fix of that title at one warning after the other until none is left. */
  async mendAll(title) {
    for (let left = await this.#count("warning"); left > 0; left = await this.#count("warning")) {
      await this.act(title);
      await until("the warning goes", async () => (await this.#count("warning")) < left);
      if ((await this.#count("warning")) > 0) await this.nextFinding();
    }
  }

  async rename(name) {
    const input = this.page.locator(".rename-box input");
    await this.pressUntil("rename", () => this.keys.press("F2"), input);
    await input.fill(name);
    await this.keys.press("Enter");
    await input.waitFor({ state: "hidden" });
  }

  /** Saves every file that was changed, and waits until none is left so. */
  async saveAll() {
    await this.run("File: Save All Files");
    await until("no tab is dirty", async () => (await this.page.locator(".tab.dirty").count()) === 0);
  }

  /** Waits until a file is open and changed. */
  async isDirty(path) {
    await this.page.locator(`.tab.dirty[data-resource-name="${basename(path)}"]`).first().waitFor();
  }

  /** Leaves the workbench as it was found, whatever the case before it left open. */
  async closeEverything() {
    await this.keys.press("Escape");
    await this.run("View: Close All Editors");
    const answer = this.page.locator(".monaco-dialog-box .monaco-button", { hasText: "Don't Save" });
    await until("no tab is open", async () => {
      if ((await answer.count()) > 0) await answer.first().click();
      return (await this.page.locator(".tab").count()) === 0;
    });
  }

  async openPalette(text) {
    const input = this.page.locator(".quick-input-widget input.input");
    await this.pressUntil("open the palette", () => this.keys.press("F1"), input);
    await input.fill(`>${text}`);
    await this.page.locator(".quick-input-list .monaco-list-row", { hasText: text.trim() }).first().waitFor();
  }

  /** The names in the open palette. */
  async offered() {
    return (await this.page.locator(".quick-input-list .monaco-list-row").allInnerTexts()).map(plain);
  }

  /** Whether a visible editor holds a match. */
  async holds(pattern) {
    const lines = await this.page.locator(".editor-instance .view-line").allInnerTexts();
    return lines.map(plain).some((line) => pattern.test(line));
  }

  /** Waits until the visible part of a file's editor holds a text. */
  async shows(path, text) {
    const editor = this.text(path);
    await until(`${path} shows ${text}`, async () => {
      const lines = await editor.locator(".view-line").allInnerTexts();
      return lines.map(plain).some((line) => line.includes(text));
    });
  }

  /** Waits until a lens in a file's editor says some words. */
  async hasLens(path, words) {
    await this.text(path).locator(".codelens-decoration", { hasText: words }).first().waitFor();
  }

  /** How many findings of that severity are underlined in a file's editor. */
  underlined(path, severity) {
    return this.text(path).locator(`.squiggly-${severity}`);
  }

  /** The extension's item in the status bar. */
  get verdict() {
    return this.page.locator('.statusbar-item[id$="gradus.verdict"]');
  }

  async verdictIs(words) {
    await this.verdict.filter({ hasText: words }).waitFor();
  }

  /** Does something while the side bar leaves its place to the texts. */
  async withoutSideBar(something) {
    const sideBar = this.page.locator(".part.sidebar");
    await this.keys.press("Control+b");
    await sideBar.waitFor({ state: "hidden" });
    await something();
    await this.keys.press("Control+b");
    await sideBar.waitFor();
  }

  #telling(words) {
    return this.page.locator(".notification-toast", { hasText: words });
  }

  /** Waits until a message says something. */
  async told(words) {
    await this.#telling(words).first().waitFor();
  }

  /** How many messages say something now. */
  async tellings(words) {
    return this.#telling(words).count();
  }

  /** Presses a button of a message. */
  async answer(words, button) {
    const shown = this.#telling(words).first();
    await shown.hover();
    await shown.locator(".monaco-button", { hasText: button }).click();
    await shown.waitFor({ state: "hidden" });
  }

  async clearMessages() {
    await this.run("Notifications: Clear All Notifications");
  }

  /** Waits until the settings editor shows a setting. */
  async showsSetting(name) {
    await this.page.locator(`.settings-editor [data-key="${name}"]`).first().waitFor();
  }

  /** Waits until the panel of outputs shows a log. Its text is none of ours: this VS Code has no module that writes logs. */
  async logIsOpen(name) {
    await this.page.locator(".part.panel select option:checked", { hasText: name }).first().waitFor({ state: "attached" });
  }

  /** Runs a command that asks with a list, and takes an entry of that. */
  async runAndPick(command, entry) {
    await this.#command(command);
    const rows = this.page.locator(".quick-input-list .monaco-list-row");
    await rows.filter({ hasText: entry }).waitFor();
    await this.page.locator(".quick-input-widget input.input").fill(entry);
    await rows.and(this.page.locator(".focused")).filter({ hasText: entry }).waitFor();
    await this.keys.press("Enter");
  }

  /** A step of the walkthrough that is open. */
  step(title) {
    return this.page.locator(".gettingStartedContainer .getting-started-step", { hasText: title }).first();
  }

  /** Presses a button of the walkthrough. */
  async press(button) {
    await this.page.locator(".gettingStartedContainer .monaco-button", { hasText: button }).first().click();
  }

  /** Answers the question for the place of a file, once its own proposal stands there: before that it reads no path. */
  async saveAs(path) {
    const input = this.page.locator(".quick-input-widget input.input");
    await input.waitFor();
    await until("a place is proposed", async () => (await input.inputValue()).endsWith(basename(path)));
    await input.fill(path);
    await this.keys.press("Enter");
    await input.waitFor({ state: "hidden" });
  }

  async picture(name) {
    await this.page.screenshot({ path: join(artefacts, `vscode-${name}.png`) });
  }
}
