// SPDX-License-Identifier: BSD-3-Clause
// The result that the page carries: what it says, and its arrays, which are unpacked when they are asked for.
import { unzlibSync } from 'fflate';

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const word = atob(text);
  const bytes = new Uint8Array(word.length);
  for (let i = 0; i < word.length; i += 1) bytes[i] = word.charCodeAt(i);
  return bytes;
}

async function inflated(bytes) {
  if (typeof DecompressionStream === 'function') {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }
  return unzlibSync(bytes);
}

// The bytes lie sorted by their place in a number: see view_arrays.cpp.
function numbers(bytes, { type, count }) {
  const size = 4;
  const out = new Uint8Array(size * count);
  if (bytes.length !== out.length) throw new Error(`an array has ${bytes.length} bytes, and not ${out.length}`);
  for (let k = 0; k < size; k += 1) {
    for (let i = 0, from = k * count, to = k; i < count; i += 1, from += 1, to += size) out[to] = bytes[from];
  }
  return type === 'int32' ? new Int32Array(out.buffer) : new Float32Array(out.buffer);
}

// xxx.. yyy.. zzz.. as xyz xyz ..
function interleaved(values) {
  const count = values.length / 3;
  const out = new Float32Array(values.length);
  for (let i = 0; i < count; i += 1) {
    out[3 * i] = values[i];
    out[3 * i + 1] = values[count + i];
    out[3 * i + 2] = values[2 * count + i];
  }
  return out;
}

const mostBytes = 128 * 2 ** 20; // of the steps that are kept unpacked

export class Result {
  constructor(root) {
    this.root = root;
    const data = JSON.parse(root.getElementById('delam-data').textContent);
    Object.assign(this, {
      about: data.about,
      steps: data.steps,
      jumps: data.jumps,
      every: data.every,
      layout: data.mesh,
    });
    this.columns = new Map(data.history.map(({ name, values }) => [name, values]));
    this.rows = this.column('step').length;
    // The row of the history that each step with fields has.
    const rowOf = new Map(this.column('step').map((step, row) => [step, row]));
    this.rowOfStep = this.steps.map(({ step }) => rowOf.get(step) ?? this.rows - 1);
    this.unpacked = new Map();
    this.bytes = 0;
  }

  column(name) {
    return this.columns.get(name) ?? [];
  }

  // The step with fields that is next to a row of the history.
  stepOfRow(row) {
    let best = 0;
    this.rowOfStep.forEach((at, i) => {
      if (Math.abs(at - row) < Math.abs(this.rowOfStep[best] - row)) best = i;
    });
    return best;
  }

  async array(description) {
    if (!description) return null;
    return numbers(await inflated(bytesOfBase64(this.root.getElementById(description.id).textContent)), description);
  }

  async mesh() {
    const { layout } = this;
    const polygons = async (of) => ({ offsets: await this.array(of.offsets), nodes: await this.array(of.nodes) });
    const interfaces = layout.interfaces.map(async (one) => ({
      name: one.name,
      sides: (await Promise.all([this.array(one.a), this.array(one.b)])).filter((side) => side),
      faces: await polygons(one),
    }));
    return {
      flat: layout.dimension === 2,
      points: interleaved(await this.array(layout.points)),
      faces: await polygons(layout),
      body: await this.array(layout.body),
      interfaces: await Promise.all(interfaces),
    };
  }

  // Of a step what colours bodies; unpacked anew each time, where all steps are gone through.
  async ofBodies(i) {
    const { displacement, stress } = this.steps[i];
    const u = await this.array(displacement);
    return { displacement: u && interleaved(u), stress: await this.array(stress) };
  }

  // The fields of a step; null where the scene did not ask for one. Stresses are by component, one value for each face.
  async step(i) {
    if (!this.unpacked.has(i)) {
      const of = this.steps[i];
      const one = {
        step: of.step,
        time: of.time,
        ...(await this.ofBodies(i)),
        adhesion: await Promise.all(of.adhesion.map((zeta) => this.array(zeta))),
      };
      one.bytes = [one.displacement, one.stress, ...one.adhesion].reduce((sum, a) => sum + (a ? a.byteLength : 0), 0);
      this.unpacked.set(i, one);
      this.bytes += one.bytes;
      for (const [old, { bytes }] of this.unpacked) {
        if (this.bytes <= mostBytes || old === i) break;
        this.unpacked.delete(old);
        this.bytes -= bytes;
      }
    }
    return this.unpacked.get(i);
  }
}

// Widens a range {low, high} by values.
export function widen(range, values) {
  for (const value of values) {
    if (value < range.low) range.low = value;
    if (value > range.high) range.high = value;
  }
  return range;
}

export const nothing = () => ({ low: Infinity, high: -Infinity });

// What a step comes to: the largest displacement, and of each interface the mean and the least adhesion.
export function summary(step) {
  let largest = 0;
  const u = step.displacement ?? [];
  for (let i = 0; i < u.length; i += 3) largest = Math.max(largest, u[i] ** 2 + u[i + 1] ** 2 + u[i + 2] ** 2);
  const adhesion = step.adhesion.map((zeta) => {
    if (!zeta || zeta.length === 0) return null;
    let sum = 0;
    let least = Infinity;
    for (const value of zeta) {
      sum += value;
      least = Math.min(least, value);
    }
    return { mean: sum / zeta.length, least };
  });
  return { displacement: step.displacement ? Math.sqrt(largest) : null, adhesion };
}
