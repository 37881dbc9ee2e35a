#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the npm package: in Node and in Chromium, against the native library; its types; the examples of docs/js.md.

Usage: run.py PACKAGE BUILD_DIR     PACKAGE: build/js/delone; BUILD_DIR: the native library and the command
"""
import functools
import gzip
import http.server
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import threading

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "site"), str(ROOT / "tests" / "js")]
LARGEST = 3 * 1000 * 1000  # bytes of the compressed module


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm", ".mjs": "text/javascript"}

    def log_message(self, *arguments):
        pass


def in_node(package, reference):
    environment = {**os.environ, "PACKAGE": str(package), "REFERENCE": str(reference)}
    return subprocess.run(["node", "--test", "tests/js/package_test.mjs"], cwd=ROOT, env=environment, check=False).returncode == 0


def in_chromium(package, reference):
    from selenium.webdriver.support.ui import WebDriverWait

    from chromium import start, stop
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=str(ROOT)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    browser, profile = start(["--disable-gpu"])
    try:
        browser.get(f"http://127.0.0.1:{server.server_port}/tests/js/page.html?package=/{package.relative_to(ROOT)}/&reference=/{reference.relative_to(ROOT)}")
        WebDriverWait(browser, 300).until(lambda one: one.execute_script("return window.results !== undefined"))
        results = browser.execute_script("return window.results")
        complaints = browser.get_log("browser")
    finally:
        stop(browser, profile)
        server.shutdown()
    failed = [f"{name}: {failure}" for name, failure in results if failure] + [str(one["message"]) for one in complaints if "favicon" not in one["message"]]
    print("\n".join(failed))
    print(f"In Chromium:\n{len(results) - len(failed)} passed, {len(failed)} failed")
    return not failed and len(results) > 100


def is_small(package):
    content = (package / "module.wasm").read_bytes()
    sizes = {"as it is": len(content), "by gzip": len(gzip.compress(content, 9))}
    if shutil.which("brotli"):
        sizes["by brotli"] = len(subprocess.run(["brotli", "-c", "-q", "11", "-w", "24", str(package / "module.wasm")], stdout=subprocess.PIPE, check=True).stdout)
    print("module.wasm: " + ", ".join(f"{size} bytes {how}" for how, size in sizes.items()))
    return sizes["by gzip"] <= LARGEST


def types_name_all_members(package):
    """Whether index.d.ts has the members of each class, and no others."""
    text = (package / "index.d.ts").read_text(encoding="utf-8")
    classes = {name: (base, set(re.findall(r"^  readonly (\w+)\??:", body, re.M)))
               for name, base, body in re.findall(r"^(?:export|declare) class (\w+)(?: extends (\w+))? \{(\}|.*?^\})$", text, re.M | re.S)}

    def all_of(name):
        base, own = classes.get(name, ("", set()))
        return own | all_of(base) if name in classes else own

    program = f"""
      import * as d from "{(package / 'node.js').as_uri()}";
      const x = [[0, 0], [4, 0], [5, 3], [1, 4], [2, 2]], t = new d.Delaunay(x), r = new d.Regular(x, [0, 0, 0, 0, 0]), f = new d.FurthestSite(x);
      const hull = new d.ConvexHull(x, 2), box = new d.HalfspaceIntersection([[1, 0, -1], [-1, 0, -1], [0, 1, -1], [0, -1, -1]]), v = new d.Voronoi(t);
      const all = [t, r, f, hull, box, v, new d.PowerDiagram(r), new d.FurthestVoronoi(f), t.alphaComplex(9), t.trim(0.1), t.check(), t.siteCells({{low: [0, 0], high: [9, 9], vertices: true}}),
        t.linearInterpolator([1, 2, 3, 4, 5]), new d.LowerHull(x), new d.UpperHull(x), new d.ConvexHulls(x, [0, 5]),
        ...[t, hull, box, v].map((one) => d.read(one.toBytes("npz"), "one.npz"))];
      console.log(JSON.stringify(all.map((o) => [o.constructor.name, [...Object.keys(o.constructor.prototype), ...Object.keys(o)]])));
    """
    found = subprocess.run(["node", "--input-type=module", "-e", program], stdout=subprocess.PIPE, check=True, text=True).stdout
    good = True
    for name, members in json.loads(found):
        if set(members) != all_of(name):
            print(f"index.d.ts, {name}: lacks {sorted(set(members) - all_of(name))}, has besides {sorted(all_of(name) - set(members))}")
            good = False
    return good


def types_are_checked(package):
    """Whether TypeScript takes and refuses what types.ts says."""
    folder = package.parent / "types"
    (folder / "node_modules").mkdir(parents=True, exist_ok=True)
    (folder / "node_modules/delone").unlink(missing_ok=True)
    (folder / "node_modules/delone").symlink_to(package)
    shutil.copy2(ROOT / "tests/js/types.ts", folder)
    command = ["tsc", "--noEmit", "--strict", "--target", "es2022", "--module", "es2022", "--moduleResolution", "node", "types.ts"]
    return subprocess.run(command, cwd=folder, check=False).returncode == 0


def main():
    package, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    reference = package.parent / "reference.json"
    subprocess.run(["/usr/bin/python3", "-B", "tests/js/reference.py", str(build / "libdelone_c.so"), str(reference)], cwd=ROOT, check=True)
    passed = {
        "Node": in_node(package, reference),
        "Chromium": in_chromium(package, reference),
        "members in index.d.ts": types_name_all_members(package),
        "types.ts": types_are_checked(package),
        "size": is_small(package),
        "docs/js.md": subprocess.run([sys.executable, "-B", "tools/check_docs.py", build, "--js", package, "--only", "docs/js.md"], cwd=ROOT,
                                     check=False).returncode == 0,
    }
    for name, good in passed.items():
        print(f"{name}: {'passed' if good else 'FAILED'}")
    sys.exit(not all(passed.values()))


if __name__ == "__main__":
    main()
