// SPDX-License-Identifier: MIT
#include "viewer/window/offscreen.h"

#include <fmt/format.h>
#include <imgui.h>

#include <glm/common.hpp>
#include <stdexcept>
#include <string>

#include "common/error.h"
#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"
#include "viewer/window/window_panels.h"

#ifdef SIDELIGHT_HAVE_OSMESA
#include <algorithm>
#include <future>
#include <memory>
#include <mutex>
#include <vector>

#include "viewer/window/osmesa.h"
#endif

namespace sidelight {
namespace {

// Throws std::invalid_argument, naming both sizes, unless the pictures have one size, of at least 1x1, and as many bytes
// as that needs.
void check_pictures(const Image8& left, const Image8& right) {
  const auto bytes = [](const Image8& image) {
    return 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  };
  const auto name = [](const Image8& image) {
    return fmt::format("{}x{} ({} bytes)", image.width, image.height, image.rgb.size());
  };
  const bool same = left.width == right.width && left.height == right.height;
  if (!same || left.width < 1 || left.height < 1 || left.rgb.size() != bytes(left) ||
      right.rgb.size() != bytes(right))
    throw std::invalid_argument("pictures that cannot stand side by side: " + name(left) + " and " +
                                name(right));
}

// Both pictures at zoom 1 into the whole of the canvas, within Canvas::draw.
void draw_comparison(const Canvas& canvas, ImTextureID left, ImTextureID right, glm::ivec2 size,
                     const Labels& labels, const Layout& layout) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  draw_line(list, *canvas.fonts().title, layout.title, kText, labels.title);
  const View view = fit(View{}, size, layout.left);
  const glm::dvec2 inset = picture_origin(view, layout.left) - glm::dvec2(layout.left.x0, layout.left.y0);
  const Layout at = with_captions_at(layout, glm::ivec2(glm::max(inset, glm::dvec2(0))), canvas.scale());
  draw_caption(canvas, list, labels.left, kLeftAccent, at.left_caption, at.left_times);
  draw_picture(list, left, size, view, at.left);
  draw_caption(canvas, list, labels.right, kRightAccent, at.right_caption, at.right_times);
  draw_picture(list, right, size, view, at.right);
}

}  // namespace

Image8 side_by_side(const Image8& left, const Image8& right, const Labels& labels) {
  check_pictures(left, right);
  const LayoutOptions options = layout_options(labels);
  const glm::ivec2 picture(left.width, left.height), size = side_by_side_size(picture, labels);
  return draw_offscreen(size.x, size.y, [&](Canvas& canvas) {
    const ImTextureID at_left = canvas.add_picture(left), at_right = canvas.add_picture(right);
    canvas.draw(size.x, size.y, [&] {
      draw_comparison(canvas, at_left, at_right, picture, labels, make_layout(size, options));
    });
  });
}

glm::ivec2 side_by_side_size(glm::ivec2 picture, const Labels& labels) {
  const LayoutOptions options = layout_options(labels);
  return layout_size(panel_for(picture, options), options);
}

Image8 screenshot(const WindowState& state, const Pictures& pictures, int width, int height) {
  const Shown shown = show(state, pictures, pictures);
  const std::optional<Inspection> inspection = inspect_pixel(state, pictures);
  return draw_offscreen(width, height, [&](Canvas& canvas) {
    canvas.set_scale(state.text_scale);
    WindowState fitted = state;
    const WindowLayout layout = window_layout(state, {width, height}, canvas.scale());
    fitted.view = clamp(state.view, picture_size(state), layout.panels.left);
    std::vector<void*> textures;
    for (const ShownPanel& panel : shown.panels) textures.push_back(canvas.add_picture(panel.image));
    // Twice, as in the window: widgets know their sizes from the frame before.
    for (int frame = 0; frame < 2; ++frame)
      canvas.draw(width, height, [&] {
        draw_window(canvas,
                    {fitted, pictures, pictures, shown, textures, inspection ? &*inspection : nullptr},
                    layout);
      });
  });
}

std::vector<std::string> left_out(const WindowState& state, int width, int height) {
  std::vector<std::string> out;
  const auto look = [&](const char* name, Rect WindowLayout::*part) {
    const auto shown = [&](int at) {
      return (window_layout(state, {width, at}, state.text_scale).*part).height() > 0;
    };
    int from = height;
    while (from < kLongestOffscreen && !shown(from)) ++from;
    if (from == height) return;
    out.push_back(
        fmt::format("no room for the {} at {}x{}: shown from {}x{} on", name, width, height, width, from));
  };
  if (state.inspected) look("inspector", &WindowLayout::inspector);
  if (state.lesson) look("lesson", &WindowLayout::lesson);
  return out;
}

#ifdef SIDELIGHT_HAVE_OSMESA
namespace {

struct DestroyOsmesa {
  void operator()(osmesa_context* context) const {
    osmesa().make_current(nullptr, nullptr, 0, 0, 0);
    osmesa().destroy_context(context);
  }
};
using OsmesaContext = std::unique_ptr<osmesa_context, DestroyOsmesa>;

OsmesaContext make_context() {
  // Else as OSMesa has it: RGBA, and no depth, stencil or accumulation buffer.
  const int attributes[] = {OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  OsmesaContext context(osmesa().create_context(attributes, nullptr));
  if (!context) throw OutputError("nothing can be drawn off screen: OSMesa has no OpenGL 3.3 core context");
  return context;
}

Image8 without_alpha(const std::vector<std::uint8_t>& rgba, int width, int height) {
  Image8 image{width, height, std::vector<std::uint8_t>(rgba.size() / 4 * 3)};
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = rgba[i / 3 * 4 + i % 3];
  return image;
}

Image8 draw_on_this_thread(int width, int height, const std::function<void(Canvas&)>& draw) {
  std::vector<std::uint8_t> rgba(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const OsmesaContext context = make_context();
  if (osmesa().make_current(context.get(), rgba.data(), GL_UNSIGNED_BYTE, width, height) == 0)
    throw OutputError("nothing can be drawn off screen: OSMesa cannot draw into " + std::to_string(width) +
                      "x" + std::to_string(height));
  osmesa().pixel_store(OSMESA_Y_UP, 0);  // top row first
  Canvas canvas(osmesa().get_proc_address);
  draw(canvas);
  canvas.finish();
  return without_alpha(rgba, width, height);
}

}  // namespace

Image8 draw_offscreen(int width, int height, const std::function<void(Canvas&)>& draw) {
  if (std::min(width, height) < 1 || std::max(width, height) > kLongestOffscreen)
    throw UsageError("cannot draw a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                     " off screen: sides are from 1 to " + std::to_string(kLongestOffscreen));
  static std::mutex one_at_a_time;  // OSMesa makes its shared state without a lock
  const std::lock_guard lock(one_at_a_time);
  return std::async(std::launch::async, [&] { return draw_on_this_thread(width, height, draw); }).get();
}
#else
Image8 draw_offscreen(int, int, const std::function<void(Canvas&)>&) {
  throw UsageError("this build of sidelight has no OSMesa, so it cannot draw pictures off screen");
}
#endif

}  // namespace sidelight

// Sanitizer builds read these by name. Mesa keeps a few hundred bytes a context for good and guards its own threads in
// ways that ThreadSanitizer cannot see; what is ours stays under watch.
#ifdef __SANITIZE_ADDRESS__
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif
#ifdef __SANITIZE_THREAD__
extern "C" const char* __tsan_default_suppressions() {
  return "race:libOSMesa\nrace:libLLVM\ndeadlock:libOSMesa\ndeadlock:libLLVM\n"
         "called_from_lib:libOSMesa.so.8\n";
}
extern "C" const char* __tsan_default_options() { return "print_suppressions=0"; }
#endif
