/* Pictures: channels to colours. A picture is an ImageData of a source's window. */

const notANumber = [255, 0, 255], plusInfinity = [0, 200, 255], minusInfinity = [255, 150, 0], missing = [128, 128, 128];
const srgbCode = (v) => 255 * (v <= 0 ? 0 : v >= 1 ? 1 : v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);

/* From 0 to 1. */
function between(stops, t) {
  const at = Math.min(Math.max(t, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2);
  return [0, 1, 2].map((c) => stops[k][c] + (at - k) * (stops[k + 1][c] - stops[k][c]));
}
const ramps = {
  gray: [[0, 0, 0], [255, 255, 255]],
  viridis: [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121],
            [109, 205, 89], [180, 222, 44], [253, 231, 37]],
  signed: [[33, 102, 220], [120, 170, 240], [245, 245, 245], [240, 150, 110], [200, 30, 40]],
  heat: [[0, 0, 60], [60, 0, 120], [180, 20, 80], [240, 90, 20], [255, 190, 60], [255, 255, 240]],
};
/* As the heat map of compare --legal. */
const classColours = [[0, 114, 178], [240, 228, 66], [160, 160, 160], [213, 94, 0], [0, 0, 0]];
/* A table of 1024 colours is quicker than a blend each. */
const tables = Object.fromEntries(Object.entries(ramps).map(([name, stops]) =>
  [name, Array.from({ length: 1024 }, (_, k) => between(stops, k / 1023))]));

function special(v) {
  return Number.isNaN(v) ? notANumber : v === Infinity ? plusInfinity : v === -Infinity ? minusInfinity : null;
}
/* Codes apart in hue, so that neighbours differ. */
function colourOfCode(code) {
  if (code === 0xffffffff) return [40, 40, 44];
  const hue = (code * 0.61803398875 + 0.08) % 1, f = (n) => {
    const k = (n + hue * 12) % 12;
    return 255 * (0.58 - 0.3 * Math.max(-1, Math.min(k - 3, 9 - k, 1)));
  };
  return [f(0), f(8), f(4)];
}

const statuses = ["none", "hit", "floor", "cap", "clip", "no frame", "NaN", "outside"];
const codeText = (name, code) => (name.endsWith("status") && statuses[code] ? `${code} ${statuses[code]}` : String(code));

function paint(source, colourAt) {
  const picture = new ImageData(source.width, source.height), out = picture.data;
  for (let i = 0; i < source.width * source.height; i += 1) {
    const [r, g, b] = colourAt(i);
    out[4 * i] = r; out[4 * i + 1] = g; out[4 * i + 2] = b; out[4 * i + 3] = 255;
  }
  return picture;
}

/* What is chosen in the list of channels: one channel, or the components of a vector together. */
function componentsOf(source, choice) {
  return choice.names.map((name) => source.channels.get(name)).filter(Boolean);
}
/* How a choice is coloured unless the user says otherwise. */
function usualColours(choice, channel) {
  if (choice.names.length > 1) return choice.names[0] === "R" ? "colour" : "vector";
  if (channel && channel.type === "uint32") return isCode(choice.names[0]) ? "codes" : "viridis";
  return "gray";
}
/* Few values that mean something each, and no counts. */
function isCode(name) {
  return /(^|\.)(status|flags|kind|mask|object|material|primitive|undecided)$/.test(name) || /^id\./.test(name);
}

/* `how`: { colours, exposure, low, high }. */
function pictureOf(source, choice, how) {
  const channels = componentsOf(source, choice);
  if (channels.length < choice.names.length) return paint(source, () => missing);
  const gain = 2 ** how.exposure;
  if (how.colours === "colour" || how.colours === "vector") {
    // Codes of a picture of 8 bits are for the screen as they are.
    const curve = channels[0].stored === "unorm8" ? (v) => 255 * v : srgbCode;
    const code = how.colours === "colour" ? (v) => curve(v * gain) : (v) => 127.5 + 127.5 * v * gain;
    const [r, g, b] = channels.map((c) => c.values);
    return paint(source, (i) => special(r[i]) || special(g[i]) || (b && special(b[i])) ||
      [code(r[i]), code(g[i]), b ? code(b[i]) : 0]);
  }
  const values = channels[0].values;
  if (how.colours === "codes") return paint(source, (i) => colourOfCode(channels[0].bits[i]));
  const table = tables[how.colours], low = how.low, scale = 1023 / (how.high - low || 1);
  return paint(source, (i) => special(values[i]) || table[Math.min(Math.max((values[i] - low) * scale, 0), 1023) | 0]);
}

/* The largest difference of each pixel over the choice's channels: black where equal, then by its logarithm
   from 2^-24 of `scale` up. */
const heatOctaves = 24;
function heatOf(a, b, choice, scale) {
  const pairs = choice.names.map((name) => [a.channels.get(name), b.channels.get(name)]);
  if (!a.fits(b) || pairs.some(([x, y]) => !x || !y)) return paint(a, () => missing);
  return paint(a, (i) => {
    let most = 0, unequal = false;
    for (const [x, y] of pairs)
      if (isUnequal(x, y, i)) { unequal = true; most = Math.max(most, differenceOf(x, y, i, i)); }
    if (!unequal) return [0, 0, 0];
    if (most === Infinity) return notANumber;
    const octaves = most > 0 ? Math.log2(most / scale) + heatOctaves : 0;
    return tables.heat[Math.round(1023 * Math.min(Math.max(octaves / heatOctaves, 0), 1))];
  });
}
/* Both signed, so that it is seen which side is more. */
function signedDifferenceOf(a, b, choice, extent) {
  const x = a.channels.get(choice.names[0]), y = b.channels.get(choice.names[0]);
  if (!a.fits(b) || !x || !y) return paint(a, () => missing);
  return paint(a, (i) => {
    const v = isUnequal(x, y, i) ? y.values[i] - x.values[i] : 0;
    return Number.isFinite(v) ? tables.signed[Math.round(1023 * Math.min(Math.max(0.5 + 0.5 * v / extent, 0), 1))] : notANumber;
  });
}
/* The worst class of each pixel over the choice's channels; null where the reference has no ranges of them. */
function classesOf(a, b, choice) {
  const judged = choice.names.map((name) =>
    ({ ranges: rangesOf(a, name), value: b.channels.get(name), extent: a.channels.has(name) ? extentOf(a, name) : 0 }))
    .filter(({ ranges, value }) => ranges && value);
  if (judged.length === 0 || !a.fits(b)) return null;
  const classes = new Uint8Array(a.width * a.height), counts = classNames.map(() => 0);
  for (let i = 0; i < classes.length; i += 1) {
    for (const { ranges, value, extent } of judged)
      classes[i] = Math.max(classes[i], classOf(ranges, extent, value.values[i], i));
    counts[classes[i]] += 1;
  }
  return { classes, counts, picture: paint(a, (i) => classColours[classes[i]]) };
}
/* The first channel of each pixel, in the reference's order, that leaves its range; null where there are no ranges. */
const noneLeft = [60, 64, 72];
function firstLeftOf(a, b) {
  const judged = judgedChannels(a, b);
  if (judged.length === 0 || !a.fits(b)) return null;
  const none = -1, unknown = -2, first = new Int16Array(a.width * a.height).fill(unknown), counts = judged.map(() => 0);
  judged.forEach((of, k) => {
    for (let i = 0; i < first.length; i += 1) {
      if (first[i] >= 0 || !isJudged(of, i)) continue;
      first[i] = none;
      if (isOutside(of, i)) { first[i] = k; counts[k] += 1; }
    }
  });
  const unjudged = first.filter((k) => k === unknown).length;
  return { names: judged.map(({ name }) => name), counts, unjudged, inside: first.filter((k) => k === none).length,
           picture: paint(a, (i) => (first[i] === unknown ? classColours[4] : first[i] === none ? noneLeft : colourOfCode(first[i]))) };
}
