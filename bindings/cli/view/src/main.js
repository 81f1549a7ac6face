// SPDX-License-Identifier: BSD-3-Clause
// The page: what is chosen, and what follows from it in the scene, the charts and the numbers.
import { makeCharts } from './charts.js';
import { painter } from './colours.js';
import { nothing, Result, summary, widen } from './data.js';
import { box } from './geometry.js';
import { frameOf, Scene, views } from './scene.js';
import { element, sayColours, sayResult, sayStep } from './texts.js';
import { Units, suiting } from './units.js';

const byId = (id) => document.getElementById(id);
const darkness = window.matchMedia('(prefers-color-scheme: dark)');
const oneFrame = 120; // milliseconds between steps that are played

function drawsInSpace() {
  const context = document.createElement('canvas').getContext('webgl2');
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return Boolean(context);
}

// A beam seen from the side needs less height.
function isLong({ points }) {
  const { low, high } = box(points);
  return high[0] - low[0] > 3 * (high[1] - low[1]);
}

// In space the interfaces are inside.
const bodyOpacity = ({ flat }) => (flat ? 1 : 0.25);

// A colour of the style sheet as three numbers of 0 to 1.
function styled(name) {
  const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return [1, 3, 5].map((at) => Number.parseInt(text.slice(at, at + 2), 16) / 255);
}

function drawTriad(camera) {
  const { right, up } = frameOf(camera);
  const parts = [0, 1, 2].map((c) => {
    const [x, y] = [22 * right[c], -22 * up[c]];
    if (Math.hypot(x, y) < 3) return '';
    return `<line x2="${x}" y2="${y}"/><text x="${1.32 * x}" y="${1.32 * y}">${'xyz'[c]}</text>`;
  });
  byId('triad').innerHTML = parts.join('');
}

class Page {
  constructor() {
    this.result = new Result(document);
    this.units = new Units(this.result);
    this.index = this.result.steps.length - 1;
    sayResult(this.result, this.units);
    this.charts = makeCharts(byId('charts'), this.result, this.units, (row) => this.show(this.result.stepOfRow(row)));
  }

  async open() {
    const { about } = this.result;
    const mesh = await this.result.mesh();
    const flat = mesh.flat;
    // On a phone the charts come next to the scene.
    byId('more').open = !window.matchMedia('(max-width: 52rem)').matches;
    this.chosen = {
      scale: about.displacement_scale ?? 1,
      colour: 'body',
      mesh: false,
      opacity: bodyOpacity(mesh),
      apart: 0,
    };
    byId('scene').classList.toggle('long', flat && isLong(mesh));
    byId('scene').setAttribute('aria-label', `Deformed body: ${byId('title').textContent}`);
    byId('drag').textContent = flat ? 'move' : 'turn';
    // The numbers and charts are there without a picture, too.
    if (drawsInSpace()) this.scene = new Scene(byId('scene'), mesh, drawTriad);
    else byId('waiting').textContent = 'No picture: this browser has no WebGL 2, or it is switched off.';
    this.colours = painter(darkness.matches);
    await this.bind(mesh);
    await this.show(this.index);
    if (this.scene) {
      this.scene.fit(Object.values(flat ? views.plane : views.space)[0]);
      this.scene.draw();
      byId('waiting').hidden = true;
    }
    darkness.addEventListener('change', () => {
      this.colours = painter(darkness.matches);
      this.redraw();
    });
  }

  async bind(mesh) {
    const { chosen } = this;
    const step = await this.result.step(this.index);
    const select = (id, items) => byId(id).append(...items.map(([value, text]) => element('option', text, { value })));
    select('colour', Scene.fields(step, mesh.flat));
    select('interfaces', [
      ['all', 'all'],
      ...(mesh.interfaces.length > 1 ? mesh.interfaces.map(({ name }, i) => [String(i), name]) : []),
      ['none', 'none'],
    ]);
    byId('opacity').value = chosen.opacity;
    byId('apart-field').hidden = !this.scene || this.scene.bodies < 2;
    const on = (id, key, read) =>
      byId(id).addEventListener('input', (event) => {
        chosen[key] = read(event.target);
        this.redraw();
      });
    // Through a body that shows a field nothing else is seen: the legend has its colours as they are.
    on('colour', 'colour', ({ value }) => {
      chosen.opacity = value === 'body' ? bodyOpacity(mesh) : 1;
      byId('opacity').value = chosen.opacity;
      return value;
    });
    on('mesh', 'mesh', ({ checked }) => checked);
    on('opacity', 'opacity', ({ value }) => Number(value));
    on('apart', 'apart', ({ value }) => Number(value));
    byId('apart').addEventListener('input', () => {
      this.scene?.fit();
      this.scene?.draw();
    });
    byId('interfaces').addEventListener('input', ({ target }) => {
      this.scene?.showInterfaces(target.value);
      this.redraw();
    });
    this.bindScale();
    this.bindSteps();
    this.bindViews(mesh.flat ? views.plane : views.space);
  }

  bindScale() {
    const { chosen } = this;
    const range = byId('scale');
    range.max = Math.max(4 * chosen.scale, 10);
    const set = (value) => {
      if (!Number.isFinite(value) || value < 0) return;
      chosen.scale = value;
      range.value = Math.min(value, range.max);
      byId('scale-number').value = Number(value.toPrecision(3));
      this.redraw();
    };
    range.addEventListener('input', () => set(Number(range.value)));
    byId('scale-number').addEventListener('change', ({ target }) => set(Number(target.value)));
    byId('true-scale').addEventListener('click', () => set(1));
    range.value = chosen.scale;
    byId('scale-number').value = chosen.scale;
  }

  bindSteps() {
    const { length } = this.result.steps;
    byId('step').max = length - 1;
    byId('step').addEventListener('input', ({ target }) => this.show(Number(target.value)));
    byId('previous').addEventListener('click', () => this.show(Math.max(0, this.index - 1)));
    byId('next').addEventListener('click', () => this.show(Math.min(length - 1, this.index + 1)));
    byId('play').addEventListener('click', () => this.play(!this.playing));
  }

  bindViews(all) {
    for (const [name, view] of Object.entries(all)) {
      const button = element('button', name, { type: 'button' });
      button.addEventListener('click', () => {
        this.scene?.fit(view);
        this.scene?.draw();
      });
      byId('views').append(button);
    }
    const turn = 0.1;
    const keys = {
      ArrowLeft: [-turn, 0],
      ArrowRight: [turn, 0],
      ArrowUp: [0, turn],
      ArrowDown: [0, -turn],
      '+': [0, 0, 1.2],
      '-': [0, 0, 1 / 1.2],
    };
    // Before vtk.js, which has keys of its own.
    byId('scene').addEventListener(
      'keydown',
      (event) => {
        if (!this.scene || event.ctrlKey || event.metaKey || event.altKey) return;
        if (keys[event.key]) this.scene.nudge(...keys[event.key]);
        else if (event.key === '0') {
          this.scene.fit();
          this.scene.draw();
        } else return;
        event.preventDefault();
        event.stopPropagation();
      },
      true,
    );
  }

  async play(on) {
    this.playing = on;
    byId('play').setAttribute('aria-pressed', String(on));
    byId('play').textContent = on ? 'Pause' : 'Play';
    byId('play').title = on ? 'pause' : 'play';
    const last = this.result.steps.length - 1;
    if (on && this.index === last) await this.show(0);
    while (this.playing && this.index < last) {
      const began = performance.now();
      await this.show(this.index + 1);
      await new Promise((done) => {
        setTimeout(done, Math.max(0, oneFrame - (performance.now() - began)));
      });
    }
    if (this.playing) this.play(false);
  }

  // The step with fields of this number; what was asked for last is shown.
  async show(index) {
    this.index = index;
    byId('step').value = index;
    const row = this.result.rowOfStep[index];
    for (const chart of this.charts) chart.cursor(row);
    const step = await this.result.step(index);
    if (index !== this.index) return;
    this.step = step;
    this.sums = summary(step);
    sayStep(this.result, this.units, row, this.sums);
    this.redraw();
  }

  // Goes through all steps when the first field is chosen; a step at a time, so that the page can be used meanwhile.
  async findRanges() {
    if (this.finding) return;
    this.finding = true;
    const keys = Scene.fields(this.step, this.scene.mesh.flat).map(([key]) => key);
    const ranges = new Map(keys.filter((key) => key !== 'body').map((key) => [key, nothing()]));
    for (let i = 0; i < this.result.steps.length; i += 1) {
      const step = await this.result.ofBodies(i);
      for (const [key, range] of ranges) widen(range, this.scene.fieldOf(step, key));
    }
    this.ranges = ranges;
    this.redraw();
  }

  redraw() {
    const { scene, step, chosen } = this;
    if (!scene || !step) return;
    scene.move(step, chosen.scale, chosen.apart);
    if (chosen.colour !== 'body') this.findRanges();
    const range = scene.paint(step, chosen.colour, this.colours, this.ranges?.get(chosen.colour));
    scene.look({ opacity: chosen.opacity, mesh: chosen.mesh, background: styled('--scene'), edge: styled('--edge') });
    const stress = !chosen.colour.startsWith('u');
    const unit = range && suiting(stress ? this.units.stress : this.units.length, Math.max(Math.abs(range.low), Math.abs(range.high)));
    sayColours({
      result: this.result,
      colours: this.colours,
      adhesion: byId('interfaces').value !== 'none' && step.adhesion.some((zeta) => zeta),
      field: range && {
        title: `${byId('colour').selectedOptions[0].textContent}, ${this.ranges ? 'all steps' : 'this step'}`,
        unit: unit.name,
        range: { low: range.low * unit.factor, high: range.high * unit.factor },
      },
    });
    if (!scene.drawn) return;
    // A longer legend would lie on the body, a shorter one leaves room.
    if (scene.isFitted() && (scene.legendHeight() !== scene.fittedBelow || scene.isOutgrown())) scene.fit();
    scene.draw();
  }
}

async function begin() {
  const page = new Page();
  window.delam = page; // for tests, and for whoever wants the numbers
  await page.open();
  await new Promise((done) => {
    requestAnimationFrame(() => requestAnimationFrame(done));
  });
  document.documentElement.dataset.state = page.scene ? 'drawn' : 'shown';
  performance.mark('delam-drawn');
}

begin().catch((error) => {
  byId('waiting').textContent = `This result cannot be shown: ${error.message}`;
  document.documentElement.dataset.state = 'failed';
  throw error;
});
