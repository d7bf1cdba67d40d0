#!/usr/bin/env bash
# Each of the five jobs stopped, killed and continued at random points and parallelisms, with aligned and unaligned checkpoints, against an undisturbed run.
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
Runs the tests that every build runs with three inputs per job. Each random input goes through the job once undisturbed and once with
two to four restarts: stopped with a savepoint or killed after a checkpoint. It passes where everything that is written is equal.

  --cases N  Inputs for each job. Default: $cases.
  --seed N   The seed that a failure printed, to see it again (with --cases 1).
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --cases) cases=${2-} ;;
        --seed) seed=${2-} ;;
        *) fail "job-restarts knows no option $1. See: ./furrow soak job-restarts --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak job-restarts --help"
    shift 2
done
[[ $cases =~ ^[1-9][0-9]*$ ]] || fail "--cases must be a whole number of at least 1, not '$cases'."
[[ -z $seed || $seed =~ ^-?[0-9]+$ ]] || fail "--seed must be a whole number, not '$seed'."

logs=$home/target/soak/job-restarts
rm -rf "$logs"
mkdir -p "$logs"

for job in Ingest:ingest Normalize:ingest Temperature:analytics Collision:analytics Presence:analytics; do
    test=${job%:*}RestartTest
    say "$test"
    if ! (cd "$home" && ./mvnw -B -ntp -pl "${job#*:}" -am test -Dspotless.check.skip -Dtest="$test" \
        -Dsurefire.failIfNoSpecifiedTests=false "-Dfurrow.restarts.cases=$cases" \
        ${seed:+"-Dfurrow.restarts.seed=$seed"}) >"$logs/$test.log" 2>&1; then
        grep -E 'seed|ERROR' "$logs/$test.log" | head -n 10 >&2
        fail "job-restarts: a case differs, or the build failed: $logs/$test.log"
    fi
    grep -E 'cases without a difference' "$logs/$test.log" || fail "The test did not say what it compared: $logs/$test.log"
done
echo "job-restarts: passed"
