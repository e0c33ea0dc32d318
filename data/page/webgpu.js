/* An exported scene in WGSL, drawn by WebGPU as webgl.js draws it in GLSL ES by WebGL 2. Rows of what is drawn are
   those of WebGL's framebuffer: where the scene's clip space has y or z otherwise than WebGPU, the vertex shader turns
   it, so that both judge one scene. */

/* A vertex shader that gives WebGPU's clip space. */
function withClipSpace(text, { clip_origin, clip_depth }) {
  let turned = "";
  if (clip_origin === "lower-left") turned += "    varyings.window.y = -varyings.window.y;\n";
  if (clip_depth === "negative-one-to-one") turned += "    varyings.window.z = 0.5 * (varyings.window.z + varyings.window.w);\n";
  return text.replace("    return varyings;\n", `${turned}    return varyings;\n`);
}

class WebGpuDrawing {
  /* As Drawing, of a scene whose manifest is in WGSL. Throws where nothing can be drawn. */
  constructor(scene) {
    if (scene.refusal) throw new Error(`WebGPU has not what the scene needs (${scene.refusal})`);
    if (!navigator.gpu) throw new Error("this browser has no WebGPU, or not for this page");
    this.scene = scene;
    this.notes = [];
    this.snapsCoarser = false;  /* it does not tell how finely it snaps */
    const { limits } = scene;
    if (limits && !limits.startsWith("webgpu"))
      this.notes.push(`The ranges are those of --limits ${limits}, not WebGPU's own, which permits more in places: export with --limits webgpu.`);
  }

  get renderer() {
    const { vendor, architecture, device, description } = this.adapter.info;
    return `WebGPU on ${[vendor, architecture, device, description].filter(Boolean).join(" ") || "a GPU without a name"}`;
  }
  get attributes() {
    return { "WebGPU adapter": this.renderer, "features": [...this.device.features].join(" ") || "none", "browser": navigator.userAgent };
  }

  /* What the GPU says of `work`'s validity, which it says elsewhere than it is done. */
  async checked(what, work) {
    const { device } = this, kinds = ["out-of-memory", "internal", "validation"];
    for (const kind of kinds) device.pushErrorScope(kind);
    const made = await work();
    for (const _ of kinds) {
      const error = await device.popErrorScope();
      if (error) throw new Error(`${what}: ${error.message.split("\n")[0]}`);
    }
    if (this.lost) throw new Error(`the GPU was lost while it drew (${this.lost}): it may have taken too long`);
    return made;
  }

  async load() {
    const { scene } = this;
    this.adapter = await navigator.gpu.requestAdapter({ powerPreference: "high-performance" });
    if (!this.adapter) throw new Error("this browser finds no adapter for WebGPU");
    const { limits } = this.adapter, most = limits.maxTextureDimension2D;
    this.device = await this.adapter.requestDevice({
      requiredFeatures: ["float32-filterable"].filter((feature) => this.adapter.features.has(feature)),
      requiredLimits: { maxTextureDimension2D: most, maxBufferSize: limits.maxBufferSize },
    });
    this.device.lost.then(({ message }) => { this.lost = message || "no reason given"; });
    if (Math.max(...scene.size) > most) throw new Error(`the image has ${scene.size[0]} × ${scene.size[1]} pixels, this GPU draws ${most} a side`);
    await this.checked("textures and buffers", async () => {
      this.vertices = this.buffer(await unpackedFile(scene.data["vertices.bin"]), GPUBufferUsage.VERTEX);
      this.indices = this.buffer(await unpackedFile(scene.data["indices.bin"]), GPUBufferUsage.INDEX);
      this.textures = [];
      for (const texture of scene.textures) this.textures.push(await this.loadTexture(texture, most));
    });
    this.materials = [];
    for (const material of scene.materials) this.materials.push(await this.loadMaterial(material));
  }
  buffer(data, usage) {
    const made = this.device.createBuffer({ size: Math.max(4 * Math.ceil(data.byteLength / 4), 4), usage: usage | GPUBufferUsage.COPY_DST });
    this.device.queue.writeBuffer(made, 0, data);
    return made;
  }
  async loadTexture(texture, most) {
    const { levels: [first], kind } = texture, layers = { "2d": 1, cube: 6, "2d-array": texture.layers }[kind];
    if (Math.max(first.width, first.height) > most) throw new Error(`${texture.name} has ${first.width} × ${first.height} texels, this GPU takes ${most} a side`);
    const made = this.device.createTexture({
      size: [first.width, first.height, layers], format: texture.webgpu, mipLevelCount: texture.levels.length,
      usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
    });
    for (const [mipLevel, level] of texture.levels.entries()) {
      const texels = await unpackedFile(this.scene.data[level.bytes]);
      this.device.queue.writeTexture({ texture: made, mipLevel }, texels,
        { bytesPerRow: texels.byteLength / layers / level.height, rowsPerImage: level.height }, [level.width, level.height, layers]);
    }
    return made;
  }

  /* Shaders, and how what they read is bound: { layout, group, vertex, fragment }. */
  async loadMaterial(material) {
    const { device, scene } = this, { uniform_buffer, bindings } = material.webgpu;
    const entries = [], bound = [];
    if (uniform_buffer.size)
      entries.push({ binding: uniform_buffer.binding, visibility: GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT, buffer: {} });
    material.samplers.forEach((sampler, i) => {
      const { texture, sampler: at } = bindings[i], of = scene.textures[sampler.texture];
      if (texture < 0) return;
      const filters = at !== null && [sampler.mag, sampler.min, sampler.mip].includes("linear");
      const holdsFloats = of.webgpu.endsWith("32float");
      if (filters && holdsFloats && !device.features.has("float32-filterable"))
        throw new Error(`${sampler.uniform}: WebGPU filters no floats here (float32-filterable)`);
      const viewDimension = of.kind;
      entries.push({ binding: texture, visibility: GPUShaderStage.FRAGMENT,
                     texture: { sampleType: holdsFloats && !filters ? "unfilterable-float" : "float", viewDimension } });
      /* Without mip levels of its own a look-up is of the first one. */
      const levels = at !== null && sampler.mip === "none" ? { mipLevelCount: 1 } : {};
      bound.push({ binding: texture, resource: this.textures[sampler.texture].createView({ dimension: viewDimension, ...levels }) });
      if (at === null) return;
      entries.push({ binding: at, visibility: GPUShaderStage.FRAGMENT, sampler: { type: filters ? "filtering" : "non-filtering" } });
      bound.push({ binding: at, resource: this.sampler(sampler) });
    });
    const layout = device.createBindGroupLayout({ entries });
    const shader = async (file, text) => {
      const module = device.createShaderModule({ code: text });
      const [error] = (await module.getCompilationInfo()).messages.filter(({ type }) => type === "error");
      if (error) throw new Error(`${file} does not compile: ${error.message.trim()} (line ${error.lineNum}: ${(text.split("\n")[error.lineNum - 1] ?? "").trim()})`);
      return module;
    };
    return { material, layout, bound, vertex: await shader(material.vertex, withClipSpace(scene.data[material.vertex], scene.state)),
             fragment: await shader(material.fragment, scene.data[material.fragment]) };
  }
  sampler(sampler) {
    const modes = { repeat: "repeat", "mirrored-repeat": "mirror-repeat", "clamp-to-edge": "clamp-to-edge" };
    const least = Math.max(Number(sampler.lod_min), 0);
    return this.device.createSampler({
      addressModeU: modes[sampler.wrap[0]], addressModeV: modes[sampler.wrap[1]],
      magFilter: sampler.mag, minFilter: sampler.min, mipmapFilter: sampler.mip === "linear" ? "linear" : "nearest",
      lodMinClamp: least, lodMaxClamp: Math.max(Number(sampler.lod_max), least),
    });
  }
  uniforms(material, draw) {
    const { uniform_buffer: { size, offsets } } = material.webgpu, numbers = new Float32Array(size / 4);
    for (const { name, values, hex } of [...this.scene.uniforms, ...material.uniforms, ...draw.uniforms])
      if (name in offsets) numbers.set(floatsOf(values, hex), offsets[name] / 4);
    return this.buffer(numbers, GPUBufferUsage.UNIFORM);
  }
  async pipeline({ material, layout, vertex, fragment }, pass) {
    const { device, scene } = this, { attributes, stride } = scene.vertex_buffer, { state } = scene;
    const turned = state.clip_origin === "lower-left", counterClockwise = (state.front_face === "ccw") !== turned;
    return device.createRenderPipelineAsync({
      layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
      vertex: { module: vertex, entryPoint: material.webgpu.vertex_entry, buffers: [{ arrayStride: stride,
        attributes: attributes.map(({ location, components, offset }) => ({ shaderLocation: location, offset, format: components > 1 ? `float32x${components}` : "float32" })) }] },
      primitive: { topology: "triangle-list", frontFace: counterClockwise ? "ccw" : "cw", cullMode: material.cull },
      depthStencil: { format: "depth32float", depthWriteEnabled: true, depthCompare: state.depth_test },
      fragment: { module: fragment, entryPoint: material.webgpu.fragment_entries[pass], targets: scene.passes[pass].targets.map(() => ({ format: "rgba32float" })) },
    }).catch((error) => { throw new Error(`${material.fragment}: ${error.message.split("\n")[0]}`); });
  }

  /* As Drawing's. */
  async drawPass(pass) {
    const pipelines = [];
    for (const of of this.materials) pipelines.push(await this.pipeline(of, pass));
    return this.checked("drawing", () => this.drawBy(pipelines, pass));
  }
  async drawBy(pipelines, pass) {
    const { device, scene } = this, { targets } = scene.passes[pass], [width, height] = scene.size;
    const texture = (format, usage) => device.createTexture({ size: [width, height], format, usage: GPUTextureUsage.RENDER_ATTACHMENT | usage });
    const pictures = targets.map(() => texture("rgba32float", GPUTextureUsage.COPY_SRC)), depth = texture("depth32float", 0);
    const encoder = device.createCommandEncoder();
    /* What is not finite cannot be cleared to; drawnSource sees to what nothing covers. */
    const drawing = encoder.beginRenderPass({
      colorAttachments: pictures.map((picture, i) => ({ view: picture.createView(), loadOp: "clear", storeOp: "store",
                                                        clearValue: targets[i].clear.map((v) => (Number.isFinite(v) ? v : 0)) })),
      depthStencilAttachment: { view: depth.createView(), depthLoadOp: "clear", depthStoreOp: "discard", depthClearValue: scene.state.depth_clear },
    });
    drawing.setViewport(0, 0, width, height, ...scene.state.depth_range);
    drawing.setVertexBuffer(0, this.vertices);
    drawing.setIndexBuffer(this.indices, "uint32");
    const numbers = [];
    for (const draw of scene.draws) {
      const { material, layout, bound } = this.materials[draw.material], entries = [...bound];
      if (material.webgpu.uniform_buffer.size) {
        numbers.push(this.uniforms(material, draw));
        entries.push({ binding: material.webgpu.uniform_buffer.binding, resource: { buffer: numbers.at(-1) } });
      }
      drawing.setPipeline(pipelines[draw.material]);
      drawing.setBindGroup(0, device.createBindGroup({ layout, entries }));
      drawing.drawIndexed(draw.index_count, 1, draw.first_index);
    }
    drawing.end();
    const rowBytes = 256 * Math.ceil(16 * width / 256);
    const copies = pictures.map((picture) => {
      const copy = device.createBuffer({ size: rowBytes * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
      encoder.copyTextureToBuffer({ texture: picture }, { buffer: copy, bytesPerRow: rowBytes }, [width, height]);
      return copy;
    });
    device.queue.submit([encoder.finish()]);
    const all = [];
    for (const copy of copies) {
      await copy.mapAsync(GPUMapMode.READ);
      const bits = new Uint32Array(copy.getMappedRange()), components = [0, 1, 2, 3].map(() => new Uint32Array(width * height));
      for (let y = 0, to = 0; y < height; y += 1)
        for (let x = 0, from = y * rowBytes / 4; x < width; x += 1, to += 1, from += 4)
          for (let c = 0; c < 4; c += 1) components[c][to] = bits[from + c];
      all.push(components);
    }
    for (const made of [...pictures, depth, ...copies, ...numbers]) made.destroy();
    return all;
  }
  release() { this.device?.destroy(); }
}
