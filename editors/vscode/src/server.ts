/**
 * The language server as the editor sees it: started for the first document that concerns
 * it, restarted on demand or after a crash, and silent but for one message when it gives up.
 * Restarts after a crash are this module's, not the client library's, which would announce
 * each that fails.
 */
import {
  commands,
  type ExtensionContext,
  env,
  type LogOutputChannel,
  TabInputText,
  Uri,
  ViewColumn,
  window,
  workspace,
} from "vscode";
import {
  CloseAction,
  type CloseHandlerResult,
  ErrorAction,
  type ErrorHandler,
  type ErrorHandlerResult,
  type InitializationFailedHandler,
  LanguageClient,
  type LanguageClientOptions,
  type Message,
  RevealOutputChannelOn,
  State,
} from "vscode-languageclient/node";
import { findExecutable } from "./executable";
import { ownLanguages, schemes, xmlLanguages } from "./ladder-file";
import { furtherCapabilities, type Scan, type Simulated, type Verified } from "./protocol";
import { pageOf, scansOf, withPages } from "./virtual-documents";

/** How often a server that has died is started anew within so many milliseconds. */
const restarts = 4;
const lately = 3 * 60 * 1000;

/** A client whose faults go to the log. What users are told of them, and once, is said here. */
class QuietClient extends LanguageClient {
  override error(message: string, data?: unknown): void {
    super.error(message, data, false);
  }
}

export class Server {
  #client: LanguageClient | undefined;
  #starting: Promise<LanguageClient | undefined> | undefined;
  #wasWanted = false;
  /** When servers have died lately. */
  #deaths: number[] = [];

  constructor(
    private readonly context: ExtensionContext,
    private readonly log: LogOutputChannel,
    private readonly onClient: (client: LanguageClient) => void,
    private readonly onState: (state: State) => void,
  ) {}

  /** The running client, started if need be; undefined if it cannot be started, which the user has been told. */
  running(): Promise<LanguageClient | undefined> {
    this.#wasWanted = true;
    this.#starting ??= this.#start().then((client) => {
      // A failed start is tried again when it is asked for again.
      if (client === undefined) this.#starting = undefined;
      return client;
    });
    return this.#starting;
  }

  /** Whether it was asked for, even if it could not be started. */
  get wasWanted(): boolean {
    return this.#wasWanted;
  }

  async restart(): Promise<void> {
    await this.stop();
    this.#deaths = [];
    await this.running();
  }

  async stop(): Promise<void> {
    const client = this.#client;
    this.#client = undefined;
    this.#starting = undefined;
    if (client === undefined) return;
    try {
      await client.dispose();
    } catch (error) {
      this.log.warn(`The language server did not stop as asked: ${error}`);
    }
  }

  async #start(): Promise<LanguageClient | undefined> {
    const settings = workspace.getConfiguration("gradus");
    const executable = await findExecutable(settings.get("server.path", ""), this.context.extensionPath);
    if ("reason" in executable) {
      this.log.error(executable.reason);
      void this.#tell(executable.reason, "Open the Setting");
      return undefined;
    }
    this.log.info(`Language server: ${executable.path} (from the ${executable.from})`);

    const client = new QuietClient(
      "gradus",
      "Gradus",
      {
        command: executable.path,
        args: ["lsp"],
        options: { env: { ...process.env, ...settings.get<Record<string, string>>("server.extraEnv", {}) } },
      },
      this.#options(),
    );
    client.registerFeature(furtherCapabilities);
    client.onDidChangeState(({ newState }) => this.onState(newState));
    this.onClient(client);
    this.#client = client;
    try {
      await client.start();
      return client;
    } catch (error) {
      // Who has stopped it meanwhile wants to hear nothing of it.
      if (this.#client !== client) return undefined;
      this.#client = undefined;
      this.log.error(`${executable.path} did not start as a language server: ${error}`);
      const choices = executable.from === "setting" ? (["Open the Setting"] as const) : [];
      void this.#tell("The Gradus language server did not start.", ...choices, "Restart", "Show the Log");
      return undefined;
    }
  }

  #options(): LanguageClientOptions {
    const languages = [...ownLanguages, ...xmlLanguages];
    const initializationFailedHandler: InitializationFailedHandler = () => false;
    return {
      documentSelector: schemes.flatMap((scheme) => languages.map((language) => ({ scheme, language }))),
      initializationOptions: settingsForServer(),
      synchronize: { configurationSection: "gradus" },
      outputChannel: this.log,
      revealOutputChannelOn: RevealOutputChannelOn.Never,
      initializationFailedHandler,
      errorHandler: this.#errorHandler(),
      middleware: {
        // Commands of code actions and lenses reach the server through here; a text it answers is shown.
        executeCommand: async (command, args, next) => {
          const answer: unknown = await next(command, args);
          if (command === "gradus.explain" && typeof args[0] === "string") await showPage(pageOf(args[0]));
          await showRun(command, args[0], answer);
          return answer;
        },
        provideHover: async (document, position, token, next) => {
          const hover = await next(document, position, token);
          return hover && withPages(hover);
        },
        window: {
          // A spec opens beside its ladder, not in its place.
          showDocument: async (params, token, next) => {
            if (params.external) return next(params, token);
            await showBeside(Uri.parse(params.uri, true), params.takeFocus ?? false);
            return { success: true };
          },
        },
      },
    };
  }

  #errorHandler(): ErrorHandler {
    let usual: ErrorHandler | undefined;
    const handler = () => {
      usual ??= this.#client?.createDefaultErrorHandler();
      return usual;
    };
    return {
      error: async (
        error: Error,
        message: Message | undefined,
        count: number | undefined,
      ): Promise<ErrorHandlerResult> => {
        this.log.error(`Connection to the language server: ${error.message}`);
        return (await handler()?.error(error, message, count)) ?? { action: ErrorAction.Continue };
      },
      closed: async (): Promise<CloseHandlerResult> => {
        // Of one that ends before it has answered, its start tells.
        if (this.#client?.state === State.Running) this.#died();
        return { action: CloseAction.DoNotRestart, handled: true };
      },
    };
  }

  /** A server that worked is gone, and nobody asked for it. */
  #died(): void {
    this.#client = undefined;
    this.#starting = undefined;
    const now = Date.now();
    this.#deaths = [...this.#deaths.filter((death) => now - death < lately), now];
    if (this.#deaths.length <= restarts) {
      this.log.warn("The language server ended without being asked to; it is started again.");
      void this.running();
      return;
    }
    this.log.error(`The language server ended more than ${restarts} times within three minutes.`);
    void this.#tell(
      "The Gradus language server keeps ending. Nothing of your files is lost.",
      "Restart",
      "Show the Log",
    );
  }

  async #tell(message: string, ...choices: ("Open the Setting" | "Show the Log" | "Restart")[]): Promise<void> {
    switch (await window.showErrorMessage(message, ...choices)) {
      case "Open the Setting":
        await showSetting("server.path");
        break;
      case "Show the Log":
        this.log.show();
        break;
      case "Restart":
        await this.restart();
        break;
      default:
    }
  }
}

/** Shows what came of a command about a scenario or a spec, whether a lens, an action or the palette had it run. */
async function showRun(command: string, argument: unknown, answer: unknown): Promise<void> {
  if (command === "gradus.simulate" && answer) {
    const { uri } = argument as { readonly uri: string };
    await showBeside(scansOf(Uri.parse(uri, true)), false);
    window.setStatusBarMessage(`Gradus: ${(answer as Simulated).summary}`, 10_000);
  } else if (command === "gradus.verify" && answer) {
    const { uri, summary } = answer as Verified;
    await showBeside(Uri.parse(uri, true), false);
    window.setStatusBarMessage(`Gradus: ${summary}`, 10_000);
  } else if (command === "gradus.showScan" && answer) {
    const { scan, done } = answer as Scan;
    await commands.executeCommand("setContext", "gradus.showsScan", true);
    window.setStatusBarMessage(`Gradus: scan ${scan} is shown, after ${done}`, 10_000);
  } else if (command === "gradus.hideScan") {
    await commands.executeCommand("setContext", "gradus.showsScan", false);
  }
}

/** Shows a document beside the active one, or where it is visible already. */
export async function showBeside(uri: Uri, takeFocus: boolean): Promise<void> {
  const visible = window.visibleTextEditors.find((editor) => editor.document.uri.toString() === uri.toString());
  const document = await workspace.openTextDocument(uri);
  await window.showTextDocument(document, {
    viewColumn: visible?.viewColumn ?? ViewColumn.Beside,
    preserveFocus: !takeFocus,
    preview: false,
  });
  // An edit of a file that was closed has opened it behind the ladder; once is enough.
  const behind = window.tabGroups.all
    .flatMap((group) => group.tabs)
    .filter((tab) => !tab.isActive && tab.input instanceof TabInputText && tab.input.uri.toString() === uri.toString());
  await window.tabGroups.close(behind, true);
}

/** Shows one of our settings where it is set, or would be: each of these lists shows its own settings only. */
async function showSetting(name: string): Promise<void> {
  const set = workspace.getConfiguration("gradus").inspect(name);
  const inFolder = set?.workspaceFolderValue !== undefined || set?.workspaceValue !== undefined;
  const elsewhere = env.remoteName === undefined ? "openSettings" : "openRemoteSettings";
  const list = inFolder ? "openWorkspaceSettings" : elsewhere;
  await commands.executeCommand(`workbench.action.${list}`, { query: `gradus.${name}` });
}

/** Shows a page of Markdown beside the active document, rendered where the editor can. */
export async function showPage(uri: Uri): Promise<void> {
  try {
    await commands.executeCommand("markdown.showPreviewToSide", uri);
  } catch {
    await showBeside(uri, true);
  }
}

function settingsForServer(): unknown {
  const settings = workspace.getConfiguration("gradus");
  return Object.fromEntries(
    ["codeLens", "inlayHints", "suggestions", "diagnostics", "verify", "maxFileSize"].map((section) => [
      section,
      settings.get(section),
    ]),
  );
}
