/* An FMI 3 unit in WebAssembly, driven by Node alone. Arguments: MODULE.wasm JOB.json; what came out goes to stdout.
 *
 * A job: token; set, [reference, value] pairs; outputs, references; times, communication points in s from 0;
 * cycles, how many more instances are made and freed. */
import { readFileSync } from "node:fs";

const [file, jobFile] = process.argv.slice(2);
const job = JSON.parse(readFileSync(jobFile, "utf8"));
const fmi = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(file))).exports;
fmi._initialize();

/* The module's memory may move when it grows, in any call: look at it afresh each time. */
const floats = (address, n) => new Float64Array(fmi.memory.buffer, address, n);
const words = (address, n) => new Uint32Array(fmi.memory.buffer, address, n);

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

function references(values) {
  const address = fmi.malloc(4 * values.length + 4);
  words(address, values.length).set(values);
  return address;
}

/* A pointer to a function is a place in the module's table, which takes functions of WebAssembly alone: so one of a
 * module that does nothing but import it, as (i32, i32, i32, i32) -> (), and export it again. */
function logger(receive) {
  const type = [1, 8, 1, 0x60, 4, 0x7f, 0x7f, 0x7f, 0x7f, 0];
  const shim = [0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, ...type, 2, 7, 1, 1, 0x6d, 1, 0x66, 0, 0, 7, 5, 1, 1, 0x66, 0, 0];
  const { f } = new WebAssembly.Instance(new WebAssembly.Module(new Uint8Array(shim)), { m: { f: receive } }).exports;
  const place = fmi.__indirect_function_table.grow(1);
  fmi.__indirect_function_table.set(place, f);
  return place;
}

const messages = [];
const log = logger((environment, status, category, message) =>
  messages.push([environment, status, text(category), text(message)]),
);
const name = string("unit");
const token = string(job.token);
const outputs = references(job.outputs);
const values = fmi.malloc(8 * job.outputs.length);
const parts = fmi.malloc(24);
const state = fmi.malloc(4);

function instance() {
  return fmi.fmi3InstantiateCoSimulation(name, token, 0, 0, 1, 0, 0, 0, 0, 4711, log, 0);
}

function demand(status, what) {
  if (status !== 0) throw new Error(`${what}: status ${status}: ${messages.at(-1)}`);
}

function started() {
  const unit = instance();
  demand(fmi.fmi3EnterInitializationMode(unit, 1, 1e-6, 0, 0, 0), "start");
  for (const [reference, value] of job.set) {
    const address = references([reference]);
    floats(values, 1)[0] = value;
    demand(fmi.fmi3SetFloat64(unit, address, 1, values, 1), `set ${reference}`);
    fmi.free(address);
  }
  demand(fmi.fmi3ExitInitializationMode(unit), "initialization");
  return unit;
}

const step = (unit, time, size) => fmi.fmi3DoStep(unit, time, size, 0, parts, parts + 4, parts + 8, parts + 16);

function row(unit) {
  demand(fmi.fmi3GetFloat64(unit, outputs, job.outputs.length, values, job.outputs.length), "get");
  return Array.from(floats(values, job.outputs.length));
}

function run(unit, from, to) {
  const rows = [];
  for (let i = from; i < to; i++) {
    demand(step(unit, job.times[i], job.times[i + 1] - job.times[i]), `step ${i}`);
    rows.push(row(unit));
  }
  return rows;
}

const unit = started();
const half = job.times.length >> 1;
const rows = [row(unit), ...run(unit, 0, half)];
demand(fmi.fmi3GetFMUState(unit, state), "a state");
rows.push(...run(unit, half, job.times.length - 1));
demand(fmi.fmi3SetFMUState(unit, words(state, 1)[0]), "the state");
const again = run(unit, half, job.times.length - 1);
demand(fmi.fmi3FreeFMUState(unit, state), "free the state");
const refused = step(unit, job.times.at(-1), -1);
fmi.fmi3FreeInstance(unit);

const size = fmi.memory.buffer.byteLength;
for (let cycle = 0; cycle < job.cycles; cycle++) {
  const other = started();
  demand(step(other, 0, job.times[1]), "a step");
  fmi.fmi3FreeInstance(other);
}
const stranger = fmi.fmi3InstantiateCoSimulation(name, name, 0, 0, 1, 0, 0, 0, 0, 4711, log, 0);
const found = {
  version: text(fmi.fmi3GetVersion()),
  rows,
  again,
  refused,
  stranger,
  messages,
  grown: fmi.memory.buffer.byteLength - size,
};
console.log(JSON.stringify(found, (_, value) => (Object.is(value, -0) ? "-0" : value)));
