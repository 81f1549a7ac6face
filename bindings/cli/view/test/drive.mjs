// SPDX-License-Identifier: BSD-3-Clause
// node drive.mjs PACKAGES BROWSER PAGE OUT: opens a page as a person does, at two widths, and writes what it found as
// JSON to standard output; pictures of the scene go to OUT. PACKAGES is the folder with node_modules.
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [packages, browserPath, page, out] = process.argv.slice(2);
const { default: puppeteer } = await import(
  pathToFileURL(createRequire(path.resolve(packages, 'package.json')).resolve('puppeteer-core')).href
);
const most = 120000; // milliseconds, on a machine that is busy and draws without a graphics card

// What the page says and has at this moment.
const state = (tab) =>
  tab.evaluate(() => ({
    index: window.delam.index,
    step: window.delam.step.step,
    sums: window.delam.sums,
    readings: Object.fromEntries(
      [...document.querySelectorAll('#readings dd')].map((dd) => [dd.dataset.key, dd.textContent]),
    ),
    instant: document.getElementById('instant').textContent,
    slider: Number(document.getElementById('step').value),
    rows: [...document.querySelectorAll('.chart svg')].map((svg) => Number(svg.dataset.row)),
    scale: window.delam.chosen.scale,
    legend: document.getElementById('legend').innerText,
  }));

// A new step has been drawn.
const settled = (tab) =>
  tab.evaluate(
    () =>
      new Promise((done) => {
        requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 60)));
      }),
  );
const shown = async (tab, index) => {
  await tab.waitForFunction(
    (i) => window.delam.index === i && window.delam.step === window.delam.result.unpacked.get(i),
    { timeout: most },
    index,
  );
  await settled(tab);
  return state(tab);
};
const picture = async (tab, name) => {
  await settled(tab);
  await (await tab.$('#scene')).screenshot({ path: path.join(out, name) });
};
const choose = async (tab, id, value) => {
  await tab.select(id, value);
  // The range of all steps follows.
  await tab.waitForFunction(() => !document.getElementById('legend').innerText.includes('this step'), { timeout: most });
  await settled(tab);
};

// How far the legend reaches down, and where the body begins, in parts of the height of the picture: of a body that fills
// it, with and without a field.
async function heights(tab) {
  await tab.evaluate(() => {
    const apart = document.getElementById('apart');
    apart.value = 1;
    apart.dispatchEvent(new Event('input'));
    [...document.querySelectorAll('#views button')].find(({ textContent }) => /^(fit|along x)$/.test(textContent)).click();
  });
  const out = [];
  for (const colour of ['body', 'mises']) {
    await choose(tab, '#colour', colour);
    out.push(
      await tab.evaluate(() => {
        const { scene } = window.delam;
        const camera = scene.renderer.getActiveCamera();
        const [up, focus, points] = [camera.getViewUp(), camera.getFocalPoint(), scene.points.getData()];
        let top = -Infinity;
        for (let i = 0; i < points.length; i += 3)
          top = Math.max(top, up.reduce((sum, value, c) => sum + value * (points[i + c] - focus[c]), 0));
        const { offsetTop, offsetHeight } = document.getElementById('legend');
        return [
          (offsetTop + offsetHeight) / scene.container.clientHeight,
          0.5 - top / (2 * camera.getParallelScale()),
        ];
      }),
    );
  }
  return out;
}

async function open(browser, width, { old = false, dark = false } = {}) {
  const tab = await browser.newPage();
  const found = { width, errors: [], requests: [] };
  tab.on('console', (message) => {
    if (['error', 'warn', 'warning', 'assert'].includes(message.type()))
      found.errors.push(`${message.type()}: ${message.text()}`);
  });
  tab.on('pageerror', (error) => found.errors.push(error.message));
  tab.on('request', (request) => {
    if (!request.url().startsWith('data:')) found.requests.push(request.url());
  });
  await tab.setViewport({ width, height: 800, hasTouch: width < 600, isMobile: width < 600 });
  await tab.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }]);
  // A browser that cannot inflate by itself.
  if (old)
    await tab.evaluateOnNewDocument(() => {
      delete window.DecompressionStream;
      delete Uint8Array.fromBase64;
    });
  await tab.goto(pathToFileURL(path.resolve(page)).href);
  await tab.waitForFunction(() => document.documentElement.dataset.state, { timeout: most });
  found.state = await tab.evaluate(() => document.documentElement.dataset.state);
  found.title = await tab.title();
  found.warnings = await tab.evaluate(() => [...document.querySelectorAll('#warnings li')].map((li) => li.textContent));
  found.overflow = await tab.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  found.below = await tab.evaluate(
    () =>
      document.getElementById('charts').getBoundingClientRect().top >=
      document.getElementById('scene').getBoundingClientRect().bottom,
  );
  found.steps = await tab.evaluate(() => Number(document.getElementById('step').max) + 1);
  found.unnamed = await tab.evaluate(() =>
    [...document.querySelectorAll('button, input, select, [role], section')]
      .filter((one) => !(one.getAttribute('aria-label') || one.textContent.trim() || one.labels?.length))
      .map((one) => one.outerHTML.slice(0, 80)),
  );
  return { tab, found };
}

async function walk(browser, width) {
  const { tab, found } = await open(browser, width);
  const last = found.steps - 1;
  found.seen = [await state(tab)];
  await picture(tab, `last-${width}.png`);
  // By keys on the slider.
  await tab.focus('#step');
  await tab.keyboard.press('Home');
  found.seen.push(await shown(tab, 0));
  await picture(tab, `first-${width}.png`);
  for (let i = 1; i <= last; i += 1) {
    await tab.keyboard.press('ArrowRight');
    found.seen.push(await shown(tab, i));
  }
  // A point of the load curve: the one of a row in the middle.
  const target = Math.floor(last / 2);
  const place = await tab.evaluate((i) => {
    const chart = window.delam.charts[0];
    const row = window.delam.result.rowOfStep[i];
    chart.svg.node().scrollIntoView({ block: 'center' });
    const area = chart.svg.node().getBoundingClientRect();
    return { x: area.left + chart.x(chart.curves[0].x[row]), y: area.top + chart.y(chart.curves[0].y[row]) };
  }, target);
  await tab.mouse.click(place.x, place.y);
  found.clicked = { target, ...(await shown(tab, target)) };
  await tab.evaluate(() => {
    document.getElementById('more').open = true;
  });
  await tab.click('#true-scale');
  await picture(tab, `true-${width}.png`);
  found.trueScale = (await state(tab)).scale;
  found.colours = await tab.evaluate(() => [...document.getElementById('colour').options].map(({ value }) => value));
  found.jumps = await tab.evaluate(() => document.querySelectorAll('.chart .jump-end').length / 2);
  found.legends = {};
  for (const colour of found.colours) {
    await choose(tab, '#colour', colour);
    found.legends[colour] = (await state(tab)).legend;
    await picture(tab, `${colour}-${width}.png`);
  }
  await tab.evaluate(() => document.getElementById('scene').scrollIntoView());
  const camera = () =>
    tab.evaluate(() => {
      const of = window.delam.scene.renderer.getActiveCamera();
      return [...of.getPosition(), of.getParallelScale()];
    });
  const cameras = [await camera()];
  await tab.focus('#scene');
  for (const key of ['ArrowLeft', '+', '0']) {
    await tab.keyboard.press(key);
    cameras.push(await camera());
  }
  found.cameras = cameras;
  found.heights = await heights(tab);
  await tab.evaluate(() => window.delam.show(0));
  await shown(tab, 0);
  await tab.click('#play');
  await tab.waitForFunction((i) => window.delam.index === i && !window.delam.playing, { timeout: most }, last);
  found.played = (await shown(tab, last)).index;
  await tab.close();
  return found;
}

// What a browser shows that draws nothing.
async function unpictured() {
  const browser = await launched(['--disable-3d-apis']);
  const { tab, found } = await open(browser, 1280);
  found.said = await tab.evaluate(() => document.getElementById('waiting').textContent);
  await tab.focus('#step');
  await tab.keyboard.press('Home');
  found.seen = [await shown(tab, 0)];
  await browser.close();
  return found;
}

// The sandbox does not work for root.
const launched = (more) =>
  puppeteer.launch({ executablePath: browserPath, args: ['--no-sandbox', ...more], protocolTimeout: 2 * most });
// Drawn without a graphics card.
const browser = await launched(['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist']);
try {
  const walks = [];
  for (const width of [1280, 380]) walks.push(await walk(browser, width));
  const { tab, found: old } = await open(browser, 1280, { old: true, dark: true });
  old.seen = [await state(tab)];
  await picture(tab, 'dark-1280.png');
  process.stdout.write(JSON.stringify({ walks, old, blind: await unpictured() }));
} finally {
  await browser.close();
}
