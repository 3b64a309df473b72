// node validate.mjs FILE...: fails where Khronos' validator has an error, a warning or a hint about a glTF file.
import { readFile } from "node:fs/promises";
import validator from "gltf-validator";

const names = { 0: "error", 1: "warning", 3: "hint" }; // the validator's severities; 2 is information
let faults = 0;
const files = process.argv.slice(2);
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), { maxIssues: 0 });
  for (const { severity, code, message, pointer } of report.issues.messages) {
    if (!(severity in names)) continue;
    console.log(`${file}: ${names[severity]} ${code} at ${pointer}: ${message}`);
    ++faults;
  }
}
console.log(`validator ${validator.version()}: ${files.length} files, ${faults} faults`);
process.exit(files.length > 0 && faults === 0 ? 0 : 1);
