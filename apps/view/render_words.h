// SPDX-License-Identifier: Apache-2.0
/// \file
/// Between the words of a state and the options that they stand for: by the parser of `tetralux render` itself.
#pragma once

#include <string>
#include <vector>

#include <apps/render_options.h>
#include <apps/render_scene.h>
#include <apps/view/option_words.h>

namespace tetralux::apps::view {

/// Mesh and options from a command line's words. \throws std::runtime_error for what `render` does not know, and for
/// options that say where results go.
OptionWords wordsOf(const std::vector<std::string>& arguments);

/// \throws std::runtime_error as `tetralux render` does.
RenderOptions optionsOf(const OptionWords& words);

/// What has to be made again for `to` when `from` is there.
SceneRenderer::Change changeBetween(const OptionWords& from, const OptionWords& to);

}  // namespace tetralux::apps::view
