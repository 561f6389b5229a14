// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include <projection/core/engine.h>

namespace tetralux::projection {

/// What wraps an engine to do something before or after each of its frames, and is otherwise like it.
class WrappedEngine : public Engine {
public:
    explicit WrappedEngine(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

    std::string name() const override { return engine_->name(); }
    std::string renderer() const override { return engine_->renderer(); }
    std::map<std::string, double> prepareMilliseconds() const override { return engine_->prepareMilliseconds(); }
    const preint::PreintegrationTable* table() const override { return engine_->table(); }
    double wantedTableError() const override { return engine_->wantedTableError(); }
    bool walksNodes() const override { return engine_->walksNodes(); }

protected:
    std::unique_ptr<Engine> engine_;
};

}  // namespace tetralux::projection
