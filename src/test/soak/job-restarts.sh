#!/usr/bin/env bash
# Stops, kills and restores each of the five jobs at random points and parallelisms, with aligned and unaligned checkpoints, and compares with an undisturbed run.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"

cases=100
seed=

usage() {
    cat <<USAGE
Usage: ./furrow soak job-restarts [OPTION VALUE]…
Runs the tests that every build runs with three inputs per job. The job processes each random input once undisturbed and once with two to
four restarts, stopped with a savepoint or killed after a checkpoint. The output of both must be equal.

  --cases N  Inputs per job. Default: $cases.
  --seed N   The seed printed by a failure, to repeat it (with --cases 1).
USAGE
}

read_options "cases seed" "$@"
check_numbers 1 cases
[[ -z $seed || $seed =~ ^-?[0-9]+$ ]] || fail "--seed must be a whole number, not '$seed'."

prepare

for job in Ingest:ingest Normalize:ingest Temperature:analytics Collision:analytics Presence:analytics; do
    test=${job%:*}RestartTest
    say "$test"
    if ! (cd "$home" && ./mvnw -B -ntp -pl "${job#*:}" -am test -Dspotless.check.skip -Dtest="$test" \
        -Dsurefire.failIfNoSpecifiedTests=false "-Dfurrow.restarts.cases=$cases" \
        ${seed:+"-Dfurrow.restarts.seed=$seed"}) >"$logs/$test.log" 2>&1; then
        grep -E 'seed|ERROR' "$logs/$test.log" | head -n 10 >&2
        fail "a case differs, or the build failed: $logs/$test.log"
    fi
    grep -E 'cases without a difference' "$logs/$test.log" || fail "The test has not logged its comparison: $logs/$test.log"
done
echo "job-restarts: passed"
