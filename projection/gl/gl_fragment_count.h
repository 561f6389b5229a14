// SPDX-License-Identifier: Apache-2.0
/// \file
/// How many fragments a frame composites.
#pragma once

#include <cstdint>

#include <projection/gl/gl_functions.h>

namespace tetralux::projection {

/// Counts cell–pixel segments that the fragment shader keeps (GL_SAMPLES_PASSED). Its context must be current.
class GlFragmentCount {
public:
    explicit GlFragmentCount(const GlFunctions& gl) : gl_(gl) { gl_.GenQueries(1, &query_); }
    ~GlFragmentCount() { gl_.DeleteQueries(1, &query_); }
    GlFragmentCount(const GlFragmentCount&) = delete;
    GlFragmentCount& operator=(const GlFragmentCount&) = delete;

    void begin() const { gl_.BeginQuery(GL_SAMPLES_PASSED, query_); }
    void end() const { gl_.EndQuery(GL_SAMPLES_PASSED); }
    /// Of the last begin and end; waits for the drawing to end.
    std::uint64_t count() const {
        GLuint64 samples = 0;
        gl_.GetQueryObjectui64v(query_, GL_QUERY_RESULT, &samples);
        return samples;
    }

private:
    const GlFunctions& gl_;
    GLuint query_ = 0;
};

}  // namespace tetralux::projection
