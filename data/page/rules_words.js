/* Answers of the probes in few words, and whether the specification permits them: what src/rules/probes says of the
   same numbers, which a test holds it to. `values` has four floats per pixel. */

const answerAt = (values, i, c = 0) => values[4 * i + c];
const pixelsOf = (values) => values.length / 4;
/* printf's %.Ng. */
function general(x, digits = 6) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "nan" : x > 0 ? "inf" : "-inf";
  if (x === 0) return Object.is(x, -0) ? "-0" : "0";
  const [mantissa, exponent] = x.toExponential(digits - 1).split("e"), power = Number(exponent);
  if (power >= -4 && power < digits) return String(Number(x.toPrecision(digits)));
  return `${Number(mantissa)}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
}
const generals = (...numbers) => numbers.map((x) => general(x)).join(" ");

/* Whether both derivatives are what is expected wherever something was drawn, of 16 x 16 pixels. */
function allAre(values, expected) {
  for (let i = 0; i < 256; i += 1) {
    if (answerAt(values, i, 3) === 0) continue;
    const [dx, dy] = expected(i % 16, i >> 4);
    if (answerAt(values, i) !== dx || answerAt(values, i, 1) !== dy) return false;
  }
  return true;
}
function modeWords(values) {
  if (allAre(values, (x, y) => [y, x])) return "fine";
  for (const row of [0, 1])
    for (const column of [0, 1])
      if (allAre(values, (x, y) => [(y & ~1) + row, (x & ~1) + column])) return row + column === 0 ? "coarse" : `coarse: row ${row}, column ${column}`;
  return "other";
}
function isExtrapolated(values) {
  for (let i = 0; i < pixelsOf(values); i += 1)
    if (answerAt(values, i, 3) !== 0 && (Math.abs(answerAt(values, i) - 3) > 1e-3 || Math.abs(answerAt(values, i, 1) - 5) > 1e-3)) return false;
  return true;
}
function laneWords(values) {
  const [first, ...rest] = [0, 1, 2, 3].map((lane) => answerAt(values, (lane >> 1) * 16 + (lane & 1)));
  if (rest.some((other) => other !== first)) return "each its own";
  return Math.abs(first - 1) < Math.fround(0.1) ? "lane 0's" : "one per quad";
}
function fanWords(values) {
  const fans = 4, side = 32, frame = 4 * side * side, size = values.length / fans;
  let holes = 0, twice = 0;
  for (let fan = 0; fan < fans; fan += 1)
    for (let y = 4; y < 28; y += 1)
      for (let x = 4; x < 28; x += 1) {
        let times = 0;
        for (let first = fan * size; first < (fan + 1) * size; first += frame) times += values[first + 4 * (y * side + x)] !== 0;
        holes += times === 0;
        twice += times > 1;
      }
  return holes + twice === 0 ? "once" : `${holes} not, ${twice} more than once`;
}
const edgeOwners = (values) => [["left", 2, 3], ["right", 5, 3], ["bottom", 3, 2], ["top", 3, 5]].filter(([, x, y]) => answerAt(values, 8 * y + x) !== 0).map(([name]) => name);
/* In 1/2048 pixel: the last edge right of a centre that still covers it. */
function snapReach(values) {
  let last = 0;
  while (last < 256 && answerAt(values, 8 * last + 2) !== 0) last += 1;
  return last - 1 - 128;
}
function snapWords(values) {
  const last = snapReach(values);
  for (let bits = 10; bits >= 1; bits -= 1) {
    const half = 2 ** (10 - bits);
    if (last === half) return `${bits} bits, half to even`;
    if (last === half - 1) return `${bits} bits, half up`;
  }
  return last < 0 ? "finer than 1/2048" : `${last}/2048 pixel`;
}
function relativeWords(values, { exact }) {
  let worst = 0, largest = 0;
  for (let i = 0; i < exact.length; i += 1) {
    if (values[i | 3] === 0 || exact[i | 3] === 0) continue;
    worst = Math.max(worst, Math.abs(values[i] - exact[i]));
    largest = Math.max(largest, Math.abs(exact[i]));
  }
  return worst === 0 ? "exact" : `2^${Math.log2(worst / largest).toFixed(1)}`;
}

/* Formulas for rho, of gradients (x, y) and (z, w) in texels. */
const longerGradient = ([x, y, z, w]) => Math.max(Math.sqrt(x * x + y * y), Math.sqrt(z * z + w * w));
function ellipseAxis([x, y, z, w]) {
  if (x * w - y * z === 0) return longerGradient([x, y, z, w]);
  const a = x * x + z * z, b = y * y + w * w, c = x * y + z * w, half = (a - b) / 2;
  return Math.sqrt((a + b) / 2 + Math.sqrt(half * half + c * c));
}
const greatestComponent = (g) => Math.max(...g.map(Math.abs));
const sumOfAxes = ([x, y, z, w]) => Math.max(Math.abs(x), Math.abs(z)) + Math.max(Math.abs(y), Math.abs(w));
/* Least and greatest of the levels less the formula's, of those within [low, high]. */
function departure(scale, asked, values, low, high) {
  let least = 1e30, most = -1e30;
  for (let i = 0; i < pixelsOf(asked); i += 1) {
    const level = Math.log2(scale(asked.subarray(4 * i, 4 * i + 4)));
    if (!(level > low + 0.1 && level < high - 0.1)) continue;
    const off = answerAt(values, i) - level;
    least = Math.min(least, off);
    most = Math.max(most, off);
  }
  return [least, most];
}
function formulaWords(values, { asked }, low = 0, high = 6) {
  const short = (x) => (Math.abs(x) < 0.0005 ? "0" : (x < 0 ? "" : "+") + x.toFixed(3));
  let best = "no number", width = 1e30;
  for (const [name, scale] of [["longer gradient", longerGradient], ["ellipse", ellipseAxis], ["greatest component", greatestComponent], ["sum of axes", sumOfAxes]]) {
    const [least, most] = departure(scale, asked, values, low, high);
    if (!(most - least < width - 1e-6)) continue;
    width = most - least;
    best = name + (Math.max(Math.abs(least), Math.abs(most)) >= 0.0005 ? `, ${short(least)} to ${short(most)}` : "");
  }
  return best;
}
function permitsLevels(values, { asked }, low = 0, high = 6) {
  return departure(greatestComponent, asked, values, low, high)[0] >= -0.0625 && departure(sumOfAxes, asked, values, low, high)[1] <= 0.0625;
}
function bitsWords(values) {
  const apart = new Set();
  for (let i = 0; i < pixelsOf(values); i += 1) apart.add(answerAt(values, i));
  return 2 * apart.size > pixelsOf(values) ? "exact" : `${apart.size} values, ${Math.log2(apart.size).toFixed(1)} bits`;
}
function stepsWords(values, { asked }) {
  return [0, 1, 2, 3].map((level) => {
    let last = -1;
    for (let i = 0; i < pixelsOf(asked); i += 1)
      if (answerAt(values, i) <= level) last = Math.max(last, Math.log2(answerAt(asked, i)));
    return last < 0 ? "-" : (last + 1 / 128).toFixed(2);
  }).join(" ");
}
function filterSwitch(values) {
  let last = -1;
  for (let i = 0; i < 128; i += 1) if (answerAt(values, i) === 0.375) last = i;
  return last < 0 ? "never" : general((last - 32) / 64);
}
const nearestLevels = (values) => [0, 16, 32, 48].map((i) => answerAt(values, i));

function boundaryOfTexels(values) {
  let first = 0;
  while (first < 256 && answerAt(values, first) === 3) first += 1;
  const late = first - 128;
  return late === 0 ? "exact" : `${late > 0 ? "+" : ""}${late} / 8192 texel`;
}
const wrapWords = (period) => (values, { asked }) => {
  const texelOf = (u) => {
    const index = Math.floor(2 * u), within = index - period * Math.floor(index / period);
    return within < 2 ? within : 3 - within;
  };
  let right = 0;
  while (right < pixelsOf(asked) && answerAt(values, right) === texelOf(answerAt(asked, right))) right += 1;
  return `to 2^${Math.trunc(right / 32) - 1}`;
};
function orderWords(values, { asked }) {
  let worst = 0;
  for (let i = 0; i < pixelsOf(asked); i += 1) {
    const u = answerAt(asked, i), texel = 3 * (u - Math.floor(u)) - 0.5, base = Math.floor(texel), texels = [4, 0, 1, 4, 0];
    const exact = texels[base + 1] + (texel - base) * (texels[base + 2] - texels[base + 1]);
    worst = Math.max(worst, Math.abs(answerAt(values, i) - exact));
  }
  return worst < 2 ** -16 ? "wrapped first" : `off by up to ${general(worst, 1)}`;
}
const boundaryWords = (values) => generals(...[8, 10, 12, 14, 16].map((i) => answerAt(values, i)));
const firstFour = (values) => generals(...values.subarray(0, 4));
function wrongSizes(values, { asked }) {
  let wrong = 0;
  for (let i = 0; i < 256; i += 1) wrong += answerAt(values, i) !== 16 / 2 ** answerAt(asked, i);
  return wrong;
}

function seamJump(values) {
  let most = 0;
  for (let i = 0; i + 1 < pixelsOf(values); i += 2) most = Math.max(most, Math.abs(answerAt(values, i) - answerAt(values, i + 1)));
  return most;
}
/* The mean of the three texels that meet at a corner of a cube of 2 x 2 texels a face. */
function cornerMean(v) {
  const texel = (face) => {
    const [x, y, z] = v, s = [-z, z, x, x, x, -x], t = [-y, -y, z, -z, -y, -y];
    return 4 * face + 2 * (t[face] > 0) + (s[face] > 0);
  };
  return [0, 1, 2].reduce((sum, axis) => sum + texel(2 * axis + (v[axis] < 0)), 0) / 3;
}
function cornerWords(values, { asked }) {
  for (let i = 0; i < 8; i += 1)
    if (Math.abs(answerAt(values, i) - cornerMean(asked.subarray(4 * i, 4 * i + 3))) > 0.01) return "other";
  return "mean of three";
}
const faceWords = (values) => [0, 1, 2, 3].map((i) => "XXYYZZ"[Math.trunc(answerAt(values, i) / 4)] ?? "?").join(" ");

function worstUlps(exact, values, { asked }) {
  let most = 0;
  for (let i = 0; i < pixelsOf(asked); i += 1) {
    const is = exact(answerAt(asked, i), answerAt(asked, i, 1)), size = Math.max(Math.abs(is), 2 ** -126);
    let unit = 2 ** Math.floor(Math.log2(size));  /* may be off by one beside a power of two */
    if (unit > size) unit /= 2;
    if (2 * unit <= size) unit *= 2;
    if (Number.isFinite(is) && Math.abs(is) <= 3e38) most = Math.max(most, Math.abs(answerAt(values, i) - is) / (unit * 2 ** -23));
  }
  return most;
}
const ofFunction = (exact, permitted) => ({ words: (values, q) => `${general(worstUlps(exact, values, q), 2)} ulp`,
                                            ...(permitted ? { permits: (values, q) => worstUlps(exact, values, q) <= permitted } : {}) });
const onceOrTwice = { words: (values) => (values.some((v, i) => i % 4 === 0 && v !== 0) ? "once" : "twice") };
const modeRule = { words: modeWords, permits: (values) => modeWords(values) !== "other" };
const levelRule = { words: (values, q) => formulaWords(values, q), permits: (values, q) => permitsLevels(values, q) };
const boundaryRule = { words: boundaryWords }, bitsRule = { words: bitsWords }, stepsRule = { words: stepsWords };

/* By the probe's name. `q`: { asked, exact }: what is asked, and what Quadrel answers exactly. */
const ruleWords = {
  "quads": { words: (values) => (allAre(values, (x, y) => [-(x & 1), -(y & 1)]) ? "even" : allAre(values, (x, y) => [(x & 1) - 1, (y & 1) - 1]) ? "odd" : "other") },
  "derivatives": modeRule,
  "derivatives-qualified": modeRule,
  "helper-lanes": { words: (values) => (isExtrapolated(values) ? "extrapolated" : "other"), permits: isExtrapolated },
  "quad-lod": { words: laneWords },
  "quad-gradients": { words: laneWords, permits: (values) => laneWords(values) === "each its own" },
  "fill-fans": { words: fanWords, permits: (values) => fanWords(values) === "once" },
  "fill-edges": { words: (values) => edgeOwners(values).join(", ") || "none", permits: (values) => {
    const owners = edgeOwners(values);
    return owners.includes("left") !== owners.includes("right") && owners.includes("bottom") !== owners.includes("top");
  } },
  "snapping": { words: snapWords, permits: (values) => Math.abs(snapReach(values)) <= 64 },
  "samples": { words: (values) => Array.from({ length: values.length / 2 }, (_, i) => `${values[2 * i].toFixed(0)},${values[2 * i + 1].toFixed(0)}`).join(" ") },
  "interpolation": { words: relativeWords },
  "lod-axis": levelRule, "lod-formula": levelRule, "lod-implicit": levelRule,
  "lod-query": { words: (values, q) => formulaWords(values, q, -2, 7), permits: (values, q) => permitsLevels(values, q, 0, 7) },
  "lod-query-level": { words: (values) => `up to ${general(Math.round(Math.max(...values.filter((_, i) => i % 4 === 0)) * 100) / 100)}`,
                       permits: (values) => values.every((v, i) => i % 4 !== 0 || v <= 6) },
  "lod-bits": bitsRule,
  "nearest-level": { words: (values) => generals(...nearestLevels(values)), permits: (values) => nearestLevels(values).every((v, row) => v === row || v === row + 1) },
  "nearest-gradient": stepsRule, "nearest-implicit": stepsRule,
  "filter-switch": { words: filterSwitch, permits: (values) => ["0", "0.5"].includes(filterSwitch(values)) },
  "weights-R8": bitsRule, "weights-RGBA8": bitsRule, "weights-SRGB8_ALPHA8": bitsRule, "weights-R16": bitsRule, "weights-R16F": bitsRule, "weights-R32F": bitsRule,
  "nearest-texel": { words: boundaryOfTexels },
  "gather": { words: firstFour, permits: (values) => firstFour(values) === "9 10 6 5" },
  "wrap-repeat": { words: wrapWords(2) }, "wrap-mirrored": { words: wrapWords(4) },
  "wrap-order": { words: orderWords },
  "boundary-repeat": boundaryRule, "boundary-mirrored": boundaryRule,
  "coordinates-nan": { words: (values) => [0, 1].map((c) => generals(...[0, 1, 2].map((i) => answerAt(values, i, c)))).join(", ") },
  "texture-size": { words: (values, q) => (wrongSizes(values, q) ? `${wrongSizes(values, q)} of 256 another's` : "each its own"), permits: (values, q) => wrongSizes(values, q) === 0 },
  "cube-seams": { words: (values) => (seamJump(values) < 1e-3 ? "seamless" : `jumps by ${general(seamJump(values), 2)}`), permits: (values) => seamJump(values) < 1e-3 },
  "cube-corners": { words: cornerWords },
  "cube-ties": { words: faceWords },
  "denormals": { words: (values) => [0, 1].map((c) => (values[c] !== 0 ? "kept" : "0")).join(", ") },
  "min-nan": { words: (values) => [0, 1, 2, 3].map((c) => (Number.isNaN(values[c]) ? "NaN" : "1")).join(" ") },
  "isnan": { words: (values) => `${generals(...values.subarray(0, 3))}; ${general(values[3])}` },
  "contraction": onceOrTwice,
  "fma": onceOrTwice,
  "division": ofFunction((x, y) => x / y, 2.5),
  "sqrt": ofFunction((x) => Math.sqrt(x), 4.5),
  "inversesqrt": ofFunction((x) => 1 / Math.sqrt(x), 2),
  "exp2": ofFunction((x) => 2 ** x, 23),
  "log2": ofFunction((x) => Math.log2(x), 3),
  "sin": ofFunction((x) => Math.sin(x)),
};

/* The probes for who looks at WebGPU: WebGL 2 asks them on the same GPU; they are told by WGSL's names, with what WebGPU
   permits. Of rasterizer and samplers no document states it. */
const wgslNames = [[/dFd([xy])(Coarse|Fine)?/g, "dpd$1$2"], [/textureGrad/g, "textureSampleGrad"], [/texture\(\)/g, "textureSample()"],
                   [/textureLod/g, "textureSampleLevel"], [/textureSize/g, "textureDimensions"], [/inversesqrt/g, "inverseSqrt"]];
const inWgsl = (text) => wgslNames.reduce((told, [glsl, wgsl]) => told.replace(glsl, wgsl), text);
const accuracy = "WGSL, Floating Point Accuracy", noNaN = "anything: that there is no NaN may be assumed (WGSL, Floating Point Evaluation)";
const noDocument = "no document states it; ranges assume Vulkan's", noFunction = "WGSL has no such function";
const webGpuPermits = {
  "derivatives": `any value (${accuracy}); ranges assume a difference along any row and column of the quad`,
  "derivatives-qualified": `any value (${accuracy}); ranges assume what the names say`,
  "fill-fans": "once, where triangles share an edge: Vulkan's, which is assumed", "snapping": "no document states it: Vulkan, 4 bits at least; ranges assume 8 unless snapping= says otherwise",
  "lod-query": noFunction, "lod-query-level": noFunction, "isnan": `${noFunction} (of NaN); ${noNaN}`, "min-nan": noNaN, "coordinates-nan": noNaN,
  "gather": "i0j1 i1j1 i1j0 i0j0 (WGSL, textureGather)", "texture-size": "each pixel's own level's (WGSL, textureDimensions)", "quad-gradients": "each lane's own (WGSL, textureSampleGrad)",
  "denormals": `kept, or 0 (${accuracy})`, "contraction": "either (WGSL, Reassociation and Fusion)", "fma": `either: as x y + z (${accuracy})`,
  "division": `2.5 ulp (${accuracy})`, "sqrt": `as 1 / inverseSqrt (${accuracy})`, "inversesqrt": `2 ulp (${accuracy})`, "exp2": `3 + 2 abs(x) ulp (${accuracy})`,
  "log2": `3 ulp outside of [0.5, 2], 2^-21 within (${accuracy})`, "sin": `2^-11 in [-pi, pi] (${accuracy})`,
};
/* A probe's text in the terms of the interface that draws the scene: { asks, permits, missing }. */
function probeTexts({ id, asks, permits, missing }, by) {
  if (by !== "webgpu") return { asks, permits, missing };
  const lacks = missing.startsWith("GLSL ES");
  return { asks: inWgsl(asks), permits: webGpuPermits[id] ?? noDocument,
           missing: lacks ? `WebGL 2 asks, and ${missing}${webGpuPermits[id] === noFunction ? ", nor has WGSL" : ""}` : missing };
}
