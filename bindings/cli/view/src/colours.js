// SPDX-License-Identifier: BSD-3-Clause
// Colours that people tell apart who see few of them: of the adhesion (as plot.py has them), of bodies, of fields.
import { interpolateViridis } from 'd3-scale-chromatic';
import { scaleLinear } from 'd3-scale';

const adhesionStops = {
  light: ['#b3122a', '#f2a541', '#f5e9b8', '#2b6cb0', '#0b2e59'],
  dark: ['#e0503c', '#f2a541', '#f5e9b8', '#6aa6e0', '#2b6cb0'],
};
const bodyTones = ['#efe6cf', '#c8d9ea', '#d5e3cc', '#ead2c6', '#d9d0e8', '#cbe1df', '#e6e0ae', '#d6d6d6'];

const bytesOf = (colour) =>
  colour.startsWith('#')
    ? [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16))
    : colour.match(/\d+/g).slice(0, 3).map(Number);

// A table of 256 colours; values of 0 to 1 are looked up.
function tableOf(colourAt) {
  const table = new Uint8Array(3 * 256);
  for (let i = 0; i < 256; i += 1) table.set(bytesOf(colourAt(i / 255)), 3 * i);
  return table;
}

export function painter(dark) {
  const adhesion = scaleLinear([0, 0.25, 0.5, 0.75, 1], adhesionStops[dark ? 'dark' : 'light']);
  return { adhesion: tableOf(adhesion), field: tableOf(interpolateViridis) };
}

export const toneOf = (body) => bodyTones[body % bodyTones.length];
export const bytesOfTone = (body) => bytesOf(toneOf(body));

// Colours of values from `low` to `high`, three bytes each.
export function painted(values, low, high, table) {
  const out = new Uint8Array(3 * values.length);
  const factor = high > low ? 255 / (high - low) : 0;
  for (let i = 0; i < values.length; i += 1) {
    const at = 3 * Math.min(255, Math.max(0, Math.round((values[i] - low) * factor)));
    out[3 * i] = table[at];
    out[3 * i + 1] = table[at + 1];
    out[3 * i + 2] = table[at + 2];
  }
  return out;
}

export function gradient(table) {
  const stops = [0, 32, 64, 96, 128, 160, 192, 224, 255].map((i) => `rgb(${table.slice(3 * i, 3 * i + 3).join(' ')})`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}
