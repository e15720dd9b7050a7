// SPDX-License-Identifier: MIT
#include "raster/tile.h"

namespace sidelight::raster {

template <class Recorder>
DepthTile<Recorder>::DepthTile(const Camera& camera, const Rect& pixels, Recorder& recorder, bool count_tests)
    : camera_(camera),
      samples_(samples_of(pixels, camera.n)),
      axis_(camera.axis_part()),
      recorder_(recorder) {
  for (int X = samples_.x0; X < samples_.x1; ++X) columns_.push_back(camera.column_part(X));
  for (int Y = samples_.y0; Y < samples_.y1; ++Y) rows_.push_back(camera.row_part(Y));
  nearest_.resize(columns_.size() * rows_.size());
  if (count_tests) tests_.resize(nearest_.size());
}

template <class Recorder>
void DepthTile<Recorder>::add_tests(const SampleBox& box) {
  if (tests_.empty()) return;
  for (int Y = box.y0; Y < box.y1; ++Y)
    for (int X = box.x0; X < box.x1; ++X) ++tests_[index(X, Y)];
}

template <class Recorder>
void DepthTile<Recorder>::draw(const Scene& scene, std::uint32_t primitive, VisibilityCounts& counts) {
  const SampleBox box = intersection(box_of_primitive(scene, camera_, primitive), samples_);
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  if (ref.kind == ObjectKind::mesh)
    return draw_triangle(scene, primitive, scene.triangles[ref.index], box, counts);

  // Spheres and planes: solved at each sample they may cover.
  add_tests(box);
  for (int Y = box.y0; Y < box.y1; ++Y)
    for (int X = box.x0; X < box.x1; ++X) {
      const Hit hit = intersect(scene, primitive, {camera_.eye, direction(X, Y)}, kRayStart, counts);
      if (hit.found()) keep(X, Y, hit, counts);
    }
}

template <class Recorder>
void DepthTile<Recorder>::draw_triangle(const Scene& scene, std::uint32_t primitive, const Triangle& triangle,
                                        const SampleBox& box, VisibilityCounts& counts) {
  const auto [v0, v1, v2] = corners(scene, triangle);
  const TriangleView view = view_triangle(camera_.eye, v0, v1, v2);
  const int side = view_side(view, counts);
  if (side == 0) return;  // seen exactly edge-on
  const DepthPlane plane = depth_plane(view, v0, v1, v2);
  add_tests(box);
  for (int Y = box.y0; Y < box.y1; ++Y)
    for (int X = box.x0; X < box.x1; ++X) {
      const glm::dvec3 d = direction(X, Y);
      ++counts.tests;
      if (edge_agreement(view, d, counts) == side)
        keep(X, Y, {triangle_depth(view, plane, d), primitive}, counts);
    }
}

template class DepthTile<NoFragments>;
template class DepthTile<FragmentsOfSample>;

}  // namespace sidelight::raster
