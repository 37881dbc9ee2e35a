// SPDX-License-Identifier: BSD-3-Clause
// Work in steps while the page is read: it gives way to the browser, and a bar shows how much is done.

const STEP = 50;  // milliseconds of work between two pictures of the bar

/** Runs a generator to its end, giving way from time to time; `tell` hears what it yields then. */
export async function finished(generator, tell = () => {}) {
  for (let pause = performance.now() + STEP;;) {
    const { done, value } = generator.next();
    if (done) return value;
    if (performance.now() < pause) continue;
    tell(value);
    await new Promise((resolve) => setTimeout(resolve));
    pause = performance.now() + STEP;
  }
}

/** The steps of a generator that yields parts of its work, 0 … 1, as steps from one part to another of a larger work. */
export function* between(from, to, generator) {
  for (;;) {
    const { done, value } = generator.next();
    if (done) return value;
    yield from + (to - from) * (value ?? 0);
  }
}

export class Loading {
  constructor(notice) {
    this.bar = notice.querySelector("progress");
    this.text = notice.querySelector("p");
    this.done = 0;
  }
  begin(total, text) {
    this.total = total;
    this.text.textContent = text;
  }
  /** Runs a generator that does so much of the total. */
  async run(share, generator) {
    const result = await finished(generator, (part) => this.show(this.done + share * (part ?? 0)));
    this.done += share;
    return result;
  }
  show(done) {
    this.bar.value = done / this.total;
  }
}
