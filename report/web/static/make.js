// Makes elements of HTML and SVG. It knows nothing of Roofslip; every other module builds on it.

const SVG = "http://www.w3.org/2000/svg";

/** Make an HTML element; attributes that are null or false are left out. */
export function html(name, attributes, ...children) {
  return filled(document.createElement(name), attributes, children);
}

/** Make an SVG element, likewise. */
export function svg(name, attributes, ...children) {
  return filled(document.createElementNS(SVG, name), attributes, children);
}

/** Make a button. */
export function button(label, click, attributes = {}) {
  return html("button", { type: "button", class: "button", on: { click }, ...attributes }, label);
}

/** Make a paragraph beside the matter, in small type. */
export function note(text) {
  return html("p", { class: "note" }, text);
}

/** Return an element with HTML of the server in it, whose templates escape what they print. */
export function parsed(name, text) {
  return new DOMParser().parseFromString(`<${name}>${text}</${name}>`, "text/html").body.firstElementChild;
}

/** Replace all that is in an element. */
export function replace(element, ...children) {
  element.replaceChildren(...nodes(children));
}

/** Replace what differs in an element from another one; what is the same stays, and is not laid out again. */
export function update(element, other) {
  const former = [...element.childNodes];
  const next = [...other.childNodes];
  next.forEach((node, k) => {
    const old = former[k];
    if (!old) element.append(node);
    else if (old.isEqualNode(node)) return;
    else if (node.firstElementChild && old.cloneNode().isEqualNode(node.cloneNode())) update(old, node);
    else old.replaceWith(node);
  });
  for (const old of former.slice(next.length)) old.remove();
}

/** Return words with their subscripts: S_DS is an S with a small DS. */
export function words(text) {
  const parts = text.split(/\b([A-Z])_(\w{1,3})\b/);
  return parts.map((part, k) => (k % 3 === 2 ? html("sub", {}, part) : part));
}

/** Set attributes of an element. */
export function set(element, attributes) {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
}

/** Return points as the attribute of a polygon. */
export function points(all) {
  return all.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");
}

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (name === "on") {
      for (const [event, listener] of Object.entries(value)) element.addEventListener(event, listener);
    } else if (value !== null && value !== undefined && value !== false) {
      element.setAttribute(name, value === true ? "" : value);
    }
  }
  element.append(...nodes(children));
  return element;
}

function nodes(children) {
  return children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false);
}
