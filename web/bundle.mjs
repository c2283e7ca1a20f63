/* live.html with everything in it, from src/live.ts and the unit: node bundle.mjs UNIT-FOLDER OUT.html */
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const [folder, out] = process.argv.slice(2).map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));
const used = new Set();

async function bundle(entry, plugins = []) {
  const { outputFiles, metafile } = await build({
    entryPoints: [join(here, "src", entry)],
    alias: {
      "unit.wasm": join(folder, "CarTrailer.wasm"),
      "unit.json": join(folder, "CarTrailer.json"),
      "presets.json": join(folder, "presets.json"),
    },
    absWorkingDir: here,
    bundle: true,
    metafile: true,
    minify: true,
    write: false,
    outdir: dirname(out),
    loader: { ".wasm": "binary" },
    plugins,
  });
  Object.keys(metafile.inputs).forEach((input) => used.add(input.match(/.*node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[0]));
  return (ending) => outputFiles.find(({ path }) => path.endsWith(ending)).text;
}

const worker = {
  name: "worker",
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /^worker\.js$/ }, () => ({ path: "worker.js", namespace: "worker" }));
    onLoad({ filter: /./, namespace: "worker" }, async () => ({ contents: (await bundle("worker.ts"))(".js"), loader: "text" }));
  },
};

/* The licence of each package that is in the page, after ours. */
function licences() {
  const packages = [...used].filter((path) => path).sort().map((path) => {
    const { name, version, license } = JSON.parse(readFileSync(join(here, path, "package.json"), "utf8"));
    const file = readdirSync(join(here, path)).find((entry) => /^licen[cs]e/i.test(entry));
    return `${name} ${version} (${license})\n\n${file ? readFileSync(join(here, path, file), "utf8") : ""}`;
  });
  const ours = readdirSync(join(folder, "licenses")).map((file) => readFileSync(join(folder, "licenses", file), "utf8"));
  return [...ours, ...packages].join("\n\n").replaceAll("&", "&amp;").replaceAll("<", "&lt;");
}

const text = await bundle("live.ts", [worker]);
const page = readFileSync(join(here, "live.html"), "utf8")
  .replace("/*STYLE*/", () => text(".css"))
  .replace("LICENCES", () => licences())
  .replace("/*SCRIPT*/", () => text(".js").replaceAll("</script", "<\\/script"));
mkdirSync(dirname(out), { recursive: true });
writeFileSync(out, page);
