/** What web/unit.py and web/presets.py have written, and what bundle.mjs makes: put into the bundle there. */
declare module "unit.wasm" {
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}

declare module "unit.json" {
  const description: unknown; // a Description
  export default description;
}

declare module "presets.json" {
  const paper: unknown; // a Paper
  export default paper;
}

declare module "worker.js" {
  const source: string; // worker.ts with all that it imports
  export default source;
}

declare module "*.css" {}
