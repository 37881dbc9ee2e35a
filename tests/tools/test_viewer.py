# SPDX-License-Identifier: BSD-3-Clause
"""Whether viewer/dist/viewer.html was made of the sources in viewer/ as they are, and is what the build expects. Without Node.

  python3 tests/tools/test_viewer.py [unittest arguments]
"""
import hashlib
import json
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
VIEWER = ROOT / "viewer"
PAGE = (VIEWER / "dist" / "viewer.html").read_bytes().decode()


class Page(unittest.TestCase):
    def test_is_made_of_these_sources(self):
        """Otherwise `make viewer` was forgotten."""
        names = ["build.mjs", "package-lock.json", "package.json", *("src/" + path.name for path in (VIEWER / "src").iterdir())]
        digest = hashlib.sha256()
        for name in sorted(names):
            digest.update(f"{name}\n".encode() + (VIEWER / name).read_bytes())
        self.assertIn(f"Sources: {digest.hexdigest()} -->", PAGE)

    def test_can_be_split_into_literals(self):
        self.assertTrue(PAGE.isascii())
        self.assertEqual(PAGE.count("<!--delone:data-->\n"), 1)
        self.assertNotIn(')delone_page"', PAGE)

    def test_needs_no_network(self):
        scripts = re.findall(r"<script[^>]*>", PAGE)
        self.assertEqual(scripts, ["<script>"])
        self.assertEqual(re.findall(r"<link\b|@import|url\(", PAGE.split("<script>")[0]), [])

    def test_license_of_three_js_is_told(self):
        self.assertIn("Copyright (c) 2010-2026 three.js authors", PAGE)
        version = json.loads((VIEWER / "package.json").read_text())["devDependencies"]["three"]
        self.assertIn(f'"{version.split(".")[1]}"', PAGE)
        self.assertIn("The above copyright notice and this permission notice shall be included", PAGE)
        self.assertRegex((ROOT / "THIRD_PARTY_LICENSES").read_text(), r"three\.js +MIT License")


if __name__ == "__main__":
    unittest.main()
