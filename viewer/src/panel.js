// SPDX-License-Identifier: BSD-3-Clause
// The settings beside the picture, made of plain form elements, so that keyboards and screen readers know them.

function element(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

/** A number as a legend shows it. */
export function shown(value) {
  if (!Number.isFinite(value)) return "none";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(2).replace("e+", "e");
  return String(Number(value.toPrecision(4)));
}

/** Digits in groups of three. */
export const counted = (count, one, many = one + "s") => `${count.toLocaleString("en").replaceAll(",", "\u202f")} ${count === 1 ? one : many}`;

export class Panel {
  constructor(form) {
    this.form = form;
  }
  group(title) {
    this.set = element("fieldset", {}, element("legend", { textContent: title }));
    this.form.append(this.set);
    return this.set;
  }
  /** `choices`: [value, text] pairs. */
  select(text, id, choices, value, changed) {
    const select = element("select", { id });
    for (const [choice, name] of choices) select.append(element("option", { value: choice, textContent: name }));
    select.value = value;
    select.addEventListener("change", () => changed(select.value));
    this.set.append(element("label", {}, element("span", { textContent: text }), select));
    return select;
  }
  check(text, id, value, changed) {
    const box = element("input", { type: "checkbox", id, checked: value });
    box.addEventListener("change", () => changed(box.checked));
    this.set.append(element("label", { className: "check" }, box, element("span", { textContent: text, style: "flex: 1; color: inherit" })));
    return box;
  }
  range(text, id, value, changed) {
    const range = element("input", { type: "range", id, min: 0, max: 1000, value });
    range.addEventListener("input", () => changed(Number(range.value) / 1000));
    this.set.append(element("label", {}, element("span", { textContent: text }), range));
    return range;
  }
  output(id) {
    const output = element("output", { id });
    this.set.append(output);
    return output;
  }
  buttons(...buttons) {
    const row = element("div", { className: "buttons" });
    for (const [text, id, pressed] of buttons) {
      const button = element("button", { type: "button", id, textContent: text });
      button.addEventListener("click", pressed);
      row.append(button);
    }
    this.set.append(row);
  }
  note(text) {
    this.form.append(element("p", { className: "note", textContent: text }));
  }
}
