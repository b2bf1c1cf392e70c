// Checks glTF files with the Khronos validator (the npm package gltf-validator, a library without a program):
//   npm install --prefix SOME_FOLDER gltf-validator
//   NODE_MODULES=SOME_FOLDER/node_modules node pipelines/validate_gltf.mjs [--all] city.glb...
// Prints one line per file, then its errors and warnings (--all: infos and hints too). Exit code 1 on any error.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';

const modules = process.env.NODE_MODULES ?? path.join(process.cwd(), 'node_modules');
const require = createRequire(path.join(path.resolve(modules), 'anchor.js'));
let validator;
try {
  validator = require('gltf-validator');
} catch {
  console.error(`validate_gltf: no gltf-validator in ${modules}: npm install --prefix FOLDER gltf-validator`);
  process.exit(2);
}

const all = process.argv.includes('--all');
const files = process.argv.slice(2).filter((argument) => argument !== '--all');
const severities = ['error', 'warning', 'info', 'hint'];
let failed = files.length === 0;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: path.basename(file),
    maxIssues: 1000,
    externalResourceFunction: async (uri) =>
      new Uint8Array(await readFile(path.resolve(path.dirname(file), decodeURIComponent(uri)))),
  });
  const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints`);
  for (const m of messages)
    if (all || m.severity < 2) console.log(`  ${severities[m.severity]} ${m.code} ${m.pointer ?? m.offset ?? ''}: ${m.message}`);
  failed ||= numErrors > 0;
}
process.exit(failed ? 1 : 0);
