// SPDX-License-Identifier: MIT
#include "viewer/window/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/picture/layer_picture.h"

namespace sidelight {
namespace {

using Lines = std::vector<std::string>;
using SharedFrame = std::shared_ptr<const Frame>;
using Colors = std::span<const glm::vec3>;

Lines number_lines(const glm::vec3& v) {
  return {fmt::format("{:.4f}", v.x), fmt::format("{:.4f}", v.y), fmt::format("{:.4f}", v.z)};
}

bool holds(const Frame& frame, glm::ivec2 pixel) {
  const Rect& window = frame.window;
  return pixel.x >= window.x0 && pixel.y >= window.y0 && pixel.x < window.x1 && pixel.y < window.y1;
}

// Of a frame at full resolution only: a coarse block's number is no pixel's.
std::function<Lines(glm::ivec2)> numbers_of(SharedFrame frame, bool full,
                                            std::function<Lines(const Frame&, std::size_t)> tell) {
  return [frame = std::move(frame), full, tell = std::move(tell)](glm::ivec2 pixel) {
    return full && holds(*frame, pixel) ? tell(*frame, frame->index(pixel.x, pixel.y)) : Lines();
  };
}

Lines layer_lines(const Frame& frame, Layer layer, std::size_t i) {
  if (layer == Layer::depth) return {fmt::format("{:.5g}", frame.depth[i])};
  if (layer == Layer::object) return {fmt::format("{}", frame.object_id[i])};
  if (layer == Layer::primitive) return {fmt::format("{}", frame.primitive_id[i])};
  if (layer == Layer::normal) return number_lines(frame.normal[i]);
  if (layer == Layer::cost) return {fmt::format("{:.0f}", frame.cost[i])};
  return number_lines(frame.layer(layer)[i]);
}

// Whether the layer has been made yet: all are only in finished pictures.
bool has_layer(const Frame& frame, Layer layer) {
  if (layer == Layer::depth) return !frame.depth.empty();
  if (layer == Layer::object) return !frame.object_id.empty();
  if (layer == Layer::primitive) return !frame.primitive_id.empty();
  if (layer == Layer::normal) return !frame.normal.empty();
  if (layer == Layer::cost) return !frame.cost.empty();
  return !frame.layer(layer).empty();
}

Image8 picture_of(const Frame& frame, Colors colors) {
  return to_image8(colors, frame.width(), frame.height());
}

// "3.1 M rays/s"
std::string rate_text(double per_second, const char* what) {
  return per_second >= 1e6 ? fmt::format("{:.1f} M {}/s", per_second / 1e6, what)
                           : fmt::format("{:.0f} k {}/s", per_second / 1e3, what);
}

class ShownMaker {
 public:
  ShownMaker(const WindowState& state, const Pictures& pictures) : state_(state), pictures_(pictures) {}

  ShownPanel left(std::string name) const { return panel(std::move(name), true, pictures_.left, "samples"); }
  ShownPanel right(std::string name) const { return panel(std::move(name), false, pictures_.right, "rays"); }

  ShownPanel raster() const {
    ShownPanel out = left(
        state_.slow ? fmt::format("z-buffer: {} of {} objects", state_.objects, state_.drawn->objects.size())
                    : "z-buffer: local light only");
    out.image = picture_of(*pictures_.rastered, pictures_.rastered->color);
    out.numbers = color_numbers(pictures_.rastered, true);
    return out;
  }

  ShownPanel raytrace() const {
    const Frame& frame = *pictures_.traced;
    ShownPanel out =
        right(state_.slow ? fmt::format("ray tracer: {} of {} rows", state_.rows, state_.scene->height)
                          : traced_name());
    KeptArray<glm::vec3> colors = frame.color;
    if (state_.slow && full()) {
      const std::ptrdiff_t rows = std::clamp(state_.rows - frame.window.y0, 0, frame.height());
      std::fill(colors.begin() + rows * frame.width(), colors.end(), glm::vec3(0));
    }
    out.image = picture_of(frame, colors);
    out.numbers = color_numbers(pictures_.traced, full());
    return out;
  }

  // What is there of the tracer's picture, of which `mode` needs all.
  ShownPanel waiting(Mode mode) const {
    ShownPanel out = raytrace();
    out.caption.name += fmt::format(", then the {}", mode_name(mode));
    return out;
  }

  bool has(Layer layer) const {
    return has_layer(*pictures_.traced, layer) &&
           (!both_make(layer) || has_layer(*pictures_.rastered, layer));
  }
  std::vector<ShownPanel> layer(Layer layer) const {
    std::vector<ShownPanel> out;
    const std::string name(kLayerNames[static_cast<std::size_t>(layer)]);
    const auto fill = [&](ShownPanel shown, const SharedFrame& frame, bool at_full) {
      shown.image = layer_picture(*frame, layer);
      shown.numbers = numbers_of(frame, at_full,
                                 [layer](const Frame& f, std::size_t i) { return layer_lines(f, layer, i); });
      out.push_back(std::move(shown));
    };
    if (both_make(layer)) fill(left("z-buffer: " + name), pictures_.rastered, true);
    fill(right("ray tracer: " + name), pictures_.traced, full());
    return out;
  }

  // A sum that begins with the z-buffer's picture.
  ShownPanel sum(std::string name, Colors colors) const {
    ShownPanel out = left(std::move(name));
    out.image = picture_of(*pictures_.traced, colors);
    out.numbers =
        numbers_of(pictures_.traced, full(),
                   [all = std::make_shared<const std::vector<glm::vec3>>(colors.begin(), colors.end())](
                       const Frame&, std::size_t i) { return number_lines((*all)[i]); });
    return out;
  }

  // The map's colours say which; the numbers under the glass say how much.
  ShownPanel difference(std::string name, Colors map) const {
    ShownPanel out = right(std::move(name));
    out.image = picture_of(*pictures_.traced, map);
    out.numbers =
        numbers_of(pictures_.traced, full(), [r = pictures_.rastered](const Frame& f, std::size_t i) {
          return number_lines(f.color[i] - r->color[i]);
        });
    return out;
  }

 private:
  bool full() const { return pictures_.block == 1; }

  std::string traced_name() const {
    if (pictures_.finished) return sidelight::traced_name(pictures_.task.scene->trace);
    if (pictures_.block <= 1) return "ray tracer: refining";
    return fmt::format("ray tracer: blocks of {0}\u00D7{0}", pictures_.block);
  }

  static std::function<Lines(glm::ivec2)> color_numbers(SharedFrame frame, bool at_full) {
    return numbers_of(std::move(frame), at_full,
                      [](const Frame& f, std::size_t i) { return number_lines(f.color[i]); });
  }

  ShownPanel panel(std::string name, bool of_left, const RendererTimes& times, const char* what) const {
    ShownPanel out;
    out.caption.name = std::move(name);
    if (state_.opened.times)
      out.caption.times = Times{times.build_ms, times.frame_ms, rate_text(times.per_second, what)};
    out.of_left = of_left;
    return out;
  }

  const WindowState& state_;
  const Pictures& pictures_;
};

std::vector<ShownPanel> ledger(const WindowState& state, const Pictures& finished, const ShownMaker& maker) {
  constexpr std::array<const char*, 4> kSums{"R: the z-buffer's picture", "R \u2212 S: minus the shadows",
                                             "R \u2212 S + M: plus what is mirrored",
                                             "R \u2212 S + M + G: plus what is refracted"};
  const auto sums = ledger_sums(*finished.rastered, *finished.traced);
  const auto term = static_cast<std::size_t>(state.ledger_term);
  return {maker.sum(kSums[term], sums[term]), maker.raytrace()};
}

std::vector<ShownPanel> panels(const WindowState& state, const Pictures& latest, const Pictures& finished) {
  const ShownMaker now(state, latest), complete(state, finished);
  if (const auto layer = layer_of(state.mode)) {
    if (now.has(*layer)) return now.layer(*layer);
    // Asked for with the mode, not here yet.
    return finished.finished && complete.has(*layer) ? complete.layer(*layer) : std::vector{now.raster()};
  }
  if (compares(state.mode) && !finished.finished) return {now.waiting(state.mode)};
  const std::string before = latest.finished ? "" : " (of the view before)";
  switch (state.mode) {
    case Mode::raster:
      return {now.raster()};
    case Mode::raytrace:
      return {now.raytrace()};
    case Mode::difference:
      return {complete.difference(
          "ray tracer minus z-buffer: yellow brighter, violet darker, grey equal" + before,
          signed_difference(*finished.rastered, *finished.traced))};
    case Mode::causes:
      return {complete.difference("what made the difference" + before,
                                  cause_map(*finished.rastered, *finished.traced))};
    case Mode::ledger:
      return ledger(state, finished, complete);
    default:
      return {now.raster(), now.raytrace()};
  }
}

}  // namespace

Shown show(const WindowState& state, const Pictures& latest, const Pictures& finished) {
  if (!latest.rastered || !latest.traced) return {};
  Shown out;
  out.panels = panels(state, latest, finished);
  if (state.mode == Mode::flip) out.panels.erase(out.panels.begin() + (state.view.flipped ? 0 : 1));
  out.swipe = state.mode == Mode::swipe;
  if (state.mode == Mode::difference && finished.finished)
    out.histogram = difference_histogram(*finished.rastered, *finished.traced);
  return out;
}

ShownKey shown_key(const WindowState& state, const Pictures& latest, const Pictures& finished) {
  const bool flipped = state.mode == Mode::flip && state.view.flipped;
  return {state.mode,          flipped ? -1 : state.ledger_term,
          state.rows,          state.slow,
          latest.finished,     latest.rastered.get(),
          latest.traced.get(), finished.traced.get()};
}

std::vector<std::string> cause_lines(const Comparison& comparison) {
  const double pixels = std::max(1.0, static_cast<double>(comparison.width) * comparison.height);
  const std::array<const Cause*, 3> causes{&comparison.shadow, &comparison.reflection,
                                           &comparison.refraction};
  std::vector<std::string> out;
  for (std::size_t i = 0; i < causes.size(); ++i)
    out.push_back(fmt::format("{}: {:.1f} % of pixels, mean {:.4f}", kCauseNames[i],
                              100 * static_cast<double>(causes[i]->pixels) / pixels, causes[i]->energy));
  return out;
}

}  // namespace sidelight
