/**
 * The extension: starts the language server for the first document that concerns it, and
 * connects the commands and the status item to it. What the files mean, the server knows.
 */
import { commands, type ExtensionContext, window, workspace } from "vscode";
import { registerCommands } from "./commands";
import { concernsGradus, scenarioLanguage } from "./ladder-file";
import { statusNotification } from "./protocol";
import { Server, showBeside } from "./server";
import { Verdicts } from "./verdicts";
import { VirtualDocuments } from "./virtual-documents";

let server: Server | undefined;

export function activate(context: ExtensionContext): void {
  const log = window.createOutputChannel("Gradus", { log: true });
  const verdicts = new Verdicts();

  const lookAtFront = () => {
    verdicts.show();
    const has = verdicts.ladderInFront() !== undefined;
    void commands.executeCommand("setContext", "gradus.hasLadder", has);
  };
  const running = new Server(
    context,
    log,
    (client) =>
      client.onNotification(statusNotification, (status) => {
        verdicts.take(status);
        texts.ladderChanged(status.uri);
        lookAtFront();
      }),
    (state) => verdicts.serverIs(state),
  );
  const texts = new VirtualDocuments(running);
  server = running;

  const startFor = (documents: readonly Parameters<typeof concernsGradus>[0][]) => {
    if (!running.wasWanted && documents.some(concernsGradus)) {
      void running.running();
    }
  };
  context.subscriptions.push(
    log,
    verdicts,
    texts,
    ...registerCommands(context, running, verdicts, () => log.show()),
    workspace.onDidOpenTextDocument((document) => startFor([document])),
    window.onDidChangeActiveTextEditor(lookAtFront),
    workspace.onDidChangeTextDocument(({ document }) => {
      if (document.languageId === scenarioLanguage) texts.scenarioChanged(document.uri);
    }),
    workspace.onDidCreateFiles(({ files }) => {
      // The first decision about a ladder makes its spec, which then grows in view. The cursor stays.
      const made = files.find((file) => verdicts.isSpecInView(file));
      if (made !== undefined) void showBeside(made, false);
    }),
    workspace.onDidChangeConfiguration((change) => {
      const program = ["gradus.server.path", "gradus.server.extraEnv"].some((name) =>
        change.affectsConfiguration(name),
      );
      if (program && running.wasWanted) void running.restart();
    }),
  );
  startFor(workspace.textDocuments);
  lookAtFront();
}

export async function deactivate(): Promise<void> {
  await server?.stop();
}
