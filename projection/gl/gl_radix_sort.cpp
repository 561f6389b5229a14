// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_radix_sort.h>

#include <utility>

namespace tetralux::projection {
namespace {

constexpr unsigned digitBits = 4, digitValues = 1u << digitBits, keyBits = 32;

}  // namespace

GlRadixSort::GlRadixSort(const GlFunctions& gl, std::size_t cells)
    : gl_(gl),
      count_(gl, {}, {"projection/gl/gl_radix_count.comp"}),
      scan_(gl, {}, {"projection/gl/gl_scan.comp"}),
      scatter_(gl, {}, {"projection/gl/gl_radix_scatter.comp"}),
      settle_(gl, {}, {"projection/gl/gl_settle_ties.comp"}) {
    reserve(cells);
}

void GlRadixSort::reserve(std::size_t cells) {
    const std::size_t blocks = (cells + glSortBlock - 1) / glSortBlock;
    digits_.reset();
    digits_.emplace(gl_, (digitValues * blocks + 1) * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY);
}

void GlRadixSort::scan(GLuint plan, GLuint values, std::size_t count) const {
    scan_.use();
    scan_.set("fixedCount", count);
    bindStorage(gl_, {plan, values});
    scan_.run(1);
}

void GlRadixSort::sortBits(GLuint plan, std::size_t sortGroups, GLuint keyed, GLuint scratch, unsigned bits) const {
    constexpr unsigned twoPasses = 2 * digitBits;  // the result ends where it began
    const std::size_t sorted = std::size_t{twoPasses} * ((bits + twoPasses - 1) / twoPasses);
    for (std::size_t shift = 0; shift < sorted; shift += digitBits) {
        count_.use();
        count_.set("shift", shift);
        bindStorage(gl_, {plan, keyed, digits_->name()});
        count_.runIndirect(sortGroups);
        scan(plan, digits_->name(), 0);
        scatter_.use();
        scatter_.set("shift", shift);
        bindStorage(gl_, {plan, keyed, digits_->name(), scratch});
        scatter_.runIndirect(sortGroups);
        std::swap(keyed, scratch);
    }
}

void GlRadixSort::sort(GLuint plan, std::size_t sortGroups, std::size_t settleGroups, GLuint keyed, GLuint scratch,
                       GLuint keyPlanes, const glm::dvec4& eye) const {
    sortBits(plan, sortGroups, keyed, scratch, keyBits);
    settle_.use();
    settle_.set("keyEye", eye);
    bindStorage(gl_, {plan, keyed, keyPlanes});
    settle_.runIndirect(settleGroups);
}

}  // namespace tetralux::projection
