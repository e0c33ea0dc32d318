/* Values: as text, in numbers of a whole channel, and against those of another source. */

const scratch = new DataView(new ArrayBuffer(4));
const hexOf = (bits) => "0x" + bits.toString(16).padStart(8, "0");
/* The shortest decimal that is this float and no other. */
function decimalOf(type, bits) {
  if (type === "uint32") return String(bits);
  scratch.setUint32(0, bits);
  const value = scratch.getFloat32(0);
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "NaN" : value > 0 ? "inf" : "-inf";
  if (Object.is(value, -0)) return "-0";
  for (let digits = 1; digits < 9; digits += 1) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === value) return String(Number(text));
  }
  return String(Number(value.toPrecision(9)));
}
/* As C's %a: 0x1.8p+1. */
function hexFloatOf(bits) {
  const sign = bits >>> 31 ? "-" : "", exponent = (bits >>> 23) & 255, fraction = bits & 0x7fffff;
  if (exponent === 255) return "";
  if (exponent === 0 && fraction === 0) return sign + "0x0p+0";
  const digits = (fraction * 2).toString(16).padStart(6, "0").replace(/0+$/, "");
  const power = exponent === 0 ? -126 : exponent - 127;
  return `${sign}0x${exponent === 0 ? 0 : 1}${digits ? "." + digits : ""}p${power < 0 ? "" : "+"}${power}`;
}
const counted = (n, what) => `${n} ${what}${n === 1 ? "" : "s"}`;
function short(x) {
  if (x === null || x === undefined) return "–";
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "NaN" : x > 0 ? "inf" : "-inf";
  if (x === 0) return "0";
  const size = Math.abs(x);
  return size >= 1e6 || size < 1e-3 ? x.toExponential(2).replace("e+", "e") : String(Number(x.toPrecision(5)));
}

/* FNV-1a over the words of all bits: tells whether the page has what the file has. */
function hashOf(bits) {
  let hash = 2166136261;
  for (let i = 0; i < bits.length; i += 1) hash = Math.imul(hash ^ bits[i], 16777619);
  return hash >>> 0;
}
/* Of a channel or a pair of them once: they don't change. */
function remembered(fn) {
  const known = new WeakMap();
  return (channel, other) => {
    if (!known.has(channel)) known.set(channel, new Map());
    const ofIt = known.get(channel);
    if (!ofIt.has(other)) ofIt.set(other, fn(channel, other));
    return ofIt.get(other);
  };
}
const statisticsOf = remembered((channel) => {
  const s = { least: Infinity, most: -Infinity, mean: 0, finite: 0, nan: 0, infinite: 0 };
  for (const v of channel.values) {
    if (Number.isNaN(v)) s.nan += 1;
    else if (!Number.isFinite(v)) s.infinite += 1;
    else {
      if (v < s.least) s.least = v;
      if (v > s.most) s.most = v;
      s.mean += v;
      s.finite += 1;
    }
  }
  if (s.finite === 0) s.least = s.most = s.mean = NaN;
  else s.mean /= s.finite;
  return s;
});

const isNaNBits = (bits) => (bits & 0x7fffffff) > 0x7f800000;
const onLine = (bits) => (bits >>> 31 ? -(bits & 0x7fffffff) : bits);
/* How far two values are apart: 0 for equal bits (all NaNs count as equal), infinite where one side alone is
   NaN or infinite. `ulp` counts floats between them. */
function differenceOf(a, b, i, j) {
  if (a.bits[i] === b.bits[j] && a.type === b.type) return 0;
  const x = a.values[i], y = b.values[j];
  if (a.type === "float32" && Number.isNaN(x) && b.type === "float32" && Number.isNaN(y)) return 0;
  const apart = Math.abs(x - y);
  return Number.isNaN(apart) ? Infinity : apart;
}
function ulpOf(a, b, i, j) {
  if (a.type !== "float32" || b.type !== "float32") return null;
  if (isNaNBits(a.bits[i]) || isNaNBits(b.bits[j])) return isNaNBits(a.bits[i]) === isNaNBits(b.bits[j]) ? 0 : Infinity;
  return Math.abs(onLine(a.bits[i]) - onLine(b.bits[j]));
}
const isUnequal = (a, b, i) =>
  a.bits[i] !== b.bits[i] && !(a.type === "float32" && isNaNBits(a.bits[i]) && isNaNBits(b.bits[i]));

/* Of channels over one window. */
const comparisonOf = remembered((a, b) => {
  const c = { unequal: 0, most: 0, ulp: 0, notFinite: 0 };
  for (let i = 0; i < a.bits.length; i += 1) {
    if (!isUnequal(a, b, i)) continue;
    c.unequal += 1;
    const apart = differenceOf(a, b, i, i);
    if (apart === Infinity) c.notFinite += 1;
    else if (apart > c.most) c.most = apart;
    const ulp = ulpOf(a, b, i, i);
    if (ulp !== null && ulp !== Infinity && ulp > c.ulp) c.ulp = ulp;
  }
  return c;
});
/* The pixels that are farthest apart in any of the pairs of channels; equal ones are none. */
function worstPixels(pairs, count) {
  const worst = [];
  if (pairs.length === 0) return worst;
  for (let i = 0; i < pairs[0][0].bits.length; i += 1) {
    let most = 0, unequal = false, name = "";
    for (const [a, b] of pairs) {
      if (!isUnequal(a, b, i)) continue;
      const apart = differenceOf(a, b, i, i);
      if (!unequal || apart > most) { most = apart; name = a.name; }
      unequal = true;
    }
    if (!unequal || (worst.length === count && most <= worst[count - 1].most)) continue;
    let at = worst.length;
    while (at > 0 && worst[at - 1].most < most) at -= 1;
    worst.splice(at, 0, { i, most, name });
    worst.length = Math.min(worst.length, count);
  }
  return worst;
}

/* Classes: what a value is against the range that the reference holds of it (compare --legal). */
const classNames = ["pass", "ambiguous", "unconstrained", "fail", "not judged"], notJudged = 0xffffffff;
function rangesOf(source, name) {
  const [low, high, paths] = ["lo", "hi", "paths"].map((part) => source.channels.get(`gpu.${part}.${name}`));
  const [gapLow, gapHigh] = ["lo", "hi"].map((end) => source.channels.get(`gpu.gap.${end}.${name}`) || high);
  return low && high && paths ? { low, high, paths, gapLow, gapHigh } : null;
}
/* As extent_of has it. */
function extentOf(source, name) {
  const vector = vectorOf(name), own = statisticsOf(source.channels.get(name));
  let magnitude = 0;
  for (const [other, channel] of source.channels) {
    if (vectorOf(other) !== vector) continue;
    const s = statisticsOf(channel);
    if (s.finite) magnitude = Math.max(magnitude, Math.abs(s.least), Math.abs(s.most));
  }
  return Math.max(own.finite ? own.most - own.least : 0, 0.1 * (magnitude || 100 * 2 ** -20));
}
/* As legal_verdict has it, with its 10 % of the extent. */
function classOf(ranges, extent, value, i) {
  const low = ranges.low.values[i], high = ranges.high.values[i], paths = ranges.paths.values[i];
  if (paths === notJudged) return 4;
  if (paths === 0) return 2;
  const gapLow = ranges.gapLow.values[i], gapHigh = ranges.gapHigh.values[i];
  const hasGap = gapLow >= low && gapLow < gapHigh && gapHigh <= high;
  const open = [low, high].filter(Number.isNaN).length;
  const holds = Number.isNaN(value) ? open > 0
    : open < 2 && !(value < low) && !(value > high) && !(hasGap && value > gapLow && value < gapHigh);
  if (!holds) return 3;
  const gap = hasGap ? gapHigh - gapLow : 0;
  const width = open === 1 ? Infinity : open === 2 || low === high ? 0 : high - low - gap;
  if (!(width <= 0.1 * extent)) return 2;
  return paths > 1 ? 1 : 0;
}

/* The channels that have ranges, in the reference's order: { name, ranges, value, extent }[]. */
function judgedChannels(a, b) {
  return [...a.channels.keys()].map((name) => ({ name, ranges: rangesOf(a, name), value: b.channels.get(name) }))
    .filter(({ ranges, value }) => ranges && value).map((judged) => ({ ...judged, extent: extentOf(a, judged.name) }));
}
const isJudged = ({ ranges }, i) => ranges.paths.values[i] !== notJudged;
const isOutside = ({ ranges, value, extent }, i) => classOf(ranges, extent, value.values[i], i) === 3;
/* As compare --legal has it: pixels outside of their range, NaN first, then by the distance from it. */
function worstOutside(judged, count) {
  const worst = [];
  for (const of of judged)
    for (let i = 0; i < of.value.bits.length; i += 1) {
      if (!isOutside(of, i)) continue;
      const v = of.value.values[i], [low, high, gapLow, gapHigh] = ["low", "high", "gapLow", "gapHigh"].map((end) => of.ranges[end].values[i]);
      const most = Number.isNaN(v) ? Infinity : Math.max(low - v || 0, v - high || 0, Math.min(v - gapLow, gapHigh - v) || 0);
      if (worst.length === count && most <= worst[count - 1].most) continue;
      let at = worst.length;
      while (at > 0 && worst[at - 1].most < most) at -= 1;
      worst.splice(at, 0, { i, most, name: of.name });
      worst.length = Math.min(worst.length, count);
    }
  return worst;
}

/* "N" of N.X; "R G B" of R: what is looked at together. */
function vectorOf(name) {
  if (["R", "G", "B"].includes(name)) return "R G B";
  const dot = name.lastIndexOf(".");
  return dot > 0 && /^[A-Z0-9]+$/.test(name.slice(dot + 1)) ? name.slice(0, dot) : name;
}
