// The roof plan: outlines, envelopes, clearances with provided and required, north, scale bar.
// It looks like the plan of the package. A clearance that is not satisfied is heavy and says NG.

import { along, boxAround, place } from "./place.js";
import { points, replace, svg } from "./make.js";

const MARGIN_PX = 26;
const FOOT_PX = 58; // scale bar and north
const LINE_PX = 15;
const LETTER_PX = 6.6; // of the plan's type, on average
const CIRCLE_PX = 10;
const NUMBER_ALONE = [2 * CIRCLE_PX + 4, 36]; // with room for the mark NG below it
const TICK_PX = 5;
const ARROW_PX = 6;

/** Draw plans into an element; returns `show(plan)`. */
export function mountPlan(element) {
  let latest = null;
  const draw = () => {
    if (latest && element.clientWidth > 2 * MARGIN_PX) replace(element, drawing(latest, element.clientWidth, element.clientHeight));
  };
  new ResizeObserver(draw).observe(element);
  return {
    show(plan) {
      latest = plan;
      draw();
    },
  };
}

function drawing(plan, wide, tall) {
  const to = scaled(plan.extent, wide, tall);
  const frame = { x: 2, y: 2, wide: wide - 4, tall: tall - 4 };
  const taken = [{ x: 0, y: tall - 34, wide: 240, tall: 34 }]; // north and scale bar
  const [solids, edges] = [false, true].map((isEdge) => plan.objects.filter((object) => object.is_edge === isEdge));
  const shapes = [
    ...solids.map((object) => solid(object, to, taken)),
    ...plan.arrays.map((array) => block(array, to)),
    ...edges.map((object) => edge(object, to, taken)),
    ...edges.map((object) => edgeName(object, to, taken, [wide / 2, tall / 2])),
  ];
  for (const gap of plan.gaps) taken.push(...along(to(gap.from), to(gap.to)));
  // In order of need: a name inside its array, a clearance near its gap, an object where there is room.
  const arrayNames = plan.arrays.map((array) => arrayName(array, to, taken));
  const callouts = placed(plan.gaps, to, taken, frame);
  taken.push(...callouts.map(({ at }) => at));
  const objectNames = solids.map((object) => objectName(object, to, taken, frame));
  return svg(
    "svg",
    { viewBox: `0 0 ${wide} ${tall}`, role: "img", "aria-labelledby": "plan-title plan-description" },
    svg("title", { id: "plan-title" }, plan.title),
    svg("desc", { id: "plan-description" }, plan.described.map(sentence).join(" ")),
    svg("defs", {}, hatch()),
    plan.roof.length > 0 ? svg("polygon", { class: "roof", points: points(plan.roof.map(to)) }) : null,
    plan.arrays.map((array) => envelope(array, to)),
    shapes,
    arrayNames,
    objectNames,
    plan.gaps.map((gap) => dimension(gap, to)),
    callouts.map(({ gap, at, isWhole }) => callout(gap, at, isWhole, to)),
    north(plan.north_deg, tall),
    scaleBar(plan.scale_bar, to, tall),
  );
}

// From meters, y up, to pixels, y down, in the middle of what the foot leaves.
function scaled([x0, y0, x1, y1], wide, tall) {
  const free = { wide: wide - 2 * MARGIN_PX, tall: tall - MARGIN_PX - FOOT_PX };
  const scale = Math.min(free.wide / (x1 - x0), free.tall / (y1 - y0));
  const left = MARGIN_PX + (free.wide - scale * (x1 - x0)) / 2;
  const top = MARGIN_PX + (free.tall - scale * (y1 - y0)) / 2;
  const to = ([x, y]) => [left + (x - x0) * scale, top + (y1 - y) * scale];
  to.scale = scale;
  return to;
}

function sentence({ text, verdict }) {
  return `${text}${verdict ? `, ${verdict.text}` : ""}.`;
}

function hatch() {
  const line = svg("path", { d: "M0 0V6", class: "hatch-line" });
  return svg("pattern", { id: "hatch", width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" }, line);
}

function envelope({ envelope: outline }, to) {
  return outline.length > 0 ? svg("polygon", { class: "envelope", points: points(outline.map(to)) }) : null;
}

function block({ outline, downslope_deg: downslope, center }, to) {
  return svg("g", {}, svg("polygon", { class: "array", points: points(outline.map(to)) }), arrow(to(center), downslope));
}

// The downslope arrow, below the name at the center.
function arrow([x, y], degrees) {
  const turn = (degrees * Math.PI) / 180;
  const [dx, dy] = [Math.cos(turn), -Math.sin(turn)];
  const middle = [x, y + 2.4 * LINE_PX];
  const [tail, tip] = [-1, 1].map((side) => [middle[0] + side * 14 * dx, middle[1] + side * 14 * dy]);
  const wing = (side) => [tip[0] - 8 * dx + side * 3.5 * dy, tip[1] - 8 * dy - side * 3.5 * dx];
  return svg(
    "g",
    { class: "downslope" },
    svg("line", { x1: tail[0], y1: tail[1], x2: tip[0] - 6 * dx, y2: tip[1] - 6 * dy }),
    svg("polygon", { points: points([tip, wing(1), wing(-1)]) }),
  );
}

function arrayName({ id, label, center }, to, taken) {
  const [x, y] = to(center);
  const wide = LETTER_PX * Math.max(id.length, label.length);
  taken.push({ x: x - wide / 2, y: y - LINE_PX, wide, tall: 2 * LINE_PX });
  taken.push({ x: x - ARROW_PX, y: y + LINE_PX, wide: 2 * ARROW_PX, tall: 2.6 * LINE_PX });
  return svg(
    "g",
    { class: "middle" },
    svg("text", { class: "strong", x, y: y - 2 }, id),
    svg("text", { class: "label", x, y: y + LINE_PX - 2 }, label),
  );
}

function solid({ outline }, to, taken) {
  const drawn = outline.map(to);
  taken.push(boxAround(drawn));
  return svg("polygon", { class: "object", points: points(drawn) });
}

function objectName({ id, outline }, to, taken, frame) {
  const box = boxAround(outline.map(to));
  const [wide, tall] = [LETTER_PX * id.length + 8, LINE_PX + 2];
  const middle = [box.x + box.wide / 2, box.y + box.tall / 2];
  const fits = box.wide > wide + 8 && box.tall > tall + 4;
  const at = fits
    ? { x: middle[0] - wide / 2, y: middle[1] - tall / 2, wide, tall }
    : place(wide, tall, middle, taken, frame);
  if (!at) return null;
  taken.push(at);
  return svg("g", { class: "middle" }, backing(at), svg("text", { class: "label", x: at.x + wide / 2, y: at.y + tall - 4 }, id));
}

function edge({ id, outline, has_parapet: hasParapet }, to, taken) {
  const drawn = outline.map(to);
  for (const [k, point] of drawn.slice(1).entries()) taken.push(...along(drawn[k], point));
  return svg(
    "polygon",
    { class: hasParapet ? "edge has-parapet" : "edge", points: points(drawn) },
    svg("title", {}, id),
  );
}

// Outside of its edge; turned along one that is more vertical than horizontal.
function edgeName({ id, outline }, to, taken, [midX, midY]) {
  const box = boxAround(outline.map(to));
  const [x, y] = [box.x + box.wide / 2, box.y + box.tall / 2];
  const long = LETTER_PX * id.length + 4;
  const isTurned = box.tall > box.wide;
  const at = isTurned ? [x + Math.sign(x - midX) * 11, y] : [x, y + Math.sign(y - midY) * 11];
  const [wide, tall] = isTurned ? [LINE_PX, long] : [long, LINE_PX];
  taken.push({ x: at[0] - wide / 2, y: at[1] - tall / 2, wide, tall });
  const turn = isTurned ? `rotate(-90 ${at[0]} ${at[1]})` : null;
  return svg("g", { class: "middle" }, svg("text", { class: "tick", x: at[0], y: at[1] + 4.5, transform: turn }, id));
}

function backing({ x, y, wide, tall }) {
  return svg("rect", { class: "backing", x, y, width: wide, height: tall });
}

function dimension({ from, to: end, verdict }, to) {
  const [[x0, y0], [x1, y1]] = [to(from), to(end)];
  const long = Math.hypot(x1 - x0, y1 - y0) || 1;
  const [nx, ny] = [(-(y1 - y0) / long) * TICK_PX, ((x1 - x0) / long) * TICK_PX];
  const tick = (x, y) => `M${x - nx} ${y - ny}L${x + nx} ${y + ny}`;
  return svg("path", {
    class: isNg(verdict) ? "gap is-ng" : "gap",
    d: `M${x0} ${y0}L${x1} ${y1}${tick(x0, y0)}${tick(x1, y1)}`,
  });
}

// Where the callouts go. One that finds no room for its text is tried again before all others.
function placed(gaps, to, taken, frame) {
  const all = (order) => {
    const full = [...taken];
    return order.map((gap) => {
      const middle = middleOf(gap, to);
      const whole = place(...calloutSize(gap), middle, full, frame);
      const at = whole ?? place(...NUMBER_ALONE, middle, full, frame);
      if (at) full.push(at);
      return { gap, at, isWhole: whole !== null };
    });
  };
  const first = all(gaps);
  const [tight, others] = [false, true].map((isWhole) => first.filter((item) => item.isWhole === isWhole).map(({ gap }) => gap));
  const again = tight.length > 0 ? all([...tight, ...others]) : first;
  return (wholes(again) > wholes(first) ? again : first).filter(({ at }) => at !== null);
}

function wholes(tried) {
  return tried.filter(({ isWhole }) => isWhole).length;
}

function middleOf({ from, to: end }, to) {
  const [[x0, y0], [x1, y1]] = [to(from), to(end)];
  return [(x0 + x1) / 2, (y0 + y1) / 2];
}

function calloutSize({ lines }) {
  const letters = Math.max(...lines.map((line) => line.length));
  return [2 * CIRCLE_PX + 12 + letters * LETTER_PX, 2 * LINE_PX + 6];
}

function isNg(verdict) {
  return verdict?.look === "ng";
}

// Number, provided and required, led to the middle of the gap; the number alone where it is tight.
// The mark NG is below the number, so that a verdict moves no label.
function callout({ number, lines, verdict, ...gap }, at, isWhole, to) {
  const middle = middleOf(gap, to);
  const left = isWhole ? at.x + CIRCLE_PX + 5 : at.x + at.wide / 2;
  const y = at.y + at.tall / 2;
  const text = (line, k) => svg("text", { class: "label", x: left + CIRCLE_PX + 6, y: at.y + LINE_PX * (k + 1) - 1 }, line);
  return svg(
    "g",
    { class: isNg(verdict) ? "callout is-ng" : "callout" },
    svg("line", { class: "leader", x1: middle[0], y1: middle[1], ...nearest(at, middle) }),
    isWhole ? svg("rect", { class: "frame", x: at.x, y: at.y, width: at.wide, height: at.tall }) : null,
    number ? numbered(number, left, isNg(verdict) ? y - 8 : y) : null,
    isWhole ? lines.map(text) : null,
    isNg(verdict) ? ngBox(verdict.text, left, y + 9) : null,
  );
}

function numbered(number, x, y) {
  return [svg("circle", { cx: x, cy: y, r: CIRCLE_PX - 2 }), svg("text", { class: "label number", x, y: y + 4.5 }, number)];
}

function ngBox(text, x, y) {
  return svg(
    "g",
    { class: "ng-box" },
    svg("rect", { x: x - 11.5, y: y - 7, width: 23, height: 14 }),
    svg("text", { class: "strong", x, y: y + 4.5 }, text),
  );
}

// The point of a box that is nearest to a point: where a leader ends.
function nearest({ x, y, wide, tall }, [px, py]) {
  return { x2: Math.min(Math.max(px, x), x + wide), y2: Math.min(Math.max(py, y), y + tall) };
}

function north(degrees, tall) {
  const [x, y] = [18, tall - 16];
  return svg(
    "g",
    { class: "north", transform: `rotate(${90 - degrees} ${x} ${y})` },
    svg("path", { d: `M${x} ${y + 12}V${y - 6}` }),
    svg("polygon", { points: points([[x, y - 14], [x - 4, y - 5], [x + 4, y - 5]]) }),
    svg("text", { class: "strong", x: x + 8, y: y - 4 }, "N"),
  );
}

function scaleBar({ length_m: meters, text }, to, tall) {
  const [x, y, long] = [52, tall - 12, meters * to.scale];
  return svg(
    "g",
    { class: "scale-bar" },
    svg("rect", { class: "dark", x, y: y - 5, width: long / 2, height: 5 }),
    svg("rect", { class: "light", x: x + long / 2, y: y - 5, width: long / 2, height: 5 }),
    svg("text", { class: "tick", x, y: y - 9 }, "0"),
    svg("text", { class: "tick", x: x + long + 6, y: y + 1 }, text),
  );
}
