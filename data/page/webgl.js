/* An exported scene (its manifest, with `data` for the files) drawn by WebGL 2. What a browser lacks is said in
   `notes`. */

/* The numbers of a uniform. Decimals read back to the bits; what is not finite is in the hex list alone, by its name. */
const floatsOf = (values, hex) => new Float32Array(values.map((v, i) => v ?? { inf: Infinity, "-inf": -Infinity }[hex[i]] ?? NaN));
/* The elements of a file of bytes, in their order. */
async function unpackedFile({ elements, parts, count, bits }) {
  const planar = await unpackedBits(bits, count), records = count / parts;
  const made = { uint8: Uint8Array, uint16: Uint16Array, uint32: Uint32Array, float32: Uint32Array, unorm16: Float32Array }[elements];
  const all = new made(count), scale = elements === "unorm16" ? 65535 : 1;
  for (let part = 0, from = 0; part < parts; part += 1)
    for (let at = part; at < count; at += parts, from += 1) all[at] = scale === 1 ? planar[from] : planar[from] / scale;
  return elements === "float32" ? new Float32Array(all.buffer) : all;
}

/* A sampler object for textures of so many levels; `mirrorsOnce`: the extension that has this mode, if there is one. */
function glSampler(gl, sampler, levels, mirrorsOnce) {
  const made = gl.createSampler();
  const wraps = { repeat: gl.REPEAT, "mirrored-repeat": gl.MIRRORED_REPEAT, "mirror-once": mirrorsOnce?.MIRROR_CLAMP_TO_EDGE_EXT };
  const mip = levels === 1 ? "" : { none: "", nearest: "_MIPMAP_NEAREST", linear: "_MIPMAP_LINEAR" }[sampler.mip];
  [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T].forEach((axis, k) => gl.samplerParameteri(made, axis, wraps[sampler.wrap[k]] ?? gl.CLAMP_TO_EDGE));
  gl.samplerParameteri(made, gl.TEXTURE_MAG_FILTER, gl[sampler.mag.toUpperCase()]);
  gl.samplerParameteri(made, gl.TEXTURE_MIN_FILTER, gl[sampler.min.toUpperCase() + mip]);
  gl.samplerParameterf(made, gl.TEXTURE_MIN_LOD, Number(sampler.lod_min));
  gl.samplerParameterf(made, gl.TEXTURE_MAX_LOD, Number(sampler.lod_max));
  return made;
}

class Drawing {
  /* `wishes`: { targets: "float" | "packed", samplers: "own" | "emulated" }: what is to be used though the browser
     has better. Throws where nothing can be drawn. */
  constructor(scene, wishes) {
    this.scene = scene;
    this.notes = [];
    this.canvas = html("canvas", { width: 1, height: 1 });
    const gl = this.canvas.getContext("webgl2", { antialias: false, depth: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("this browser has no WebGL 2");
    this.gl = gl;
    this.packed = !gl.getExtension("EXT_color_buffer_float");
    if (this.packed) this.notes.push("No float targets here (EXT_color_buffer_float): bits are drawn as bytes of RGBA8.");
    else if (wishes.targets === "packed") {
      this.packed = true;
      this.notes.push("As asked for, bits are drawn as bytes of RGBA8.");
    }
    this.filtersFloats = Boolean(gl.getExtension("OES_texture_float_linear"));
    this.mirrorsOnce = gl.getExtension("EXT_texture_mirror_clamp_to_edge");
    const subPixelBits = gl.getParameter(gl.SUBPIXEL_BITS), { limits } = scene;
    this.snapsCoarser = Boolean(limits) && subPixelBits < 8 && !limits.includes("snapping=");
    if (this.snapsCoarser)
      this.notes.push(`This GPU knows ${subPixelBits} bits below a pixel (SUBPIXEL_BITS), which is permitted, where the ranges take 8 for granted: export with --limits ${limits},snapping=${2 ** -subPixelBits}.`);
    this.allEmulated = wishes.samplers === "emulated";
    this.setConventions();
    this.emulated = scene.materials.map((material) => material.samplers.map((sampler) => this.emulation(sampler)).filter(Boolean));
  }

  get renderer() {
    const { gl } = this, info = gl.getExtension("WEBGL_debug_renderer_info");
    return gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  }
  get attributes() {
    const { gl } = this, info = gl.getExtension("WEBGL_debug_renderer_info");
    return { "WebGL renderer": this.renderer, "WebGL vendor": gl.getParameter(info ? info.UNMASKED_VENDOR_WEBGL : gl.VENDOR),
             "WebGL version": gl.getParameter(gl.VERSION), "GLSL version": gl.getParameter(gl.SHADING_LANGUAGE_VERSION),
             "extensions": gl.getSupportedExtensions().join(" "), "browser": navigator.userAgent,
             "targets": this.packed ? "packed in RGBA8" : "float", "samplers emulated": this.emulatedNames().join(" ") || "none" };
  }

  /* Where clip space and depth begin. */
  setConventions() {
    const { gl } = this, { state, conventions } = this.scene;
    if (state.clip_origin === "lower-left" && state.clip_depth === "negative-one-to-one") return;
    const control = gl.getExtension("EXT_clip_control");
    if (!control) throw new Error(`the scene has the conventions of ${conventions}, for which this browser lacks EXT_clip_control`);
    control.clipControlEXT(state.clip_origin === "upper-left" ? control.UPPER_LEFT_EXT : control.LOWER_LEFT_EXT,
                           state.clip_depth === "zero-to-one" ? control.ZERO_TO_ONE_EXT : control.NEGATIVE_ONE_TO_ONE_EXT);
  }

  /* How a sampler is replaced, if it is. */
  emulation(sampler) {
    const texture = this.scene.textures[sampler.texture], name = sampler.uniform;
    const linear = [sampler.mag, sampler.min, sampler.mip].includes("linear");
    const whole = { sampler, last: texture.levels.length - 1, isArray: texture.kind === "2d-array", whole: true };
    const reasons = [];
    if (texture.kind === "cube") {
      if (Number(sampler.lod_bias) !== 0) this.notes.push(`${name}: WebGL has no bias of the level of detail; it is left out.`);
      if (this.halved(texture)) this.notes.push(`${name}: no filtering of floats here (OES_texture_float_linear): halves are drawn. Sampler not judged.`);
      return null;
    }
    if (this.allEmulated) reasons.push("as asked for");
    for (const mode of sampler.wrap)
      if (mode === "clamp-to-border" || (mode === "mirror-once" && !this.mirrorsOnce)) reasons.push(`WebGL has no ${mode}`);
    if (Number(sampler.lod_bias) !== 0) reasons.push("WebGL has no bias of the level of detail");
    if (linear && texture.gl.type === "FLOAT" && !this.filtersFloats) reasons.push("no filtering of floats here (OES_texture_float_linear)");
    if (reasons.length) {
      this.notes.push(`${name}: sampled by texelFetch in the shader: ${[...new Set(reasons)].join(", ")}. Sampler not judged.`);
      return whole;
    }
    const gathers = this.scene.materials.some((material) => gathersFrom(this.scene.data[material.fragment], name));
    if (gathers) this.notes.push(`${name}: WebGL has no textureGather; it is done by texelFetch. Gathering not judged.`);
    return gathers ? { ...whole, whole: false } : null;
  }
  emulatedNames() {
    return [...new Set(this.emulated.flat().filter(({ whole }) => whole).map(({ sampler }) => sampler.uniform))];
  }
  /* Whether a cube map's floats become halves. */
  halved(texture) {
    return texture.kind === "cube" && texture.gl.type === "FLOAT" && !this.filtersFloats;
  }

  async load() {
    const { gl, scene } = this;
    const [vertices, indices] = [await unpackedFile(scene.data["vertices.bin"]), await unpackedFile(scene.data["indices.bin"])];
    gl.bindVertexArray(gl.createVertexArray());
    for (const [target, data] of [[gl.ARRAY_BUFFER, vertices], [gl.ELEMENT_ARRAY_BUFFER, indices]]) {
      gl.bindBuffer(target, gl.createBuffer());
      gl.bufferData(target, data, gl.STATIC_DRAW);
    }
    for (const { location, components, offset } of scene.vertex_buffer.attributes) {
      gl.vertexAttribPointer(location, components, gl.FLOAT, false, scene.vertex_buffer.stride, offset);
      gl.enableVertexAttribArray(location);
    }
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    this.textures = [];
    for (const texture of scene.textures) this.textures.push(await this.loadTexture(texture));
    this.programs = new Map();
  }
  async loadTexture(texture) {
    const { gl, scene } = this, most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    const target = { "2d": gl.TEXTURE_2D, cube: gl.TEXTURE_CUBE_MAP, "2d-array": gl.TEXTURE_2D_ARRAY }[texture.kind], made = gl.createTexture();
    const { width, height } = texture.levels[0];
    if (Math.max(width, height) > most) throw new Error(`${texture.name} has ${width} × ${height} texels, this GPU takes ${most} a side`);
    gl.bindTexture(target, made);
    const internal = this.halved(texture) ? texture.gl.internal_format.replace("32F", "16F") : texture.gl.internal_format;
    const [format, type] = [gl[texture.gl.format], gl[texture.gl.type]];
    for (const [level, of] of texture.levels.entries()) {
      const texels = await unpackedFile(scene.data[of.bytes]);
      if (texture.kind === "2d-array")
        gl.texImage3D(target, level, gl[internal], of.width, of.height, texture.layers, 0, format, type, texels);
      else {
        const faces = texture.kind === "cube" ? 6 : 1, each = texels.length / faces;
        for (let face = 0; face < faces; face += 1)
          gl.texImage2D(texture.kind === "cube" ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + face : target, level, gl[internal], of.width, of.height, 0,
                        format, type, texels.subarray(face * each, (face + 1) * each));
      }
    }
    gl.texParameteri(target, gl.TEXTURE_MAX_LEVEL, texture.levels.length - 1);
    return { target, made };
  }

  /* A program, made once. */
  program(material, fragment) {
    const { gl, scene } = this, vertex = scene.data[material.vertex], key = vertex + fragment;
    if (this.programs.has(key)) return this.programs.get(key);
    const program = gl.createProgram();
    for (const [kind, text, what] of [[gl.VERTEX_SHADER, vertex.replace("#version 310 es", "#version 300 es"), material.vertex], [gl.FRAGMENT_SHADER, fragment, material.fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
        throw new Error(`${what} does not compile: ${explainedMessage(gl.getShaderInfoLog(shader) || "no reason given", text)}`);
      gl.attachShader(program, shader);
      gl.deleteShader(shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(`${material.fragment} does not link: ${gl.getProgramInfoLog(program)}`);
    this.programs.set(key, program);
    return program;
  }

  setUniforms(program, uniforms) {
    const { gl } = this;
    for (const { name, type, values, hex } of uniforms) {
      const at = gl.getUniformLocation(program, name);
      if (!at) continue;  /* not read by this pass */
      gl[{ float: "uniform1fv", vec2: "uniform2fv", vec3: "uniform3fv", vec4: "uniform4fv" }[type]](at, floatsOf(values, hex));
    }
  }
  bindSamplers(program, material, emulated) {
    const { gl } = this;
    material.samplers.forEach((sampler, unit) => {
      const { target, made } = this.textures[sampler.texture];
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(target, made);
      const replaced = emulated.some((of) => of.whole && of.sampler === sampler);
      /* Texels that are fetched need a complete texture, and no filter. */
      gl.bindSampler(unit, glSampler(gl, replaced ? { ...sampler, mag: "nearest", min: "nearest", mip: "nearest" } : sampler,
                                     this.scene.textures[sampler.texture].levels.length, this.mirrorsOnce));
      const at = gl.getUniformLocation(program, sampler.uniform);
      if (at) gl.uniform1i(at, unit);
    });
  }

  setState() {
    const { gl } = this, { state } = this.scene;
    gl.disable(gl.BLEND);
    gl.disable(gl.DITHER);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl[state.depth_test.toUpperCase()]);
    gl.depthRange(...state.depth_range);
    gl.frontFace(gl[state.front_face.toUpperCase()]);
  }
  /* Renderbuffers of `count` targets, with depth. */
  targets(count) {
    const { gl } = this, [width, height] = this.scene.size, frame = gl.createFramebuffer(), places = [];
    const most = gl.getParameter(gl.MAX_RENDERBUFFER_SIZE);
    if (Math.max(width, height) > most) throw new Error(`the image has ${width} × ${height} pixels, this GPU draws ${most} a side`);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    const buffers = [];
    const add = (format, place) => {
      const buffer = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
      buffers.push(buffer);
    };
    for (let i = 0; i < count; i += 1) {
      places.push(gl.COLOR_ATTACHMENT0 + i);
      add(this.packed ? gl.RGBA8 : gl.RGBA32F, places[i]);
    }
    add(gl.DEPTH_COMPONENT32F, gl.DEPTH_ATTACHMENT);
    gl.drawBuffers(places);
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE)
      throw new Error(`this GPU has no ${count} ${this.packed ? "RGBA8" : "float"} targets of ${width} × ${height} pixels`);
    gl.viewport(0, 0, width, height);
    return { places, remove: () => { gl.deleteFramebuffer(frame); buffers.forEach((buffer) => gl.deleteRenderbuffer(buffer)); } };
  }
  /* All draws, in their order: depth may tie. `textOf` makes a material's fragment shader. */
  drawAll(textOf) {
    const { gl, scene } = this;
    gl.clearBufferfv(gl.DEPTH, 0, [scene.state.depth_clear]);
    for (const draw of scene.draws) {
      const material = scene.materials[draw.material], emulated = this.emulated[draw.material];
      const program = this.program(material, textOf(withEmulatedSamplers(scene.data[material.fragment], emulated)));
      gl.useProgram(program);
      for (const uniforms of [scene.uniforms, material.uniforms, draw.uniforms]) this.setUniforms(program, uniforms);
      this.bindSamplers(program, material, emulated);
      if (material.cull === "none") gl.disable(gl.CULL_FACE);
      else {
        gl.enable(gl.CULL_FACE);
        gl.cullFace(gl[material.cull.toUpperCase()]);
      }
      gl.drawElements(gl.TRIANGLES, draw.index_count, gl.UNSIGNED_INT, 4 * draw.first_index);
    }
    const error = gl.getError();
    if (gl.isContextLost()) throw new Error("the GPU was reset while it drew (the context is lost): it may have taken too long");
    if (error !== gl.NO_ERROR) throw new Error(`WebGL error ${error}`);
  }

  /* The four components of the targets of a pass, by their bits: [target][component], rows from the bottom of the
     framebuffer up. */
  drawPass(pass) {
    const { gl, scene } = this, { targets } = scene.passes[pass], [width, height] = scene.size, count = width * height;
    const clears = targets.map(({ clear }) => new Float32Array(clear.map((v) => (v === "inf" ? Infinity : v === "-inf" ? -Infinity : Number(v)))));
    this.setState();
    if (!this.packed) {
      const { places, remove } = this.targets(targets.length);
      clears.forEach((clear, i) => gl.clearBufferfv(gl.COLOR, i, clear));
      this.drawAll((text) => textOfPass(text, pass));
      const all = targets.map((_, i) => {
        const values = new Float32Array(4 * count), bits = new Uint32Array(values.buffer);
        gl.readBuffer(places[i]);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, values);
        const components = [0, 1, 2, 3].map(() => new Uint32Array(count));
        for (let k = 0; k < bits.length; k += 1) components[k & 3][k >> 2] = bits[k];
        return components;
      });
      remove();
      return all;
    }
    return targets.map((_, target) => {
      const { places, remove } = this.targets(4);
      const bytes = new Uint8Array(clears[target].buffer);
      for (let c = 0; c < 4; c += 1) gl.clearBufferfv(gl.COLOR, c, [...bytes.subarray(4 * c, 4 * c + 4)].map((byte) => byte / 255));
      this.drawAll((text) => withPackedTarget(textOfPass(text, pass), target, scene.pack));
      const components = places.map((place) => {
        const bits = new Uint32Array(count);
        gl.readBuffer(place);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(bits.buffer));
        return bits;
      });
      remove();
      return components;
    });
  }
  release() { this.gl.getExtension("WEBGL_lose_context")?.loseContext(); }  /* browsers hold few */
}

/* Whole numbers that a shader wrote as floats: NaN and what is below 0 become 0. */
const wholeOf = (value) => (value > 0 ? Math.min(Math.floor(value + 0.5), 0xffffffff) : 0);
const canonicalBits = (bits) => ((bits & 0x7fffffff) > 0x7f800000 ? 0x7fc00000 : bits);
/* What a pixel holds that nothing covers. */
function clearBits(clear, integer) {
  const number = clear === "inf" ? Infinity : clear === "-inf" ? -Infinity : Number(clear);
  return integer ? number : canonicalBits(new Uint32Array(new Float32Array([number]).buffer)[0]);
}
/* The channels of a scene that WebGL or WebGPU draws. `reference` has the frame. */
async function drawnSource(drawing, reference) {
  const { scene } = drawing, [width, height] = scene.size, source = new Source("This GPU", reference.frame, reference.frame);
  const clears = new Map();
  await drawing.load();
  for (const [pass, { targets }] of scene.passes.entries()) {
    const drawn = await drawing.drawPass(pass);
    targets.forEach(({ channels, clear }, target) => channels.forEach((channel, c) => {
      if (!channel || source.channels.has(channel.name)) return;
      const integer = channel.type === "uint", bits = new Uint32Array(width * height), from = drawn[target][c];
      const values = new Float32Array(from.buffer);
      for (let y = 0; y < height; y += 1) {
        const row = scene.state.first_row === "top" ? y : height - 1 - y;
        for (let x = 0, at = row * width, to = y * width; x < width; x += 1, at += 1, to += 1)
          bits[to] = integer ? wholeOf(values[at]) : canonicalBits(from[at]);
      }
      clears.set(channel.name, clearBits(clear[c], integer));
      source.channels.set(channel.name, channelOf(channel.name, integer ? "uint32" : "float32", integer ? "uint32" : "float32", bits));
    }));
  }
  /* Drivers need not clear to what is not finite, nor are all whole numbers floats. */
  const coverage = source.channels.get("A")?.values;
  if (coverage)
    for (const [name, { bits }] of source.channels)
      if (name !== "A") for (let i = 0; i < bits.length; i += 1) if (!(coverage[i] > 0)) bits[i] = clears.get(name);
  source.attributes = drawing.attributes;
  return source;
}
