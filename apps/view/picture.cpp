// SPDX-License-Identifier: Apache-2.0
#include <apps/view/picture.h>

#include <stdexcept>

#include <fmt/format.h>

#include <apps/view/render_words.h>
#include <projection/reference/reference_ray_caster.h>
#include <projection/reference/reference_segment.h>

namespace tetralux::apps::view {

void Picture::show(const OptionWords& words) {
    if (made_ && *made_ == words) return;
    RenderOptions options = optionsOf(words);
    const auto change = made_ ? changeBetween(*made_, words) : SceneRenderer::Change::Mesh;
    made_.reset();
    if (renderer_)
        renderer_->change(options, change);
    else
        renderer_ = std::make_unique<SceneRenderer>(options);
    options_ = std::move(options);
    made_ = words;
}

glm::dvec3 Picture::pointUnder(const glm::dvec2& pixel) {
    const projection::Scene& scene = renderer_->scene();
    const projection::Camera view = camera();
    const projection::ReferenceRayCaster caster(scene);
    const preint::ExactIntegral exact(scene.transferFunction);
    const glm::ivec2 at(pixel);
    for (const projection::RaySegment& segment : caster.segmentsAt(view, at.x, at.y)) {
        const double alpha = exact
                                 .segment(segment.scalarIn, segment.scalarOut, segment.tOut - segment.tIn,
                                          projection::integralOf(scene.settings.mode))
                                 .opacity();
        if (!(alpha > 0)) continue;
        const projection::Ray ray = projection::pixelRay(projection::cameraFrame(view), at.x, at.y);
        return ray.origin + projection::firstShownAt(exact, segment).value_or(segment.tIn) * ray.direction;
    }
    throw std::runtime_error(fmt::format("pixel {},{}: nothing shows there; take another", at.x, at.y));
}

}  // namespace tetralux::apps::view
