// SPDX-License-Identifier: MIT
// The MTL reader: the mapping to the scene's materials, and every kind of mistake with its line and column.
#include "common/scene/obj.h"

#include <doctest/doctest.h>

#include "tests/scene/temp_folder.h"

using namespace sidelight;
using glm::dvec3;

namespace {

MtlFile parsed_mtl(const std::string& text) {
  const TempFolder folder;
  return read_mtl(folder.write("m.mtl", text), {"t.obj", 2, 8});
}

// What read_mtl throws, from the file's name on; empty for nothing.
std::string mistake_in_mtl(const std::string& text) {
  try {
    parsed_mtl(text);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("m.mtl"));
  }
  return "";
}

bool ends_with(const std::string& text, const std::string& end) { return text.ends_with(end); }

}  // namespace

TEST_CASE("mtl: coefficients as they are") {
  const MtlFile mtl = parsed_mtl(
      "# two materials\r\n"
      "newmtl red glass\r\n"
      "  Ka .1 .2 .3\r\n\tKd 0.5\r\nKs 1 2 3 # more than 1 is fine\r\nNs 32.5\r\nNi 1.5\r\nillum 2\r\n"
      "newmtl plain");
  CHECK(mtl.warnings.empty());
  REQUIRE(mtl.materials.size() == 2);
  const Material& m = mtl.materials[0];
  CHECK(m.name == "red glass");
  CHECK(m.ambient == dvec3(0.1, 0.2, 0.3));
  CHECK(m.diffuse == dvec3(0.5));
  CHECK(m.specular == dvec3(1, 2, 3));
  CHECK(m.shininess == 32.5);
  CHECK(m.ior == 1.5);
  CHECK(m.local == dvec3(1));
  CHECK(m.reflect == dvec3(0));
  CHECK(m.refract == dvec3(0));
  CHECK(m.casts_shadow);

  const Material& plain = mtl.materials[1];
  CHECK(plain.name == "plain");
  CHECK(plain.diffuse == dvec3(0));
  CHECK(plain.shininess == 1);
  CHECK(plain.ior == 1);
}

TEST_CASE("mtl: illum says which coefficients are mirrors and glass") {
  for (int illum = 0; illum <= 10; ++illum) {
    CAPTURE(illum);
    const MtlFile mtl =
        parsed_mtl("newmtl m\nillum " + std::to_string(illum) + "\nKs .1 .2 .3\nTf .4 .5 .6\n");
    const bool mirrors = illum == 3 || illum == 5 || illum == 7, transmits = illum == 6 || illum == 7;
    CHECK(mtl.materials.at(0).reflect == (mirrors ? dvec3(0.1, 0.2, 0.3) : dvec3(0)));
    CHECK(mtl.materials.at(0).refract == (transmits ? dvec3(0.4, 0.5, 0.6) : dvec3(0)));
    CHECK(mtl.materials.at(0).specular == dvec3(0.1, 0.2, 0.3));
    CHECK(mtl.warnings.size() == (illum == 4 || illum >= 8 ? 1 : 0));
  }
}

TEST_CASE("mtl: one warning names all that is passed over") {
  const MtlFile mtl = parsed_mtl(
      "newmtl a\nd 0.5\nmap_Kd wood.png\nKe 1 1 1\nillum 7\n"
      "newmtl b\nd 1\nTr 0\nillum 4\nnewmtl a\nKd 1\n");
  REQUIRE(mtl.warnings.size() == 1);
  CHECK(ends_with(mtl.warnings[0],
                  "m.mtl:2:1: passed over: d, map_Kd, Ke, illum 7 without Tf, Tr, illum 4, newmtl a again"));
  REQUIRE(mtl.materials.size() == 2);
  CHECK(mtl.materials[0].diffuse == dvec3(0));

  std::string text = "newmtl a\n";
  for (int i = 0; i < 17; ++i) text += "x" + std::to_string(i) + " 1\n";
  CHECK(ends_with(parsed_mtl(text).warnings.at(0), ", x14, x15, and more"));
}

TEST_CASE("mtl: mistakes name their line and column") {
  const std::vector<std::pair<std::string, std::string>> table{
      {"newmtl", "m.mtl:1:1: newmtl without a name"},
      {"\n Kd 1 1 1", "m.mtl:2:2: 'Kd' before the first newmtl"},
      {"map_Kd x.png", "m.mtl:1:1: 'map_Kd' before the first newmtl"},
      {"newmtl a\nKd", "m.mtl:2:1: Kd with 0 numbers, expected 1 or 3"},
      {"newmtl a\nKd 1 1", "m.mtl:2:1: Kd with 2 numbers, expected 1 or 3"},
      {"newmtl a\nKd 1 1 1 1", "m.mtl:2:10: '1' is one number too many for Kd, expected 1 or 3"},
      {"newmtl a\nKa 1 -.1 1", "m.mtl:2:6: Ka of '-.1', expected 0 to 1e+30"},
      {"newmtl a\nKd 1 1 1.1e30", "m.mtl:2:8: Kd of '1.1e30', expected 0 to 1e+30"},
      {"newmtl a\nKs nan", "m.mtl:2:4: 'nan' is not a finite number"},
      {"newmtl a\nKs spectral f.rfl", "m.mtl:2:4: 'spectral' is not a number"},
      {"newmtl a\nTf 1 1e999 1", "m.mtl:2:6: '1e999' is not a finite number"},
      {"newmtl a\nNs -1", "m.mtl:2:4: Ns of '-1', expected 0 to 1e+06"},
      {"newmtl a\nNs 1000001", "m.mtl:2:4: Ns of '1000001', expected 0 to 1e+06"},
      {"newmtl a\nNs", "m.mtl:2:1: Ns with 0 numbers, expected 1"},
      {"newmtl a\nNi 0.2", "m.mtl:2:4: Ni of '0.2', expected 0.25 to 4"},
      {"newmtl a\nNi 4.1", "m.mtl:2:4: Ni of '4.1', expected 0.25 to 4"},
      {"newmtl a\nNi inf", "m.mtl:2:4: 'inf' is not a finite number"},
      {"newmtl a\nillum 11", "m.mtl:2:7: illum of '11', expected 0 to 10"},
      {"newmtl a\nillum 2.5", "m.mtl:2:1: illum must be a whole number"},
  };
  for (const auto& [text, expected] : table) {
    CAPTURE(text);
    CHECK(mistake_in_mtl(text) == expected);
  }
}

TEST_CASE("mtl: a file that is not there is a mistake of the line that names it") {
  CHECK_THROWS_WITH_AS(read_mtl("/nowhere/m.mtl", {"t.obj", 2, 8}),
                       "t.obj:2:8: cannot read '/nowhere/m.mtl': No such file or directory", InputError);
}
