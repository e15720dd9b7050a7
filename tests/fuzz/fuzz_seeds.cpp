// SPDX-License-Identifier: MIT
// fuzz_seeds FOLDER: what each fuzz target begins with, in FOLDER/scene, mesh, material and picture: the shipped scenes,
// small files in which each statement of OBJ and MTL stands once, and pictures as the program writes them.
#include <cstdio>
#include <filesystem>

#include "common/picture/image_io.h"
#include "tests/picture/folder.h"
#include "tests/picture/frames.h"

using namespace sidelight;
using test::write_bytes;

namespace {

const std::string kMaterials =
    "newmtl red\nKa 0.1 0.1 0.1\nKd 1 0 0\nKs 0.5\nNs 20\nillum 2\n"
    "newmtl clear glass\nKd 0 0 0\nKs 0.1 0.1 0.1\nTf 0.9 0.9 0.9\nNi 1.5\nillum 7\nmap_Kd wood.png\n";

// A tetrahedron, a quadrilateral and a polygon that is not convex.
const std::string kMesh =
    "# seed\nmtllib m.mtl\no tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1e0\nvn 0 0 1\nvt 0.5 0.5\nusemtl "
    "red\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\ng flat\ns off\nusemtl clear glass\nf -4//1 -3//1 -2//1\nv 1 1 0\n"
    "f 1/1/1 2/1/1 5/1/1 3/1/1\nv 0.5 0.2 0\nf 1/1 2/1 6/1 \\\n  3/1\n";

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: fuzz_seeds FOLDER\n", stderr), 2;
  const std::filesystem::path folder = argv[1];
  for (const char* target : {"scene", "mesh", "material", "picture"})
    std::filesystem::create_directories(folder / target);

  for (const auto& entry : std::filesystem::directory_iterator(SIDELIGHT_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".toml")
      std::filesystem::copy_file(entry.path(), folder / "scene" / entry.path().filename(),
                                 std::filesystem::copy_options::overwrite_existing);
  write_bytes((folder / "mesh/all.obj").string(), kMesh + '\0' + kMaterials);
  write_bytes((folder / "material/all.mtl").string(), kMaterials);

  Frame frame = make_frame(7, 5, 1, test::options_with(kRaytraceLayers));
  test::fill_with_noise(frame, 1);
  const Metadata metadata{{"program", "sidelight"}, {"title", "seed"}};
  write_exr((folder / "picture/color.exr").string(), frame, metadata);
  write_png((folder / "picture/color.png").string(), to_image8(frame.color, frame.width(), frame.height()),
            metadata);
  write_png_linear16((folder / "picture/linear16.png").string(), frame, metadata);
}
