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

export class Units {
  constructor(about) {
    const { length = '', force = '', time = '' } = about.units ?? {};
    const flat = about.scene.dimension === 2;
    const known = Boolean(force && length);
    this.length = length;
    this.time = time;
    const work = force === 'N' && length === 'm' ? 'J' : known ? `${force} ${length}` : '';
    this.force = flat ? (known ? `${force}/${length}` : '') : force;
    this.energy = flat && known ? `${work}/${length}` : work;
    this.debonded = !length || flat ? length : `${length}²`;
    // Energy of an area: in the plane both are per unit of thickness.
    this.energyRate = known ? `${force}/${length}` : '';
    [this.stressFactor, this.stress] =
      force === 'N' && length === 'm' ? [1e6, 'MPa'] : [1, known ? `${force}/${length}²` : ''];
  }
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
    if (about.cell || drives === 'strain') {
      return {
        ...curve,
        x: factor,
        y: reaction,
        xLabel: 'load factor',
        yLabel: axis('conjugate of the factor', units.energy),
        xUnit: '',
        yUnit: units.energy,
      };
    }
    if (curve.force) {
      return {
        ...curve,
        x: reaction.map((value) => -value),
        y: factor,
        xLabel: axis('conjugate displacement', units.length),
        yLabel: 'load factor',
        xUnit: units.length,
        yUnit: '',
      };
    }
    return {
      ...curve,
      x: factor,
      y: reaction,
      xLabel: axis('prescribed displacement', units.length),
      yLabel: axis('reaction', units.force),
      xUnit: units.length,
      yUnit: units.force,
    };
  });
}

// Average stress over average strain, of the periodic cell or else of all bodies.
export function averageCurves(result, units) {
  for (const prefix of ['cell_', '']) {
    const found = ['xx', 'yy', 'zz', 'xy', 'yz', 'zx'].filter(
      (c) => result.columns.has(`${prefix}strain_${c}`) && result.columns.has(`${prefix}stress_${c}`),
    );
    if (found.length > 0) {
      return found.map((c) => ({
        name: c,
        x: result.column(`${prefix}strain_${c}`).map((value) => 100 * value),
        y: result.column(`${prefix}stress_${c}`).map((value) => value / units.stressFactor),
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
