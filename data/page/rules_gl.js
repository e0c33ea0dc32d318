/* Questions of the probes (src/rules) put to this GPU by WebGL 2. Numbers go in and come out as their bits, as in
   src/tools/gl/probe/ask_gl.cpp. */

class Asking {
  /* `described`: what src/rules/page.hpp writes; `lists`: its numbers, unpacked. */
  constructor(described, lists) {
    const gl = html("canvas", { width: 1, height: 1 }).getContext("webgl2", { antialias: false, depth: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("this browser has no WebGL 2");
    this.gl = gl;
    this.vertex = described.vertex;
    this.lists = lists;
    this.norm16 = gl.getExtension("EXT_texture_norm16");
    this.filtersFloats = Boolean(gl.getExtension("OES_texture_float_linear"));
  }
  release() { this.gl.getExtension("WEBGL_lose_context")?.loseContext(); }

  /* Why this browser cannot be asked; "" where it can. */
  missing({ maps }) {
    for (const { format, sampler } of maps) {
      if (format === "unorm16" && !this.norm16) return "no textures of 16 bits here (EXT_texture_norm16)";
      if (format === "float32" && [sampler.mag, sampler.min, sampler.mip].includes("linear") && !this.filtersFloats)
        return "no filtering of floats here (OES_texture_float_linear)";
    }
    return "";
  }

  /* Lists of numbers as one, whose records have a number of each. */
  records(numbers) {
    const lists = numbers.map((number) => this.lists[number]), all = new Uint32Array(lists[0].length * lists.length);
    lists.forEach((list, part) => list.forEach((bits, i) => { all[i * lists.length + part] = bits; }));
    return all;
  }
  program(fragment) {
    const { gl } = this, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, this.vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(explainedMessage(gl.getShaderInfoLog(shader) || "does not compile", text));
      gl.attachShader(program, shader);
      gl.deleteShader(shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
  }
  /* Internal format, type, and what a float is in that type. WebGL converts nothing. */
  format({ format, channels }) {
    const { gl, norm16 } = this, one = channels === 1;
    const codes = (array, most) => (floats) => array.from(floats, (v) => Math.round(v * most));
    switch (format) {
      case "unorm8": return [one ? gl.R8 : gl.RGBA8, gl.UNSIGNED_BYTE, codes(Uint8Array, 255)];
      case "srgb8": return [gl.SRGB8_ALPHA8, gl.UNSIGNED_BYTE, codes(Uint8Array, 255)];  /* 0 and 1 alone */
      case "unorm16": return [one ? norm16.R16_EXT : norm16.RGBA16_EXT, gl.UNSIGNED_SHORT, codes(Uint16Array, 65535)];
      case "half": return [one ? gl.R16F : gl.RGBA16F, gl.FLOAT, (floats) => floats];
      default: return [one ? gl.R32F : gl.RGBA32F, gl.FLOAT, (floats) => floats];
    }
  }
  bindMap(map, unit, objects) {
    const { gl } = this, target = map.cube ? gl.TEXTURE_CUBE_MAP : gl.TEXTURE_2D, faces = map.cube ? 6 : 1;
    const [internal, type, convert] = this.format(map), components = map.channels === 1 ? gl.RED : gl.RGBA;
    const texture = gl.createTexture(), sampler = glSampler(gl, map.sampler, map.levels.length);
    objects.push(() => gl.deleteTexture(texture), () => gl.deleteSampler(sampler));
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(target, texture);
    gl.bindSampler(unit, sampler);
    map.levels.forEach((number, level) => {
      const width = Math.max(1, map.size[0] >> level), height = Math.max(1, map.size[1] >> level);
      const texels = convert(new Float32Array(this.lists[number].slice().buffer)), each = texels.length / faces;
      for (let face = 0; face < faces; face += 1)
        gl.texImage2D(map.cube ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + face : target, level, internal, width, height, 0, components, type,
                      texels.subarray(face * each, (face + 1) * each));
    });
    gl.texParameteri(target, gl.TEXTURE_MAX_LEVEL, map.levels.length - 1);
  }
  bindNumbers(asked, width, height, unit, objects) {
    const { gl } = this, texture = gl.createTexture();
    objects.push(() => gl.deleteTexture(texture));
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.bindSampler(unit, null);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32UI, width, height, 0, gl.RGBA_INTEGER, gl.UNSIGNED_INT, this.records(asked));
  }
  bindTriangles(program, triangles, objects) {
    const { gl } = this, array = gl.createVertexArray(), buffer = gl.createBuffer();
    objects.push(() => gl.deleteVertexArray(array), () => gl.deleteBuffer(buffer));
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, this.records(triangles), gl.STATIC_DRAW);
    for (const [name, offset] of [["position", 0], ["corner", 16]]) {
      const location = gl.getAttribLocation(program, name);
      if (location < 0) continue;
      gl.vertexAttribPointer(location, 4, gl.FLOAT, false, 32, offset);
      gl.enableVertexAttribArray(location);
    }
  }
  bindTarget(width, height, objects) {
    const { gl } = this, buffer = gl.createRenderbuffer(), frame = gl.createFramebuffer();
    objects.push(() => gl.deleteRenderbuffer(buffer), () => gl.deleteFramebuffer(frame));
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA32UI, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, buffer);
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) throw new Error("no targets of four integers");
    gl.viewport(0, 0, width, height);
  }

  /* Four floats per pixel, row 0 (the lowest) first; of a question `apart` a picture of each triangle alone. */
  answers({ size: [width, height], fragment, apart, maps, asked, triangles }) {
    const { gl } = this, objects = [], program = this.program(fragment), corners = this.lists[triangles[0]].length, each = apart ? 3 : corners;
    objects.push(() => gl.deleteProgram(program));
    gl.useProgram(program);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    maps.forEach((map, unit) => {
      gl.uniform1i(gl.getUniformLocation(program, `map${unit}`), unit);
      this.bindMap(map, unit, objects);
    });
    const at = gl.getUniformLocation(program, "numbers");
    if (at) gl.uniform1i(at, maps.length);
    this.bindNumbers(asked, width, height, maps.length, objects);
    this.bindTriangles(program, triangles, objects);
    this.bindTarget(width, height, objects);
    const frame = 4 * width * height, all = new Uint32Array(frame * corners / each);
    for (let first = 0, to = 0; first < corners; first += each, to += frame) {
      gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
      gl.drawArrays(gl.TRIANGLES, first, each);
      gl.readPixels(0, 0, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, all.subarray(to, to + frame));
    }
    const error = gl.getError();
    for (const remove of objects) remove();
    if (gl.isContextLost()) throw new Error("the GPU was reset (the context is lost)");
    if (error !== gl.NO_ERROR) throw new Error(`WebGL error ${error}`);
    return new Float32Array(all.buffer);
  }
}
