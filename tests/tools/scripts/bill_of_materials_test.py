"""tools/bill_of_materials names what is linked. Run by ctest: bill_of_materials_test.py FOLDER_OF_THE_PROJECT BUILD"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(2)).resolve()
ROOT = pathlib.Path(sys.argv.pop(1)).resolve()


class BillOfMaterials(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "bill.json"
            subprocess.run([ROOT / "tools/bill_of_materials", "--build", BUILD, "-o", file], check=True,
                           stdout=subprocess.DEVNULL)
            cls.bill = json.loads(file.read_text())
        cls.packages = {package["name"]: package for package in cls.bill["packages"]}

    def test_has_what_spdx_asks_of_every_package(self):
        self.assertEqual(self.bill["spdxVersion"], "SPDX-2.3")
        identifiers = [package["SPDXID"] for package in self.bill["packages"]]
        self.assertEqual(len(identifiers), len(set(identifiers)))
        for package in self.bill["packages"]:
            self.assertRegex(package["SPDXID"], r"^SPDXRef-[A-Za-z0-9.-]+$")
            self.assertTrue(package["versionInfo"] and package["licenseDeclared"], package["name"])
        for relation in self.bill["relationships"]:
            for end in ("spdxElementId", "relatedSpdxElement"):
                self.assertIn(relation[end], identifiers + ["SPDXRef-DOCUMENT"])

    def test_explains_every_licence_that_spdx_does_not_know(self):
        named = set(re.findall(r"LicenseRef-[A-Za-z0-9.-]+", json.dumps(self.bill["packages"])))
        explained = {licence["licenseId"] for licence in self.bill["hasExtractedLicensingInfos"]}
        self.assertEqual(named, explained)

    def test_names_headers_libraries_and_what_was_fetched(self):
        for name, licence in (("libeigen3-dev", "MPL-2.0"), ("nlohmann-json3-dev", "MIT"),
                              ("libhdf5-103-1", "BSD-3-Clause"), ("mujoco-core", "Apache-2.0")):
            self.assertEqual(self.packages[name]["licenseDeclared"], licence)

    def test_leaves_no_directly_linked_library_out(self):
        needed = re.findall(r"\(NEEDED\).*\[(.+)\]",
                            subprocess.run(["readelf", "-d", BUILD / "warmjoint"], check=True, text=True,
                                           capture_output=True).stdout)
        self.assertGreater(len(needed), 10)
        linked = {relation["relatedSpdxElement"] for relation in self.bill["relationships"]
                  if relation["relationshipType"] == "DYNAMIC_LINK"}
        for soname in needed:
            if soname.startswith("libmujoco"):
                continue
            answer = subprocess.run(["dpkg-query", "-S", f"*/{soname}"], text=True, capture_output=True).stdout
            owners = {line.split(":")[0] for line in answer.splitlines()}
            self.assertTrue({f"SPDXRef-{re.sub('[^A-Za-z0-9.-]', '-', owner)}" for owner in owners} & linked, soname)


if __name__ == "__main__":
    unittest.main()
