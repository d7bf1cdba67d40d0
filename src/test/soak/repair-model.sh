#!/usr/bin/env bash
# Tests the repair of the NGSI source against random losses, duplicates, disorder and restarts of a context broker.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"

runs=10000
seed=$((RANDOM * 32768 + RANDOM))

usage() {
    cat <<USAGE
Usage: ./furrow soak repair-model [OPTION VALUE]…
Runs the test that every build runs 300 times, in one process without a network. After each run the newest state of each entity on the
topic must equal that of the context broker. 10,000 runs take some four minutes on two busy cores.

  --runs N  Runs. Default: $runs.
  --seed N  Seed of the first run, incremented for each run. A failure prints its seed; repeat it with --runs 1. Default: random.
USAGE
}

read_options "runs seed" "$@"
check_numbers 1 runs
check_numbers 0 seed

prepare

say "$runs runs from seed $seed"
if ! (cd "$home" && ./mvnw -B -ntp -pl ngsi-connector -am test -Dspotless.check.skip -Dtest=RepairModelTest \
    -Dsurefire.failIfNoSpecifiedTests=false "-Dfurrow.repair.runs=$runs" "-Dfurrow.repair.seed=$seed" \
    "-Dfurrow.repair.report=$logs/report.txt") >"$logs/test.log" 2>&1; then
    grep -E 'furrow.repair.seed|expected|but was|ERROR' "$logs/test.log" | head -n 10 >&2
    fail "a run differs, or the build failed: $logs/test.log"
fi
cat "$logs/report.txt" || fail "The test has not written its report: $logs/test.log"
echo "repair-model: passed"
