/* A tab of the judge's page: what this GPU does where it may choose, beside Quadrel's presets of `hardware`. */

const isSameAnswer = (x, y, tolerance) => (Number.isNaN(x) || Number.isNaN(y) ? Number.isNaN(x) && Number.isNaN(y) :
  Object.is(x, y) || (tolerance > 0 && Math.abs(x - y) <= tolerance));
function differingAnswers(a, b, tolerance) {
  if (a.length !== b.length) return Math.max(a.length, b.length);
  let count = 0;
  for (let i = 0; i < a.length; i += 1) count += !isSameAnswer(a[i], b[i], tolerance);
  return count;
}
/* One probe: what this GPU is seen to do, or why it could not be asked, and each preset beside it. */
function askedProbe(asking, presets, probe) {
  const { id, question, tolerance } = probe, floats = (bits) => new Float32Array(bits.buffer);
  const bits = probe.answers.map((numbers) => asking.records(numbers));
  const own = bits.map((of, k) => floats(k ? of.map((word, i) => word ^ bits[0][i]) : of)), about = { asked: floats(asking.records(question.asked)), exact: own[presets.indexOf("exact")] };
  const { words, permits } = ruleWords[id], result = { id, missing: probe.missing || asking.missing(question) };
  let seen = null;
  if (!result.missing)
    try {
      seen = asking.answers(question);
      result.seen = words(seen, about);
      if (permits) result.permitted = permits(seen, about);
    } catch (error) {
      result.missing = error.message;
    }
  result.presets = own.map((values) => ({ does: words(values, about), ...(permits ? { permitted: permits(values, about) } : {}),
                                          ...(seen ? { differing: differingAnswers(seen, values, tolerance), answers: seen.length } : {}) }));
  return result;
}
async function askRules(described) {
  const all = await unpackedBits(described.numbers, described.lengths.reduce((sum, length) => sum + length, 0));
  let from = 0;
  const lists = described.lengths.map((length) => all.subarray(from, from += length));
  const asking = new Asking(described, lists), results = [];
  try {
    for (const probe of described.probes) {
      results.push(askedProbe(asking, described.presets, probe));
      await new Promise((done) => setTimeout(done, 0));  /* so that the page lives */
    }
  } finally {
    asking.release();
  }
  return results;
}

/* "=" where a preset does the same, else what it does; where that reads the same, how many answers differ. */
function presetCell(result, preset) {
  if (preset.differing === 0) return html("td", { className: "word equal" }, "=");
  return html("td", { className: "word" }, preset.does === result.seen ? `${preset.differing} of ${preset.answers} differ` : preset.does);
}
function seenCell(result, { missing }) {
  if (result.missing) return html("td", { className: "word equal" }, `not asked: ${missing || result.missing}`);
  if (result.permitted === false) return html("td", { className: "word unequal" }, `${result.seen}: not permitted`);
  return html("td", { className: "word" }, result.seen);
}
function rulesTable({ presets, probes }, results) {
  const head = html("tr", {}, ...["Probe", "This GPU", ...presets].map((text, k) => html("th", { scope: "col", className: k ? "word" : "" }, text)));
  const texts = probes.map((probe) => probeTexts(probe, wishes.by));
  const rows = results.map((result, i) => html("tr", {},
    html("th", { scope: "row", title: `Permitted: ${texts[i].permits}` }, result.id, probes[i].not_modelled ? " *" : "", html("small", {}, texts[i].asks)),
    seenCell(result, texts[i]), ...result.presets.map((preset) => presetCell(result, preset))));
  return html("div", { className: "scroll" }, html("table", {}, html("thead", {}, head), html("tbody", {}, ...rows)));
}
function agreements(presets, results) {
  const asked = results.filter(({ missing }) => !missing);
  return presets.map((name, k) => ({ name, agreed: asked.filter(({ presets: all }) => all[k].differing === 0).length, of: asked.length }));
}
function showRules(described, results) {
  const counts = agreements(described.presets, results), closest = counts.reduce((x, y) => (y.agreed > x.agreed ? y : x));
  const wrong = results.filter(({ permitted }) => permitted === false).map(({ id }) => id);
  const byWebGpu = wishes.by === "webgpu";
  const left = described.probes.filter(({ not_modelled }) => not_modelled);
  byId("rules").replaceChildren(
    html("p", { id: "rules-verdict", className: wrong.length ? "bad" : "good" }, wrong.length ? `Not permitted${byWebGpu ? " by OpenGL" : ""}: ${wrong.join(", ")}.` : `All that is seen is permitted${byWebGpu ? " by OpenGL" : ""}.`),
    ...(byWebGpu ? [html("p", { className: "lead" }, "The scene is drawn by WebGPU, the probes are asked by WebGL 2 on the same GPU, perhaps by another driver: what is seen need not hold there.")] : []),
    html("p", { className: "lead" }, `Small shaders make visible what a GPU does where it may choose; Quadrel's own code runs on the same numbers, once for each preset of hardware. = : the same answers. ` +
      `Closest is ${closest.name}: ${counts.map(({ name, agreed, of }) => `${name} ${agreed} of ${of}`).join(", ")}.`),
    rulesTable(described, results),
    ...listOf(left.map(({ id, not_modelled }) => `* ${id}: ${not_modelled}.`)));
}

/* The tabs. Probes are asked when theirs is first opened. */
let rulesAsked = null, rulesAnswers = null;
async function openTab(name) {
  const isRules = name === "rules";
  for (const tab of document.querySelectorAll("#tabs button")) tab.ariaSelected = String(tab.value === name);
  byId("rules").hidden = !isRules;
  for (const part of [byId("summary"), byId("judge"), byId("controls"), document.querySelector("main")]) if (part) part.hidden = isRules;
  if (isRules) state.more.tab = name;
  else delete state.more.tab;
  if (state.choice) remember();
  if (!isRules) sizePanels();
  if (isRules && rulesAnswers) showRules(...rulesAnswers);  /* the scene may be drawn by another interface now */
  if (!isRules || rulesAsked) return rulesAsked;
  byId("rules").replaceChildren(html("p", { className: "lead" }, "Asking…"));
  const ask = async () => {
    const described = JSON.parse(await unpackedText(judgedScene.rules)), results = await askRules(described);
    document.body.dataset.rules = JSON.stringify(results);
    rulesAnswers = [described, results];
    showRules(described, results);
  };
  rulesAsked = ask().catch((error) => {
    document.body.dataset.rules = JSON.stringify({ error: error.message });
    byId("rules").replaceChildren(html("p", { className: "lead unequal" }, `The probes could not be asked: ${error.message}.`));
  });
  return rulesAsked;
}
function makeTabs() {
  const tab = (value, text) => html("button", { type: "button", role: "tab", value, onclick: () => openTab(value) }, text);
  const bar = html("div", { id: "tabs", role: "tablist" }, tab("scene", "The scene"), tab("rules", "This GPU's rules"));
  document.querySelector("h1").after(bar);
  document.querySelector("header").after(html("section", { id: "rules", hidden: true }));
}
afterReading.push(async () => {
  makeTabs();
  await openTab(new URLSearchParams(location.hash.slice(1)).get("tab") === "rules" ? "rules" : "scene");
});
