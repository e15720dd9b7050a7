// SPDX-License-Identifier: MIT
#include "viewer/window/keys.h"

#include <algorithm>
#include <array>

namespace sidelight {
namespace {

constexpr auto kBindings = std::to_array<KeyBinding>({
    {"1", Action::side_by_side},
    {"2", Action::swipe},
    {"3", Action::flip},
    {"4", Action::difference},
    {"5", Action::causes},
    {"6", Action::ledger},
    {"7", Action::next_layer},
    {"&", Action::previous_layer},
    {"8", Action::previous_layer},
    {"9", Action::next_alone},
    {"Space", Action::swap},
    {"<", Action::swipe_left},
    {">", Action::swipe_right},
    {"Left", Action::orbit_left},
    {"Right", Action::orbit_right},
    {"Up", Action::orbit_up},
    {"Down", Action::orbit_down},
    {"Shift+Left", Action::slide_left},
    {"Shift+Right", Action::slide_right},
    {"Shift+Up", Action::slide_up},
    {"Shift+Down", Action::slide_down},
    {".", Action::nearer},
    {",", Action::farther},
    {"+", Action::zoom_in},
    {"=", Action::zoom_in},
    {"-", Action::zoom_out},
    {"0", Action::whole_picture},
    {"Home", Action::whole_picture},
    {"i", Action::inspect},
    {"n", Action::next_step},
    {"PageDown", Action::next_step},
    {"p", Action::previous_step},
    {"PageUp", Action::previous_step},
    {"]", Action::next_scene},
    {"[", Action::previous_scene},
    {"o", Action::slow_motion},
    {"k", Action::more},
    {"j", Action::fewer},
    {"d", Action::deeper},
    {"D", Action::shallower},
    {"f", Action::shadows},
    {"g", Action::reflection},
    {"r", Action::refraction},
    {"a", Action::more_samples},
    {"A", Action::fewer_samples},
    {"y", Action::copy_command},
    {"s", Action::save},
    {"z", Action::reset},
    {"c", Action::controls},
    {"Tab", Action::next_panel},
    {"l", Action::lesson},
    {"t", Action::text_size},
    {"h", Action::help},
    {"?", Action::help},
    {"F1", Action::help},
    {"Esc", Action::escape},
    {"q", Action::close},
    {"Q", Action::close},
});

constexpr auto kLooking = std::to_array<KeyHelp>({
    {"1", "side by side"},
    {"2", "swipe (drag, < >)"},
    {"3", "flip in place"},
    {"4", "signed difference"},
    {"5", "causes"},
    {"6", "ledger"},
    {"7 8", "a layer alone"},
    {"9", "one picture alone"},
    {"Space", "swap the two; next term of the ledger"},
    {"wheel + -", "zoom about the cursor"},
    {"right drag", "move the pictures"},
    {"0, Home", "the whole picture"},
});
constexpr auto kMoving = std::to_array<KeyHelp>({
    {"drag, arrows", "orbit"},
    {"with Shift", "slide"},
    {"Ctrl wheel . ,", "nearer, farther"},
    {"d D", "longer, shorter paths"},
    {"f g r", "shadows, reflection, refraction"},
    {"a A", "more, fewer samples"},
    {"c", "controls"},
    {"Tab", "arrows, Space to the next open panel"},
    {"z", "reset"},
    {"s", "save as a new scene"},
});
constexpr auto kTeaching = std::to_array<KeyHelp>({
    {"n p", "next, previous step (PageDown, PageUp)"},
    {"l", "lesson text"},
    {"] [", "next, previous scene"},
    {"click, i", "inspect a pixel"},
    {"y", "copy as command"},
    {"o", "slow motion"},
    {"k j", "  more, fewer"},
    {"t", "text size"},
    {"h ? F1", "help"},
    {"Esc", "back, then close"},
    {"q", "close"},
});
constexpr std::array<KeyGroup, 3> kGroups{
    {{"Look", kLooking}, {"Move and change", kMoving}, {"Teach", kTeaching}}};

}  // namespace

std::span<const KeyBinding> key_bindings() { return kBindings; }

std::optional<Action> action_of(std::string_view key) {
  const auto at =
      std::find_if(kBindings.begin(), kBindings.end(), [&](const KeyBinding& b) { return b.key == key; });
  if (at == kBindings.end()) return {};
  return at->action;
}

std::span<const KeyGroup> key_help() { return kGroups; }

}  // namespace sidelight
