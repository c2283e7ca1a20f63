/* live.html with everything in it, from src/live.ts and the unit: node bundle.mjs UNIT-FOLDER OUT.html */
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const [folder, out] = process.argv.slice(2).map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));
const { outputFiles } = await build({
  entryPoints: [join(here, "src", "live.ts")],
  alias: { "unit.wasm": join(folder, "CarTrailer.wasm"), "unit.json": join(folder, "CarTrailer.json") },
  bundle: true,
  minify: true,
  write: false,
  outdir: dirname(out),
  loader: { ".wasm": "binary" },
});

function text(ending) {
  return outputFiles.find(({ path }) => path.endsWith(ending)).text.replaceAll("</script", "<\\/script");
}

const page = readFileSync(join(here, "live.html"), "utf8")
  .replace("/*STYLE*/", () => text(".css"))
  .replace("/*SCRIPT*/", () => text(".js"));
mkdirSync(dirname(out), { recursive: true });
writeFileSync(out, page);
