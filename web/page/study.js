// What settings cost and what error they cause: the open scene drawn small by the reference tracer, with several numbers of samples and
// depths, each compared with one of many samples without a depth limit; and the Pareto front of settings, beside a slider.
import { Cancelled } from './glint.js';

const SAMPLES = [1, 4, 16];
const DEPTHS = [0, 1, 2, 3, 4, 6, 10, 16];
const TRUTH = 64; // samples of the picture that the others are compared with
const BUDGET_MS = 15000; // for all measurements, which are meant to take a third of it
const SHORT_MS = 20; // a picture that takes less is drawn again: clocks and caches matter
const SIZE = { first: 48, most: 128 }; // pixels across
const LIMITED = ['--as-file']; // draws as a device would; without it, rays are followed to their end
const PLAIN = ['--device', 'reference', '--no-cache', '--quiet', '--stats=json', '--color', 'never'];

// The points that no other beats in both time and error, the fastest first.
export function frontOf(points) {
  const front = [];
  for (const one of [...points].sort((a, b) => a.ms - b.ms || a.error - b.error))
    if (!front.length || one.error < front.at(-1).error) front.push(one);
  return front;
}

// {points, left, size}: for each setting {samples, depth, ms, error}, where error is the mean of FLIP and ms the time of a whole picture;
// `left` counts settings for which there was no time, `size` is that of the small pictures. `run` is Glint's; `told(words)` reports the
// progress.
export async function measure({ run, path, scene, camera, told }) {
  const heightOf = (width) => Math.max(8, Math.round((width * scene.height) / scene.width));
  const chosen = camera ? ['--camera', camera] : [];
  const sizeOf = (width) => `${width}x${heightOf(width)}`;
  async function draw(width, samples, limits, file) {
    const words = ['render', path, ...PLAIN, ...chosen, '--size', sizeOf(width), '--samples', String(samples)];
    const { status, out, err } = await run([...words, '--set', 'image.error=0', ...limits, '-o', file]);
    if (status !== 0) throw new Error(err.split('\n')[0]);
    const { seconds, rays } = JSON.parse(out);
    return { ms: seconds * 1000, deepest: rays.deepest };
  }
  async function errorOf(file) {
    const { status, out, err } = await run(['compare', file, '/truth.pfm', '--format', 'json', '--color', 'never']);
    if (status !== 0) throw new Error(err.split('\n')[0]);
    return JSON.parse(out).metrics.flip.value;
  }
  const limited = (depth) => [...LIMITED, '--set', `trace.max_depth=${depth}`];
  told('Measuring: the size');
  const { ms: one, deepest } = await draw(SIZE.first, 1, limited(scene.depth), '/point.pfm');
  // No ray goes deeper than the deepest: a larger limit changes nothing.
  const most = Math.min(scene.depth, deepest);
  const depths = [...DEPTHS.filter((depth) => depth < most), most];
  // As large as fits in the time: all settings together take about as long as this many samples.
  const all = TRUTH + depths.length * SAMPLES.reduce((sum, samples) => sum + samples, 0);
  const width = Math.round(Math.min(SIZE.most, scene.width, Math.max(SIZE.first / 2, SIZE.first * Math.sqrt((BUDGET_MS / 3) / (Math.max(one, 1) * all)))));
  told('Measuring: the picture to compare with');
  await draw(width, TRUTH, [], '/truth.pfm');
  const began = performance.now();
  const wanted = SAMPLES.flatMap((samples) => depths.map((depth) => ({ samples, depth })));
  const points = [];
  for (const { samples, depth } of wanted) {
    if (performance.now() - began > BUDGET_MS) break;
    told(`Measuring: ${points.length + 1} of ${wanted.length} settings`);
    let { ms } = await draw(width, samples, limited(depth), '/point.pfm');
    if (ms < SHORT_MS) ms = Math.min(ms, (await draw(width, samples, limited(depth), '/point.pfm')).ms);
    points.push({ samples, depth, ms, error: await errorOf('/point.pfm') });
  }
  // The time of a whole picture, in proportion to its pixels.
  const pixels = (scene.width * scene.height) / (width * heightOf(width));
  for (const point of points) point.ms *= pixels;
  return { points, left: wanted.length - points.length, size: sizeOf(width) };
}

// ---- beside the slider

const SVG = 'http://www.w3.org/2000/svg';
const time = (ms) => (ms < 100 ? `${ms.toPrecision(2)} ms` : ms < 1000 ? `${ms.toFixed(0)} ms` : `${(ms / 1000).toFixed(1)} s`);
const words = ({ samples, depth, ms, error }) => `${samples} sample${samples === 1 ? '' : 's'}, depth ${depth}: ${time(ms)}, error ${error.toPrecision(2)}`;

function chart(svg, points, front, at) {
  const [width, height, edge] = [300, 150, 22];
  const scale = (values, from, to) => {
    const logs = values.map((value) => Math.log(Math.max(value, 1e-6)));
    const [low, high] = [Math.min(...logs), Math.max(...logs)];
    return (value) => from + ((Math.log(Math.max(value, 1e-6)) - low) / (high - low || 1)) * (to - from);
  };
  const x = scale(points.map(({ ms }) => ms), edge, width - 8);
  const y = scale(points.map(({ error }) => error), height - edge, 8);
  const add = (name, facts, text = '') => {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(facts)) element.setAttribute(key, value);
    element.textContent = text;
    return element;
  };
  svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
  svg.replaceChildren(
    add('path', { class: 'axes', d: `M${edge} 4V${height - edge}H${width - 4}` }),
    add('text', { x: width - 6, y: height - 6, 'text-anchor': 'end' }, 'time →'),
    add('text', { x: 12, y: 10, transform: 'rotate(-90 12 10)', 'text-anchor': 'end' }, 'error →'),
    ...points.map((one) => add('circle', { cx: x(one.ms), cy: y(one.error), r: 2.5 })),
    add('path', { class: 'front', d: front.map((one, i) => `${i ? 'L' : 'M'}${x(one.ms)} ${y(one.error)}`).join('') }),
    ...front.map((one, i) => add('circle', { class: i === at ? 'chosen' : 'front', cx: x(one.ms), cy: y(one.error), r: i === at ? 6 : 3.5 })),
  );
}

export class Study {
  // `$`: the elements of the page by their ids; `worker()`: a Glint of its own; `scene()`: {path, camera, width, height, depth} of now, or
  // null; `choose(words, draws)`: adds these options from now on, and draws again if `draws`; no words: as the scene says.
  constructor({ $, worker, scene, choose }) {
    Object.assign(this, { $, worker, scene, choose });
    this.glint = null;
    $('measure').onclick = () => (this.glint ? this.stop('Stopped') : this.start());
    $('setting').oninput = () => this.pick(+$('setting').value);
    $('asis').onclick = () => this.pick(-1);
  }

  // The text has changed: the measurements are of another scene.
  forget() {
    this.stop('');
    this.choose([], false);
    this.show(null);
  }

  stop(why) {
    if (this.glint) this.glint.end();
    this.glint = null;
    this.$('measure').textContent = 'Measure';
    this.$('measured').textContent = why;
  }

  async start() {
    const scene = this.scene();
    if (!scene) return this.stop('The scene has errors');
    const glint = (this.glint = this.worker());
    if (this.at >= 0) this.choose([], true);
    this.show(null);
    this.$('measure').textContent = 'Stop';
    try {
      const found = await measure({ run: (command) => glint.run(command), path: scene.path, camera: scene.camera, scene, told: (text) => this.glint === glint && (this.$('measured').textContent = text) });
      if (this.glint !== glint) return;
      this.stop(`${found.points.length} settings measured${found.left ? `, no time for ${found.left}` : ''}; the line joins those worth choosing.`);
      this.size = found.size;
      this.show(found.points);
    } catch (error) {
      if (this.glint === glint && !(error instanceof Cancelled)) this.stop(error.message);
    }
  }

  show(points) {
    this.points = points;
    this.front = points && frontOf(points);
    this.at = -1;
    this.$('front').hidden = !points;
    if (!points) return;
    const slider = this.$('setting');
    Object.assign(slider, { min: 0, max: this.front.length - 1, step: 1, value: 0 });
    slider.setAttribute('aria-valuetext', words(this.front[0]));
    this.$('points').replaceChildren(...this.front.map((one) => Object.assign(document.createElement('li'), { textContent: words(one) })));
    this.draw();
  }

  draw() {
    const { $, at } = this;
    const one = this.front[at];
    chart($('chart'), this.points, this.front, at);
    $('chart').setAttribute('aria-label', `Error against time of ${this.points.length} settings; ${this.front.length} are worth choosing, from ${words(this.front[0])} to ${words(this.front.at(-1))}`);
    $('chosen').textContent = one ? words(one) : 'The picture is as the scene says.';
    $('paste').textContent = one ? `image: {samples: ${one.samples}}\ntrace: {max_depth: ${one.depth}}` : '';
    $('paste').hidden = $('asis').hidden = !one;
  }

  pick(at) {
    this.at = at;
    const one = this.front[at];
    if (one) Object.assign(this.$('setting'), { value: at }).setAttribute('aria-valuetext', words(one));
    this.draw();
    this.choose(one ? ['--samples', String(one.samples), '--set', `trace.max_depth=${one.depth}`, '--set', 'image.error=0'] : [], true);
  }
}
