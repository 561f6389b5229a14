// SPDX-License-Identifier: Apache-2.0
/// \file
/// The part of oneTBB that this project calls, by std::thread. For the thread sanitizer alone: it sees no
/// synchronization inside libtbb, which is not instrumented, and takes every task's data for a race. Here all of it is
/// seen, and the bodies of the parallel loops, which are the project's, run side by side as ever. The folder stands
/// before the system's in such builds, so <tbb/parallel_for.h> finds this.
#pragma once

#include <algorithm>
#include <exception>
#include <functional>
#include <iterator>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>

namespace tbb {

namespace plain {

inline constexpr int threads = 4;  // more than there are cores, so that bodies are interrupted anywhere

inline bool& nested() {
    static thread_local bool inside = false;
    return inside;
}

/// Calls work(0) … work(threads − 1) side by side, or one after the other within such a call. Throws what one of them
/// threw.
template <class Work>
void sideBySide(int count, const Work& work) {
    std::exception_ptr failure;
    std::mutex failing;
    const auto guarded = [&](int thread) {
        const bool outer = std::exchange(nested(), true);
        try {
            work(thread);
        } catch (...) {
            const std::lock_guard lock(failing);
            failure = std::current_exception();
        }
        nested() = outer;
    };
    if (nested()) {
        for (int i = 0; i < count; ++i) guarded(i);
    } else {
        std::vector<std::thread> others;
        for (int i = 1; i < count; ++i) others.emplace_back(guarded, i);
        guarded(0);
        for (std::thread& other : others) other.join();
    }
    if (failure) std::rethrow_exception(failure);
}

/// Pieces of a range.
template <class Index>
struct Pieces {
    Index begin, end, step;
    std::size_t count;

    explicit Pieces(const blocked_range<Index>& range)
        : begin(range.begin()),
          end(range.end()),
          step(static_cast<Index>(stepOf(range))),
          count((range.size() + static_cast<std::size_t>(step) - 1) / static_cast<std::size_t>(step)) {}
    blocked_range<Index> operator[](std::size_t i) const {
        const Index from = begin + static_cast<Index>(i) * step;
        return {from, from + std::min<Index>(step, end - from)};
    }

private:
    static std::size_t stepOf(const blocked_range<Index>& range) {
        return std::max<std::size_t>({1, std::min<std::size_t>(range.grainsize(), range.size()), range.size() / 64});
    }
};

}  // namespace plain

struct simple_partitioner {};

template <class Index, class Body, class... Partitioner>
void parallel_for(const blocked_range<Index>& range, const Body& body, const Partitioner&...) {
    const plain::Pieces<Index> pieces(range);
    plain::sideBySide(plain::threads,
                      [&](int thread) {  // pieces by turns: each thread has some of even the shortest loop
                          for (auto i = static_cast<std::size_t>(thread); i < pieces.count; i += plain::threads)
                              body(pieces[i]);
                      });
}

template <class First, class Last, class Body, class... Partitioner,
          std::enable_if_t<std::is_integral_v<First>, int> = 0>
void parallel_for(First first, Last last, const Body& body, const Partitioner&...) {
    using Index = std::common_type_t<First, Last>;
    if (static_cast<Index>(first) >= static_cast<Index>(last)) return;
    parallel_for(blocked_range<Index>(first, last), [&](const blocked_range<Index>& range) {
        for (Index i = range.begin(); i != range.end(); ++i) body(i);
    });
}

template <class Index, class Value, class Body, class Join>
Value parallel_reduce(const blocked_range<Index>& range, const Value& identity, const Body& body, const Join& join) {
    struct Result {  // of its own bytes, which std::vector<bool> has not
        Value value;
    };
    const plain::Pieces<Index> pieces(range);
    std::vector<Result> results(pieces.count, Result{identity});
    const blocked_range<std::size_t> all(0, pieces.count);
    parallel_for(all, [&](const blocked_range<std::size_t>& some) {
        for (std::size_t i = some.begin(); i != some.end(); ++i) results[i].value = body(pieces[i], identity);
    });
    Value sum = identity;
    for (const Result& result : results) sum = join(std::move(sum), result.value);
    return sum;
}

template <class Index, class Value, class Body, class Join>
Value parallel_deterministic_reduce(const blocked_range<Index>& range, const Value& identity, const Body& body,
                                    const Join& join) {
    return parallel_reduce(range, identity, body, join);
}

template <class Iterator, class... Less>
void parallel_sort(Iterator begin, Iterator end, const Less&... less) requires std::random_access_iterator<Iterator> {
    std::sort(begin, end, less...);
}
template <class Container, class Less>
void parallel_sort(Container& container, const Less& less) requires requires {
    container.begin();
}
{ std::sort(container.begin(), container.end(), less); }

template <class... Work>
void parallel_invoke(const Work&... work) {
    const std::function<void()> all[] = {work...};
    plain::sideBySide(static_cast<int>(sizeof...(work)), [&](int i) { all[i](); });
}

class task_arena {
public:
    static constexpr int automatic = -1;
    explicit task_arena(int = automatic) {}
    template <class Work>
    decltype(auto) execute(const Work& work) {
        return work();
    }
    int max_concurrency() const { return plain::threads; }
};

namespace this_task_arena {
inline int max_concurrency() {
    return plain::threads;
}
}  // namespace this_task_arena

class task_group {
public:
    ~task_group() { wait(); }
    template <class Work>
    void run(Work work) {
        threads_.emplace_back(std::move(work));
    }
    void wait() {
        for (std::thread& thread : threads_) thread.join();
        threads_.clear();
    }

private:
    std::vector<std::thread> threads_;
};

}  // namespace tbb
