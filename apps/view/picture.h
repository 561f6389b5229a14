// SPDX-License-Identifier: Apache-2.0
/// \file
/// The scene of a state, kept from one state to the next as far as it is the same.
#pragma once

#include <memory>
#include <optional>

#include <apps/render_scene.h>
#include <apps/view/option_words.h>
#include <apps/view/view_state.h>

namespace tetralux::apps::view {

class Picture : public Shown {
public:
    /// Makes what this state needs. \throws std::runtime_error as `tetralux render` does; the next state is then made
    /// anew.
    void show(const OptionWords& words);

    SceneRenderer& renderer() { return *renderer_; }
    const RenderOptions& options() const { return options_; }

    projection::Camera camera() override { return renderer_->record().camera; }
    preint::TransferFunction function() override { return renderer_->scene().transferFunction; }
    std::vector<double> times() override { return renderer_->times(); }
    glm::dvec3 pointUnder(const glm::dvec2& pixel) override;

private:
    std::unique_ptr<SceneRenderer> renderer_;
    std::optional<OptionWords> made_;
    RenderOptions options_;
};

}  // namespace tetralux::apps::view
