// SPDX-License-Identifier: BSD-3-Clause
// Numbers and axes with the units of the scene, as plot.py has them (bindings/python/src/delam/_pictures/result.py).
export const number = (value, digits = 4) => {
  if (value === null || value === undefined) return 'infinite';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text = size >= 1e5 || size < 1e-4 ? value.toExponential(digits - 1) : String(Number(value.toPrecision(digits)));
  return text
    .replace(/\.?0+e/, 'e')
    .replace('e+', 'e')
    .replaceAll('-', '−');
};
export const withUnit = (value, unit) => (unit ? `${number(value)} ${unit}` : number(value));
export const axis = (label, unit) => (unit ? `${label} [${unit}]` : label);

// Shown in the unit that the scene names, as text/unit.cpp has it; else with another prefix.
const [leastShown, mostShown] = [0.2, 2000];

// {factor, name} of the unit for numbers up to `largest`; scales: from the smallest unit to the largest (result.json).
export function suiting(scales, largest) {
  if (scales.length === 1) return scales[0];
  const own = scales.find(({ factor }) => factor === 1) ?? { factor: 1, name: '' };
  const size = Math.abs(largest);
  if (!(size > 0) || !Number.isFinite(size) || (size >= leastShown && size < mostShown)) return own;
  if (size * scales[0].factor < leastShown) return own; // rounding
  return scales.findLast(({ factor }) => size * factor >= 1 - 1e-9) ?? scales[0] ?? own;
}

const largestOf = (values) =>
  values.reduce((most, value) => (Number.isFinite(value) ? Math.max(most, Math.abs(value)) : most), 0);

// The scales of a quantity that has one unit on the whole page: that which suits the largest of these numbers.
const one = (scales, ...lists) => [suiting(scales, Math.max(0, ...lists.map(largestOf)))];

export class Units {
  constructor(result) {
    const { about } = result;
    const { length = '', force = '', time = '', scales = {} } = about.units ?? {};
    const flat = about.scene.dimension === 2;
    const known = Boolean(force && length);
    const of = (key, plain) => scales[key] ?? [{ factor: 1, name: plain }];
    const over = known && flat ? `/${length}` : '';
    this.time = time;
    this.length = of('length', length);
    this.force = of(flat ? 'line_force' : 'force', known ? `${force}${over}` : '');
    this.energy = of(flat ? 'line_energy' : 'energy', known ? `${force} ${length}${over}` : '');
    this.debonded = of(flat ? 'length' : 'area', length && !flat ? `${length}²` : length);
    this.energyRate = of('release_rate', known ? `${force}/${length}` : '');
    this.stress = of('stress', known ? `${force}/${length}²` : '');
    // Energies, forces and toughnesses are compared with each other; lengths reach from displacements to specimens.
    const columns = (...names) => names.map((name) => result.column(name));
    const several = (about.patterns ?? []).length > 1;
    const reactions = (about.patterns ?? []).map(({ name, drives }) => ({ of: several ? `reaction_${name}` : 'reaction', drives }));
    const within = Boolean(about.cell);
    this.force = one(this.force, ...columns(...reactions.filter(({ drives }) => drives === 'displacement').map(({ of: key }) => key)));
    this.energy = one(
      this.energy,
      ...columns('stored_bulk', 'stored_interface', 'dissipated', 'work', 'load_potential'),
      ...columns(...reactions.filter(({ drives }) => within || drives === 'strain').map(({ of: key }) => key)),
    );
    this.energyRate = one(this.energyRate, result.column('energy_release_rate'));
    this.none = [{ factor: 1, name: '' }];
  }
}

// "5.08 mm" for 0.00508 in a scene in m.
export function withScale(value, scales) {
  const { factor, name } = suiting(scales, value);
  return withUnit(value === null || value === undefined ? value : value * factor, name);
}

// The numbers of an axis, in the unit that suits all of them, and its label.
export function scaled(label, scales, ...lists) {
  const { factor, name } = suiting(scales, Math.max(0, ...lists.map(largestOf)));
  return {
    factor,
    label: axis(label, name),
    lists: lists.map((list) => (factor === 1 ? list : list.map((value) => value * factor))),
  };
}

// The patterns whose curves are drawn, with their axes; of prescribed strains only if all are.
export function loadCurves(result, units) {
  const { about } = result;
  const all = about.patterns ?? [];
  const shown = all.length > 1 ? all.filter((p) => p.drives !== 'strain') : all;
  const patterns = shown.length > 0 ? shown : all;
  return (patterns.length > 0 ? patterns : [{ name: '', drives: 'displacement' }]).map(({ name, drives }) => {
    const suffix = all.length > 1 ? `_${name}` : '';
    const factor = result.column(`load${suffix}`);
    const reaction = result.column(`reaction${suffix}`);
    const curve = { name, suffix, force: drives === 'force' };
    const axes = (x, xName, xScales, y, yName, yScales) => {
      // The upright axis is short: the reading below says of what it is the conjugate.
      const [across, up] = [scaled(xName, xScales, x), scaled(yName.replace(' of the factor', ''), yScales, y)];
      return {
        ...curve,
        x: across.lists[0],
        y: up.lists[0],
        xFactor: across.factor,
        yFactor: up.factor,
        xLabel: across.label,
        yLabel: up.label,
        xName,
        yName,
        own: { x, y, xScales, yScales },
      };
    };
    if (about.cell || drives === 'strain')
      return axes(factor, 'load factor', units.none, reaction, 'conjugate of the factor', units.energy);
    if (curve.force) {
      const moved = reaction.map((value) => -value);
      return axes(moved, 'conjugate displacement', units.length, factor, 'load factor', units.none);
    }
    return axes(factor, 'prescribed displacement', units.length, reaction, 'reaction', units.force);
  });
}

// Average stress over average strain, of the periodic cell or else of all bodies.
export function averageCurves(result) {
  for (const prefix of ['cell_', '']) {
    const found = ['xx', 'yy', 'zz', 'xy', 'yz', 'zx'].filter(
      (c) => result.columns.has(`${prefix}strain_${c}`) && result.columns.has(`${prefix}stress_${c}`),
    );
    if (found.length > 0) {
      return found.map((c) => ({
        name: c,
        x: result.column(`${prefix}strain_${c}`).map((value) => 100 * value),
        y: result.column(`${prefix}stress_${c}`),
      }));
    }
  }
  return [];
}

// Energies over time. The work is counted from what is stored at the beginning, so that it meets the total.
export function energyCurves(result) {
  const bulk = result.column('stored_bulk');
  const interfaces = result.column('stored_interface');
  const dissipated = result.column('dissipated');
  const potential = result.columns.has('load_potential') ? result.column('load_potential') : null;
  const stored = bulk.map((value, i) => value + interfaces[i] + (potential ? potential[i] : 0));
  const x = result.column('time');
  return [
    { name: 'stored, bodies', x, y: bulk, colour: 'blue' },
    { name: 'stored, interfaces', x, y: interfaces, colour: 'green' },
    ...(potential ? [{ name: 'potential of the dead loads', x, y: potential, colour: 'grey' }] : []),
    { name: 'dissipated', x, y: dissipated, colour: 'red' },
    { name: 'total', x, y: stored.map((value, i) => value + dissipated[i]), colour: 'ink' },
    { name: 'work', x, y: result.column('work').map((value) => value + stored[0]), colour: 'orange', dash: true },
  ];
}

// The larger jumps: on a coarse mesh every pair that breaks is one.
export function largerJumps(result) {
  const most = Math.max(0, ...result.jumps.map(({ debonded }) => debonded));
  return result.jumps.filter(({ debonded }) => debonded > 0.2 * most);
}
