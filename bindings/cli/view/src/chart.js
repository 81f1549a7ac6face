// SPDX-License-Identifier: BSD-3-Clause
// A chart of curves over the rows of the history, with a cursor at one of them; whoever points at it chooses a row.
import { axisBottom, axisLeft } from 'd3-axis';
import { scaleLinear } from 'd3-scale';
import { select } from 'd3-selection';
import { line } from 'd3-shape';

import { number } from './units.js';

const margin = { right: 12, top: 8, bottom: 44 };

// From the least to the largest number of several lists.
function extent(lists) {
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) {
    for (const value of list) {
      if (Number.isFinite(value)) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
  }
  if (low > high) return [0, 1];
  const room = high > low ? 0.03 * (high - low) : Math.abs(high) || 1;
  return [low - room, high + room];
}

export class Chart {
  // curves: {name, x, y, colour, dash, path: points that are drawn instead, [x, y], with null where the curve jumps}; jumps: {x0, y0, x1, y1}, or {x} across the chart; failed: rows that are marked.
  // near: 'x', or 'both' where a curve may turn back. onRow: called with the row that was chosen.
  constructor(parent, { title, xLabel, yLabel, curves, jumps = [], failed = [], near = 'x', onRow }) {
    Object.assign(this, { title, xLabel, yLabel, curves, jumps, failed, near, onRow, row: 0 });
    const figure = select(parent).append('figure').attr('class', 'chart');
    figure.append('figcaption').text(title);
    this.svg = figure.append('svg').attr('role', 'img').attr('aria-label', this.inWords());
    this.keys(figure.append('div').attr('class', 'keys'));
    this.svg.on('pointerdown', (event) => {
      this.svg.node().setPointerCapture(event.pointerId);
      this.choose(event);
    });
    this.svg.on('pointermove', (event) => {
      if (event.buttons > 0) this.choose(event);
    });
    new ResizeObserver(() => this.draw()).observe(figure.node());
    this.draw();
  }

  inWords() {
    const ends = this.curves.map(
      ({ name, y }) => `${name || 'curve'} from ${number(y[0])} to ${number(y[y.length - 1])}`,
    );
    return `${this.title}: ${this.yLabel} over ${this.xLabel}; ${ends.join(', ')}`;
  }

  keys(box) {
    const items = this.curves.filter(({ name }) => name).map(({ name, colour, dash }) => ({ name, colour, dash }));
    if (items.length > 0) {
      box
        .selectAll('span')
        .data(items)
        .join('span')
        .text(({ name }) => name)
        .style('--colour', ({ colour }) => `var(--${colour})`)
        .style('--dash', ({ dash }) => (dash ? 'dashed' : 'solid'));
    }
    const more = (text, colour, dash, kind) =>
      box.append('span').attr('class', kind).text(text).style('--colour', `var(--${colour})`).style('--dash', dash);
    if (this.jumps.length > 0) more('jump', 'grey', 'dotted', 'jump-key');
    if (this.failed.length > 0) more('not converged', 'red', 'solid', 'cross');
  }

  draw() {
    const { svg } = this;
    const width = svg.node().clientWidth || 320;
    const height = Math.max(170, Math.min(240, 0.55 * width));
    svg.attr('height', height).attr('viewBox', `0 0 ${width} ${height}`);
    svg.selectAll('*').remove();
    const drawn = this.curves.flatMap(({ path = [] }) => path.filter((point) => point !== null));
    const jumpX = this.jumps.flatMap(({ x, x0, x1 }) => (x === undefined ? [x0, x1] : [x])).concat(drawn.map(([x]) => x));
    const jumpY = this.jumps.flatMap(({ y0, y1 }) => (y0 === undefined ? [] : [y0, y1])).concat(drawn.map(([, y]) => y));
    const format = (value) => number(value, 3);
    this.y = scaleLinear(extent([...this.curves.map(({ y }) => y), jumpY]), [height - margin.bottom, margin.top]);
    // Room for the longest number, beside the name of the axis.
    const ticks = 5;
    const left = 38 + 7.5 * Math.max(...this.y.ticks(ticks).map((value) => format(value).length));
    this.x = scaleLinear(extent([...this.curves.map(({ x }) => x), jumpX]), [left, width - margin.right]);
    svg
      .append('g')
      .attr('transform', `translate(0,${height - margin.bottom})`)
      .call(
        axisBottom(this.x)
          .ticks(Math.max(3, width / 100))
          .tickFormat(format),
      );
    svg.append('g').attr('transform', `translate(${left},0)`).call(axisLeft(this.y).ticks(ticks).tickFormat(format));
    svg
      .append('text')
      .attr('class', 'name')
      .attr('x', (left + width - margin.right) / 2)
      .attr('y', height - 6)
      .attr('text-anchor', 'middle')
      .text(this.xLabel);
    const upright = svg
      .append('text')
      .attr('class', 'name')
      .attr('text-anchor', 'middle')
      .attr('transform', `translate(12,${(height - margin.bottom + margin.top) / 2}) rotate(-90)`)
      .text(this.yLabel);
    // A long name, such as that of a conjugate, would pass the ends of the axis.
    const room = (height - margin.bottom - margin.top) / upright.node().getComputedTextLength();
    if (room < 1) upright.style('font-size', `${13.5 * room}px`);
    for (const { x, y, colour, dash, path = y.map((value, i) => [x[i], value]) } of this.curves) {
      svg
        .append('path')
        .attr('class', 'curve')
        .style('stroke', `var(--${colour})`)
        .attr('stroke-dasharray', dash ? '6 4' : null)
        .attr(
          'd',
          line(
            (point) => this.x(point[0]),
            (point) => this.y(point[1]),
          ).defined((point) => point !== null)(path),
        );
    }
    this.drawJumps(svg, height);
    const arm = 4;
    for (const row of this.failed) {
      const [x, y] = [this.x(this.curves[0].x[row]), this.y(this.curves[0].y[row])];
      svg
        .append('path')
        .attr('class', 'failed')
        .attr('d', `M${x - arm},${y - arm}l8,8m0,-8l-8,8`);
    }
    this.upright = svg
      .append('line')
      .attr('class', 'cursor')
      .attr('y1', margin.top)
      .attr('y2', height - margin.bottom);
    this.dots = this.curves.map(() => svg.append('circle').attr('class', 'cursor').attr('r', 4));
    this.cursor(this.row);
  }

  drawJumps(svg, height) {
    for (const { x, x0, y0, x1, y1 } of this.jumps) {
      const mark = svg.append('line').attr('class', 'jump');
      if (x !== undefined) {
        mark
          .attr('x1', this.x(x))
          .attr('x2', this.x(x))
          .attr('y1', margin.top)
          .attr('y2', height - margin.bottom);
      } else {
        mark.attr('x1', this.x(x0)).attr('x2', this.x(x1)).attr('y1', this.y(y0)).attr('y2', this.y(y1));
        // A jump under a held displacement may hardly change the load.
        for (const [x2, y2] of [
          [x0, y0],
          [x1, y1],
        ])
          svg.append('circle').attr('class', 'jump-end').attr('r', 2.5).attr('cx', this.x(x2)).attr('cy', this.y(y2));
      }
    }
  }

  cursor(row) {
    this.row = row;
    const at = this.x(this.curves[0].x[row]);
    this.svg.attr('data-row', row);
    this.upright.attr('x1', at).attr('x2', at);
    this.dots.forEach((dot, i) =>
      dot.attr('cx', this.x(this.curves[i].x[row])).attr('cy', this.y(this.curves[i].y[row])),
    );
  }

  // The row whose point is next to where it was pointed.
  choose(event) {
    const area = this.svg.node().getBoundingClientRect();
    const [px, py] = [event.clientX - area.left, event.clientY - area.top];
    let best = 0;
    let least = Infinity;
    for (const { x, y } of this.near === 'both' ? this.curves : this.curves.slice(0, 1)) {
      for (let row = 0; row < y.length; row += 1) {
        const distance = Math.hypot(this.x(x[row]) - px, this.near === 'both' ? this.y(y[row]) - py : 0);
        if (distance < least) {
          least = distance;
          best = row;
        }
      }
    }
    this.onRow(best);
  }
}
