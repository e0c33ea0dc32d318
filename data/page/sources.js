/* Sources: named images whose channels are arrays of bits. What draws and compares knows nothing
   of where they come from. */

function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i += 1) bytes[i] = text.charCodeAt(i);
  return bytes;
}
async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
/* What packed_text did, undone. */
const unpackedText = async (base64) => new TextDecoder().decode(await inflated(bytesOf(base64)));
/* What packed_bits (src/page/bits.hpp) did, undone. */
async function unpackedBits(base64, count, earlier) {
  const bytes = await inflated(bytesOf(base64)), head = 5;
  if (bytes.length !== 4 * count + head) throw new Error(`${bytes.length} bytes instead of ${4 * count + head}`);
  const bits = new Uint32Array(count), [ofBytes, left, plane] = [0, 1, 2], prediction = bytes[0];
  const width = new DataView(bytes.buffer, bytes.byteOffset).getUint32(1, true);
  let last = 0, at = head;
  for (let shift = 0; shift < 32; shift += 8)
    for (let i = 0; i < count; i += 1) {
      last = prediction === ofBytes ? (last + bytes[at++]) & 255 : bytes[at++];
      bits[i] |= last << shift;
    }
  if (prediction === left || prediction === plane)
    for (let i = 0; i < count; i += 1) {
      const hasLeft = prediction === left ? i > 0 : i % width > 0, hasAbove = prediction === plane && i >= width;
      const above = hasAbove ? bits[i - width] - (hasLeft ? bits[i - width - 1] : 0) : 0;
      bits[i] = ((bits[i] >>> 1) ^ -(bits[i] & 1)) + (hasLeft ? bits[i - 1] : 0) + above;
    }
  if (earlier) for (let i = 0; i < count; i += 1) bits[i] ^= earlier[i];
  return bits;
}

/* What range_codes (src/page/range_codes.hpp) did, undone: the bits of bounds of `values`. */
function boundBits(values, codes, end) {
  const bounds = new Uint32Array(codes.length), floats = new Float32Array(bounds.buffer), numbers = new Float32Array(values.buffer);
  const nanCode = 0x2000, inward = 0x1000, infiniteCode = 1, firstCode = 2, firstExponent = -24, low = end === "low";
  const distanceOf = (code, exponent) => (code === 0 ? 0 : code === infiniteCode ? Infinity :
    (8 + (code - firstCode) % 8) * 2 ** (Math.floor((code - firstCode) / 8) + firstExponent - 3 + exponent));
  for (let i = 0; i < codes.length; i += 1) {
    if (codes[i] === nanCode) { bounds[i] = 0x7fc00000; continue; }
    const finite = Number.isFinite(numbers[i]), base = finite ? numbers[i] : 0;
    const exponent = Math.max(finite ? (values[i] >>> 23) & 255 : 0, 1) - 127;
    const distance = distanceOf(codes[i] & ~inward, exponent), exact = low === !(codes[i] & inward) ? base - distance : base + distance;
    floats[i] = exact;
    if (low ? floats[i] > exact : floats[i] < exact) {  /* to the next float outwards */
      const at = onLine(bounds[i]) + (low ? -1 : 1);
      bounds[i] = at < 0 ? (-at | 0x80000000) >>> 0 : at;
    }
  }
  return bounds;
}

/* A channel: `values` are numbers; bits tell what numbers don't. */
function channelOf(name, type, stored, bits) {
  return { name, type, stored, bits, values: type === "uint32" ? bits : new Float32Array(bits.buffer) };
}
class Source {
  constructor(name, frame, window, attributes = {}) {
    this.name = name;
    this.frame = frame;
    [this.x0, this.y0, this.x1, this.y1] = window;
    this.width = this.x1 - this.x0;
    this.height = this.y1 - this.y0;
    this.attributes = attributes;
    this.channels = new Map();
  }
  /* -1 where the image has no such pixel. */
  index(x, y) {
    const inside = x >= this.x0 && x < this.x1 && y >= this.y0 && y < this.y1;
    return inside ? (y - this.y0) * this.width + x - this.x0 : -1;
  }
  fits(other) {
    return ["x0", "y0", "x1", "y1"].every((key) => this[key] === other[key]);
  }
}
async function embeddedSource(described, earlier) {
  const source = new Source(described.name, described.frame, described.window, described.attributes);
  for (const { name, type, stored, against, beside, end, bits } of described.channels)
    try {
      const before = against ? earlier.channels.get(name).bits : null;
      const unpacked = await unpackedBits(bits, source.width * source.height, before);
      source.channels.set(name, channelOf(name, type, stored,
        beside ? boundBits(source.channels.get(beside).bits, unpacked, end) : unpacked));
    } catch (error) {
      throw new Error(`${described.name}: the data of channel ${name} are damaged (${error.message})`);
    }
  return source;
}
async function embeddedSources() {
  if (typeof DecompressionStream === "undefined")
    throw new Error("this browser cannot unpack the values: it lacks DecompressionStream, which Chrome 80, Firefox 113 and Safari 16.4 have");
  const sources = [];
  for (const described of JSON.parse(byId("sources-data").textContent).sources)
    sources.push(await embeddedSource(described, sources.at(-1)));
  return sources;
}
