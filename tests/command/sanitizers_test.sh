# SPDX-License-Identifier: MIT
# sanitizers_test.sh ASAN_BUILD: the tests of the build with AddressSanitizer and UndefinedBehaviorSanitizer, leaks included. Nothing else runs beside it.
build=$1
if [[ ! -f $build/CTestTestfile.cmake ]]; then
    echo "NOTICE: $build has not been built; nothing was run"
    exit 0
fi
export ASAN_OPTIONS=detect_leaks=1:abort_on_error=0
exec ctest --test-dir "$build" --output-on-failure --parallel "${CHECK_JOBS:-2}" --label-exclude slow
