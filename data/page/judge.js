/* The judge's page: the second source is what this GPU draws of the scene. */

const judgedScene = JSON.parse(byId("sources-data").textContent).scene;
const wishes = { by: "webgl", targets: "float", samplers: "own" };
const wishLabels = { by: [["webgl", "WebGL 2"], ["webgpu", "WebGPU"]],
                     targets: [["float", "Float"], ["packed", "Bytes (RGBA8)"]], samplers: [["own", "The GPU's"], ["emulated", "In the shader"]] };
/* The scene in WGSL has its own shaders, and of the rest what is other than in GLSL ES. */
const drawingOf = () => (wishes.by === "webgpu" ?
  new WebGpuDrawing({ ...judgedScene, ...judgedScene.webgpu, data: { ...judgedScene.data, ...judgedScene.webgpu.data } }) :
  new Drawing(judgedScene, wishes));

/* Ranges stand beside the values that they are of. */
saidOtherwise = (name) => name.startsWith("gpu.");

/* Pixels that one side alone covers, by whether the reference's coverage ends beside them: snapped elsewhere, an edge
   may pass another pixel's centre, but none that lies farther away. */
function coverageOf(reference, drawn) {
  const [x, y] = [reference, drawn].map((source) => source.channels.get("A")?.values), apart = [], far = [];
  if (!x || !y) return { apart, far };
  const { width, height } = reference, covers = (values, i) => values[i] > 0;
  const endsBeside = (i) => {
    const column = i % width, row = Math.floor(i / width);
    for (let v = Math.max(row - 1, 0); v <= Math.min(row + 1, height - 1); v += 1)
      for (let u = Math.max(column - 1, 0); u <= Math.min(column + 1, width - 1); u += 1)
        if (covers(x, v * width + u) !== covers(x, i)) return true;
    return false;
  };
  for (let i = 0; i < x.length; i += 1)
    if (covers(x, i) !== covers(y, i)) (endsBeside(i) ? apart : far).push(i);
  return { apart, far };
}
/* Where one side has no fragment, no range holds: there is nothing to judge but coverage. */
const embeddedPaths = new Map();
function judgeCoveredAlone(reference, { apart, far }) {
  for (const [name, channel] of reference.channels) {
    if (!name.startsWith("gpu.paths.")) continue;
    if (!embeddedPaths.has(name)) embeddedPaths.set(name, channel.bits);
    const bits = embeddedPaths.get(name).slice();
    for (const i of [...apart, ...far]) bits[i] = notJudged;
    reference.channels.set(name, channelOf(name, channel.type, channel.stored, bits));
  }
}

/* Pixels by their worst class over all channels, and by channel; `farthest` as worstOutside has it. */
function verdictOf(reference, drawn) {
  const { apart, far } = coverageOf(reference, drawn);
  judgeCoveredAlone(reference, { apart, far });
  const judged = judgedChannels(reference, drawn), pixels = reference.width * reference.height, worst = new Uint8Array(pixels);
  const rows = judged.map((of) => {
    const counts = classNames.map(() => 0), own = reference.channels.get(of.name);
    let equal = 0;
    for (let i = 0; i < pixels; i += 1) {
      const found = classOf(of.ranges, of.extent, of.value.values[i], i);
      counts[found] += 1;
      worst[i] = Math.max(worst[i], found);
      if (!isUnequal(own, of.value, i)) equal += 1;
    }
    /* The hashes tell whether the page has what it was given. */
    return { name: of.name, ends: [of.ranges.low, of.ranges.high].map(({ bits }) => hexOf(hashOf(bits))), counts, equal, farthest: counts[3] ? worstOutside([of], 1)[0].most : 0 };
  });
  for (const i of far) worst[i] = 3;
  const counts = classNames.map(() => 0);
  for (const found of worst) counts[found] += 1;
  const unranged = [...drawn.channels.keys()].filter((name) => reference.channels.has(name) && !rangesOf(reference, name)).map((name) => {
    const { unequal } = comparisonOf(reference.channels.get(name), drawn.channels.get(name));
    return { name, unequal, equal: pixels - unequal };
  });
  return { rows, counts, pixels, unranged, edges: apart.length, uncovered: far.length,
           first: far.length ? "A" : rows.find((row) => row.counts[3] > 0)?.name };
}

// `snapsCoarser`: the GPU places corners by fewer bits than the ranges take for granted, as it may.
function verdictLine({ rows, counts, pixels, unranged, first }, snapsCoarser) {
  const apart = unranged.filter(({ unequal }) => unequal).length;
  if (!rows.length) return `Not judged: no ranges are embedded. ${apart ? `${apart} of ${counted(unranged.length, "channel")} ${apart === 1 ? "differs" : "differ"}.` : "All channels are equal, bit for bit."}`;
  const judged = pixels - counts[4];
  if (!judged) return "No pixel is judged.";
  const line = counts[3] ? `${counted(counts[3], "pixel")} of ${judged} ${counts[3] === 1 ? "leaves its" : "leave their"} legal range, first in ${first}${snapsCoarser ? ": perhaps as this GPU snaps corners coarser than the ranges know, which it may (below)" : ""}.` :
    `None of ${counted(judged, "judged pixel")} leaves its legal range${counts[4] ? `; ${counts[4]} are not judged` : ""}.`;
  const most = codesApart(unranged)[0];
  return line + (counts[2] ? ` In ${counts[2]} some channel is unconstrained, so that nearly any value would do.` : "") +
    (most ? ` Codes, which have no ranges, differ: ${most.name} in ${counted(most.unequal, "pixel")}.` : "");
}
/* Codes, as how a search ended, that differ: the one in most pixels first. */
const codesApart = (unranged) => unranged.filter(({ name, unequal }) => unequal && isCode(name)).sort((a, b) => b.unequal - a.unequal);
function channelButton(name) {
  return html("button", { type: "button", onclick: () => { byId("channel").value = name; takeControls(); byId("stage").scrollIntoView({ block: "nearest" }); } }, name);
}
function verdictTable({ rows, counts, pixels, unranged }) {
  const number = (n, bad) => html("td", { className: bad && n ? "unequal" : n ? "" : "equal" }, String(n));
  const shown = counts[4] ? classNames : classNames.slice(0, 4), last = shown.length;
  const head = html("tr", {}, ...["Channel", "equal bits", ...shown, "farthest outside"].map((text, k) =>
    html("th", { scope: "col" }, ...(k > 1 && k < last + 2 ? [html("i", { className: "box", style: `background:rgb(${classColours[k - 2]})` }), " "] : []), text)));
  const body = rows.map((row) => html("tr", {}, html("th", { scope: "row" }, channelButton(row.name)), number(row.equal),
    ...row.counts.slice(0, last).map((n, k) => number(n, k === 3)), html("td", { className: row.counts[3] ? "unequal" : "equal" }, row.counts[3] ? short(row.farthest) : "–")));
  for (const { name, equal, unequal } of unranged)
    body.push(html("tr", {}, html("th", { scope: "row" }, channelButton(name)), number(equal),
      html("td", { colSpan: last + 1, className: unequal ? "word unequal" : "word equal" }, unequal ? `no range; ${unequal} of ${pixels} differ` : "no range")));
  if (rows.length)
    body.unshift(html("tr", { className: "all" }, html("th", { scope: "row" }, "pixels by their worst"), html("td", {}, ""), ...counts.slice(0, last).map((n, k) => number(n, k === 3)), html("td", {}, "")));
  return html("div", { className: "scroll tall" }, html("table", {}, html("thead", {}, head), html("tbody", {}, ...body)));
}
const endings = { one: "st", two: "nd", few: "rd", other: "th" }, ordinals = new Intl.PluralRules("en", { type: "ordinal" });
const ordinal = (n) => n === 2 ? "second" : n === 3 ? "third" : n + endings[ordinals.select(n)];
function notesOf(drawing, verdict) {
  const { limits, refusal, every, lacking } = judgedScene, notes = drawing ? [...new Set(drawing.notes)] : [];
  if (verdict?.edges) notes.push(`${counted(verdict.edges, "pixel")} at edges ${verdict.edges === 1 ? "is" : "are"} covered on one side alone, which snapping permits; nothing else is judged there.`);
  if (verdict?.uncovered) notes.push(`${counted(verdict.uncovered, "pixel")} away from all edges ${verdict.uncovered === 1 ? "is" : "are"} covered on one side alone.`);
  if (limits && verdict?.counts[3] && wishes.by === "webgpu" && !limits.includes("snapping="))
    notes.push(`WebGPU does not tell how finely a GPU snaps corners, and ranges take 8 bits below a pixel for granted. Vulkan asks for 4: where pixels fail all over, in uv first, export with --limits ${limits},snapping=0.0625.`);
  if (limits) notes.push(`Ranges are what --limits ${limits} permits, rounded outwards by at most an eighth of their distance from the reference.`);
  if (every > 1) notes.push(`Every ${ordinal(every)} row of quads is judged, the others are compared and no more.`);
  if (lacking.length) notes.push(`Not judged: ${lacking.join(", ")}, for which neither GLSL ES 3.0 nor WGSL has a word.`);
  if (refusal) notes.push(`Some channels have no range: ${refusal}.`);
  return notes;
}
function judgeControls() {
  const shown = Object.entries(wishLabels).filter(([key]) => key === "by" || wishes.by === "webgl");
  return shown.map(([key, all]) => html("label", {}, { by: "Drawn by ", targets: "Targets ", samplers: "Samplers " }[key],
    html("select", { id: `wish-${key}`, onchange: (event) => { wishes[key] = event.target.value; drawAgain(); } },
      ...all.map(([value, text]) => html("option", { value, selected: wishes[key] === value }, text)))));
}
/* The section says what `lines` are, a title first. */
function showJudge(title, kind, ...parts) {
  let section = byId("judge");
  if (!section) {
    section = html("section", { id: "judge" });
    section.setAttribute("aria-live", "polite");
    document.querySelector("header").append(section);
  }
  section.replaceChildren(html("p", { id: "verdict", className: kind }, title), ...parts);
}
const listOf = (lines) => (lines.length ? [html("ul", { className: "lead notes" }, ...lines.map((line) => html("li", {}, line)))] : []);

/* What is drawn becomes the second source; where nothing can be, the reference stays alone. */
async function drawAndJudge() {
  const reference = sources[0];
  sources.length = 1;
  for (const [key, all] of Object.entries(wishLabels)) {
    const [usual] = all[0];
    if (wishes[key] === usual) delete state.more[key];
    else state.more[key] = wishes[key];
  }
  showJudge("Drawing…", "");
  await new Promise((done) => setTimeout(done, 0));  /* so that this is seen */
  let drawing = null;
  try {
    const begun = performance.now();
    drawing = drawingOf();
    const passes = drawing.scene.passes.length, drawn = await drawnSource(drawing, reference), took = performance.now() - begun;
    sources.push(drawn);
    const verdict = verdictOf(reference, drawn);
    document.body.dataset.verdict = JSON.stringify({ ...verdict, renderer: drawing.renderer });
    showJudge(verdictLine(verdict, drawing.snapsCoarser), verdict.counts[3] ? "bad" : verdict.counts[2] || codesApart(verdict.unranged).length ? "" : "good",
      html("p", { className: "lead" }, `${drawing.renderer}; ${passes === 1 ? "one pass" : `${passes} passes`}${took < 1 ? "" : `, drawn and read in ${took < 1000 ? `${Math.round(took)} ms` : `${(took / 1000).toFixed(1)} s`}`}.`),
      verdictTable(verdict), ...listOf(notesOf(drawing, verdict)), html("div", { className: "row wishes" }, ...judgeControls()));
  } catch (error) {
    document.body.dataset.verdict = JSON.stringify({ error: error.message });
    showJudge(`Not judged: ${error.message}.`, "bad", html("p", { className: "lead" }, "The reference alone is shown."),
      ...listOf(notesOf(drawing)), html("div", { className: "row wishes" }, ...judgeControls()));
  } finally {
    drawing?.release();
  }
}
async function drawAgain() {
  remember();
  await drawAndJudge();
  showSources();
}

afterReading.push(async () => {
  const asked = new URLSearchParams(location.hash.slice(1));
  for (const [key, all] of Object.entries(wishLabels)) if (all.some(([value]) => value === asked.get(key))) wishes[key] = asked.get(key);
  await drawAndJudge();
});
