/* The page: what is chosen, and what is said of it. */

const state = { choice: null, view: "a", colours: "", exposure: 0, low: null, high: null, kept: null, hovered: null,
                more: {} };  /* what else a link keeps */
let sources = [], choices = [];
const [a, b] = [() => sources[0], () => sources[1]];

/* Choices */

/* Channels that are said otherwise: of pages that know more. */
let saidOtherwise = () => false;
const order = (name) => "RGBXYZUVWA".indexOf(name.at(-1));
/* R G B A first, the rest as the files have them. */
function channelNames() {
  const names = [...new Set(sources.flatMap((source) => [...source.channels.keys()]))].filter((name) => !saidOtherwise(name));
  const rank = (name) => (name.length === 1 && "RGBA".includes(name) ? "RGBA".indexOf(name) : 4);
  return names.sort((x, y) => rank(x) - rank(y));
}
function channelNamed(name) {
  return sources.map((source) => source.channels.get(name)).find(Boolean);
}
/* Vectors of two or three floats first, then every channel by itself. */
function makeChoices() {
  const vectors = new Map();
  for (const name of channelNames())
    if (vectorOf(name) !== name && channelNamed(name).type === "float32")
      vectors.set(vectorOf(name), [...(vectors.get(vectorOf(name)) || []), name]);
  const made = [];
  for (const [label, names] of vectors)
    if (names.length === 2 || names.length === 3)
      made.push({ label, names: names.sort((x, y) => order(x) - order(y)) });
  made.sort((x, y) => (y.label === "R G B") - (x.label === "R G B"));
  return [...made, ...channelNames().map((name) => ({ label: name, names: [name] }))];
}
/* What all sources have, if anything. */
function firstChoice() {
  return choices.find(({ names }) => names.every((name) => sources.every((source) => source.channels.has(name)))) || choices[0];
}
const views = [["both", "Side by side"], ["a", "First"], ["b", "Second"], ["difference", "Difference"], ["heat", "Heat map"],
               ["classes", "Classes"], ["first", "First to leave"]];
const classes = () => (b() ? classesOf(a(), b(), state.choice) : null);
const firstLeft = () => (b() && hasRanges() ? firstLeftOf(a(), b()) : null);
const isOneChannel = () => state.choice.names.length === 1;

/* Pictures */

/* Of the finite values of both sources. */
function rangeOfChoice() {
  let low = Infinity, high = -Infinity;
  for (const source of sources)
    for (const channel of componentsOf(source, state.choice)) {
      const s = statisticsOf(channel);
      if (s.finite) { low = Math.min(low, s.least); high = Math.max(high, s.most); }
    }
  return low <= high ? { low, high } : { low: 0, high: 1 };
}
function coloursInUse() {
  return state.colours || usualColours(state.choice, channelNamed(state.choice.names[0]));
}
function how() {
  const range = rangeOfChoice();
  let low = state.low ?? range.low, high = state.high ?? range.high;
  const colours = coloursInUse();
  if (colours === "signed" && state.low === null && state.high === null) {
    high = Math.max(Math.abs(low), Math.abs(high));
    low = -high;
  }
  return { colours, exposure: state.exposure, low, high };
}
/* The heat map's white. */
function heatScale() {
  const { low, high } = rangeOfChoice();
  return Math.max(Math.abs(low), Math.abs(high)) || 1;
}
function differenceExtent() {
  const [x, y] = [a(), b()].map((source) => source.channels.get(state.choice.names[0]));
  return (x && y && a().fits(b()) && comparisonOf(x, y).most || 1) / 2 ** state.exposure;
}
function shownPanels() {
  const single = (source) => ({ caption: source.name, source, picture: pictureOf(source, state.choice, how()) });
  const heat = () => ({ caption: "Difference, heat map", source: a(), picture: heatOf(a(), b(), state.choice, heatScale()) });
  const judged = () => {
    const found = classes();
    return found && { caption: "Against the legal range", source: a(), picture: found.picture };
  };
  const left = () => {
    const found = firstLeft();
    return found && { caption: "The first channel that leaves its range", source: a(), picture: found.picture };
  };
  if (!b()) return [single(a())];
  switch (state.view) {
    case "both": return [single(a()), single(b()), ...(a().fits(b()) ? [judged() || heat()] : [])];
    case "b": return [single(b())];
    case "difference":
      return [isOneChannel() ? { caption: `${b().name} less ${a().name}`, source: a(),
                                 picture: signedDifferenceOf(a(), b(), state.choice, differenceExtent()) } : heat()];
    case "heat": return [heat()];
    case "classes": return [judged() || heat()];
    case "first": return [left() || heat()];
    default: return [single(a())];
  }
}

/* What colours mean */

function rampText(name, low, high) {
  const stops = ramps[name].map((c) => `rgb(${c.map(Math.round)})`).join(",");
  return html("span", {}, low + " ", html("i", { className: "ramp", style: `background:linear-gradient(90deg,${stops})` }), " " + high);
}
const boxText = (colour, text) =>
  html("span", {}, html("i", { className: "box", style: `background:rgb(${colour})` }), " " + text);
function legendOfValues() {
  const { colours, low, high } = how(), items = [];
  if (ramps[colours]) items.push(rampText(colours, short(low), short(high)));
  if (colours === "vector") items.push(html("span", {}, "−1 to 1 as black to full red, green, blue"));
  if (colours === "codes") {
    const channel = channelNamed(state.choice.names[0]), seen = [...new Set(channel.bits)].sort((x, y) => x - y);
    for (const code of seen.slice(0, 12)) items.push(boxText(colourOfCode(code), codeText(state.choice.names[0], code)));
    if (seen.length > 12) items.push(html("span", {}, `and ${seen.length - 12} more`));
  }
  const found = sources.flatMap((source) => componentsOf(source, state.choice)).flatMap((c) => [...new Set(c.type === "uint32" ? [] : c.values.filter((v) => !Number.isFinite(v)))]);
  for (const [v, colour, text] of [[NaN, notANumber, "NaN"], [Infinity, plusInfinity, "inf"], [-Infinity, minusInfinity, "−inf"]])
    if (found.some((w) => Object.is(v, w))) items.push(boxText(colour, text));
  return items;
}
function legendOfHeat() {
  return [boxText([0, 0, 0], "equal"), rampText("heat", short(heatScale() / 2 ** heatOctaves) + " and less", short(heatScale())),
          boxText(notANumber, "NaN or infinite on one side")];
}
function legendOfClasses(found) {
  return classNames.map((name, k) => boxText(classColours[k], `${name}: ${found.counts[k]}`)).filter((_, k) => k < 4 || found.counts[k]);
}
function legendOfFirstLeft({ names, counts, inside, unjudged }) {
  return [boxText(noneLeft, `none: ${inside}`), ...(unjudged ? [boxText(classColours[4], `not judged: ${unjudged}`)] : []), ...names.map((name, k) => boxText(colourOfCode(k), `${name}: ${counts[k]}`)).filter((_, k) => counts[k])];
}
function showLegend() {
  const found = b() && classes(), single = state.view === "difference" && isOneChannel();
  let items = [];
  if (!b() || ["both", "a", "b"].includes(state.view)) items = legendOfValues();
  if (b() && single) items = [rampText("signed", short(-differenceExtent()), short(differenceExtent()))];
  if (state.view === "first" && firstLeft()) items = legendOfFirstLeft(firstLeft());
  else if (b() && (state.view === "classes" || state.view === "both") && found) items.push(...legendOfClasses(found));
  else if (b() && a().fits(b()) && (["both", "heat", "classes", "first"].includes(state.view) || (state.view === "difference" && !single))) items.push(...legendOfHeat());
  byId("legend").replaceChildren(...items);
}

/* Values of a pixel */

function valueCell(source, number, name, place) {
  const channel = source.channels.get(name), i = channel ? source.index(place.x, place.y) : -1;
  if (i < 0) return html("td", {}, "–");
  const { type } = channel, bits = channel.bits[i];
  const cell = html("td", {}, decimalOf(type, bits), html("small", {}, hexOf(bits)));
  if (type === "float32") cell.title = hexFloatOf(bits);
  cell.dataset.of = `${number} ${name} ${hexOf(bits)}`;
  return cell;
}
function apartCell(name, place) {
  const [x, y] = sources.map((source) => source.channels.get(name));
  const [i, j] = sources.map((source) => source.index(place.x, place.y));
  if (!x || !y || i < 0 || j < 0) return html("td", {}, "–");
  const apart = differenceOf(x, y, i, j), ulp = ulpOf(x, y, i, j);
  if (apart === 0 && !(ulp > 0) && (x.bits[i] === y.bits[j] || ulp === 0 && isNaNBits(x.bits[i]))) return html("td", { className: "equal" }, "equal");
  if (apart === 0 && ulp === 0) return html("td", { className: "unequal" }, "sign of 0");
  return html("td", { className: "unequal" }, short(apart), html("small", {}, ulp === null || ulp === Infinity ? "" : `${ulp} ulp`));
}
/* What the range says of the pixel, where the reference has one. */
function rangeCell(name, place) {
  const ranges = rangesOf(a(), name), value = b().channels.get(name), i = a().index(place.x, place.y), j = b().index(place.x, place.y);
  if (!ranges || !value || i < 0 || j < 0) return html("td", {}, "");
  const found = classOf(ranges, extentOf(a(), name), value.values[j], i);
  return html("td", { className: "word" }, html("i", { className: "box", style: `background:rgb(${classColours[found]})` }), " " + classNames[found],
    html("small", {}, found === 4 ? "" : `${short(ranges.low.values[i])} to ${short(ranges.high.values[i])}`));
}
const hasRanges = () => Boolean(b()) && channelNames().some((name) => rangesOf(a(), name));
function showFirstLeft(ranged, place) {
  const i = a().index(place.x, place.y), line = byId("first-left");
  if (!ranged || i < 0 || !a().fits(b())) return;
  const judged = judgedChannels(a(), b()).filter((of) => isJudged(of, i)), name = judged.find((of) => isOutside(of, i))?.name;
  line.hidden = false;
  line.className = name ? "lead unequal" : "lead";
  line.textContent = name ? `First to leave its range: ${name}` : judged.length ? "No channel leaves its range here." : "Not judged here: no channel has a range.";
}
function showValues() {
  const place = state.kept || state.hovered, head = byId("values").tHead, body = byId("values").tBodies[0];
  byId("place").textContent = place ? `${place.x}, ${place.y}` : "";
  byId("hint").hidden = Boolean(place);
  byId("values").parentElement.hidden = !place;
  byId("first-left").hidden = true;
  if (!place) return;
  const ranged = hasRanges();
  showFirstLeft(ranged, place);
  head.replaceChildren(html("tr", {}, ...["Channel", ...sources.map((s) => s.name), ...(b() ? ["Apart"] : []), ...(ranged ? ["Range"] : [])]
    .map((text) => html("th", { scope: "col", title: text, className: text === "Range" ? "word" : "" }, text))));
  const chosen = state.choice.names, rest = channelNames().filter((name) => !chosen.includes(name));
  body.replaceChildren(...[...chosen, ...rest].map((name) => html("tr", { className: chosen.includes(name) ? "chosen" : "" },
    html("th", { scope: "row" }, name), ...sources.map((source, k) => valueCell(source, k, name, place)),
    ...(b() ? [apartCell(name, place)] : []), ...(ranged ? [rangeCell(name, place)] : []))));
}

/* Tables */

function choose(place) {
  const x = Math.floor(place.x), y = Math.floor(place.y);
  if (sources.every((source) => source.index(x, y) < 0)) return;
  state.kept = chosenPixel = { x, y };
  showPixel();
}
function showPixel() {
  showValues();
  drawPanels();
  remember();
}
/* Of channels none of whose values leaves its range. */
function inRangeText(channels) {
  if (!hasRanges()) return "";
  const pixels = a().width * a().height;
  let judged = 0;
  for (let i = 0; i < pixels; i += 1) judged += channels.some((of) => isJudged(of, i));
  if (judged === 0) return "; none is judged";
  return judged === pixels ? "; all are in their range" : `; the ${counted(judged, "pixel")} that ${judged === 1 ? "is" : "are"} judged ${judged === 1 ? "is" : "are"} in range, ${pixels - judged} are not judged`;
}
function showWorst() {
  byId("worst-section").hidden = !b();
  if (!b()) return;
  const pairs = state.choice.names.map((name) => [a().channels.get(name), b().channels.get(name)]).filter(([x, y]) => x && y);
  const lead = byId("worst-lead"), table = byId("worst");
  table.parentElement.hidden = true;
  if (!a().fits(b())) { lead.textContent = "The images have different windows; pixels are compared one at a time only."; return; }
  if (pairs.length === 0) { lead.textContent = "One of the images lacks this channel."; return; }
  const outside = judgedChannels(a(), b()).filter(({ name }) => state.choice.names.includes(name)), left = worstOutside(outside, 12);
  const worst = left.length ? left : worstPixels(pairs, 12), by = left.length ? "Outside by" : "Apart";
  lead.textContent = left.length ? `Of ${state.choice.label}, outside of the range: NaN first, then by the distance. Click one to see it.` :
    worst.length ? `Of ${state.choice.label}, by the absolute difference${inRangeText(outside)}. Click one to see it.` :
    `${state.choice.label} is equal, bit for bit.`;
  if (!worst.length) return;
  table.parentElement.hidden = false;
  table.tHead.replaceChildren(html("tr", {}, ...["Pixel", "Channel", a().name, b().name, by].map((text, k) => html("th", { scope: "col", className: k === 1 ? "word" : "" }, text))));
  table.tBodies[0].replaceChildren(...worst.map(({ i, most, name }) => {
    const place = { x: a().x0 + i % a().width, y: a().y0 + Math.floor(i / a().width) };
    const show = () => { goTo(place); byId("stage").scrollIntoView({ block: "nearest" }); };
    return html("tr", {}, html("th", { scope: "row" }, html("button", { type: "button", onclick: show }, `${place.x}, ${place.y}`)),
      html("td", { className: "word" }, name), ...sources.map((source) => html("td", {}, decimalOf(source.channels.get(name).type, source.channels.get(name).bits[i]))),
      html("td", {}, short(most)));
  }));
}
function goTo(place) {
  if (panels.length && zoomOf(panels[0]) < 8 * devicePixelRatio) sight.zoom = Math.max(8 * devicePixelRatio, fitZoom(panels[0]));
  sight.x = place.x + 0.5;
  sight.y = place.y + 0.5;
  choose({ x: place.x + 0.5, y: place.y + 0.5 });
}
function statisticsRow(name) {
  const row = html("tr", {}, html("th", { scope: "row" }, html("button", { type: "button", onclick: () => { byId("channel").value = name; takeControls(); } }, name)));
  sources.forEach((source, k) => {
    const channel = source.channels.get(name);
    if (!channel) { row.append(...Array.from({ length: 5 }, () => html("td", {}, "–"))); return; }
    const s = statisticsOf(channel);
    const cells = [short(s.least), short(s.most), short(s.mean), String(s.nan), String(s.infinite)].map((text) => html("td", {}, text));
    if (s.nan) cells[3].className = "unequal";
    cells[0].dataset.hash = `${k} ${name} ${hexOf(hashOf(channel.bits))}`;
    row.append(...cells);
  });
  if (!b()) return row;
  const [x, y] = sources.map((source) => source.channels.get(name));
  if (!x || !y || !a().fits(b())) row.append(html("td", {}, "–"), html("td", {}, "–"), html("td", {}, "–"));
  else {
    const c = comparisonOf(x, y);
    row.append(html("td", { className: c.unequal ? "unequal" : "equal" }, String(c.unequal)), html("td", {}, c.notFinite ? `${short(c.most)}, ${c.notFinite} not finite` : short(c.most)), html("td", {}, c.ulp ? String(c.ulp) : "0"));
  }
  return row;
}
function showStatistics() {
  const of = ["Least", "Most", "Mean", "NaN", "Infinite"], table = byId("statistics"), head = [];
  if (b()) head.push(html("tr", {}, html("th", {}), ...sources.map((s) => html("th", { colSpan: 5, scope: "colgroup" }, s.name)), html("th", { colSpan: 3, scope: "colgroup" }, "Between them")));
  head.push(html("tr", {}, ...["Channel", ...sources.flatMap(() => of), ...(b() ? ["Pixels apart", "Most apart", "Most ulp"] : [])].map((text) => html("th", { scope: "col" }, text))));
  table.tHead.replaceChildren(...head);
  table.tBodies[0].replaceChildren(...channelNames().map(statisticsRow));
  byId("statistics-lead").textContent = b() && !a().fits(b()) ? "The images have different windows; they are not compared here." : "Of finite values. Click a channel to see it.";
}
function showAttributes() {
  byId("attributes-section").hidden = sources.every((source) => Object.keys(source.attributes).length === 0);
  byId("attributes").replaceChildren(...sources.filter((s) => Object.keys(s.attributes).length).map((source) => {
    const list = html("dl", {});
    for (const [key, text] of Object.entries(source.attributes)) list.append(html("dt", {}, key), html("dd", {}, text));
    return html("details", {}, html("summary", {}, source.name), list);
  }));
}
function showSummary() {
  const about = sources.map((s) => `${s.name}: ${s.width} × ${s.height}${s.x0 || s.y0 || s.width !== s.frame[2] - s.frame[0] || s.height !== s.frame[3] - s.frame[1] ? ` at ${s.x0}, ${s.y0} of ${s.frame[2] - s.frame[0]} × ${s.frame[3] - s.frame[1]}` : ""}, ${counted([...s.channels.keys()].filter((name) => !saidOtherwise(name)).length, "channel")}`);
  let text = about.join(". ") + ".";
  if (b() && a().fits(b())) {
    const shared = channelNames().filter((name) => a().channels.has(name) && b().channels.has(name));
    const apart = shared.filter((name) => comparisonOf(a().channels.get(name), b().channels.get(name)).unequal);
    const all = shared.length === 1 ? "The one shared channel is equal" : `All ${shared.length} shared channels are equal`;
    text += apart.length ? ` ${apart.length} of ${counted(shared.length, "shared channel")} ${apart.length === 1 ? "differs" : "differ"}.` :
      shared.length ? ` ${all}, bit for bit.` : " No channel is in both.";
  }
  byId("summary").textContent = text;
}

/* Controls */

function showControls() {
  const colours = coloursInUse(), ramped = Boolean(ramps[colours]), usual = usualColours(state.choice, channelNamed(state.choice.names[0]));
  const offered = isOneChannel() ? ["gray", "viridis", "signed", ...(channelNamed(state.choice.names[0]).type === "uint32" ? ["codes"] : [])] : ["colour", "vector"];
  byId("colours").replaceChildren(...offered.map((name) => html("option", { value: name, selected: name === colours }, name === usual ? `${name} (usual)` : name)));
  const ofValues = !b() || ["both", "a", "b"].includes(state.view), exposed = ofValues && (colours === "colour" || colours === "vector");
  byId("colours-label").hidden = !ofValues;
  byId("exposure-label").hidden = !exposed && !(state.view === "difference" && isOneChannel() && b());
  byId("low-label").hidden = byId("high-label").hidden = !ofValues || !ramped;
  byId("stops").textContent = (state.exposure > 0 ? "+" : "") + state.exposure;
  const { low, high } = how();
  byId("low").placeholder = short(low);
  byId("high").placeholder = short(high);
  for (const box of document.querySelectorAll("#views input")) box.checked = box.value === state.view;
  for (const [view, found] of [["classes", classes()], ["first", b() && hasRanges()]]) {
    const button = byId("views").querySelector(`[value=${view}]`);
    if (button) button.parentElement.hidden = !found;
  }
}
function show() {
  showControls();
  showPanels(byId("pictures"), shownPanels(), { hover: hover, choose });
  byId("stage").className = (panels.length > 1 ? "many" : "one") + (hasRanges() ? " ranged" : "");
  sizePanels();
  showLegend();
  showWorst();
  showValues();
  remember();
}
function hover(place) {
  const x = Math.floor(place.x), y = Math.floor(place.y);
  if (state.kept || sources.every((source) => source.index(x, y) < 0)) return;
  state.hovered = { x, y };
  showValues();
}
const numberIn = (id) => (byId(id).value.trim() === "" || Number.isNaN(Number(byId(id).value)) ? null : Number(byId(id).value));
function takeControls(event) {
  const before = state.choice;
  state.choice = choices.find((choice) => choice.label === byId("channel").value) || choices[0];
  if (before !== state.choice) {
    state.colours = "";
    byId("low").value = byId("high").value = "";
  } else if (event && event.target.id === "colours") state.colours = byId("colours").value;
  state.view = document.querySelector("#views input:checked")?.value || "a";
  state.exposure = Number(byId("exposure").value);
  state.low = numberIn("low");
  state.high = numberIn("high");
  show();
}
function chooseView(view) {
  state.view = view;
  show();
}
function flip() {
  if (b()) chooseView(state.view === "a" ? "b" : "a");
}
/* So that a link or a reload shows the same; a browser may forbid it. */
function remember() {
  const parts = { ...state.more, channel: state.choice.label, view: state.view, ...(state.kept ? { pixel: `${state.kept.x},${state.kept.y}` } : {}) };
  try { history.replaceState(null, "", "#" + new URLSearchParams(parts)); } catch { /* then not */ }
}
function recall() {
  const parts = new URLSearchParams(location.hash.slice(1)), [x, y] = (parts.get("pixel") || "").split(",").map(Number);
  state.choice = choices.find((choice) => choice.label === parts.get("channel")) || firstChoice();
  if (views.some(([id]) => id === parts.get("view"))) state.view = parts.get("view");
  byId("channel").value = state.choice.label;
  if (Number.isInteger(x) && Number.isInteger(y)) state.kept = chosenPixel = { x, y };
}
const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.("input:not([type=radio]), select")) return;
  const { key } = event, step = steps[key];
  if (step && event.target.type === "radio") return;
  if (step && state.kept) choose({ x: state.kept.x + step[0], y: state.kept.y + step[1] });
  else if (key === "+" || key === "=") zoomBy(2, panels[0]);
  else if (key === "-") zoomBy(0.5, panels[0]);
  else if (key === "0") fit();
  else if (key === "f" || key === "F") flip();
  else if (b() && views[Number(key) - 1]) chooseView(views[Number(key) - 1][0]);
  else if (key === "[" || key === "]") { byId("exposure").value = state.exposure + (key === "]" ? 0.5 : -0.5); takeControls(); }
  else if (key === "Escape") { state.kept = chosenPixel = null; showPixel(); }
  else return;
  event.preventDefault();
}
function fit() {
  sight.zoom = 0;
  drawPanels();
}

function listenToControls() {
  byId("controls").addEventListener("submit", (event) => event.preventDefault());
  byId("controls").addEventListener("change", takeControls);
  byId("exposure").addEventListener("input", takeControls);
  byId("flip").addEventListener("click", flip);
  byId("in").addEventListener("click", () => zoomBy(2, panels[0]));
  byId("out").addEventListener("click", () => zoomBy(0.5, panels[0]));
  byId("fit").addEventListener("click", fit);
  addEventListener("resize", sizePanels);
  addEventListener("keydown", onKey);
}
function makeControls() {
  byId("channel").replaceChildren(...choices.map(({ label }) => html("option", { value: label }, label)));
  byId("views").hidden = byId("flip").hidden = !b();
  for (const label of byId("views").querySelectorAll("label")) label.remove();
  if (!b()) return;
  state.view = "both";
  for (const [id, label] of views)
    byId("views").append(html("label", {}, html("input", { type: "radio", name: "view", value: id }), id === "a" ? a().name : id === "b" ? b().name : label));
}
/* What pages that know more do between reading and showing, in order. */
const afterReading = [];
/* Of everything that depends on the sources. */
function showSources() {
  choices = makeChoices();
  makeControls();
  recall();
  showSummary();
  showStatistics();
  showAttributes();
  show();
}
async function start() {
  sources = await embeddedSources();
  for (const step of afterReading) await step();
  showSources();
  listenToControls();
  document.body.dataset.ready = String(channelNames().length);
}
