/** What tests/web/conftest.py puts into the bundle of a test. */
declare module "axe.source" {
  const source: string; // of axe-core, to be run in the page
  export default source;
}
