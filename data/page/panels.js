/* Panels: pictures that zoom and pan together. */

const sight = { x: 0, y: 0, zoom: 0 };  /* the middle, in pixels of the frame; zoom 0: all of each picture */
const panels = [];
let chosenPixel = null;

function fitZoom(panel) {
  const { picture, canvas } = panel;
  return Math.min(canvas.width / picture.width, canvas.height / picture.height);
}
const zoomOf = (panel) => sight.zoom || fitZoom(panel);
const middleOf = ({ source }) => (sight.zoom ? sight : { x: (source.x0 + source.x1) / 2, y: (source.y0 + source.y1) / 2 });
/* From a place in the window of the browser to one in the frame. */
function placeOf(panel, clientX, clientY) {
  const box = panel.canvas.getBoundingClientRect(), ratio = panel.canvas.width / box.width, zoom = zoomOf(panel);
  const middle = middleOf(panel);
  return { x: middle.x + ((clientX - box.left) * ratio - panel.canvas.width / 2) / zoom,
           y: middle.y + ((clientY - box.top) * ratio - panel.canvas.height / 2) / zoom };
}
function drawPanel(panel) {
  const { canvas, picture, source } = panel, context = canvas.getContext("2d"), zoom = zoomOf(panel);
  const middle = middleOf(panel), atX = (x) => canvas.width / 2 + (x - middle.x) * zoom, atY = (y) => canvas.height / 2 + (y - middle.y) * zoom;
  const left = atX(source.x0), top = atY(source.y0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.imageSmoothingEnabled = zoom < 1;
  context.imageSmoothingQuality = "high";
  context.drawImage(picture, left, top, picture.width * zoom, picture.height * zoom);
  canvas.style.touchAction = sight.zoom ? "none" : "pan-y";
  if (!chosenPixel || source.index(chosenPixel.x, chosenPixel.y) < 0) return;
  const x = atX(chosenPixel.x), y = atY(chosenPixel.y);
  const room = Math.max(0, (9 - zoom) / 2), side = zoom + 2 * room;
  for (const [colour, width] of [["#000", 4], ["#fff", 2]]) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.strokeRect(x - room, y - room, side, side);
  }
}
function drawPanels() {
  for (const panel of panels) drawPanel(panel);
}
/* As many pixels as the screen has; as high as the picture is, but not more than most of the window. */
function sizePanels() {
  for (const { canvas, picture } of panels) {
    const width = canvas.parentElement.clientWidth;
    const height = Math.min(width * picture.height / picture.width, Math.max(240, 0.72 * innerHeight));
    canvas.style.height = `${height}px`;
    canvas.width = Math.max(1, Math.round(width * devicePixelRatio));
    canvas.height = Math.max(1, Math.round(height * devicePixelRatio));
  }
  drawPanels();
}

function zoomBy(factor, panel, clientX, clientY) {
  const box = panel.canvas.getBoundingClientRect();
  const at = [clientX ?? box.left + box.width / 2, clientY ?? box.top + box.height / 2];
  const before = placeOf(panel, ...at), least = fitZoom(panel), most = Math.max(64, 16 * least) * devicePixelRatio;
  const zoom = Math.min(zoomOf(panel) * factor, most);
  if (zoom <= least) sight.zoom = 0;
  else {
    Object.assign(sight, middleOf(panel), { zoom });
    const after = placeOf(panel, ...at);
    sight.x += before.x - after.x;
    sight.y += before.y - after.y;
  }
  drawPanels();
}

/* `told`: { hover(place), choose(place) }, places in the frame. */
function listen(panel, told) {
  const { canvas } = panel, down = new Map();
  let moved = 0;
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomBy(2 ** (-event.deltaY / (event.deltaMode ? 8 : 240)), panel, event.clientX, event.clientY);
  }, { passive: false });
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, event);
    moved = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (!before) { told.hover(placeOf(panel, event.clientX, event.clientY)); return; }
    moved += Math.hypot(event.clientX - before.clientX, event.clientY - before.clientY);
    down.set(event.pointerId, event);
    if (down.size === 2) {
      const [other] = [...down.values()].filter((e) => e.pointerId !== event.pointerId);
      const span = (e) => Math.hypot(e.clientX - other.clientX, e.clientY - other.clientY);
      zoomBy(span(event) / (span(before) || 1), panel, other.clientX, other.clientY);
    } else if (moved > 4 && sight.zoom) {
      const from = placeOf(panel, before.clientX, before.clientY), to = placeOf(panel, event.clientX, event.clientY);
      sight.x += from.x - to.x;
      sight.y += from.y - to.y;
      drawPanels();
    }
  });
  const up = (event) => {
    if (down.delete(event.pointerId) && down.size === 0 && moved <= 4 && event.type === "pointerup")
      told.choose(placeOf(panel, event.clientX, event.clientY));
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
}

/* `shown`: { caption, source, picture }[]. */
function showPanels(place, shown, told) {
  panels.length = 0;
  place.replaceChildren(...shown.map(({ caption, source, picture }) => {
    const canvas = html("canvas", { tabIndex: 0, role: "img", ariaLabel: caption });
    const whole = html("canvas", { width: picture.width, height: picture.height });
    whole.getContext("2d").putImageData(picture, 0, 0);
    panels.push({ canvas, source, picture: whole });
    return html("figure", {}, html("figcaption", {}, caption), html("div", { className: "frame" }, canvas));
  }));
  for (const panel of panels) listen(panel, told);
  sizePanels();
}
