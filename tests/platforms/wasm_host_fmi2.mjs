/* An FMI 2 unit in WebAssembly, by Node alone: figure 8's brake, then a step that is refused. Arguments: MODULE.wasm GUID
 * and the value references of the brake torque and of what is seen, whose last value goes to stdout with the message. */
import { readFileSync } from "node:fs";

const [file, guid, torque, seen] = process.argv.slice(2);
const fmi = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(file))).exports;
fmi._initialize();

const words = (address, n) => new Uint32Array(fmi.memory.buffer, address, n);
const floats = (address) => new Float64Array(fmi.memory.buffer, address, 1);

function text(address) {
  const bytes = new Uint8Array(fmi.memory.buffer, address);
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}

function string(value) {
  const bytes = new TextEncoder().encode(`${value}\0`);
  const address = fmi.malloc(bytes.length);
  new Uint8Array(fmi.memory.buffer, address).set(bytes);
  return address;
}

/* As in wasm_host.mjs, with six arguments: the last is the address of those that are variable in number. */
const type = [1, 10, 1, 0x60, 6, 0x7f, 0x7f, 0x7f, 0x7f, 0x7f, 0x7f, 0];
const shim = [0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, ...type, 2, 7, 1, 1, 0x6d, 1, 0x66, 0, 0, 7, 5, 1, 1, 0x66, 0, 0];
const messages = [];
const receive = (environment, name, status, category, format, rest) =>
  messages.push([environment, text(name), status, text(category), text(format), text(words(rest, 1)[0])]);
const { f } = new WebAssembly.Instance(new WebAssembly.Module(new Uint8Array(shim)), { m: { f: receive } }).exports;
const place = fmi.__indirect_function_table.grow(1);
fmi.__indirect_function_table.set(place, f);
const callbacks = fmi.malloc(20);
words(callbacks, 5).set([place, 0, 0, 0, 4711]); /* logger, memory of our own (none), step finished, environment */

const reference = fmi.malloc(4);
const value = fmi.malloc(8);
const demand = (status) => { if (status !== 0) throw new Error(`status ${status}: ${messages.at(-1)}`); };
const unit = fmi.fmi2Instantiate(string("unit"), 1, string(guid), 0, callbacks, 0, 0);
demand(fmi.fmi2SetupExperiment(unit, 1, 1e-6, 0, 0, 0));
demand(fmi.fmi2EnterInitializationMode(unit));
words(reference, 1)[0] = Number(torque);
floats(value)[0] = 1000;
demand(fmi.fmi2SetReal(unit, reference, 1, value));
demand(fmi.fmi2ExitInitializationMode(unit));
for (let i = 0; i < 600; i++) demand(fmi.fmi2DoStep(unit, i / 100, (i + 1) / 100 - i / 100, 1));
words(reference, 1)[0] = Number(seen);
demand(fmi.fmi2GetReal(unit, reference, 1, value));
const refused = fmi.fmi2DoStep(unit, 6, -1, 1);
fmi.fmi2FreeInstance(unit);
console.log(JSON.stringify({ value: floats(value)[0], refused, messages }));
