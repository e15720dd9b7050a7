// SPDX-License-Identifier: MIT
// A traced tile into the frame.
#include <cstring>

#include "common/picture/tile_pixels.h"
#include "raytrace/wave.h"

namespace sidelight::raytrace {

// From the order of the packets. What is not wanted is empty.
template <class T>
const std::vector<T>& Wave::in_rows(const std::vector<T>& of, std::vector<T>& rows) const {
  rows.resize(of.size());
  constexpr std::size_t kRun = EyePackets::kRun;
  if (columns() % kRun == 0)
    for (std::size_t k = 0; k < of.size(); k += kRun)
      std::memcpy(static_cast<void*>(&rows[order_[k]]), &of[k], kRun * sizeof(T));
  else
    for (std::size_t k = 0; k < of.size(); ++k) rows[order_[k]] = of[k];
  return rows;
}

void Wave::write(Frame& frame, std::vector<double>& cut) {
  const TilePixels tile(pixels_, camera_.n);
  const Level& eye = levels_[0];
  const auto write_means = [&](const Colors& samples, KeptArray<glm::vec3>& pixels) {
    if (!pixels.empty()) tile.write_means(in_rows(samples, rows_), frame, pixels);
  };
  write_means(eye.color, frame.color);
  for (std::size_t l = 0; l < parts_.size(); ++l) write_means(parts_[l], frame.rgb[l]);
  write_means(shadow_, frame.layer(Layer::shadow));
  tile.write_surfaces([&](std::size_t sample) { return eye.hits[place_[sample]].primitive; },
                      in_rows(t_, t_rows_), in_rows(normal_, normal_rows_), scene_, camera_.depth_scale(),
                      frame);
  if (!secondary_) return;  // what such rays bring stays black
  write_means(eye.mirrored, frame.layer(Layer::reflection));
  write_means(eye.refracted, frame.layer(Layer::refraction));
  tile.for_each_pixel(frame, [&](std::size_t pixel, std::size_t first) {
    tile.for_each_sample(first, [&](std::size_t sample) { cut[pixel] += eye.cut[place_[sample]]; });
  });
}

}  // namespace sidelight::raytrace
