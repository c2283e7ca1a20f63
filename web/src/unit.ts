/**
 * A unit in WebAssembly (docs/fmu.md): FMI 3's functions on the module's memory. What the unit refuses is a UnitError
 * with the unit's own words.
 */

/** What web/unit.py takes from modelDescription.xml. */
export interface Description {
  name: string;
  token: string;
  variables: Record<string, Variable>;
}

/** Values in `unit`, SI; null: there is none. */
export interface Variable {
  reference: number;
  causality: string;
  unit: string | null;
  start: number | null;
  min: number | null;
  max: number | null;
  description: string | null;
}

export class UnitError extends Error {
  override name = "UnitError";
}

/** The exports that are used; pointers and sizes are numbers, booleans 0 or 1. */
interface Library {
  memory: WebAssembly.Memory;
  __indirect_function_table: WebAssembly.Table;
  _initialize(): void;
  malloc(size: number): number;
  free(address: number): void;
  fmi3GetVersion(): number;
  fmi3InstantiateCoSimulation(
    name: number, token: number, resources: number, visible: number, logging: number, events: number, early: number,
    required: number, nRequired: number, environment: number, log: number, update: number,
  ): number;
  fmi3Reset(unit: number): number;
  fmi3EnterInitializationMode(
    unit: number, hasTolerance: number, tolerance: number, start: number, hasStop: number, stop: number,
  ): number;
  fmi3ExitInitializationMode(unit: number): number;
  fmi3SetFloat64(unit: number, references: number, n: number, values: number, nValues: number): number;
  fmi3GetFloat64(unit: number, references: number, n: number, values: number, nValues: number): number;
  fmi3DoStep(
    unit: number, time: number, size: number, noRollback: number,
    event: number, terminate: number, early: number, last: number,
  ): number;
  fmi3FreeInstance(unit: number): void;
}

const OK_OR_WARNING = 1;
const ANSWERS = 16; // bytes: three booleans and, aligned, a time that fmi3DoStep answers

/** One instance in a module of its own, for Co-Simulation without events. */
export class Unit {
  readonly version: string;
  readonly #library: Library;
  readonly #references: Record<string, Variable>;
  readonly #instance: number;
  readonly #answers: number;
  #lastMessage = "";

  /** UnitError where module and description are not of the same unit. */
  constructor(module: WebAssembly.Module, { name, token, variables }: Description) {
    const library = new WebAssembly.Instance(module).exports as unknown as Library;
    library._initialize();
    this.#library = library;
    this.#references = variables;
    this.version = this.#text(library.fmi3GetVersion());
    const log = callback(library, (_environment, _status, _category, message) => {
      this.#lastMessage = this.#text(message);
    });
    const texts = [name, token].map((text) => this.#string(text)) as [number, number];
    this.#instance = library.fmi3InstantiateCoSimulation(...texts, 0, 0, 1, 0, 0, 0, 0, 0, log, 0);
    texts.forEach((address) => library.free(address));
    if (this.#instance === 0) {
      throw new UnitError(this.#lastMessage);
    }
    this.#answers = library.malloc(ANSWERS);
  }

  /** From the beginning: parameters and inputs by name, in SI units, others as they are by default. */
  start(values: Record<string, number>, tolerance = 1e-6): void {
    const library = this.#library;
    const names = Object.keys(values);
    this.#demand(library.fmi3Reset(this.#instance));
    this.#demand(library.fmi3EnterInitializationMode(this.#instance, 1, tolerance, 0, 0, 0));
    const list = this.#list(names);
    try {
      this.#floats(list.values, names.length).set(Object.values(values));
      this.#demand(library.fmi3SetFloat64(this.#instance, list.references, names.length, list.values, names.length));
    } finally {
      library.free(list.references);
    }
    this.#demand(library.fmi3ExitInitializationMode(this.#instance));
  }

  /**
   * Values at `times` in s, rising from that of the start, by name; between two of them the unit chooses its own steps.
   * What fails on the way ends it, and so does what takes longer than `patience` in ms.
   */
  sample(times: Float64Array, names: string[], patience = Infinity): Record<string, Float64Array> {
    const library = this.#library;
    const columns = names.map(() => new Float64Array(times.length));
    const list = this.#list(names);
    const begin = performance.now();
    try {
      times.forEach((time, i) => {
        if (performance.now() - begin > patience) {
          const taken = `takes longer than ${patience / 1000} s`;
          throw new UnitError(`a run ${taken} with this: it was ended at t = ${time.toFixed(2)} s`);
        }
        if (i > 0) {
          this.#step(times[i - 1]!, time);
        }
        this.#demand(library.fmi3GetFloat64(this.#instance, list.references, names.length, list.values, names.length));
        this.#floats(list.values, names.length).forEach((value, j) => (columns[j]![i] = value));
      });
    } finally {
      library.free(list.references);
    }
    return Object.fromEntries(names.map((name, j) => [name, columns[j]!]));
  }

  free(): void {
    this.#library.fmi3FreeInstance(this.#instance);
    this.#library.free(this.#answers);
  }

  #step(from: number, to: number): void {
    const at = this.#answers;
    this.#demand(this.#library.fmi3DoStep(this.#instance, from, to - from, 1, at, at + 1, at + 2, at + 8));
  }

  #demand(status: number): void {
    if (status > OK_OR_WARNING) {
      throw new UnitError(this.#lastMessage);
    }
  }

  /** Room for the variables' values and, at its beginning in memory, their references. */
  #list(names: string[]): { references: number; values: number } {
    const numbers = names.map((name) => {
      const variable = this.#references[name];
      if (variable === undefined) {
        throw new UnitError(`the unit has no variable ${name}`);
      }
      return variable.reference;
    });
    const values = 8 * Math.ceil(numbers.length / 2); // aligned
    const references = this.#library.malloc(values + 8 * numbers.length + 8);
    new Uint32Array(this.#library.memory.buffer, references, numbers.length).set(numbers);
    return { references, values: references + values };
  }

  /** A view for now: any call may let the memory grow, and then the view is empty. */
  #floats(address: number, n: number): Float64Array {
    return new Float64Array(this.#library.memory.buffer, address, n);
  }

  #text(address: number): string {
    const bytes = new Uint8Array(this.#library.memory.buffer, address);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  #string(text: string): number {
    const bytes = new TextEncoder().encode(`${text}\0`);
    const address = this.#library.malloc(bytes.length);
    new Uint8Array(this.#library.memory.buffer, address).set(bytes);
    return address;
  }
}

type Log = (environment: number, status: number, category: number, message: number) => void;

/**
 * A pointer to a function: its place in the module's table. That takes functions of WebAssembly alone, so the function
 * comes from a module that imports it as m.f of type (i32, i32, i32, i32) -> () and exports it as f.
 */
function callback(library: Library, receive: Log): number {
  const head = [0x00, 0x61, 0x73, 0x6d, 1, 0, 0, 0];
  const type = [1, 8, 1, 0x60, 4, 0x7f, 0x7f, 0x7f, 0x7f, 0];
  const imports = [2, 7, 1, 1, 0x6d, 1, 0x66, 0, 0];
  const exports = [7, 5, 1, 1, 0x66, 0, 0];
  const module = new WebAssembly.Module(new Uint8Array([...head, ...type, ...imports, ...exports]));
  const { f } = new WebAssembly.Instance(module, { m: { f: receive } }).exports;
  const place = library.__indirect_function_table.grow(1);
  library.__indirect_function_table.set(place, f);
  return place;
}
