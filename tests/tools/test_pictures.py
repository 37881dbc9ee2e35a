# SPDX-License-Identifier: BSD-3-Clause
"""Whether the pictures of the documentation show what there is, and whether a change is noticed.

  python3 tests/tools/test_pictures.py [unittest arguments]
"""
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import pictures  # noqa: E402


class Pictures(unittest.TestCase):
    def test_are_fresh(self):
        self.assertEqual(pictures.stale(), [], "make docs makes them again")

    def test_a_changed_input_is_noticed(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            inputs = {program: [program, *of] for program, (of, _) in pictures.PROGRAMS.items()}
            for name in {str(pictures.RECORD), *(name for names in inputs.values() for name in names)}:
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, root / name)
            self.assertEqual(pictures.stale(root), [])
            for name in {name for names in inputs.values() for name in names}:
                content = (root / name).read_bytes()
                (root / name).write_bytes(content + b"\n")
                self.assertEqual(pictures.stale(root), [program for program, names in inputs.items() if name in names], name)
                (root / name).write_bytes(content)
            self.assertEqual(pictures.stale(root), [])

    def test_all_data_are_inputs(self):
        used = set()
        for program in pictures.PROGRAMS:
            text = (ROOT / program).read_text(encoding="utf-8")
            used.update(re.findall(r'"(data/\w+\.csv)"', text), (f"data/{name}.csv" for name in re.findall(r'\bread\("(\w+)"\)', text)))
        self.assertGreaterEqual(len(used), 2)
        for _, (inputs, _) in pictures.PROGRAMS.items():
            self.assertLessEqual(used, set(inputs))


if __name__ == "__main__":
    unittest.main()
