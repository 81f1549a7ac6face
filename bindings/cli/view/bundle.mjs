// SPDX-License-Identifier: BSD-3-Clause
// node bundle.mjs PACKAGES TEMPLATE: page.html with all scripts and styles in it, as one file. PACKAGES is the
// folder with node_modules, which is not beside the sources.
import { createRequire } from 'node:module';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const [packages, template] = process.argv.slice(2).map((word) => path.resolve(word));
const here = path.dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(path.join(packages, 'package.json'))('esbuild');

const { outputFiles, metafile } = await esbuild.build({
  entryPoints: [path.join(here, 'src/main.js')],
  nodePaths: [path.join(packages, 'node_modules')],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: ['es2020'],
  legalComments: 'none',
  metafile: true,
  charset: 'utf8',
  logLevel: 'warning',
  define: { 'process.env.NODE_ENV': '"production"', global: 'globalThis' },
});
// Nothing in a script may look like the end of its element.
const script = outputFiles[0].text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const style = (
  await esbuild.transform(fs.readFileSync(path.join(here, 'page.css'), 'utf8'), { loader: 'css', minify: true })
).code;

// The licences of the packages in the script, whose terms ask for them.
function licences() {
  const names = new Set(
    Object.keys(metafile.inputs)
      .map((file) => file.match(/.*node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1])
      .filter((name) => name),
  );
  return [...names]
    .sort()
    .map((name) => {
      const folder = path.join(packages, 'node_modules', name);
      const { version, license } = JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8'));
      const find = (pattern) => fs.readdirSync(folder).find((one) => pattern.test(one));
      const read = (file) => (file ? fs.readFileSync(path.join(folder, file), 'utf8') : '');
      // Some have it in a section of their README.
      const text =
        read(find(/^(licen[sc]e|copying)/i)) || (read(find(/^readme/i)).match(/^[# ]*licen[sc]e[^]*/im)?.[0] ?? '');
      if (!text.includes('opyright')) throw new Error(`${name} comes without its licence`);
      return `${name} ${version} (${license})\n\n${text.trim()}\n`;
    })
    .join('\n');
}

// The text between two marks; a replacement is no pattern.
const put = (page, mark, text) => {
  if (!page.includes(mark)) throw new Error(`page.html has no ${mark}`);
  return page.replace(mark, () => text);
};
let page = fs.readFileSync(path.join(here, 'page.html'), 'utf8');
page = put(page, '/*style*/', style);
page = put(page, '/*script*/', script);
page = put(page, '/*licences*/', licences().replaceAll('--', '- -'));
fs.writeFileSync(template, page);
