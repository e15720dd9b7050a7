// SPDX-License-Identifier: MIT
// primitive_ref() for many primitives in turn. What is seen side by side is most often of one object, and then nothing is
// looked up: a table of a million entries would have to be brought near for one of them.
#pragma once

#include "common/scene/scene.h"

namespace sidelight {

class PrimitiveFinder {
 public:
  explicit PrimitiveFinder(const Scene& scene) : scene_(scene) {}

  PrimitiveRef operator()(std::uint32_t primitive) {
    if (primitive - object_.first_primitive >= object_.count)
      object_ = numbers_of(scene_.objects[scene_.primitive_object[primitive]]);
    return {object_.kind, object_.first + (primitive - object_.first_primitive)};
  }

 private:
  struct Numbers {
    ObjectKind kind = ObjectKind::sphere;
    std::uint32_t first = 0, first_primitive = 0, count = 0;
  };
  static Numbers numbers_of(const Object& object) {
    return {object.kind, object.first, object.first_primitive, object.count};
  }

  const Scene& scene_;
  Numbers object_;  // the last one; at first none
};

}  // namespace sidelight
