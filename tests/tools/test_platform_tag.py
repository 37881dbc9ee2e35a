# SPDX-License-Identifier: BSD-3-Clause
"""tools/platform_tag.py on what objdump prints, and on wheels whose names claim too much.

  python3 tests/tools/test_platform_tag.py [unittest arguments]
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import platform_tag  # noqa: E402
import release  # noqa: E402

PRINTED = """
module.so:     file format elf64-x86-64

Dynamic Section:
  NEEDED               libhwy.so.1
  NEEDED               libstdc++.so.6
  NEEDED               ld-linux-x86-64.so.2
  RPATH                $ORIGIN

Version definitions:
1 0x01 0x0b7e32cc GLIBC_9.9

Version References:
  required from libstdc++.so.6:
    0x0297f869 0x00 11 GLIBCXX_3.4.9
    0x0297f861 0x00 10 GLIBCXX_3.4.29
  required from libhwy.so.1:
    0x0a2d1240 0x00 09 HWY_0
  required from libc.so.6:
    0x069691b4 0x00 02 GLIBC_2.14
"""


class PlatformTag(unittest.TestCase):
    def lowest(self, *versions, libraries=("libc.so.6",), bundled=()):
        text = "Version References:\n  required from libc.so.6:\n" + "".join(f"    0x069691b4 0x00 02 {version}\n" for version in versions)
        needs = platform_tag.read(text)
        return platform_tag.lowest_policy([platform_tag.Needs(set(libraries), needs.versions)], bundled)

    def test_what_objdump_prints(self):
        needs = platform_tag.read(PRINTED)
        self.assertEqual(needs.libraries, {"libhwy.so.1", "libstdc++.so.6", "ld-linux-x86-64.so.2"})
        self.assertEqual(needs.highest(), {"GLIBCXX": (3, 4, 29), "HWY": (0,), "GLIBC": (2, 14)})

    def test_every_family_counts(self):
        self.assertEqual(self.lowest(), (2, 17))
        self.assertEqual(self.lowest("GLIBC_2.17", "GLIBCXX_3.4.19"), (2, 17))
        self.assertEqual(self.lowest("GLIBC_2.17", "GLIBCXX_3.4.20"), (2, 24))
        self.assertEqual(self.lowest("GLIBC_2.2.5", "GLIBC_2.29"), (2, 31))
        self.assertEqual(self.lowest("CXXABI_1.3.13"), (2, 34))
        self.assertEqual(self.lowest("CXXABI_1.3", "GCC_12.0.0"), (2, 39))
        self.assertEqual(self.lowest("GLIBC_2.35"), (2, 35))
        self.assertEqual(self.lowest("GLIBC_ABI_DT_RELR"), (2, 36))

    def test_what_has_no_tag(self):
        for versions in (["GLIBC_9.0"], ["GLIBCXX_4.0"], ["GLIBC_PRIVATE"]):
            with self.assertRaises(ValueError, msg=versions):
                self.lowest(*versions)

    def test_libraries(self):
        self.assertEqual(self.lowest(libraries=("libc.so.6", "ld-linux-aarch64.so.1", "libstdc++.so.6", "libgcc_s.so.1")), (2, 17))
        self.assertEqual(self.lowest(libraries=("libhwy.so.1",), bundled=("libhwy.so.1",)), (2, 17))
        self.assertEqual(self.lowest(libraries=("libz.so.1",)), (2, 17))
        for name in ("libhwy.so.1", "libzstd.so.1", "libcurl.so.4", "libc.musl-x86_64.so.1", "libmagic.so.1"):
            with self.assertRaisesRegex(ValueError, f"{name} is neither"):
                self.lowest(libraries=(name,))

    def test_policies_grow(self):
        for (earlier, before), (later, after) in zip(platform_tag.POLICIES, platform_tag.POLICIES[1:]):
            self.assertLess(earlier, later)
            self.assertEqual(after["GLIBC"], later)
            for family, version in before.items():
                self.assertLessEqual(version, after[family])

    @unittest.skipUnless(shutil.which("objdump") and sys.platform == "linux", "needs objdump and Linux")
    def test_wheels_that_claim_too_much(self):
        libc = next((line.split()[-1] for line in pathlib.Path("/proc/self/maps").read_text().splitlines() if line.endswith("/libm.so.6")), None)
        if not libc:
            self.skipTest("this Python has no libm.so.6")
        found, why = platform_tag.tag([libc], "x86_64")
        self.assertIsNotNone(why)  # libm needs private symbols of libc, which no tag allows
        self.assertEqual(found, "linux_x86_64")
        with tempfile.TemporaryDirectory() as folder:
            for name, faults in (("a-1-cp311-cp311-manylinux_2_17_x86_64.whl", "the name of the wheel says manylinux_2_17_x86_64"),
                                 ("a-1-cp311-cp311-linux_x86_64.whl", "is for systems like this one only")):
                wheel = pathlib.Path(folder) / name
                with zipfile.ZipFile(wheel, "w") as archive:
                    archive.write(libc, "a/a.so")
                self.assertRegex(" ".join(release.platform_faults(wheel)), faults)
            with zipfile.ZipFile(wheel, "w") as archive:
                archive.writestr("a/a.py", "")
            self.assertEqual(release.platform_faults(wheel), [])
            text = wheel.with_name("a-1-cp311-cp311-linux_x86_64.whl")
            with zipfile.ZipFile(text, "w") as archive:
                archive.writestr("a/a.so", "no library")
            done = subprocess.run([sys.executable, "-B", ROOT / "tools" / "platform_tag.py", text], capture_output=True, text=True)
            self.assertRegex(done.stdout, "linux_x86_64: .*not recognized")


if __name__ == "__main__":
    unittest.main()
