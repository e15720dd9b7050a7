// SPDX-License-Identifier: MIT
// A traced tile into the frame: means of samples, and what is kept of the sample in the middle.
#include <algorithm>

#include "raytrace/wave.h"

namespace sidelight::raytrace {

// write(the pixel's index in the frame, the number of its first sample)
template <class Write>
void Wave::for_each_pixel(const Frame& frame, const Write& write) const {
  const auto n = static_cast<std::size_t>(camera_.n);
  for (int y = pixels_.y0; y < pixels_.y1; ++y) {
    const std::size_t pixel = frame.index(pixels_.x0, y);
    const std::size_t sample = n * static_cast<std::size_t>(y - pixels_.y0) * columns();
    for (std::size_t x = 0; x < static_cast<std::size_t>(pixels_.width()); ++x)
      write(pixel + x, sample + n * x);
  }
}

void Wave::write_means(const Colors& samples, const Frame& frame, Colors& pixels) const {
  if (pixels.empty()) return;
  // The mean of one sample is the sample, but for the sign of a zero.
  if (camera_.n == 1)
    return for_each_pixel(
        frame, [&](std::size_t pixel, std::size_t sample) { pixels[pixel] = 0.0f + samples[sample]; });
  const auto n = static_cast<std::size_t>(camera_.n);
  for_each_pixel(frame, [&](std::size_t pixel, std::size_t sample) {
    PixelMean mean;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) mean.add(samples[sample + j * columns() + i]);
    pixels[pixel] = mean.mean(camera_.n * camera_.n);
  });
}

void Wave::write(Frame& frame, std::vector<double>& cut) const {
  const Level& eye = levels_[0];
  write_means(eye.color, frame, frame.color);
  for (std::size_t l = 0; l < parts_.size(); ++l) write_means(parts_[l], frame, frame.rgb[l]);
  write_means(shadow_, frame, frame.layer(Layer::shadow));
  if (secondary_) {  // else they stay black
    write_means(eye.mirrored, frame, frame.layer(Layer::reflection));
    write_means(eye.refracted, frame, frame.layer(Layer::refraction));
  }

  // What is kept of the sample in the middle, (n/2, n/2).
  const auto n = static_cast<std::size_t>(camera_.n);
  const std::size_t middle = n / 2 * columns() + n / 2;
  const auto for_each_middle = [&](const auto& array, const auto& write) {
    if (!array.empty())
      for_each_pixel(frame, [&](std::size_t pixel, std::size_t sample) { write(pixel, sample + middle); });
  };
  for_each_middle(frame.depth, [&](std::size_t pixel, std::size_t sample) {
    frame.depth[pixel] = static_cast<float>(t_[sample] * camera_.depth_scale());
  });
  for_each_middle(frame.object_id, [&](std::size_t pixel, std::size_t sample) {
    const Hit& hit = eye.hits[sample];
    frame.object_id[pixel] = hit.found() ? 1 + scene_.primitive_object[hit.primitive] : 0;
  });
  for_each_middle(frame.primitive_id, [&](std::size_t pixel, std::size_t sample) {
    frame.primitive_id[pixel] = eye.hits[sample].found() ? 1 + eye.hits[sample].primitive : 0;
  });
  for_each_middle(frame.normal,
                  [&](std::size_t pixel, std::size_t sample) { frame.normal[pixel] = normal_[sample]; });

  // What is kept of all samples.
  if (!cut.empty() && secondary_)
    for_each_pixel(frame, [&](std::size_t pixel, std::size_t sample) {
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) cut[pixel] += eye.cut_weight[sample + j * columns() + i];
    });
  if (!frame.sample_primitive.empty())
    for_each_pixel(frame, [&](std::size_t pixel, std::size_t sample) {
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
          const std::size_t from = sample + j * columns() + i, to = (pixel * n + j) * n + i;
          frame.sample_primitive[to] = eye.hits[from].primitive;
          frame.sample_depth[to] = t_[from];
        }
    });
}

}  // namespace sidelight::raytrace
