// Has TinyUSDZ read USD files; exit code 1 where it cannot. It has no curves to hand out: what it checks is that each
// file is well-formed USD whose attributes have the types of their values.
//
// Usage: node tests/clients/read_usda.mjs TINYUSDZ FILE...
//   TINYUSDZ  its folder in node_modules
import { readFileSync } from 'node:fs';

const [library, ...files] = process.argv.slice(2);

// It is built for browsers: it looks for a window, and refuses to run where there is a process.
const node = globalThis.process;
globalThis.window = globalThis;
Object.defineProperty(globalThis, 'process', { value: undefined, configurable: true, writable: true });
const { default: load } = await import(`file://${library}/tinyusdz.js`);
const tinyusdz = await load({ wasmBinary: readFileSync(`${library}/tinyusdz.wasm`) });
globalThis.process = node;

const read = (text) => {
  const loader = new tinyusdz.TinyUSDZLoaderNative();
  return loader.loadFromBinary(text, 'wires.usda') ? '' : loader.error();
};

let failures = 0;
for (const file of files) {
  const text = readFileSync(file, 'utf8');
  let error = read(text);
  // A reader that takes anything would tell nothing.
  if (!error && !read(text.replace('point3f[] points = [', 'point3f[] points = [x, '))) error = 'a defect was not seen';
  if (error) console.log(`FAILED: TinyUSDZ, ${file}: ${error}`);
  failures += error ? 1 : 0;
}
if (!failures) console.log(`  TinyUSDZ: ${files.length} files`);
process.exit(failures ? 1 : 0);
