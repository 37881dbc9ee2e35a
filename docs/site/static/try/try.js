// SPDX-License-Identifier: BSD-3-Clause
// The page to try delone. The computation is the worker's, so that the page can stop it.
const element = (name) => document.getElementById(`try-${name}`);
const form = document.getElementById("try");
const number = new Intl.NumberFormat("en");
let worker, file = null, urls = [];

function say(message, isError = false) {
  element("message").textContent = message;
  element("message").classList.toggle("error", isError);
}

function setBusy(busy) {
  form.setAttribute("aria-busy", String(busy));
  element("start").disabled = busy;
  element("stop").hidden = element("progress").hidden = !busy;
  element("progress").removeAttribute("value");
}

const handlers = {
  ready() {
    setBusy(false);
    say("");
  },
  unable({ message }) {
    say(message, true);
  },
  progress({ fraction }) {
    element("progress").value = fraction;
  },
  failure({ message }) {
    setBusy(false);
    say(message, true);
  },
  result({ summary, page, files }) {
    setBusy(false);
    say(summary);
    const url = (content, type) => {
      urls.push(URL.createObjectURL(new Blob([content], { type })));
      return urls.at(-1);
    };
    element("view").hidden = page === null;
    if (page !== null) element("view").src = url(page, "text/html");
    element("downloads").replaceChildren("Download: ", ...files.flatMap(([name, content]) => {
      const link = document.createElement("a");
      Object.assign(link, { href: url(content, "application/octet-stream"), download: name, textContent: name });
      return [link, " "];
    }));
    element("downloads").hidden = false;
  },
};

function startWorker() {
  worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
  worker.onmessage = ({ data }) => handlers[data.event](data);
  worker.onerror = () => {
    say("This page computes only if a web server has sent it: python3 -m http.server, for instance, in the folder of the site.", true);
  };
}

function take(chosen) {
  file = chosen;
  element("name").textContent = `${chosen.name}, ${number.format(chosen.size)} bytes`;
  element("points").value = "";
}

/** The text as a file: csv if its lines have commas. */
function pasted() {
  const text = element("points").value, table = text.includes(",") || text.includes(";");
  return { name: table ? "pasted.csv" : "pasted.txt", content: new TextEncoder().encode(text) };
}

element("file").addEventListener("change", ({ target }) => target.files.length > 0 && take(target.files[0]));
element("points").addEventListener("input", () => {
  file = null;
  element("file").value = element("name").textContent = "";
});
for (const kind of ["dragenter", "dragover", "dragleave", "drop"])
  form.addEventListener(kind, (event) => {
    event.preventDefault();
    form.classList.toggle("over", kind === "dragenter" || kind === "dragover");
    if (kind === "drop" && event.dataTransfer.files.length > 0) take(event.dataTransfer.files[0]);
  });
element("product").addEventListener("change", ({ target }) => (element("radius-label").hidden = target.value !== "alpha"));
element("stop").addEventListener("click", () => {
  worker.terminate();
  say("Stopped.");
  startWorker();
});
form.addEventListener("submit", async (event) => {
  event.preventDefault();
  setBusy(true);
  say("");
  urls.forEach((url) => URL.revokeObjectURL(url));
  urls = [];
  const { name, content } = file ? { name: file.name, content: new Uint8Array(await file.arrayBuffer()) } : pasted();
  const radius = element("radius").value === "" ? null : element("radius").valueAsNumber;
  worker.postMessage({ name, content, product: element("product").value, radius }, [content.buffer]);
});

startWorker();
