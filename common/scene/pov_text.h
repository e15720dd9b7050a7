// SPDX-License-Identifier: MIT
// Text in POV-Ray's language: lines, numbers in full, and places in its units. Private to pov.cpp and pov_mesh.cpp.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <utility>

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

}  // namespace sidelight
