// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "viewer/report/html.h"

namespace sidelight {

// A scene's lesson as paragraphs, which blank lines part; other line breaks are those of the file, not of the page. An
// indented line that begins with "sidelight " is a command and stays a line; what stands behind two blanks in it is a
// remark. Cut after 4000 bytes.
Html lesson_html(std::string_view lesson);

}  // namespace sidelight
