// SPDX-License-Identifier: BSD-3-Clause
// What the page says in words: title, solution, warnings, the numbers of a step, where the result comes from.
import { gradient, toneOf } from './colours.js';
import { loadCurves, number, withScale, withUnit } from './units.js';

const byId = (id) => document.getElementById(id);

export function element(name, text, attributes = {}) {
  const out = document.createElement(name);
  out.textContent = text;
  for (const [key, value] of Object.entries(attributes)) out.setAttribute(key, value);
  return out;
}

// Which solution this is: see plot/result.py.
function solution({ about, every }, units) {
  const { concept = {} } = about;
  const out = [];
  if (concept.solution) out.push(`${concept.solution} solution`);
  if (concept.mixity_rule) out.push(`${concept.mixity_rule} mixity`);
  if ((concept.backtracking ?? 'auto') !== 'auto') out.push(`backtracking ${concept.backtracking}`);
  if (Number(concept.jump_tolerance ?? 0) > 0) out.push(`jumps located to ${concept.jump_tolerance} of a step`);
  out.push(concept.step_control === 'adaptive' ? `adaptive steps in ${about.steps} steps` : `${about.steps} steps`);
  const edge = about.scene.shortest_edge;
  if (edge) out.push(`h = ${withScale(edge, units.length)}`);
  if (every > 1) out.push(`fields of every ${every}th written step`);
  return out.join(', ');
}

function warnings({ about }) {
  const out = [];
  if (about.status !== 'complete') {
    const why = about.reason ? `: ${about.reason}` : '';
    out.push(`INCOMPLETE: ${about.steps_done} of ${about.steps} steps were computed${why}`);
  }
  const bad = about.not_converged ?? [];
  if (bad.length > 0) {
    const few = bad.slice(0, 12).join(', ');
    out.push(
      `${bad.length === 1 ? 'Step' : 'Steps'} ${few}${bad.length > 12 ? ', …' : ''} did not converge; ` +
        'the best state found is shown',
    );
  }
  return out;
}

export function sayResult(result, units) {
  const { about } = result;
  const title = about.scene.title || about.scene.file || 'delam';
  document.title = title;
  byId('title').textContent = title;
  byId('concept').textContent = solution(result, units);
  byId('warnings').replaceChildren(...warnings(result).map((text) => element('li', text)));
  const lines = about.closing ?? [];
  byId('closing')
    .querySelector('ul')
    .replaceChildren(...lines.map((text) => element('li', text)));
  byId('closing').hidden = lines.length === 0;
  const commit = about.commit ? `commit ${String(about.commit).slice(0, 13)}, ` : '';
  byId('origin').textContent =
    `delam ${about.version}, ${commit}scene ${about.scene_hash}, ended ${about.ended}; ` +
    `${result.layout.cells} cells, ${result.steps.length} steps with fields`;
}

// The numbers of a step: [key, title, text].
function readings(result, units, row, sums) {
  const at = (name) => result.column(name)[row];
  const out = [];
  const add = (key, title, value, unit) => {
    if (value !== undefined && value !== null) out.push([key, title, withScale(value, unit)]);
  };
  for (const curve of loadCurves(result, units)) {
    const of = curve.name && curve.suffix ? `, ${curve.name}` : '';
    add(`x${curve.suffix}`, curve.xName + of, curve.own.x[row], curve.own.xScales);
    add(`y${curve.suffix}`, curve.yName + of, curve.own.y[row], curve.own.yScales);
  }
  add('stored', 'stored, bodies', at('stored_bulk'), units.energy);
  add('stored_interface', 'stored, interfaces', at('stored_interface'), units.energy);
  add('dissipated', 'dissipated', at('dissipated'), units.energy);
  add('work', 'work', at('work'), units.energy);
  const flat = result.about.scene.dimension === 2;
  // Three measures, each with what it counts: on a stiff interface the adhesion, a stiffness, is nearly gone long before the
  // toughness is.
  const extent = flat ? 'length' : 'area';
  add('debonded', `debonded ${extent}, without notches`, at('debonded_length'), units.debonded);
  add('crack_area', `crack ${extent}, to the middle of the process zone`, at('crack_area'), units.debonded);
  add(
    'crack_length',
    `${flat ? 'crack length' : 'softened area'} with notches, 1 − adhesion summed up`,
    at('crack_length'),
    units.debonded,
  );
  add('energy_release_rate', 'energy release rate', at('energy_release_rate'), units.energyRate);
  add('displacement', 'largest displacement', sums.displacement, units.length);
  sums.adhesion.forEach((one, i) => {
    if (one)
      out.push([
        `adhesion-${i}`,
        `adhesion, ${result.layout.interfaces[i].name}`,
        `mean ${number(one.mean)}, least ${number(one.least)}`,
      ]);
  });
  return out;
}

export function sayStep(result, units, row, sums) {
  byId('readings').replaceChildren(
    ...readings(result, units, row, sums).map(([key, title, text]) => {
      const item = document.createElement('div');
      item.append(element('dt', title), element('dd', text, { 'data-key': key }));
      return item;
    }),
  );
  const time = result.column('time')[row];
  const last = result.column('step')[result.rows - 1];
  byId('instant').textContent = `step ${result.column('step')[row]} of ${last}, time ${withUnit(time, units.time)}`;
  byId('step').setAttribute('aria-valuetext', byId('instant').textContent);
}

function bar(title, table, ticks) {
  const out = element('div', '', { class: 'bar' });
  out.append(element('span', title));
  const strip = element('i', '');
  strip.style.background = gradient(table);
  const numbers = element('div', '', { class: 'ticks' });
  numbers.append(...ticks.map((text) => element('span', text)));
  out.append(strip, numbers);
  return out;
}

const mostTones = 9;

// field: title, unit and range of the colours of the bodies; null: they have their own.
export function sayColours({ result, colours, field, adhesion }) {
  const parts = [];
  if (adhesion) parts.push(bar('adhesion (stiffness left)', colours.adhesion, ['0 debonded', '0.5', '1 intact']));
  if (field) {
    const { low, high } = field.range;
    parts.push(
      bar(field.title, colours.field, [
        number(low, 3),
        number(0.5 * (low + high), 3),
        `${number(high, 3)}${field.unit ? ` ${field.unit}` : ''}`,
      ]),
    );
  } else if (result.about.layers?.length > 0) {
    const box = element('div', '', { class: 'bodies' });
    const names = result.about.layers.map(String);
    names.slice(0, mostTones).forEach((name, i) => {
      const item = element('span', '');
      const swatch = element('i', '');
      swatch.style.background = toneOf(i);
      item.append(swatch, name);
      box.append(item);
    });
    if (names.length > mostTones) box.append(element('span', `and ${names.length - mostTones} more`));
    parts.push(box);
  }
  byId('legend').replaceChildren(...parts);
}
