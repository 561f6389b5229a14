// SPDX-License-Identifier: Apache-2.0
/// \file
/// What must hold for the transfer function of any text at all: it is refused with one line, or it can be used. The
/// fuzzer and the ordinary tests run this same function.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include <preint/exact_integral.h>
#include <preint/transfer_function.h>

namespace tetralux::preint {

/// Throws std::logic_error when the promise is broken; true when the text was a transfer function.
inline bool parseAnyText(const std::string& text) {
    TransferFunction function;
    try {
        function = parseTransferFunction(text, "any.json");
    } catch (const std::runtime_error& error) {
        const std::string message = error.what();
        if (message.rfind("any.json: ", 0) != 0)
            throw std::logic_error("message does not begin with its origin: " + message);
        if (message.find('\n') != std::string::npos)
            throw std::logic_error("message has more than one line: " + message);
        return false;
    }
    const ExactIntegral exact(resolved(function, -1.0, 2.0, 3.0));
    for (const double back : {-5.0, 0.25, 0.5, 1e6}) {
        const SegmentResult result = exact.segment(0.25, back, 0.5, Integral::Standard);
        for (int channel = 0; channel < 3; ++channel) {
            if (!(result.color[channel] >= 0.0 && result.color[channel] <= 1.0 + 1e-9))
                throw std::logic_error("color is not in [0, 1]");
        }
        if (!(result.opticalDepth >= 0.0)) throw std::logic_error("optical depth is not a depth");
    }
    return true;
}

}  // namespace tetralux::preint
