// SPDX-License-Identifier: BSD-3-Clause
// The charts of a result: load curves, stress and strain where the history has them, energies.
import { Chart } from './chart.js';
import { averageCurves, axis, energyCurves, largerJumps, loadCurves, scaled } from './units.js';

const mostPatterns = 6;
const colours = ['blue', 'red', 'green', 'orange', 'violet', 'grey'];

// A jump along a load curve, in its step. Rows without these columns are of an older file.
function jumpAlong(curve, jump) {
  const {
    step,
    [`load${curve.suffix}`]: load,
    [`reaction_before${curve.suffix}`]: before,
    [`reaction_after${curve.suffix}`]: after,
  } = jump;
  if ([load, before, after].some((value) => value === undefined)) return [];
  const { xFactor, yFactor } = curve;
  return curve.force
    ? [{ step, x0: -before * xFactor, y0: load * yFactor, x1: -after * xFactor, y1: load * yFactor }]
    : [{ step, x0: load * xFactor, y0: before * yFactor, x1: load * xFactor, y1: after * yFactor }];
}

// The points of a load curve and, within their steps, those between which it jumps: the peaks are on the curve. Jumps that
// are marked are no part of it.
function path(curve, steps, jumps) {
  const points = [];
  steps.forEach((step, row) => {
    for (const jump of jumps.filter((one) => one.step === step))
      points.push([jump.x0, jump.y0], ...(jump.marked ? [null] : []), [jump.x1, jump.y1]);
    points.push([curve.x[row], curve.y[row]]);
  });
  return points;
}

// Curves over one pair of axes, in the unit that suits them all.
function withAxis(curves, label, scales) {
  const { lists, label: named } = scaled(label, scales, ...curves.map(({ y }) => y));
  return { yLabel: named, curves: curves.map((curve, i) => ({ ...curve, y: lists[i] })) };
}

export function makeCharts(parent, result, units, onRow) {
  const out = [];
  const steps = result.column('step');
  const bad = new Set(result.about.not_converged ?? []);
  const failed = steps.flatMap((step, row) => (bad.has(step) ? [row] : []));
  const jumps = largerJumps(result);
  for (const curve of loadCurves(result, units).slice(0, mostPatterns)) {
    const marked = (jump) => jumps.includes(jump);
    const along = result.jumps.flatMap((jump) => jumpAlong(curve, jump).map((one) => ({ ...one, marked: marked(jump) })));
    out.push(
      new Chart(parent, {
        title: curve.name ? `Load and displacement, ${curve.name}` : 'Load and displacement',
        xLabel: curve.xLabel,
        yLabel: curve.yLabel,
        near: 'both',
        failed,
        onRow,
        curves: [{ name: '', x: curve.x, y: curve.y, path: path(curve, steps, along), colour: 'blue' }],
        jumps: along.filter((one) => one.marked),
      }),
    );
  }
  const averages = averageCurves(result);
  if (averages.length > 0) {
    out.push(
      new Chart(parent, {
        title: 'Average stress and strain',
        xLabel: 'average strain [%]',
        ...withAxis(
          averages.map((one, i) => ({ ...one, colour: colours[i % colours.length] })),
          'average stress',
          units.stress,
        ),
        near: 'both',
        onRow,
      }),
    );
  }
  out.push(
    new Chart(parent, {
      title: 'Energies',
      xLabel: axis('time', units.time),
      ...withAxis(energyCurves(result), 'energy', units.energy),
      onRow,
      jumps: jumps.map(({ time }) => ({ x: time })),
    }),
  );
  return out;
}
