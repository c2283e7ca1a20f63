/** What web/unit.py has written, put into the bundle by bundle.mjs. */
declare module "unit.wasm" {
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}

declare module "unit.json" {
  const description: unknown; // a Description
  export default description;
}

declare module "*.css" {}
