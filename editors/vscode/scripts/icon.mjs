// Draws media/icon.png, which extension galleries ask for, from media/icon.svg.
import { readFileSync, writeFileSync } from "node:fs";
import { Resvg } from "@resvg/resvg-js";

const media = new URL("../media/", import.meta.url);
const drawing = readFileSync(new URL("icon.svg", media));
const picture = new Resvg(drawing, { fitTo: { mode: "width", value: 256 } }).render();
writeFileSync(new URL("icon.png", media), picture.asPng());
