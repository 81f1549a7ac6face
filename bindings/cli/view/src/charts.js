// SPDX-License-Identifier: BSD-3-Clause
// The charts of a result: load curves, stress and strain where the history has them, energies.
import { Chart } from './chart.js';
import { averageCurves, axis, energyCurves, largerJumps, loadCurves } from './units.js';

const mostPatterns = 6;
const colours = ['blue', 'red', 'green', 'orange', 'violet', 'grey'];

// A jump along a load curve. Rows without these columns are of an older file.
function jumpAlong(curve, jump) {
  const {
    [`load${curve.suffix}`]: load,
    [`reaction_before${curve.suffix}`]: before,
    [`reaction_after${curve.suffix}`]: after,
  } = jump;
  if ([load, before, after].some((value) => value === undefined)) return [];
  return [
    curve.force ? { x0: -before, y0: load, x1: -after, y1: load } : { x0: load, y0: before, x1: load, y1: after },
  ];
}

export function makeCharts(parent, result, units, onRow) {
  const out = [];
  const steps = result.column('step');
  const bad = new Set(result.about.not_converged ?? []);
  const failed = steps.flatMap((step, row) => (bad.has(step) ? [row] : []));
  const jumps = largerJumps(result);
  for (const curve of loadCurves(result, units).slice(0, mostPatterns)) {
    out.push(
      new Chart(parent, {
        title: curve.name ? `Load and displacement, ${curve.name}` : 'Load and displacement',
        xLabel: curve.xLabel,
        yLabel: curve.yLabel,
        near: 'both',
        failed,
        onRow,
        curves: [{ name: '', x: curve.x, y: curve.y, colour: 'blue' }],
        jumps: jumps.flatMap((jump) => jumpAlong(curve, jump)),
      }),
    );
  }
  const averages = averageCurves(result, units);
  if (averages.length > 0) {
    out.push(
      new Chart(parent, {
        title: 'Average stress and strain',
        xLabel: 'average strain [%]',
        yLabel: axis('average stress', units.stress),
        near: 'both',
        onRow,
        curves: averages.map((one, i) => ({ ...one, colour: colours[i % colours.length] })),
      }),
    );
  }
  out.push(
    new Chart(parent, {
      title: 'Energies',
      xLabel: axis('time', units.time),
      yLabel: axis('energy', units.energy),
      onRow,
      curves: energyCurves(result),
      jumps: jumps.map(({ time }) => ({ x: time })),
    }),
  );
  return out;
}
