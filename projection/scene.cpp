// SPDX-License-Identifier: Apache-2.0
#include <projection/scene.h>

namespace tetralux::projection {

preint::Integral integralOf(Mode mode) {
    return mode == Mode::ScaleInvariant ? preint::Integral::ScaleInvariant : preint::Integral::Standard;
}

}  // namespace tetralux::projection
