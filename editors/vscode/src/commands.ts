/**
 * The commands of the palette. Those about a file take the ladder of the document in
 * front; the work is the server's, and what it answers is shown without moving the cursor.
 */
import {
  commands,
  type Disposable,
  type ExtensionContext,
  env,
  UIKind,
  Uri,
  ViewColumn,
  version,
  window,
  workspace,
} from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { scenarioLanguage } from "./ladder-file";
import { type Accept, type Conversion, execute, type Searched, type Spec, type Text } from "./protocol";
import { type Server, showBeside, showPage } from "./server";
import type { Verdicts } from "./verdicts";
import { conditionsOf, pageCommand, pageOf, rungsOf } from "./virtual-documents";

type FileCommand = (client: LanguageClient, ladder: Uri) => Promise<void>;

export function registerCommands(
  context: ExtensionContext,
  server: Server,
  verdicts: Verdicts,
  showLog: () => void,
): Disposable[] {
  const onLadder = (run: FileCommand) => async () => {
    const ladder = verdicts.ladderInFront();
    if (ladder === undefined) {
      window.setStatusBarMessage("Gradus: the file in front holds no ladder", 5000);
      return;
    }
    const client = await server.running();
    if (client !== undefined) await run(client, ladder);
  };
  return Object.entries({
    "gradus.file.convert": onLadder((client, ladder) => convert(client, ladder, "none")),
    "gradus.file.acceptHandovers": onLadder((client, ladder) => convert(client, ladder, "handover")),
    "gradus.file.acceptWitnessed": onLadder((client, ladder) => convert(client, ladder, "witnessed")),
    "gradus.file.openSpec": onLadder(openSpec),
    "gradus.file.ladderText": onLadder((_, ladder) => showBeside(rungsOf(ladder), true)),
    "gradus.file.conditions": onLadder((_, ladder) => showBeside(conditionsOf(ladder), true)),
    "gradus.file.search": onLadder(search),
    "gradus.file.verify": onLadder(verify),
    "gradus.file.simulate": () => onScenario(server, "gradus.simulate"),
    "gradus.file.showScan": () => onScenario(server, "gradus.showScan"),
    "gradus.file.hideScan": () => commands.executeCommand("gradus.hideScan", {}),
    "gradus.server.restart": () => server.restart(),
    "gradus.server.report": () => report(context, server),
    "gradus.server.log": showLog,
    "gradus.example": () => saveExample(context),
    [pageCommand]: (name: string) => showPage(pageOf(name)),
  }).map(([name, run]) => commands.registerCommand(name, run));
}

/** Has the server run a command about the scenario in front, at the cursor's line; what it answers is shown where all answers are. */
async function onScenario(server: Server, command: string): Promise<void> {
  const editor = window.activeTextEditor;
  if (editor?.document.languageId !== scenarioLanguage) {
    window.setStatusBarMessage("Gradus: the file in front is no scenario", 5000);
    return;
  }
  const client = await server.running();
  if (client === undefined) return;
  const uri = client.code2ProtocolConverter.asUri(editor.document.uri);
  await commands.executeCommand(command, { uri, line: editor.selection.active.line });
}

async function convert(client: LanguageClient, ladder: Uri, accept: Accept): Promise<void> {
  const uri = client.code2ProtocolConverter.asUri(ladder);
  const answer = await execute<Conversion>(client, "gradus.convert", { uri, accept });
  await showBeside(client.protocol2CodeConverter.asUri(answer.uri), false);
  window.setStatusBarMessage(`Gradus: ${answer.changed ? "" : "nothing to change: "}${answer.summary}`, 10_000);
}

async function search(client: LanguageClient, ladder: Uri): Promise<void> {
  const answer = await execute<Searched>(client, "gradus.search", { uri: client.code2ProtocolConverter.asUri(ladder) });
  window.setStatusBarMessage(`Gradus: ${answer.summary}`, 10_000);
}

/** Through the editor's own command, so that what it answers is shown where all answers are. */
async function verify(client: LanguageClient, ladder: Uri): Promise<void> {
  await commands.executeCommand("gradus.verify", { uri: client.code2ProtocolConverter.asUri(ladder) });
}

async function openSpec(client: LanguageClient, ladder: Uri): Promise<void> {
  const spec = await execute<Spec>(client, "gradus.openSpec", { uri: client.code2ProtocolConverter.asUri(ladder) });
  // A spec that exists is shown by the server's own window/showDocument.
  if (spec.exists) return;
  const create = "Create It";
  const answer = await window.showInformationMessage("There is no spec beside this ladder yet.", create);
  if (answer === create) await convert(client, ladder, "none");
}

async function report(context: ExtensionContext, server: Server): Promise<void> {
  const client = await server.running();
  const said = client && (await execute<Text>(client, "gradus.report"));
  const editor = [
    `- ${env.appName} ${version}, ${env.uiKind === UIKind.Desktop ? "desktop" : "web"}, remote: ${env.remoteName ?? "no"}`,
    `- extension ${context.extension.packageJSON.version}`,
    `- ${process.platform} ${process.arch}`,
  ];
  const content = ["# Editor", editor.join("\n"), said?.text ?? "The language server is not running.\n"].join("\n\n");
  const document = await workspace.openTextDocument({ language: said?.language ?? "markdown", content });
  await window.showTextDocument(document, { preview: false });
}

async function saveExample(context: ExtensionContext): Promise<void> {
  const folder = workspace.workspaceFolders?.[0]?.uri;
  const name = "neutralization.ladder";
  const target = await window.showSaveDialog({
    title: "Where to save the example program",
    filters: { Ladder: ["ladder"] },
    ...(folder && { defaultUri: Uri.joinPath(folder, name) }),
  });
  if (target === undefined) return;
  await workspace.fs.copy(Uri.joinPath(context.extensionUri, "examples", name), target, { overwrite: true });
  await window.showTextDocument(await workspace.openTextDocument(target), {
    viewColumn: ViewColumn.Active,
    preview: false,
  });
}
