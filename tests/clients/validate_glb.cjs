// Runs the Khronos glTF validator on a file; exit code 1 for errors and warnings.
const { readFileSync } = require('node:fs');
const validator = require('gltf-validator');

validator.validateBytes(new Uint8Array(readFileSync(process.argv[2]))).then(({ issues, info }) => {
  for (const message of issues.messages) console.log(`  ${message.pointer}: ${message.message}`);
  console.log(
    `  glTF validator: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ` +
      `${info.totalTriangleCount} triangles`,
  );
  process.exit(issues.numErrors + issues.numWarnings > 0 ? 1 : 0);
});
