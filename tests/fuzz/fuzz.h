// SPDX-License-Identifier: MIT
// What every fuzz target demands of a reader: it returns, or throws an InputError that names a file in `folder` and is
// fit for a terminal. Any other exception escapes, and libFuzzer reports it as it reports crashes, leaks, hangs and
// hunger for memory. Each target is one function for libFuzzer, which hands it bytes (LLVM, "libFuzzer: a library for
// coverage-guided fuzz testing").
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "common/error.h"

namespace sidelight::fuzz {

template <class Read>
void read_or_refuse(const std::string& folder, const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (text.starts_with(folder) && printable(text, text.size()) == text) return;
    std::fprintf(stderr, "an error that is not located or not inert: %s\n", text.c_str());
    std::abort();
  }
}

}  // namespace sidelight::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
