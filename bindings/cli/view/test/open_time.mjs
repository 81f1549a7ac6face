// SPDX-License-Identifier: BSD-3-Clause
// node open_time.mjs PACKAGES PAGE [TIMES]: prints how long a page takes from the call of its address to its first
// picture, in headless Chromium that draws without a graphics card. PACKAGES is a folder with the node_modules of
// package.json here.
// A figure to look at, no test: it depends on the machine and on what else runs there.
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [packages, page, times = '3'] = process.argv.slice(2);
const { default: puppeteer } = await import(
  pathToFileURL(createRequire(path.resolve(packages, 'package.json')).resolve('puppeteer-core')).href
);
for (let i = 0; i < Number(times); i += 1) {
  // A new browser each time: nothing is kept from the last.
  const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    protocolTimeout: 600000,
  });
  // The first tab also waits for what the browser starts with its first picture; the second is what people see.
  for (const when of ['in a new browser', 'in its second tab']) {
    const tab = await browser.newPage();
    await tab.setViewport({ width: 1280, height: 800 });
    await tab.goto(pathToFileURL(path.resolve(page)).href, { timeout: 600000 });
    await tab.waitForFunction(() => document.documentElement.dataset.state, { timeout: 600000 });
    const { drawn, cells, steps } = await tab.evaluate(() => ({
      drawn: performance.getEntriesByName('delam-drawn')[0]?.startTime,
      cells: window.delam.result.layout.cells,
      steps: window.delam.result.steps.length,
    }));
    const load = os.loadavg()[0].toFixed(1);
    process.stdout.write(
      `${cells} cells, ${steps} steps, ${when}: first picture after ${(drawn / 1000).toFixed(2)} s (load ${load})\n`,
    );
    await tab.close();
  }
  await browser.close();
}
