/**
 * The status item: what the last analysis says of the ladder in front and of its spec.
 * A ladder and the spec beside it share their path but for the ending, so either shows it.
 */
import { MarkdownString, StatusBarAlignment, type TextDocument, Uri, window, workspace } from "vscode";
import { State } from "vscode-languageclient/node";
import { concernsGradus, holdsLadder, scenarioLanguage, specLanguage } from "./ladder-file";
import type { Proof, Status, Verdict } from "./protocol";

const faces: Record<Verdict, { readonly icon: string; readonly words: string }> = {
  "no-sequence": { icon: "$(dash)", words: "no sequence" },
  "no-spec": { icon: "$(circle-large-outline)", words: "no spec" },
  "in-step": { icon: "$(check)", words: "in step" },
  behind: { icon: "$(history)", words: "behind" },
};

const proofs: Record<Proof["verdict"], { readonly icon: string; readonly words: string } | undefined> = {
  equivalent: { icon: "$(verified)", words: "equivalent" },
  different: { icon: "$(warning)", words: "different" },
  unknown: { icon: "$(question)", words: "not known" },
  refused: { icon: "$(question)", words: "not known" },
  proving: { icon: "$(loading~spin)", words: "proving" },
  stopped: undefined,
  mistaken: undefined,
  unasked: undefined,
};

export class Verdicts {
  readonly #item = window.createStatusBarItem("gradus.verdict", StatusBarAlignment.Right, 90);
  readonly #ofStem = new Map<string, Status>();
  #state = State.Stopped;
  #last: Uri | undefined;

  constructor() {
    this.#item.name = "Gradus";
  }

  dispose(): void {
    this.#item.dispose();
  }

  take(status: Status): void {
    this.#ofStem.set(stem(Uri.parse(status.uri, true)), status);
    this.show();
  }

  serverIs(state: State): void {
    this.#state = state;
    if (state === State.Stopped) this.#ofStem.clear();
    this.show();
  }

  /** The ladder that a document holds, or that the spec in it belongs to. */
  ladderOf(document: TextDocument | undefined): Uri | undefined {
    if (document === undefined) return undefined;
    if (holdsLadder(document)) return document.uri;
    if (document.languageId !== specLanguage) return undefined;
    const status = this.#ofStem.get(stem(document.uri));
    return status && Uri.parse(status.uri, true);
  }

  /**
   * The ladder of the document in front. Where no text is in front, as in the walkthrough,
   * it is that of the text that was there last.
   */
  ladderInFront(): Uri | undefined {
    const document = window.activeTextEditor?.document;
    if (document !== undefined) {
      this.#last = this.ladderOf(document);
      return this.#last;
    }
    const last = this.#last?.toString();
    return workspace.textDocuments.find((open) => open.uri.toString() === last)?.uri;
  }

  /** Whether a file is the spec of a ladder that is in view. */
  isSpecInView(file: Uri): boolean {
    if (!file.path.endsWith(".grafcet")) return false;
    return window.visibleTextEditors.some(({ document }) => holdsLadder(document) && stem(document.uri) === stem(file));
  }

  /** Brings the item up to date with the document in front. */
  show(): void {
    const document = window.activeTextEditor?.document;
    if (document === undefined || !concernsGradus(document)) {
      this.#item.hide();
      return;
    }
    const status = this.#ofStem.get(stem(document.uri));
    // Of a scenario its lens tells; here is told of a ladder of its name, if there is one.
    if (status === undefined && document.languageId === scenarioLanguage && this.#state === State.Running) {
      this.#item.hide();
      return;
    }
    if (this.#state === State.Starting || this.#state === State.StartFailed || this.#state === State.Stopped) {
      const starting = this.#state === State.Starting;
      this.#item.text = starting ? "$(loading~spin) Gradus" : "$(debug-disconnect) Gradus";
      this.#item.tooltip = starting
        ? "The language server is starting"
        : "The language server is not running; the log tells why";
      this.#item.command = "gradus.server.log";
    } else if (status === undefined) {
      this.#item.text = "Gradus";
      this.#item.tooltip = "Nothing known of this file yet";
      this.#item.command = "gradus.server.log";
    } else {
      this.#showStatus(status);
    }
    this.#item.show();
  }

  #showStatus(status: Status): void {
    const face = faces[status.verdict];
    const open = status.open > 0 ? `, ${status.open} open` : "";
    const proof = status.proof && proofs[status.proof.verdict];
    const proved = proof ? ` ${proof.icon} ${proof.words}` : "";
    this.#item.text = `${face.icon} ${face.words}${open}${proved}`;
    this.#item.tooltip = tooltip(status);
    this.#item.command = status.verdict === "no-spec" ? "gradus.file.convert" : "gradus.file.openSpec";
  }
}

function tooltip(status: Status): MarkdownString {
  const counts = [
    `${status.states} states, ${status.accepted} with a step`,
    `${status.open} successions open`,
    `${status.rules} rules, ${status.stale} no longer supported by the ladder`,
  ];
  const text = new MarkdownString("**Gradus**\n\n");
  text.appendText(status.message);
  if (status.proof) {
    text.appendMarkdown("\n\n");
    text.appendText(status.proof.message);
  }
  text.appendMarkdown(`\n\n${counts.map((count) => `- ${count}`).join("\n")}\n\n`);
  text.appendMarkdown(
    "[Open the spec](command:gradus.file.openSpec) · [Bring it up to date](command:gradus.file.convert)",
  );
  if (status.proof) text.appendMarkdown(" · [Verify it](command:gradus.file.verify)");
  text.isTrusted = { enabledCommands: ["gradus.file.openSpec", "gradus.file.convert", "gradus.file.verify"] };
  return text;
}

function stem(uri: Uri): string {
  return uri.with({ path: uri.path.replace(/\.[^./]*$/, ""), query: "", fragment: "" }).toString();
}
