// SPDX-License-Identifier: MIT
// After "MTL material format (Lightwave, OBJ)", Alias/Wavefront, in P. Bourke's transcription, 1995.
#include "common/scene/obj.h"

#include <array>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "common/scene/limits.h"
#include "common/scene/obj_text.h"

namespace sidelight {
namespace {

using glm::dvec3;

constexpr std::size_t kMaxMaterials = 1'000'000;

// A material as the file has it.
struct Entry {
  std::string name;
  Word at;  // of its newmtl
  dvec3 ka{0}, kd{0}, ks{0}, tf{0};
  bool has_tf = false;
  double ns = 1, ni = 1, illum = 2;
};

struct ColorStatement {
  std::string_view keyword;
  dvec3 Entry::*color;
};

struct NumberStatement {
  std::string_view keyword;
  double Entry::*number;
  Range range;
  bool whole;
};

constexpr std::array<ColorStatement, 4> kColors{
    {{"Ka", &Entry::ka}, {"Kd", &Entry::kd}, {"Ks", &Entry::ks}, {"Tf", &Entry::tf}}};
constexpr std::array<NumberStatement, 3> kNumbers{{{"Ns", &Entry::ns, {0, kMostShininess}, false},
                                                   {"Ni", &Entry::ni, {kLeastIor, kMostIor}, false},
                                                   {"illum", &Entry::illum, {0, 10}, true}}};

// What the illumination models mean here; the others (0, 1 and 2: local only) need nothing, 4, 8, 9 and 10
// are passed over.
bool mirrors(double illum) { return illum == 3 || illum == 5 || illum == 7; }
bool transmits(double illum) { return illum == 6 || illum == 7; }
bool is_known(double illum) { return illum <= 2 || mirrors(illum) || transmits(illum); }

class MtlReader {
 public:
  MtlReader(const std::string& path, std::string_view text) : reader_(path, text) {}

  MtlFile read() {
    for (Word keyword; reader_.next_statement(keyword);) read_statement(keyword);
    finish();
    if (!skipped_.kinds().empty()) file_.warnings.push_back(warning());
    return std::move(file_);
  }

 private:
  void read_statement(const Word& keyword) {
    if (keyword.text == "newmtl") return begin(keyword);
    if (entry_.name.empty()) reader_.fail(keyword, quoted(keyword) + " before the first newmtl");
    for (const ColorStatement& statement : kColors)
      if (keyword.text == statement.keyword) {
        entry_.*statement.color = color(keyword);
        if (statement.color == &Entry::tf) entry_.has_tf = true;
        return;
      }
    for (const NumberStatement& statement : kNumbers)
      if (keyword.text == statement.keyword) {
        entry_.*statement.number = number(keyword, statement);
        return;
      }
    skipped_.add(std::string(keyword.text), reader_, keyword);
  }

  void begin(const Word& keyword) {
    finish();
    entry_ = Entry();
    entry_.name = reader_.name(keyword).text;
    entry_.at = keyword;
  }

  // The entry that is open, if any, becomes a material.
  void finish() {
    if (entry_.name.empty()) return;
    if (!names_.insert(entry_.name).second)
      return skipped_.add("newmtl " + entry_.name + " again", reader_, entry_.at);
    if (file_.materials.size() == kMaxMaterials)
      reader_.fail(entry_.at, "more than " + std::to_string(kMaxMaterials) + " materials");
    const std::string illum = "illum " + std::to_string(static_cast<int>(entry_.illum));
    if (!is_known(entry_.illum)) skipped_.add(illum, reader_, entry_.at);
    if (transmits(entry_.illum) && !entry_.has_tf) skipped_.add(illum + " without Tf", reader_, entry_.at);

    Material material;
    material.name = entry_.name;
    material.ambient = entry_.ka;
    material.diffuse = entry_.kd;
    material.specular = entry_.ks;
    material.shininess = entry_.ns;
    material.ior = entry_.ni;
    if (mirrors(entry_.illum)) material.reflect = entry_.ks;
    if (transmits(entry_.illum)) material.refract = entry_.tf;
    file_.materials.push_back(std::move(material));
  }

  // Three numbers, or one for grey.
  dvec3 color(const Word& keyword) {
    std::array<double, 3> rgb{};
    const std::size_t count = reader_.numbers(keyword, rgb, {1, 3}, {0, kMostLight});
    return count == 1 ? dvec3(rgb[0]) : dvec3(rgb[0], rgb[1], rgb[2]);
  }

  double number(const Word& keyword, const NumberStatement& statement) {
    std::array<double, 1> value{};
    reader_.numbers(keyword, value, {1}, statement.range);
    if (statement.whole && value[0] != std::floor(value[0]))
      reader_.fail(keyword, std::string(keyword.text) + " must be a whole number");
    return value[0];
  }

  std::string warning() const {
    std::string names;
    for (const Skipped::Kind& kind : skipped_.kinds())
      names += (names.empty() ? "" : ", ") + printable(kind.name, 40);
    return located(skipped_.kinds().front().first,
                   "passed over: " + names + (skipped_.more() ? ", and more" : ""));
  }

  StatementReader reader_;
  MtlFile file_;
  Entry entry_;  // being read; none as long as its name is empty
  std::unordered_set<std::string> names_;
  Skipped skipped_;
};

}  // namespace

MtlFile read_mtl(const std::string& path, const SourceLocation& named_at) {
  const std::string text = read_text(path, named_at);
  return MtlReader(path, text).read();
}

}  // namespace sidelight
