const results = JSON.parse(document.getElementById("results-data").textContent);
const pictures = JSON.parse(document.getElementById("pictures-data").textContent);

/* Runs */

const percent = (share) => typeof share === "number" ? 100 * share : null;
const nsPerPixel = (run) => run.fragments ? 1e6 * run.trace_ms / run.fragments : null;
const times = {
  "search, ns per pixel": nsPerPixel,
  "stages, ms a frame": (run) => run.kernel_ms,
  "drawing, ms a frame": (run) => run.draw_ms,
  "look-ups of the search, a pixel": (run) => run.search_look_ups,
  "look-ups in lockstep, a pixel": (run) => run.lockstep_look_ups,
  "cache lines that are read, a frame": (run) => run.lines_touched,
};
const errors = {
  "texels from the true hit, 99 % of rays": (run) => run.texels_p99,
  "texels from the true hit, median": (run) => run.texels_median,
  "texels from the true hit, 90 % of rays": (run) => run.texels_p90,
  "texels from the true hit, greatest": (run) => run.texels_max,
  "texels as drawn, with the frame's error, 99 %": (run) => run.drawn_texels_p99,
  "depth from the true hit, 99 % of rays, thicknesses": (run) => run.s_p99,
  "depth from the true hit, median, thicknesses": (run) => run.s_median,
  "wrong rays, %": (run) => percent(run.wrong),
  "late rays, %": (run) => percent(run.late),
  "early rays, %": (run) => percent(run.early),
  "rays that end on another surface, %": (run) => percent(run.other_surface),
};
/* Exact hits have no error, and a logarithm ends nowhere: this is drawn in place of less. */
const leastError = 1e-3;

const measured = results.runs.filter((run) => !run.failed);
/* What may share an axis. */
const groupOf = (run) =>
  `${run.machine}; ${run.isa}, ${run.number}, ${run.threads} thread${run.threads === 1 ? "" : "s"}, ` +
  `build ${String(run.build).slice(0, 18)}`;
const mapOf = (run) => `${run.map} ${run.map_width}`;
const distinct = (values) => [...new Set(values)];
const ascending = (values) => distinct(values).sort((a, b) => a - b);

const state = { chosen: new Set(), flipped: false, flippedOnes: new Set(), sort: "draw_ms", down: false,
                runs: 200, pictures: 60 };
const value = (id) => byId(id).value;
const all = "all";

function matchesWords(run) {
  const text = `${run.algorithm} ${run.family} ${mapOf(run)} ${run.scene} ${run.view}`.toLowerCase();
  return value("words").toLowerCase().split(/\s+/).every((word) => text.includes(word));
}
function familyShown(family) {
  const box = document.querySelector(`#families input[value="${CSS.escape(family)}"]`);
  return !box || box.checked;
}
/* The runs that the controls leave, but for those named. */
function chosenRuns(...without) {
  const keeps = (id, text) => without.includes(id) || value(id) === all || value(id) === text;
  return measured.filter((run) => groupOf(run) === value("group") && keeps("scene", run.scene) &&
    keeps("map", mapOf(run)) && keeps("view", run.view) && familyShown(run.family) && matchesWords(run));
}
/* Geometric means over what the controls leave together. */
function pointsBy(runs, keyOf) {
  const time = times[value("time")], error = errors[value("error")], sums = new Map();
  for (const run of runs) {
    const t = time(run), e = error(run);
    if (!(t > 0) || e === null || e === undefined || Number.isNaN(e)) continue;
    const key = keyOf(run);
    const sum = sums.get(key) || { key, run, t: 0, e: 0, n: 0 };
    sum.t += Math.log(t);
    sum.e += Math.log(Math.max(e, leastError));
    sum.n += 1;
    sums.set(key, sum);
  }
  return [...sums.values()].map((sum) => ({ ...sum, t: Math.exp(sum.t / sum.n), e: Math.exp(sum.e / sum.n) }));
}
function frontOf(points) {
  const front = [];
  let best = Infinity;
  for (const p of [...points].sort((a, b) => a.t - b.t || a.e - b.e))
    if (p.e < best * (1 - 1e-9)) { front.push(p); best = p.e; }
  return front;
}

/* Elements */

function svg(name, attributes = {}, text = null) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, v] of Object.entries(attributes)) made.setAttribute(key, v);
  if (text !== null) made.textContent = text;
  return made;
}
function short(x) {
  if (x === null || x === undefined) return "–";
  if (typeof x !== "number") return String(x);
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e5 || size < 1e-3) return x.toExponential(1).replace("e+", "e");
  return size >= 100 ? x.toFixed(0) : String(Number(x.toPrecision(3)));
}

/* Charts */

function scaleOf(values, log, from, to) {
  let low = Math.min(...values), high = Math.max(...values);
  const map = log ? Math.log10 : (x) => x;
  if (!(low < high)) { low = log ? low / 2 : low - 1; high = log ? high * 2 : high + 1; }
  let a = map(low), b = map(high);
  const room = 0.05 * (b - a);
  a = !log && low >= 0 && a - room < 0 ? 0 : a - room;
  b += room;
  const at = (x) => from + (map(x) - a) / (b - a) * (to - from);
  const ticks = [];
  if (log) {
    const close = b - a < 2.2;
    const wide = Math.max(1, Math.ceil((b - a) / 9));
    for (let e = Math.floor(a); e <= b; e += 1)
      for (const m of [1, 2, 5])
        if ((m === 1 ? e % wide === 0 : close) && map(m * 10 ** e) >= a && map(m * 10 ** e) <= b) ticks.push(m * 10 ** e);
  } else {
    const rough = (b - a) / 6, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].find((m) => m * power >= rough) * power;
    for (let t = Math.ceil(a / step) * step; t <= b + 1e-9; t += step) ticks.push(Number(t.toPrecision(10)));
  }
  return { at, ticks };
}

const isWanted = (labelled) => (s) => state.chosen.has(s.name) || (state.chosen.size === 0 && labelled(s));

/* The place's size and what is left for the axes; names of lines stand in a margin where there is room. */
function frameOf(place, names, dots) {
  const width = Math.max(300, place.clientWidth || 600), tall = place.classList.contains("tall");
  const height = tall ? Math.min(640, Math.max(420, width * 0.5)) : Math.min(420, Math.max(320, width * 0.6));
  const longest = Math.max(0, ...names.map((name) => name.length));
  const beside = !dots && width >= 560 && longest > 0 && longest < 48;
  return { width, height, left: 58, right: width - (beside ? Math.min(260, 6.6 * longest + 20) : 14), top: 12, bottom: height - 46, beside };
}
function drawAxes(root, frame, X, Y, x, y) {
  const { height, left, right, top, bottom } = frame;
  let last = -Infinity;
  for (const t of x.values && x.values.length <= 12 ? x.values : X.ticks) {
    const px = X.at(t);
    root.append(svg("path", { class: "grid", d: `M${px} ${top}V${bottom}` }));
    if (px - last < 30) continue;
    last = px;
    root.append(svg("text", { x: px, y: bottom + 16, "text-anchor": "middle" }, short(t)));
  }
  for (const t of Y.ticks) {
    const text = y.floor && t <= leastError * 1.001 ? `≤${short(t)}` : short(t);
    root.append(svg("path", { class: "grid", d: `M${left} ${Y.at(t)}H${right}` }));
    root.append(svg("text", { x: left - 6, y: Y.at(t) + 4, "text-anchor": "end" }, text));
  }
  root.append(svg("text", { x: (left + right) / 2, y: height - 8, "text-anchor": "middle" }, x.title));
  root.append(svg("text", { transform: `translate(12 ${(top + bottom) / 2})rotate(-90)`, "text-anchor": "middle" }, y.title));
}
function drawOne(root, s, X, Y, dots) {
  const isChosen = state.chosen.has(s.name), faint = s.back && !isChosen;
  const kind = `${s.family} ${isChosen ? "chosen" : state.chosen.size > 0 ? "dim" : ""}`;
  const add = (element, about) => {
    element.append(svg("title", {}, about));
    element.addEventListener("click", () => choose(s.name));
    element.addEventListener("keydown", (event) => { if (event.key === "Enter") choose(s.name); });
    root.append(element);
  };
  const joined = !dots && s.points.length > 1;
  if (joined)
    add(svg("path", { class: `${faint ? "back" : "path"} ${kind}`, d: s.points.map((p, i) => `${i ? "L" : "M"}${X.at(p.x)} ${Y.at(p.y)}`).join("") }), s.name);
  if (joined && faint) return;
  for (const p of s.points)
    add(svg("circle", { class: `dot ${kind}`, cx: X.at(p.x), cy: Y.at(p.y), r: dots ? 5.5 : 3.5, tabindex: dots ? 0 : -1 }), p.about || s.name);
}
/* The pieces of the front's stairs as boxes of no width, which names keep off. */
function stairsOf(front, X, Y) {
  const boxes = [];
  for (let i = 1; i < front.length; i += 1) {
    const x0 = X.at(front[i - 1].x), x1 = X.at(front[i].x), y0 = Y.at(front[i - 1].y), y1 = Y.at(front[i].y);
    boxes.push([Math.min(x0, x1), y0, Math.max(x0, x1), y0], [x1, Math.min(y0, y1), x1, Math.max(y0, y1)]);
  }
  return boxes;
}
/* Beside a point, where neither another name nor the front is; if there is no such place, on the front. */
function drawNames(root, frame, ends, X, Y, before, front) {
  const taken = [], stairs = stairsOf(front, X, Y);
  const meets = (box, others) => others.some((t) => box[0] < t[2] && t[0] < box[2] && box[1] < t[3] && t[1] < box[3]);
  for (const { s, p } of ends) {
    const px = X.at(p.x), py = Y.at(p.y), wide = 6.4 * s.name.length;
    const left = px - 9 - wide, right = px + 9, fits = right + wide <= frame.right;
    const sides = (before || !fits ? [left, right] : [right, left]).filter((x) => x >= frame.left && x + wide <= frame.right);
    const places = sides.flatMap((x) => [-7, 14, -21, 28, -35, 42].map((dy) => ({ x, y: py + dy, box: [x, py + dy - 11, x + wide, py + dy + 3] })))
      .filter(({ box }) => box[1] >= frame.top && box[3] <= frame.bottom && !meets(box, taken));
    const place = places.find(({ box }) => !meets(box, stairs)) || places[0];
    if (place === undefined) continue;
    taken.push(place.box);
    root.append(svg("text", { class: "label", x: place.x, y: place.y }, s.name));
  }
}
/* In the margin, in the order of the lines' ends, none on another. */
function drawNamesBeside(root, frame, ends, X, Y) {
  ends.sort((a, b) => b.p.y - a.p.y);
  let low = frame.top;
  for (const end of ends) { end.y = Math.max(low, Y.at(end.p.y)); low = end.y + 14; }
  let high = frame.bottom;
  for (const end of ends.reverse()) { end.y = Math.min(high, end.y); high = end.y - 14; }
  for (const { s, p, y } of ends) {
    if (y < frame.top - 6) continue;
    root.append(svg("path", { class: `lead-line ${s.family}`, d: `M${X.at(p.x) + 4} ${Y.at(p.y)}L${frame.right + 4} ${y}` }));
    root.append(svg("text", { class: "label", x: frame.right + 8, y: y + 4 }, s.name));
  }
}
/* series: {name, family, points: [{x, y, about}], back}; front: points joined by stairs. */
function drawChart(place, { series, front, x, y, dots, labelled }) {
  place.replaceChildren();
  const every = series.flatMap((s) => s.points);
  if (every.length === 0) {
    place.append(html("p", { className: "empty" }, "Nothing to draw with these settings."));
    return;
  }
  const ends = series.filter(isWanted(labelled)).map((s) => ({ s, p: s.points[s.points.length - 1] }));
  const frame = frameOf(place, ends.map(({ s }) => s.name), dots);
  const X = scaleOf(every.map((p) => p.x), x.log, frame.left, frame.right);
  const Y = scaleOf(every.map((p) => p.y), y.log, frame.bottom, frame.top);
  const root = svg("svg", { viewBox: `0 0 ${frame.width} ${frame.height}`, role: "img", "aria-label": `${y.title} against ${x.title}` });
  drawAxes(root, frame, X, Y, x, y);
  if (front && front.length > 1)
    root.append(svg("path", { class: "front", d: front.map((p, i) => i === 0 ? `M${X.at(p.x)} ${Y.at(p.y)}` : `H${X.at(p.x)}V${Y.at(p.y)}`).join("") }));
  const layer = (s) => state.chosen.has(s.name) ? 2 : s.back ? 0 : 1;
  for (const s of [...series].sort((a, b) => layer(a) - layer(b))) drawOne(root, s, X, Y, dots);
  if (frame.beside) drawNamesBeside(root, frame, ends, X, Y);
  else drawNames(root, frame, ends, X, Y, !dots, front || []);
  place.append(root);
}

const errorAxis = () => ({ title: value("error"), log: true, floor: true });
const timeAxis = () => ({ title: value("time"), log: true });

/* What each dot is: those of the front first, then by error. */
function drawDots(points, front) {
  const rest = points.filter((p) => !front.includes(p)).sort((a, b) => a.e - b.e || a.t - b.t);
  byId("dots-summary").textContent = `The ${points.length} dots as a table, the ${front.length} that the dashed line joins first`;
  byId("dots").replaceChildren(html("thead", {}, html("tr", {}, ...["search", "family", value("time"), value("error"), "runs"].map((text) => html("th", {}, text)))),
    html("tbody", {}, ...[...front, ...rest].map((p) => {
      const first = html("td", { className: "word", title: p.key }, html("span", { className: `swatch ${p.run.family}` }), " ", names(front).has(p.key) ? html("b", {}, p.key) : p.key);
      const error = p.e <= leastError * 1.001 ? `≤${short(leastError)}` : short(p.e);
      const row = html("tr", { className: state.chosen.has(p.key) ? "chosen" : "" }, first, html("td", { className: "word" }, p.run.family),
        html("td", {}, short(p.t)), html("td", {}, error), html("td", {}, String(p.n)));
      row.addEventListener("click", () => choose(p.key));
      return row;
    })));
}
/* So many dots all have names; of more those of the front. */
const fewDots = 16;
const names = (points) => new Set(points.map((p) => p.key));

function drawFront() {
  const points = pointsBy(chosenRuns(), (run) => run.algorithm);
  const front = frontOf(points), onFront = names(front);
  drawDots(points, front);
  drawChart(byId("front"), {
    dots: true, x: timeAxis(), y: errorAxis(), front: front.map((p) => ({ x: p.t, y: p.e })), labelled: (s) => points.length <= fewDots || onFront.has(s.name),
    series: points.map((p) => ({ name: p.key, family: p.run.family, points: [{ x: p.t, y: p.e,
      about: `${p.key}: ${short(p.t)} ${value("time")}; ${short(p.e)} ${value("error")}${p.n > 1 ? ` (mean of ${p.n} runs)` : ""}` }] })),
  });
}

/* Lines over something that runs have: those that are on the front somewhere, or foremost, stand out. */
function drawLines(prefix, runs, xOf, x, nameOf, foremost) {
  const at = new Map(), standing = new Set();
  for (const run of runs) {
    const place = xOf(run);
    if (place === null || place === undefined) continue;
    if (!at.has(place)) at.set(place, []);
    at.get(place).push(run);
  }
  const lines = new Map();
  for (const place of [...at.keys()].sort((a, b) => a - b)) {
    const points = pointsBy(at.get(place), nameOf);
    for (const p of foremost || frontOf(points)) standing.add(p.key);
    for (const p of points) {
      if (!lines.has(p.key)) lines.set(p.key, { name: p.key, family: p.run.family, e: [], t: [] });
      lines.get(p.key).e.push({ x: place, y: p.e, about: `${p.key} at ${short(place)}: ${short(p.e)}` });
      lines.get(p.key).t.push({ x: place, y: p.t, about: `${p.key} at ${short(place)}: ${short(p.t)}` });
    }
  }
  const several = [...lines.values()].filter((line) => at.size < 2 || line.e.length > 1);
  for (const [which, axis, key] of [["error", errorAxis(), "e"], ["time", timeAxis(), "t"]])
    drawChart(byId(`${prefix}-${which}`), {
      x: { ...x, values: ascending([...at.keys()]) }, y: axis, labelled: (s) => !s.back,
      series: several.map((line) => ({ name: line.name, family: line.family, back: !standing.has(line.name), points: line[key] })),
    });
  return at.size > 1 && several.length > 0;
}

function drawByAngle() {
  /* Those of the front above. */
  const front = frontOf(pointsBy(chosenRuns(), (run) => run.algorithm));
  const shown = byId("angle-section");
  shown.hidden = false;
  shown.hidden = !drawLines("angle", chosenRuns("view"), (run) => run.angle, { title: "degrees between view and normal", log: false }, (run) => run.algorithm, front);
}
/* One line a search whose other parameters stay. */
function ladderOf(run) {
  const fixed = Object.entries(run.parameters).filter(([name, v]) => v !== run.steps_asked || !/steps|points|samples|iterations|layers/.test(name));
  return [run.trace, ...fixed.map(([name, v]) => `${name}=${v}`)].join(" ");
}
function drawBySteps() {
  const runs = chosenRuns().filter((run) => run.steps_asked !== null);
  const shown = byId("steps-section");
  shown.hidden = false;
  shown.hidden = !drawLines("steps", runs, (run) => run.steps_asked, { title: "steps", log: true }, ladderOf);
}
function drawBySize() {
  /* Maps of one kind at several sizes. */
  const sizes = new Map();
  for (const run of measured) sizes.set(run.map, (sizes.get(run.map) || new Set()).add(run.map_width));
  const runs = chosenRuns("map").filter((run) => sizes.get(run.map).size > 1 && (value("map") === all || value("map").replace(/ \d+$/, "") === run.map));
  const shown = byId("size-section");
  shown.hidden = false;
  shown.hidden = !drawLines("size", runs, (run) => run.map_width, { title: "texels a side", log: true }, (run) => run.algorithm);
}

/* By kind of map */

function heat(error) {
  const t = Math.min(1, Math.max(0, (Math.log10(Math.max(error, 1e-3)) + 3) / 5));
  return `hsl(${Math.round(165 - 160 * t)} ${Math.round(45 + 25 * t)}% ${Math.round(30 + 12 * t)}%)`;
}
function drawKinds() {
  const table = byId("kinds"), runs = chosenRuns("map");
  const maps = distinct(runs.map(mapOf));
  byId("kinds-section").hidden = maps.length < 2;
  byId("kinds-lead").textContent = `${value("error")}, and small beside it ${value("time")}; ${value("view") === all ? "mean over all views" : `view ${value("view")}`}. Searches that are best on the whole come first.`;
  const rows = new Map();
  for (const p of pointsBy(runs, (run) => JSON.stringify([run.algorithm, mapOf(run)]))) {
    const [algorithm, map] = JSON.parse(p.key);
    if (!rows.has(algorithm)) rows.set(algorithm, { family: p.run.family, cells: new Map() });
    rows.get(algorithm).cells.set(map, p);
  }
  const mean = (row) => [...row.cells.values()].reduce((sum, p) => sum + Math.log(p.e), 0) / row.cells.size;
  const head = html("tr", {}, html("th", {}, "search"), ...maps.map((map) => html("th", {}, map)));
  const body = [...rows].sort((a, b) => mean(a[1]) - mean(b[1])).slice(0, 120).map(([name, row]) => {
    const first = html("td", { title: name }, html("span", { className: `swatch ${row.family}` }), ` ${name}`);
    const line = html("tr", { className: state.chosen.has(name) ? "chosen" : "" }, first, ...maps.map((map) => {
      const p = row.cells.get(map);
      if (p === undefined) return html("td", {}, "–");
      const error = p.e <= leastError * 1.001 ? `≤${short(leastError)}` : short(p.e);
      const cell = html("td", { className: "cell", title: `${value("time")}: ${short(p.t)}` }, error, html("small", {}, short(p.t)));
      cell.style.background = heat(p.e);
      return cell;
    }));
    line.addEventListener("click", () => choose(name));
    return line;
  });
  table.replaceChildren(html("thead", {}, head), html("tbody", {}, ...body));
}

/* Pictures */

function showScale() {
  const ramp = (colours) => { const box = html("span", { className: "ramp" }); box.style.background = `linear-gradient(90deg, ${colours})`; return box; };
  const box = (colour) => { const made = html("span", { className: "box" }); made.style.background = colour; return made; };
  byId("scale").append(
    html("span", {}, "early, 100 to 0.01 texels ", ramp("#78f0ff, #1450c8, #000")), html("span", {}, ramp("#000, #be460a, #fff078"), " late, 0.01 to 100 texels"),
    html("span", {}, ramp("#000, #147832, #82ff96"), " on another surface"),
    html("span", {}, box("rgb(230 40 200)"), " hit for miss or miss for hit"), html("span", {}, box("#fff"), " NaN"), html("span", {}, box("#6e6e6e"), " not judged"));
}
function drawGallery() {
  const runs = chosenRuns().filter((run) => pictures[run.key]);
  byId("gallery-section").hidden = Object.keys(pictures).length === 0;
  const shown = runs.slice(0, state.pictures);
  byId("gallery").replaceChildren(...shown.map((run) => {
    const image = html("img", { loading: "lazy" });
    const show = () => {
      const flipped = state.flipped !== state.flippedOnes.has(run.key);
      image.src = pictures[run.key][flipped ? 1 : 0];
      image.alt = `${run.algorithm}, ${mapOf(run)}, ${flipped ? "distance from the true hit" : "picture"}`;
    };
    show();
    const button = html("button", { type: "button", title: "flip" }, image);
    button.addEventListener("click", () => {
      if (!state.flippedOnes.delete(run.key)) state.flippedOnes.add(run.key);
      show();
    });
    return html("figure", {}, button, html("figcaption", {}, html("b", {}, run.algorithm), ` ${mapOf(run)}, ${run.view === "camera" ? "camera" : `${run.view}°`}, ${short(run.texels_p99)} texels`));
  }));
  if (runs.length === 0) byId("gallery").append(html("p", { className: "empty" }, "No pictures of these runs: the plan says which have some."));
  byId("more-pictures").hidden = runs.length <= shown.length;
  byId("more-pictures").textContent = `show ${runs.length - shown.length} more`;
}

/* The table */

const tableColumns = [
  ["algorithm", "search"], ["family", "family"], ["scene", "scene"], ["map", "map"], ["map_width", "texels"], ["view", "view"],
  ["draw_ms", "frame ms"], ["kernel_ms", "stages ms"], ["trace_ms", "search ms"], ["fps", "frames/s"], ["published_fps", "published"],
  ["search_look_ups", "look-ups"], ["lockstep_look_ups", "in lockstep"], ["steps", "steps"], ["texels_touched", "distinct texels"], ["lines_touched", "cache lines"],
  ["s_p99", "depth 99 %"], ["texels_median", "texels median"], ["texels_p99", "texels 99 %"], ["texels_max", "texels greatest"],
  ["wrong", "wrong %"], ["late", "late %"], ["early", "early %"], ["other_surface", "other surface %"], ["missed", "missed %"], ["invented", "invented %"],
];
const isShare = (key) => ["wrong", "late", "early", "other_surface", "missed", "invented"].includes(key);
function drawTable() {
  const runs = chosenRuns(), key = state.sort, way = state.down ? -1 : 1;
  runs.sort((a, b) => {
    const u = a[key], v = b[key];
    if (u === v) return 0;
    if (u === null || u === undefined) return 1;
    if (v === null || v === undefined) return -1;
    return way * (key === "view" ? (Number(u) || 0) - (Number(v) || 0) : u < v ? -1 : 1);
  });
  const used = tableColumns.filter(([name]) => name !== "published_fps" || measured.some((run) => run.published_fps));
  byId("runs").tHead.replaceChildren(html("tr", {}, ...used.map(([name, title]) => {
    const button = html("button", { type: "button" }, title);
    button.addEventListener("click", () => {
      state.down = state.sort === name && !state.down;
      state.sort = name;
      drawTable();
    });
    const head = html("th", { scope: "col" }, button);
    const about = results.columns.find((column) => column.key === name);
    if (about) head.title = [about.meaning, about.unit].filter(Boolean).join(", ");
    if (name === key) head.setAttribute("aria-sort", state.down ? "descending" : "ascending");
    if (measured.length && typeof measured[0][name] === "string") head.className = "word";
    return head;
  })));
  byId("runs").tBodies[0].replaceChildren(...runs.slice(0, state.runs).map((run) => {
    const row = html("tr", { className: state.chosen.has(run.algorithm) ? "chosen" : "" }, ...used.map(([name], i) => {
      const v = run[name];
      const cell = html("td", { className: typeof v === "string" ? "word" : "" });
      if (i === 0) cell.append(html("span", { className: `swatch ${run.family}` }), " ");
      cell.append(isShare(name) && typeof v === "number" ? short(100 * v) : short(v));
      if (i === 0) cell.title = run.algorithm;
      return cell;
    }));
    row.addEventListener("click", () => choose(run.algorithm));
    return row;
  }));
  byId("count").textContent = `${runs.length} of ${results.runs.length} runs. Click a heading to sort, a row to follow its search. results.json and results.csv have the command that draws each.`;
  byId("more-runs").hidden = runs.length <= state.runs;
  byId("more-runs").textContent = `show all ${runs.length}`;
}

/* All of it */

function drawAll() {
  drawFront();
  drawByAngle();
  drawBySteps();
  drawBySize();
  drawKinds();
  drawGallery();
  drawTable();
}
function choose(name) {
  if (!state.chosen.delete(name)) state.chosen.add(name);
  drawAll();
}
function fillSelect(id, values, first) {
  const select = byId(id);
  select.replaceChildren(...values.map((text) => html("option", { value: text }, text)));
  if (first !== undefined) select.value = first;
  select.closest("label").hidden = values.length < 2;
}
/* One that has pictures, else one that is neither from the front nor grazing. */
function firstView(views) {
  const pictured = measured.find((run) => pictures[run.key]);
  return pictured ? pictured.view : views.includes("45") ? "45" : views.at(-1);
}
function start() {
  const processors = distinct(measured.map((run) => run.machine));
  byId("summary").textContent = `${results.runs.length} runs of ${distinct(results.runs.map((run) => run.algorithm)).length} searches on ` +
    `${distinct(results.runs.map(mapOf)).length} maps, ${distinct(results.runs.map((run) => run.view)).length} views. ` +
    `Measured on ${processors.join("; ") || "no machine"}. Figures of different machines, instruction sets and builds never share a chart.`;
  const groups = distinct(measured.map(groupOf));
  fillSelect("group", groups);
  const withAll = (values) => values.length > 1 ? [all, ...values] : values;
  fillSelect("scene", withAll(distinct(measured.map((run) => run.scene))));
  fillSelect("map", withAll(distinct(measured.map(mapOf))));
  const views = distinct(measured.map((run) => run.view)).sort((a, b) => (Number(a) || -1) - (Number(b) || -1));
  fillSelect("view", withAll(views), firstView(views));
  fillSelect("time", Object.keys(times));
  fillSelect("error", Object.keys(errors));
  for (const family of distinct(measured.map((run) => run.family)))
    byId("families").append(html("label", {}, html("input", { type: "checkbox", value: family, checked: true }), html("span", { className: `swatch ${family}` }), family));
  const failed = results.runs.filter((run) => run.failed);
  byId("failed-section").hidden = failed.length === 0;
  byId("failed").append(...failed.slice(0, 100).map((run) => html("li", {}, `${run.algorithm}, ${mapOf(run)}, ${run.view}: ${run.failed}`)));
  if (failed.length > 100) byId("failed").append(html("li", {}, `and ${failed.length - 100} more, which results.csv has`));
  for (const column of results.columns)
    byId("columns").append(html("dt", {}, column.key), html("dd", {}, [column.meaning, column.unit && `(${column.unit})`].filter(Boolean).join(" ") || "as its name says"));
  showScale();
  byId("controls").addEventListener("input", drawAll);
  byId("controls").addEventListener("submit", (event) => event.preventDefault());
  byId("flip").addEventListener("click", () => {
    state.flipped = !state.flipped;
    state.flippedOnes.clear();
    byId("flip").textContent = state.flipped ? "show pictures" : "show errors";
    drawGallery();
  });
  byId("more-pictures").addEventListener("click", () => { state.pictures += 120; drawGallery(); });
  byId("more-runs").addEventListener("click", () => { state.runs = Infinity; drawTable(); });
  let width = innerWidth;
  addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; drawAll(); } });
  drawAll();
  document.documentElement.dataset.drawn = String(document.querySelectorAll(".chart svg").length);
}
start();
