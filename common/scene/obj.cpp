// SPDX-License-Identifier: MIT
// After "Object Files (.obj)", Alias/Wavefront, Appendix B1 of the Advanced Visualizer manual. Departures:
// polygons only; an index may not point at what comes later in the file; # begins a comment anywhere between
// words.
#include "common/scene/obj.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <new>
#include <unordered_map>
#include <utility>

#include "common/scene/limits.h"
#include "common/scene/nearest_name.h"
#include "common/scene/obj_text.h"

namespace sidelight {
namespace {

using glm::dvec3;

constexpr std::size_t kMaxLibraries = 64;  // of a file

class ObjReader {
 public:
  ObjReader(const std::string& path, std::string_view text, bool with_materials)
      : path_(path), reader_(path, text), with_materials_(with_materials) {
    obj_.files.push_back(path);
  }

  ObjFile read() {
    for (Word keyword; reader_.next_statement(keyword);) read_statement(keyword);
    if (!is_obj_ && !skipped_.kinds().empty())
      throw InputError(
          skipped_.kinds().front().first,
          "not one statement of a Wavefront OBJ file, expected v and f; no other kind of mesh is read");
    for (const Skipped::Kind& kind : skipped_.kinds())
      obj_.warnings.push_back(located(kind.first, kind.name + " skipped, here and from here on"));
    if (skipped_.more())
      obj_.warnings.push_back(located({path_, 0, 0}, "more kinds of statements were skipped"));
    return std::move(obj_);
  }

 private:
  struct Statement {
    std::string_view keyword;
    void (ObjReader::*read)(const Word& keyword);
  };

  void read_statement(const Word& keyword) {
    static constexpr std::array<Statement, 9> kStatements{{{"v", &ObjReader::read_position},
                                                           {"f", &ObjReader::read_face},
                                                           {"vn", &ObjReader::read_normal},
                                                           {"vt", &ObjReader::read_texture},
                                                           {"usemtl", &ObjReader::read_use},
                                                           {"mtllib", &ObjReader::read_libraries},
                                                           {"o", &ObjReader::read_nothing},
                                                           {"g", &ObjReader::read_nothing},
                                                           {"s", &ObjReader::read_nothing}}};
    for (const Statement& statement : kStatements)
      if (keyword.text == statement.keyword) {
        is_obj_ = true;
        return (this->*statement.read)(keyword);
      }
    skipped_.add(quoted(keyword) + " statements are", reader_, keyword);
  }

  void read_nothing(const Word&) {}

  // --- Vertices ---

  void read_position(const Word& keyword) {
    std::array<double, 7> v{};  // x y z [w] [r g b]
    if (reader_.numbers(keyword, v, {3, 4, 6, 7}) > 3)
      skipped_.add("numbers of v after x y z are", reader_, keyword);
    obj_.mesh.positions.emplace_back(v[0], v[1], v[2]);
  }

  void read_normal(const Word& keyword) {
    std::array<double, 3> n{};
    reader_.numbers(keyword, n, {3});
    obj_.mesh.normals.emplace_back(n[0], n[1], n[2]);
  }

  void read_texture(const Word& keyword) {
    std::array<double, 3> uvw{};
    reader_.numbers(keyword, uvw, {1, 2, 3});
    ++textures_;
  }

  // --- Faces ---

  void read_face(const Word& keyword) {
    PolygonMesh& mesh = obj_.mesh;
    PolygonMesh::Face face;
    face.first = static_cast<std::uint32_t>(mesh.corners.size());
    face.line = keyword.line;
    face.column = keyword.column;
    for (Word word; reader_.next_word(word); ++face.count) {
      if (face.count == kMaxCorners)
        reader_.fail(word, "a face of more than " + std::to_string(kMaxCorners) + " corners");
      mesh.corners.push_back(read_corner(word));
      if ((mesh.corners.back().normal == kNone) != (mesh.corners[face.first].normal == kNone))
        reader_.fail(word, "some corners of the face have a normal and some have none");
    }
    if (face.count < 3)
      reader_.fail(keyword, "a face of " + std::to_string(face.count) + " corners, expected at least 3");
    face.material = face_material();
    mesh.faces.push_back(face);
  }

  // v, v/vt, v//vn or v/vt/vn
  PolygonMesh::Corner read_corner(const Word& word) {
    std::array<Word, 3> part;
    std::size_t parts = 0;
    for (std::size_t from = 0; from != std::string_view::npos; ++parts) {
      if (parts == part.size()) fail_corner(word, word);
      const std::size_t slash = word.text.find('/', from);
      part[parts] = {word.text.substr(from, slash - from), word.line, word.column + static_cast<int>(from)};
      from = slash == std::string_view::npos ? slash : slash + 1;
    }
    PolygonMesh::Corner corner;
    corner.position = read_index(word, part[0], "v", obj_.mesh.positions.size());
    const bool has_texture = parts == 2 || (parts == 3 && !part[1].text.empty());
    if (has_texture) read_index(word, part[1], "vt", textures_);
    if (parts == 3) corner.normal = read_index(word, part[2], "vn", obj_.mesh.normals.size());
    return corner;
  }

  // From 1, or from -1 backwards, into what has been read so far; returns it from 0.
  std::uint32_t read_index(const Word& corner, const Word& word, const char* of, std::size_t count) const {
    long long index = 0;
    if (!parse_integer(word.text, index)) fail_corner(corner, word);
    const auto n = static_cast<long long>(count);
    if (index == 0 || index > n || index < -n)
      reader_.fail(word, "index " + quoted(word) + " of " + of + ", expected " +
                             (n == 0 ? "none, since there is no " + std::string(of) + " before this line"
                                     : "1 to " + std::to_string(n) + " or -" + std::to_string(n) + " to -1"));
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : n + index);
  }

  [[noreturn]] void fail_corner(const Word& corner, const Word& at) const {
    reader_.fail(at,
                 quoted(corner) + " is not a corner, expected v, v/vt, v//vn or v/vt/vn in whole numbers");
  }

  // --- Materials ---

  void read_libraries(const Word& keyword) {
    if (!with_materials_) return;
    std::vector<Word> words;
    for (Word word; reader_.next_word(word);) {
      if (words.size() == kMaxLibraries) fail_libraries(word);
      words.push_back(word);
    }
    if (words.empty()) reader_.fail(keyword, "mtllib without a file");
    // Blanks separate names, but exporters write names with blanks, too.
    const std::string_view first = words.front().text, last = words.back().text;
    const std::string_view all(first.data(),
                               static_cast<std::size_t>(last.data() + last.size() - first.data()));
    std::error_code ignored;
    if (words.size() > 1 && std::filesystem::is_regular_file(beside(all), ignored))
      words = {{all, words.front().line, words.front().column}};
    for (const Word& word : words) read_library(word);
  }

  void read_library(const Word& word) {
    const std::string path = beside(word.text);
    if (std::find(obj_.files.begin(), obj_.files.end(), path) != obj_.files.end()) return;
    if (obj_.files.size() > kMaxLibraries) fail_libraries(word);  // the first is the mesh
    MtlFile mtl = read_mtl(path, reader_.where(word));
    obj_.files.push_back(path);
    obj_.warnings.insert(obj_.warnings.end(), mtl.warnings.begin(), mtl.warnings.end());
    for (Material& material : mtl.materials) {
      const auto number = static_cast<std::uint32_t>(library_.size());
      if (!library_number_.emplace(material.name, number).second) {
        skipped_.add("materials that an earlier file defines are", reader_, word);
        continue;
      }
      library_.push_back(std::move(material));
      used_as_.push_back(kNone);
    }
  }

  [[noreturn]] void fail_libraries(const Word& word) const {
    reader_.fail(word, "more than " + std::to_string(kMaxLibraries) + " material files");
  }

  // A file's path from the OBJ's folder.
  std::string beside(std::string_view name) const {
    return (std::filesystem::path(path_).parent_path() / std::string(name)).string();
  }

  void read_use(const Word& keyword) {
    if (!with_materials_) return;
    const Name name = reader_.name(keyword);
    const auto found = library_number_.find(name.text);
    if (found == library_number_.end())
      reader_.fail(name.at, "unknown material '" + printable(name.text, 60) + "', " + suggestion(name.text));
    current_ = found->second;
  }

  std::string suggestion(const std::string& name) const {
    std::vector<std::string_view> known;
    for (const Material& material : library_) known.push_back(material.name);
    if (known.empty()) return "and no mtllib before this line defines any";
    return "the nearest is '" + printable(std::string(nearest_name(name, known)), kNameInMessage) + "'";
  }

  // The current material's number in the result, which it enters with its first face.
  std::uint32_t face_material() {
    if (current_ == kNone) return kNone;
    std::uint32_t& number = used_as_[current_];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(obj_.materials.size());
      obj_.materials.push_back(library_[current_]);
    }
    return number;
  }

  std::string path_;
  StatementReader reader_;
  bool with_materials_;
  ObjFile obj_;
  std::size_t textures_ = 0;
  Skipped skipped_;
  bool is_obj_ = false;  // one statement is that of an OBJ file

  std::vector<Material> library_;  // of all MTL files
  std::unordered_map<std::string, std::uint32_t> library_number_;
  std::vector<std::uint32_t> used_as_;  // number in obj_.materials, or kNone
  std::uint32_t current_ = kNone;       // in library_
};

}  // namespace

ObjFile read_obj(const std::string& path, bool with_materials) {
  const SourceLocation whole{path, 0, 0};
  try {
    const std::string text = read_text(path, whole);
    return ObjReader(path, text, with_materials).read();
  } catch (const std::bad_alloc&) {
    throw InputError(whole, "the mesh needs more memory than there is");
  }
}

}  // namespace sidelight
