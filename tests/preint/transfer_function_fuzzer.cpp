// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "parse_any_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tetralux::preint::parseAnyText(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
