/* Shaders of an exported scene as WebGL 2 takes them: the same text, but for look-ups of samplers that the browser
   does not have, and for targets that hold no floats. */

const escapedWord = (word) => word.replace(/[^A-Za-z0-9_]/g, "");

/* What a sampler's mode makes of a whole coordinate: an expression of `i` and the size `n`. % of what is below 0 is
   undefined in GLSL ES. */
const wrappedIndex = {
  "repeat": "i - n * int(floor(float(i) / float(n)))",
  "mirrored-repeat": "(i - 2 * n * int(floor(float(i) / float(2 * n)))) < n ? i - 2 * n * int(floor(float(i) / float(2 * n))) : " +
    "2 * n - 1 - (i - 2 * n * int(floor(float(i) / float(2 * n))))",
  "clamp-to-edge": "clamp(i, 0, n - 1)",
  "clamp-to-border": "i",
  "mirror-once": "clamp(i < 0 ? -1 - i : i, 0, n - 1)",
};
/* Coordinates whose texels are near the map, for whole numbers of 32 bits. */
const nearCoordinate = {
  "repeat": "x - floor(x)",
  "mirrored-repeat": "x - 2.0 * floor(0.5 * x)",
  "clamp-to-edge": "clamp(x, -1.0, 2.0)",
  "clamp-to-border": "clamp(x, -1.0, 2.0)",
  "mirror-once": "clamp(x, -2.0, 2.0)",
};
const glslNumber = (v) => {
  const number = Number(v);
  if (!Number.isFinite(number)) return Number.isNaN(number) ? "intBitsToFloat(0x7fc00000)" : number > 0 ? "intBitsToFloat(0x7f800000)" : "-intBitsToFloat(0x7f800000)";
  return Number.isInteger(number) && Math.abs(number) < 1e9 ? `${number}.0` : String(number);
};

/* A sampler in the shader's own words: NAME_implicit, NAME_grad, NAME_at_lod in the place of texture, textureGrad and
   textureLod, and NAME_gather. Filters as OpenGL ES 3.0, 3.8.10 to 3.8.12, has them. `last` is the last level; of an
   array coordinates have a third component. */
function emulatedSampler(sampler, last, isArray) {
  const name = escapedWord(sampler.uniform), [u, v] = sampler.wrap, coordinates = isArray ? "vec3" : "vec2";
  const layer = isArray ? ", int layer" : "", ofLayer = isArray ? ", layer" : "";
  const border = (mode, axis) => (mode === "clamp-to-border" ? `    if (at.${axis} < 0 || at.${axis} >= size.${axis}) return vec4(${sampler.border.map(glslNumber).join(", ")});\n` : "");
  const filter = (linear) => `${name}_${linear === "linear" ? "linear" : "nearest"}`;
  const level = {
    none: "    return magnified ? MAG(at, 0LAYER) : MIN(at, 0LAYER);\n",
    nearest: `    if (magnified) return MAG(at, 0LAYER);\n    return MIN(at, int(clamp(ceil(lod + 0.5) - 1.0, 0.0, ${last}.0))LAYER);\n`,
    linear: `    if (magnified) return MAG(at, 0LAYER);\n    float level = clamp(lod, 0.0, ${last}.0);\n    int fine = int(floor(level));\n` +
      `    return mix(MIN(at, fineLAYER), MIN(at, min(fine + 1, ${last})LAYER), level - floor(level));\n`,
  }[last === 0 ? "none" : sampler.mip].replaceAll("MAG", filter(sampler.mag)).replaceAll("MIN", filter(sampler.min)).replaceAll("LAYER", ofLayer);
  return `
// ${name}: its sampler by texelFetch.
int ${name}_wrapped_u(int i, int n) { return ${wrappedIndex[u]}; }
int ${name}_wrapped_v(int i, int n) { return ${wrappedIndex[v]}; }
float ${name}_near_u(float x) { return ${nearCoordinate[u]}; }
float ${name}_near_v(float x) { return ${nearCoordinate[v]}; }
vec4 ${name}_texel(ivec2 at, int level${layer}) {
    ivec2 size = textureSize(${name}, level).xy;
${border(u, "x")}${border(v, "y")}    ivec2 texel = ivec2(${name}_wrapped_u(at.x, size.x), ${name}_wrapped_v(at.y, size.y));
    return texelFetch(${name}, ${isArray ? "ivec3(texel, layer)" : "texel"}, level);
}
vec4 ${name}_nearest(vec2 at, int level${layer}) {
    return ${name}_texel(ivec2(floor(at * vec2(textureSize(${name}, level).xy))), level${ofLayer});
}
vec4 ${name}_linear(vec2 at, int level${layer}) {
    vec2 texels = at * vec2(textureSize(${name}, level).xy) - 0.5;
    ivec2 i = ivec2(floor(texels));
    vec2 weight = texels - floor(texels);
    return mix(mix(${name}_texel(i, level${ofLayer}), ${name}_texel(i + ivec2(1, 0), level${ofLayer}), weight.x),
               mix(${name}_texel(i + ivec2(0, 1), level${ofLayer}), ${name}_texel(i + ivec2(1, 1), level${ofLayer}), weight.x), weight.y);
}
vec4 ${name}_at_lod(${coordinates} uv, float asked) {
    float lod = clamp(asked, ${glslNumber(sampler.lod_min)}, ${glslNumber(sampler.lod_max)});
    bool magnified = lod <= 0.0;
    vec2 at = vec2(${name}_near_u(uv.x), ${name}_near_v(uv.y));
${isArray ? `    int layer = clamp(int(floor(uv.z + 0.5)), 0, textureSize(${name}, 0).z - 1);\n` : ""}${level}}
vec4 ${name}_grad(${coordinates} uv, vec2 dx, vec2 dy, float bias) {
    vec2 size = vec2(textureSize(${name}, 0).xy);
    return ${name}_at_lod(uv, log2(max(length(dx * size), length(dy * size))) + bias + ${glslNumber(sampler.lod_bias)});
}
vec4 ${name}_grad(${coordinates} uv, vec2 dx, vec2 dy) { return ${name}_grad(uv, dx, dy, 0.0); }
vec4 ${name}_implicit(${coordinates} uv, float bias) { return ${name}_grad(uv, dFdx(uv.xy), dFdy(uv.xy), bias); }
vec4 ${name}_implicit(${coordinates} uv) { return ${name}_implicit(uv, 0.0); }
`;
}
/* textureGather, which comes with OpenGL ES 3.1. */
function emulatedGather(sampler) {
  const name = escapedWord(sampler.uniform);
  return `
// textureGather(${name}, uv, component)
vec4 ${name}_gather(vec2 uv, int component) {
    vec2 at = vec2(${name}_near_u(uv.x), ${name}_near_v(uv.y));
    ivec2 i = ivec2(floor(at * vec2(textureSize(${name}, 0)) - 0.5));
    return vec4(${name}_texel(i + ivec2(0, 1), 0)[component], ${name}_texel(i + ivec2(1, 1), 0)[component],
                ${name}_texel(i + ivec2(1, 0), 0)[component], ${name}_texel(i, 0)[component]);
}
`;
}

const callOf = (call, name) => new RegExp(`\\b${call}\\(\\s*${name}\\s*,\\s*`, "g");
const gathersFrom = (text, name) => callOf("textureGather", name).test(text);
/* `emulated`: { sampler, last, isArray, whole }[]; not `whole`: textureGather alone. */
function withEmulatedSamplers(text, emulated) {
  let changed = text.replace("#version 310 es", "#version 300 es");
  for (const { sampler, last, isArray, whole } of emulated) {
    const name = escapedWord(sampler.uniform), gathers = gathersFrom(changed, name);
    if (whole)
      for (const [call, own] of [["texture", "implicit"], ["textureGrad", "grad"], ["textureLod", "at_lod"]])
        changed = changed.replace(callOf(call, name), `${name}_${own}(`);
    if (gathers) changed = changed.replace(callOf("textureGather", name), `${name}_gather(`);
    const declared = new RegExp(`^uniform (highp )?sampler\\w+ ${name};.*$`, "m");
    changed = changed.replace(declared, (line) => line + "\n" + emulatedSampler(sampler, last, isArray) + (gathers ? emulatedGather(sampler) : ""));
  }
  return changed;
}

/* The text of one pass. */
const textOfPass = (text, pass) => text.replace("#define PASS 0\n", `#define PASS ${pass}\n`);

/* The same with the four floats of one target as the bytes of four targets of RGBA8; `pack` is data/snippets. */
function withPackedTarget(text, target, pack) {
  const names = ["x", "y", "z", "w"];
  const globals = text.replace(/^layout\(location = \d+\) out (vec4 target\d+;)$/gm, "$1");
  const outputs = names.map((name, i) => `layout(location = ${i}) out vec4 packed_${name};`).join("\n");
  const stores = names.map((name) => `    packed_${name} = pack_rgba8(floatBitsToUint(target${target}.${name}));`).join("\n");
  return globals.replace("void main() {", "void draw_targets() {") + `\n${outputs}\n\n${pack}\nvoid main() {\n    draw_targets();\n${stores}\n}\n`;
}

/* Line N of a text that a compiler's message is about: "ERROR: 0:N: ...". */
function explainedMessage(message, text) {
  const found = /\b0[:(](\d+)/.exec(message), line = found ? text.split("\n")[Number(found[1]) - 1] : undefined;
  return message.trim() + (line === undefined ? "" : ` (line ${found[1]}: ${line.trim()})`);
}
