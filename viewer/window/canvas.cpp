// SPDX-License-Identifier: MIT
#include "viewer/window/canvas.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>

#include "viewer/window/layout.h"
#include "viewer/window/paint.h"

namespace sidelight {
namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

// First and last of each range, closed by 0: Latin with the names of authors, Greek, punctuation with dashes
// and quotes, sub- and superscripts, arrows, mathematics.
constexpr ImWchar kGlyphs[] = {0x0020, 0x017F, 0x0370, 0x03FF, 0x2010, 0x2027, 0x2030, 0x205E,
                               0x2070, 0x209C, 0x2190, 0x21FF, 0x2200, 0x22FF, 0};

// The keys that widgets know, each with a number of ours. Enter is one more Space: to ImGui it would mean typing a number.
struct WidgetKey {
  ImGuiKey key;
  std::string_view name;
  int number;
};
constexpr WidgetKey kWidgetKeys[] = {{ImGuiKey_LeftArrow, "Left", 1},
                                     {ImGuiKey_RightArrow, "Right", 2},
                                     {ImGuiKey_UpArrow, "Up", 3},
                                     {ImGuiKey_DownArrow, "Down", 4},
                                     {ImGuiKey_Space, "Space", 5}};
constexpr std::string_view kShift = "Shift+";

std::optional<int> number_of(std::string_view key) {
  if (key.starts_with(kShift)) key.remove_prefix(kShift.size());
  if (key == "Enter") key = "Space";
  for (const WidgetKey& each : kWidgetKeys)
    if (each.name == key) return each.number;
  return {};
}

// Makes a context ImGui's current one for the length of a scope, alone in the process.
class CurrentContext {
 public:
  explicit CurrentContext(ImGuiContext* context) : lock_(mutex()), before_(ImGui::GetCurrentContext()) {
    ImGui::SetCurrentContext(context);
  }
  ~CurrentContext() { ImGui::SetCurrentContext(before_); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  ImGuiContext* before_;
};

ImGuiContext* make_context() {
  const CurrentContext none(nullptr);
  return ImGui::CreateContext();  // with a font atlas of its own
}

ImFont* add_font(ImFontAtlas& atlas, double pixels) {
  ImFontConfig config;
  config.OversampleH = config.OversampleV =
      1;  // glyphs stand on whole pixels: sharp, and the same everywhere
  config.PixelSnapH = true;
  config.SizePixels = static_cast<float>(std::lround(pixels));
  if (std::filesystem::exists(kFontFile))
    if (ImFont* font = atlas.AddFontFromFileTTF(kFontFile, config.SizePixels, &config, kGlyphs)) return font;
  config.SizePixels = 13 * std::max(1.0f, std::round(config.SizePixels / 13));  // it is drawn for 13 pixels
  return atlas.AddFontDefault(&config);
}

}  // namespace

void Canvas::DestroyContext::operator()(ImGuiContext* context) const {
  const CurrentContext current(context);
  ImGui::DestroyContext(context);
}

Canvas::Canvas(GlLoader loader, double scale)
    : gl_(load_gl(loader)), painter_(gl_), scale_(scale), context_(make_context()) {
  const CurrentContext current(context_.get());
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.BackendRendererName = "sidelight";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  for (const auto& [key, name, number] : kWidgetKeys) io.KeyMap[key] = number;
  load_fonts();
}

void Canvas::set_scale(double scale) {
  if (scale == scale_) return;
  scale_ = scale;
  const CurrentContext current(context_.get());
  load_fonts();
}

// Widgets as large as the text, in the colours of the page.
void Canvas::set_style() {
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowRounding = style.FrameRounding = style.GrabRounding = 4;
  style.WindowPadding = {12, 10};
  style.FramePadding = {9, 4};
  style.ScaleAllSizes(static_cast<float>(scale_));
  style.Colors[ImGuiCol_WindowBg] = {0.125f, 0.137f, 0.165f, 1};
  style.Colors[ImGuiCol_Text] = {0.94f, 0.95f, 0.96f, 1};
  ImGui::GetStyle() = style;
}

void Canvas::load_fonts() {
  set_style();
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  fonts_.small = add_font(atlas, kSmallText * scale_);  // the first is ImGui's own default
  fonts_.caption = add_font(atlas, kCaptionText * scale_);
  fonts_.title = add_font(atlas, kTitleText * scale_);
  unsigned char* rgba = nullptr;
  int width = 0, height = 0;
  atlas.GetTexDataAsRGBA32(&rgba, &width, &height);
  font_texture_.emplace(make_font_texture(gl_, width, height, rgba));
  atlas.SetTexID(texture_id(*font_texture_));
  atlas.ClearTexData();
}

ImTextureID Canvas::add_picture(const Image8& image, bool may_shrink) {
  return texture_id(pictures_.emplace_back(make_picture_texture(gl_, image, may_shrink)));
}

void Canvas::set_pointer(glm::dvec2 position, bool left_down, double wheel) {
  const CurrentContext current(context_.get());
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {static_cast<float>(position.x), static_cast<float>(position.y)};
  left_down_ = left_down;
  io.MouseDown[0] |= left_down;
  io.MouseWheel += static_cast<float>(wheel);
}

bool Canvas::press_key(std::string_view key) {
  if (!number_of(key)) return false;
  keys_.emplace_back(key);
  return true;
}

void Canvas::move_keys() {
  if (keys_.empty()) return;
  ImGuiIO& io = ImGui::GetIO();
  key_down_ = !key_down_;
  io.KeysDown[*number_of(keys_.front())] = key_down_;
  io.KeyShift = key_down_ && keys_.front().starts_with(kShift);
  if (!key_down_) keys_.pop_front();
}

void Canvas::draw(int width, int height, const std::function<void()>& contents) {
  const CurrentContext current(context_.get());
  ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  move_keys();
  ImGui::NewFrame();
  ImGui::GetIO().MouseDown[0] = left_down_;
  try {
    contents();
  } catch (...) {
    ImGui::EndFrame();
    throw;
  }
  ImGui::Render();
  painter_.paint(*ImGui::GetDrawData(), kPage);
  wants_pointer_ = ImGui::GetIO().WantCaptureMouse;
}

}  // namespace sidelight
