// SPDX-License-Identifier: MIT
// The tables of a bench's report.
#pragma once

#include "viewer/bench/result.h"
#include "viewer/report/bench_words.h"
#include "viewer/report/html.h"

namespace sidelight {

// A scene's errors and costs, a row a finished configuration, sortable; and which were not finished.
Html numbers_html(const BenchResult& result, std::size_t scene);

// How the front and every configuration do over several scenes, as ratios to the standard one. Empty for one scene.
Html over_scenes_html(const BenchResult& result);

// Facts as a table without heading; empty without facts.
Html facts_html(const std::string& caption, const std::vector<Fact>& facts);

}  // namespace sidelight
