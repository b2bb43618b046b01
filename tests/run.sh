#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds edgevo and runs its tests; works from a bare clone. The last lines are ctest's summary.
#
#   tests/run.sh              everything: Release build in build/release, all tests
#   tests/run.sh --quick      unit tests only, no benchmarks built
#   tests/run.sh --sanitize   the tests under AddressSanitizer and UndefinedBehaviorSanitizer, in build/asan
#   tests/run.sh --sanitize-threads  the tests under ThreadSanitizer, in build/tsan
#
# JOBS=N sets how many compilers run at a time (default: as many as there are cores). What the demo has compiled
# is not compiled again.
set -eu
cd "$(dirname "$0")/.."

folder=build/release
label_filter=
benchmarks=ON
build_options="-DCMAKE_BUILD_TYPE=Release -DEDGEVO_SANITIZE="
case "${1:-}" in
  "") ;;
  --quick)
    label_filter="-L unit"
    benchmarks=OFF ;;
  --sanitize)
    folder=build/asan
    benchmarks=OFF
    build_options="--preset asan"
    # By default UBSan continues after an error; a test must not pass then.
    export UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1" ;;
  --sanitize-threads)
    folder=build/tsan
    benchmarks=OFF
    build_options="--preset tsan"
    export TSAN_OPTIONS="halt_on_error=1:suppressions=$PWD/tests/tsan.supp" ;;
  *)
    echo "run.sh: unknown option $1; see the head of this script" >&2
    exit 2 ;;
esac

share/install_dependencies.sh --checks --workflow
share/configure.sh "$folder" $build_options -DEDGEVO_BUILD_TESTS=ON -DEDGEVO_BUILD_BENCHMARKS=$benchmarks
cmake --build "$folder" --parallel "${JOBS:-$(nproc)}"
# One more at a time than there are cores: some tests wait for a while.
ctest --test-dir "$folder" --output-on-failure --parallel $(($(nproc) + 1)) $label_filter
