# SPDX-License-Identifier: BSD-3-Clause
"""What tools/make_site.py and docs/site/conf.py do to pages and docstrings, without Sphinx and Doxygen.

  python3 tests/tools/test_site.py [unittest arguments]
"""
import importlib.util
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import make_site  # noqa: E402

specification = importlib.util.spec_from_file_location("conf", ROOT / "docs" / "site" / "conf.py")
conf = importlib.util.module_from_spec(specification)
specification.loader.exec_module(conf)


class Pages(unittest.TestCase):
    def test_places(self):
        for name, expected in {"README.md": "readme.md", "docs/guide.md": "guide.md", "docs/site/index.md": "index.md", "SECURITY.md": "SECURITY.md",
                               "docs/decisions/0001-a.md": "decisions/0001-a.md", "data/README.md": "data/README.md"}.items():
            self.assertEqual(make_site.place(ROOT / name), expected)

    def test_comments_of_c_become_prose(self):
        text = make_site.prose_of_comment("/* Ends a delone_object* and `its` a_b[1].\n *\n *   integer  seed 0\n * The end. */")
        self.assertEqual(text, "\nEnds a `delone_object*` and `its` a\\_b\\[1].\n\n```text\n  integer  seed 0\n```\n\nThe end.\n")

    def test_links_are_rewritten(self):
        pages = {}
        text = make_site.rewritten(ROOT / "README.md", pages)
        self.assertIn("](guide.md)", text)
        self.assertIn("](decisions/index.md)", text)
        self.assertIn("](examples/index.md)", text)
        self.assertIn("](pictures/overview.png)", text)
        self.assertIn("](tools/install_dependencies.sh)", text)
        self.assertIn("](https://hal.inria.fr/inria-00343188)", text)
        self.assertIn(ROOT / "docs" / "pictures" / "overview.png", pages)
        self.assertIn("](data/README.md)", make_site.rewritten(ROOT / "docs" / "guide.md", pages))
        self.assertIn("](guide.md#hulls-in-c)", make_site.front_page(ROOT / "docs" / "site" / "index.md", pages))
        self.assertIn("](#convex-hulls)", make_site.rewritten(ROOT / "docs" / "guide.md", pages))

    def test_code_is_left_alone(self):
        code = "\n\n```text\n[a](tiles.md)\n```\n"
        self.assertEqual(make_site.rewritten(ROOT / "docs" / "decisions" / "a.md", {}, "[a](../tiles.md)" + code), "[a](../tiles.md)" + code)
        code = code.replace("](", "](docs/")
        self.assertEqual(make_site.rewritten(ROOT / "README.md", {}, "[a](docs/tiles.md)" + code), "[a](tiles.md)" + code)

    def test_broken_links_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            site = pathlib.Path(folder)
            (site / "b").mkdir()
            (site / "index.html").write_text('<a href="b/c.html#x">1</a><a href="b/c.html#y">2</a><a href="d.html">3</a>'
                                             '<a href="https://e.org/d.html">4</a><a href="#z">5</a><img src="f.png"><h1 id="t">6</h1><a href="#t">7</a><a href="b/c.html?q=1#x">8</a>')
            (site / "b" / "c.html").write_text('<a name="x"></a><a href="../index.html#t">1</a><a href="../">2</a>')
            self.assertEqual(list(make_site.broken_links(site)), ["index.html: b/c.html has no anchor #y", "index.html: there is no d.html",
                                                                  "index.html: index.html has no anchor #z", "index.html: there is no f.png"])


class Docstrings(unittest.TestCase):
    def rst(self, text):
        lines = text.split("\n")
        conf.docstring(None, "method", "delone.A.b", None, None, lines)
        return "\n".join(lines)

    def test_signatures_of_pybind11_are_left_out(self):
        self.assertEqual(self.rst("b(self: delone._core.A, x: object) -> None\n\nDoes b.").strip(), "Does b.")

    def test_pages_are_linked(self):
        self.assertEqual(self.rst("See docs/tiles.md, `docs/tiles.md`."), "See :doc:`/tiles`, `docs/tiles.md`.")

    def test_fields_of_tuples_have_no_text(self):
        self.assertEqual(self.rst("Alias for field number 0"), "")

    def test_signatures_of_the_stub(self):
        arguments, result = conf.STUB["Delaunay"]
        self.assertIn("points: npt.ArrayLike, *, ", arguments)
        self.assertEqual(conf.shortened("Optional[npt.NDArray[np.bool_]]"), "Optional[NDArray[bool_]]")


if __name__ == "__main__":
    unittest.main()
