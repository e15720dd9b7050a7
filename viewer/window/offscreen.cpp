// SPDX-License-Identifier: MIT
#include "viewer/window/offscreen.h"

#include <string>

#include "common/error.h"
#include "viewer/window/canvas.h"
#include "viewer/window/window_panels.h"

#ifdef SIDELIGHT_HAVE_OSMESA
#include <GL/osmesa.h>

#include <algorithm>
#include <future>
#include <memory>
#include <mutex>
#include <vector>
#endif

namespace sidelight {
namespace {

Image8 draw_comparison_offscreen(const Image8& left, const Image8& right, const Labels& labels,
                                 glm::ivec2 size, const Layout& layout) {
  check_pictures(left, right);
  return draw_offscreen(size.x, size.y, [&](Canvas& canvas) {
    const ShownPictures pictures{
        canvas.add_picture(left), canvas.add_picture(right), {left.width, left.height}};
    const View view = fit(View{}, pictures.size, layout.left);
    canvas.draw(size.x, size.y, [&] { draw_comparison(canvas, pictures, labels, layout, view); });
  });
}

}  // namespace

Image8 side_by_side(const Image8& left, const Image8& right, const Labels& labels) {
  const LayoutOptions options = layout_options(labels, false);
  const glm::ivec2 size = layout_size(panel_for({left.width, left.height}, options), options);
  return draw_comparison_offscreen(left, right, labels, size, make_layout(size, options));
}

PictureBoxes side_by_side_boxes(glm::ivec2 picture, const Labels& labels) {
  const LayoutOptions options = layout_options(labels, false);
  const Layout layout = make_layout(layout_size(panel_for(picture, options), options), options);
  const auto box = [&](const Rect& panel) {
    const glm::ivec2 corner(picture_origin(fit(View{}, picture, panel), panel));
    return Rect{corner.x, corner.y, corner.x + picture.x, corner.y + picture.y};
  };
  return {box(layout.left), box(layout.right)};
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

#ifdef SIDELIGHT_HAVE_OSMESA
namespace {

struct DestroyOsmesa {
  void operator()(osmesa_context* context) const {
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(context);
  }
};
using OsmesaContext = std::unique_ptr<osmesa_context, DestroyOsmesa>;

OsmesaContext make_context() {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_STENCIL_BITS,
                            0,
                            OSMESA_ACCUM_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  OsmesaContext context(OSMesaCreateContextAttribs(attributes, nullptr));
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
  if (OSMesaMakeCurrent(context.get(), rgba.data(), GL_UNSIGNED_BYTE, width, height) == 0)
    throw OutputError("nothing can be drawn off screen: OSMesa cannot draw into " + std::to_string(width) +
                      "x" + std::to_string(height));
  OSMesaPixelStore(OSMESA_Y_UP, 0);  // top row first
  Canvas canvas(OSMesaGetProcAddress);
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
