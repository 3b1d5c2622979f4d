/**
 * Which documents hold ladder. Texts of the project's own languages do by their name.
 * XML belongs to everybody: only its beginning tells whether it is a ladder export, and
 * other XML must not even start the language server.
 */
import { Range, type TextDocument } from "vscode";

export const specLanguage = "grafcet";
export const scenarioLanguage = "gradus-scenario";
export const ownLanguages = ["gradus-ladder", specLanguage, scenarioLanguage, "neutral-text"] as const;
const ladderLanguages = ["gradus-ladder", "neutral-text"] as const;
export const xmlLanguages = ["xml", "l5x"] as const;

/** Where the server knows documents: it reads and writes what lies beside a file, and texts that other extensions make up have nothing beside them. */
export const schemes = ["file", "untitled"] as const;

/** Whether the language server has anything to say about the document. */
export function concernsGradus(document: TextDocument): boolean {
  return isServed(document) && (isAmong(ownLanguages, document.languageId) || isLadderXml(document));
}

/** Whether the document holds rungs, and the server knows it. */
export function holdsLadder(document: TextDocument): boolean {
  return isServed(document) && (isAmong(ladderLanguages, document.languageId) || isLadderXml(document));
}

function isServed(document: TextDocument): boolean {
  return isAmong(schemes, document.uri.scheme);
}

function isLadderXml(document: TextDocument): boolean {
  if (!isAmong(xmlLanguages, document.languageId)) return false;
  return beginsAsLadderXml(document.getText(new Range(0, 0, 100, 0)).slice(0, 4096));
}

/** Whether the beginning of an XML text is that of a Rockwell or PLCopen export. */
export function beginsAsLadderXml(text: string): boolean {
  return /<RSLogix5000Content[\s>]/.test(text) || /www\.plcopen\.org\/xml\/tc6/i.test(text);
}

function isAmong(all: readonly string[], one: string): boolean {
  return all.includes(one);
}
