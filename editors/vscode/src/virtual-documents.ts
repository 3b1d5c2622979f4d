/**
 * Documents that the server makes from a file: its rungs as text, the conditions of its
 * coils, the scans of a scenario, the verdict about a spec, the page of a finding's code or of a word. Their address names the file they are made from,
 * so they can be asked for again at any time, and are, after each analysis of it.
 */
import {
  type Event,
  EventEmitter,
  type Hover,
  MarkdownString,
  type TextDocumentContentProvider,
  Uri,
  workspace,
} from "vscode";
import type { Server } from "./server";

const ofScans = "gradus-simulation";
const ofVerdict = "gradus-verdict";
const schemes = ["gradus-ladder", "gradus-conditions", ofScans, ofVerdict, "gradus-explain"] as const;

/** The rungs of a ladder in the project's notation. */
export function rungsOf(ladder: Uri): Uri {
  return Uri.from({ scheme: "gradus-ladder", path: `${ladder.path}.ladder`, query: ladder.toString() });
}

/** The conditions of all coils of a ladder. */
export function conditionsOf(ladder: Uri): Uri {
  return Uri.from({ scheme: "gradus-conditions", path: `${ladder.path}.txt`, query: ladder.toString() });
}

/** The scans of a scenario. */
export function scansOf(scenario: Uri): Uri {
  return Uri.from({ scheme: ofScans, path: `${scenario.path}.txt`, query: scenario.toString() });
}

/** The page of a finding's code, or of a word that hovers use. */
export function pageOf(name: string): Uri {
  return Uri.from({ scheme: "gradus-explain", path: `/${name}.md` });
}

/** The command that shows a page. */
export const pageCommand = "gradus.page";

/**
 * Makes the links to pages in a hover lead there. The editor follows no address of a scheme that it does not
 * know, but it does run a command that is named to be trusted.
 */
export function withPages(hover: Hover): Hover {
  for (const part of hover.contents) {
    if (!(part instanceof MarkdownString)) continue;
    part.value = part.value.replace(/\]\(gradus-explain:\/([\w-]+)\.md\)/g, (_, name: string) => {
      const argument = encodeURIComponent(JSON.stringify([name]));
      return `](command:${pageCommand}?${argument})`;
    });
    part.isTrusted = { enabledCommands: [pageCommand] };
  }
  return hover;
}

export class VirtualDocuments implements TextDocumentContentProvider {
  readonly #changed = new EventEmitter<Uri>();
  readonly onDidChange: Event<Uri> = this.#changed.event;
  readonly #registrations = schemes.map((scheme) => workspace.registerTextDocumentContentProvider(scheme, this));

  constructor(private readonly server: Server) {}

  dispose(): void {
    for (const registration of this.#registrations) registration.dispose();
    this.#changed.dispose();
  }

  async provideTextDocumentContent(uri: Uri): Promise<string | undefined> {
    const client = await this.server.running();
    const answer = await client?.sendRequest<{ readonly text: string }>("workspace/textDocumentContent", {
      uri: client.code2ProtocolConverter.asUri(uri),
    });
    return answer?.text;
  }

  /** Asks again for what is open and made from that ladder, and for all scans and verdicts, which may be its own. */
  ladderChanged(ladder: string): void {
    const own = Uri.parse(ladder).toString();
    this.#again((uri) => [ofScans, ofVerdict].includes(uri.scheme) || Uri.parse(uri.query).toString() === own);
  }

  /** Asks again for the scans of a scenario. */
  scenarioChanged(scenario: Uri): void {
    this.#again((uri) => uri.scheme === ofScans && Uri.parse(uri.query).toString() === scenario.toString());
  }

  #again(wanted: (uri: Uri) => boolean): void {
    for (const { uri } of workspace.textDocuments) {
      if (schemes.some((scheme) => scheme === uri.scheme) && wanted(uri)) this.#changed.fire(uri);
    }
  }
}
