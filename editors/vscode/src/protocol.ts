/**
 * What the language server offers beyond the Language Server Protocol, and what this
 * client tells it in turn. The server's page of it is docs/protocol.md.
 */
import type { ClientCapabilities, FeatureState, StaticFeature } from "vscode-languageclient/node";
import { ExecuteCommandRequest, type LanguageClient, NotificationType } from "vscode-languageclient/node";

export type Verdict = "no-sequence" | "no-spec" | "in-step" | "behind";

/** Sent after each analysis of a ladder that is open, or whose spec is. */
export interface Status {
  /** The ladder. */
  readonly uri: string;
  /** States that the ladder has, and how many of them the spec has steps for. */
  readonly states: number;
  readonly accepted: number;
  /** Successions that are neither accepted nor rejected. */
  readonly open: number;
  /** Rules of the spec, and how many of them the ladder no longer supports. */
  readonly rules: number;
  readonly stale: number;
  readonly verdict: Verdict;
  readonly message: string;
  /** Whether the spec does what the ladder does, if there is a spec. */
  readonly proof?: Proof;
}

/** How far it is known whether a spec does what its ladder does. */
export interface Proof {
  readonly verdict: "equivalent" | "different" | "unknown" | "refused" | "proving" | "stopped" | "mistaken" | "unasked";
  readonly message: string;
}

export const statusNotification = new NotificationType<Status>("gradus/status");

/** What `gradus.convert` accepts on the way. */
export type Accept = "none" | "handover" | "witnessed" | "all";

/** What `gradus.convert` answers. */
export interface Conversion {
  readonly uri: string;
  readonly summary: string;
  readonly changed: boolean;
}

/** What `gradus.openSpec` answers. */
export interface Spec {
  readonly uri: string;
  readonly exists: boolean;
}

/** What `gradus.simulate` answers. */
export interface Simulated extends Text {
  /** Where the server shows it, kept up to date. */
  readonly uri: string;
  readonly summary: string;
  readonly passed: boolean;
}

/** What `gradus.search` answers. */
export interface Searched {
  readonly uri: string;
  readonly summary: string;
}

/** What `gradus.verify` answers. */
export interface Verified extends Text {
  /** Where the server shows it, kept up to date. */
  readonly uri: string;
  readonly summary: string;
}

/** What `gradus.showScan` answers: the scan that is shown, and what was done before it. */
export interface Scan {
  readonly scan: number;
  readonly done: string;
}

/** A text that the server wrote for people. */
export interface Text {
  readonly title: string;
  readonly language: string;
  readonly text: string;
}

export function execute<Answer>(client: LanguageClient, command: string, ...args: unknown[]): Promise<Answer> {
  return client.sendRequest(ExecuteCommandRequest.type, { command, arguments: args }) as Promise<Answer>;
}

/** Tells the server which of its further messages this client understands. */
export const furtherCapabilities: StaticFeature = {
  fillClientCapabilities(capabilities: ClientCapabilities): void {
    capabilities.experimental = { gradusStatus: true, gradusVirtualDocuments: true, gradusPages: true };
  },
  initialize(): void {},
  getState(): FeatureState {
    return { kind: "static" };
  },
  clear(): void {},
};
