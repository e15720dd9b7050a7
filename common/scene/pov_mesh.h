// SPDX-License-Identifier: MIT
// Text in POV-Ray's language, and a mesh of a scene in it. Private to pov.cpp, pov_mesh.cpp and pov_limits.cpp.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "common/scene/scene.h"

namespace sidelight {

// Reads back as the same doubles.
inline std::string pov_vector(const glm::dvec3& v) {
  return fmt::format("<{:.17g},{:.17g},{:.17g}>", v.x, v.y, v.z);
}

class PovText {
 public:
  // Lines go to `append`, which must outlive this; one unit of the scene is `scale` of POV-Ray's.
  PovText(const std::function<void(std::string_view)>& append, double scale)
      : append_(append), scale_(scale) {}

  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) const {
    append_(fmt::format(format, std::forward<Args>(args)...) + "\n");
  }
  double scale() const { return scale_; }
  std::string place(const glm::dvec3& point) const { return pov_vector(scale_ * point); }

 private:
  const std::function<void(std::string_view)>& append_;
  double scale_;
};

// Whether corner k of the triangle has a normal; one of 0 is none, which POV-Ray would take for <1,0,0>.
inline bool has_normal(const Scene& scene, const Triangle& triangle, std::size_t k) {
  return triangle.normal[k] != kNone && scene.normals[triangle.normal[k]] != glm::dvec3(0);
}

// A mesh2 of the object's triangles of one material, those without area left out. They go the other way round:
// POV-Ray's handedness makes that the outside, which decides on interior_texture.
void write_pov_mesh(const PovText& out, const Scene& scene, const Object& object, std::uint32_t material);

}  // namespace sidelight
