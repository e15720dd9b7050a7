// SPDX-License-Identifier: MIT
// A traced tile into the frame.
#include "common/picture/tile_pixels.h"
#include "raytrace/wave.h"

namespace sidelight::raytrace {

void Wave::write(Frame& frame, std::vector<double>& cut) const {
  const TilePixels tile(pixels_, camera_.n);
  const Level& eye = levels_[0];
  tile.write_means(eye.color, frame, frame.color);
  for (std::size_t l = 0; l < parts_.size(); ++l) tile.write_means(parts_[l], frame, frame.rgb[l]);
  tile.write_means(shadow_, frame, frame.layer(Layer::shadow));
  tile.write_surfaces([&](std::size_t sample) { return eye.hits[sample].primitive; }, t_, normal_, scene_,
                      camera_.depth_scale(), frame);
  if (!secondary_) return;  // what such rays bring stays black
  tile.write_means(eye.mirrored, frame, frame.layer(Layer::reflection));
  tile.write_means(eye.refracted, frame, frame.layer(Layer::refraction));
  tile.for_each_pixel(frame, [&](std::size_t pixel, std::size_t first) {
    tile.for_each_sample(first, [&](std::size_t sample) {
      cut[pixel] += eye.cut_mirrored[sample] + eye.cut_refracted[sample];
    });
  });
}

}  // namespace sidelight::raytrace
