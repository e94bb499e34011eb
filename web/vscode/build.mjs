// Makes the extension: node build.mjs OUT MODULES PACKAGE SOURCE, where MODULES is the folder that npm has filled, PACKAGE the npm package
// glint-lint and SOURCE the repository. OUT, a new folder, gets the extension as a folder, extension/, and as glint-VERSION.vsix.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { licences } from '../licences.mjs';
import { zip } from './zip.mjs';

const [out, modules, lint, source] = process.argv.slice(2);
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const need = createRequire(path.join(path.resolve(modules), 'build.js'));
const esbuild = need('esbuild');
const zopfli = need('@gfx/zopfli');
const folder = path.join(out, 'extension');
const dist = path.join(folder, 'dist');
fs.mkdirSync(dist, { recursive: true });

// ---- files

const common = {
  outdir: dist, bundle: true, minify: true, platform: 'browser', target: ['es2022'], nodePaths: [path.join(modules, 'node_modules')],
  define: { GLINT_HAS_GPU: 'false' }, legalComments: 'none', metafile: true, logLevel: 'warning', charset: 'utf8',
};
const built = await esbuild.build({ ...common, entryPoints: [path.join(here, 'extension.js')], format: 'cjs', external: ['vscode'] });
await esbuild.build({
  ...common, entryPoints: [path.join(here, 'worker.js')], format: 'iife', external: ['fs', 'path', 'crypto'],
  alias: { 'glint-module': path.resolve(lint, 'glint.js') },
});
await esbuild.build({ ...common, entryPoints: [path.join(here, 'view.js'), path.join(here, 'view.css')], bundle: false });
fs.copyFileSync(path.join(lint, 'glint.wasm'), path.join(dist, 'glint.wasm'));

const manifest = JSON.parse(fs.readFileSync(path.join(here, 'manifest.json'), 'utf8'));
manifest.version = fs.readFileSync(path.join(source, 'VERSION'), 'utf8').trim();
fs.writeFileSync(path.join(folder, 'package.json'), `${JSON.stringify(manifest, null, 2)}\n`);
fs.copyFileSync(path.join(here, 'README.md'), path.join(folder, 'README.md'));
fs.writeFileSync(path.join(folder, 'LICENSE.txt'), licences(Object.keys(built.metafile.inputs), modules, source));

// ---- the archive

const xml = (text) => text.replace(/[&<"]/g, (c) => `&#${c.charCodeAt(0)};`);
const about = `<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity Language="en-US" Id="${manifest.name}" Version="${manifest.version}" Publisher="${manifest.publisher}"/>
    <DisplayName>${xml(manifest.displayName)}</DisplayName>
    <Description xml:space="preserve">${xml(manifest.description)}</Description>
    <Tags>${xml([...manifest.keywords, '__web_extension'].join(','))}</Tags>
    <Categories>${xml(manifest.categories.join(','))}</Categories>
    <Properties>
      <Property Id="Microsoft.VisualStudio.Code.Engine" Value="${xml(manifest.engines.vscode)}"/>
      <Property Id="Microsoft.VisualStudio.Code.ExtensionKind" Value="ui,workspace,web"/>
    </Properties>
    <License>extension/LICENSE.txt</License>
  </Metadata>
  <Installation><InstallationTarget Id="Microsoft.VisualStudio.Code"/></Installation>
  <Dependencies/>
  <Assets>
    <Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.Details" Path="extension/README.md" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.License" Path="extension/LICENSE.txt" Addressable="true"/>
  </Assets>
</PackageManifest>
`;
const types = { '.css': 'text/css', '.js': 'application/javascript', '.json': 'application/json', '.md': 'text/markdown', '.txt': 'text/plain',
  '.vsixmanifest': 'text/xml', '.wasm': 'application/wasm' };
const known = `<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">${Object.entries(types)
  .map(([ending, type]) => `<Default Extension="${ending}" ContentType="${type}"/>`).join('')}</Types>
`;
const names = fs.readdirSync(folder, { recursive: true }).filter((name) => fs.statSync(path.join(folder, name)).isFile()).sort();
const files = [
  ['extension.vsixmanifest', Buffer.from(about)], ['[Content_Types].xml', Buffer.from(known)],
  ...names.map((name) => [`extension/${name}`, fs.readFileSync(path.join(folder, name))]),
];
const deflate = (bytes) => new Promise((resolve, reject) => {
  zopfli.deflate(bytes, { numiterations: 5 }, (error, packed) => (error ? reject(error) : resolve(packed)));
});
const archive = path.join(out, `glint-${manifest.version}.vsix`);
fs.writeFileSync(archive, await zip(files, deflate));
console.log(`${archive}: ${fs.statSync(archive).size} bytes`);
