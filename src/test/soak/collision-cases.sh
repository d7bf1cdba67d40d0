#!/usr/bin/env bash
# Compares the stages of the job collision at parallelism 1, 2 and 4 with the definition, on random devices under random rules.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"

cases=100000
seed=

usage() {
    cat <<USAGE
Usage: ./furrow soak collision-cases [OPTION VALUE]…
Runs the test that every build runs with 300 cases. Each case is processed by the three exact stages and the following ones on a
Flink cluster in the process of the test, its positions shuffled within the allowed disorder. Every record of every case must equal
that of the definition. 100,000 cases take about a quarter of an hour on two cores.

  --cases N  A multiple of 100. Default: $cases.
  --seed N   The seed printed by a failure, to repeat it (with --cases 10000).
USAGE
}

read_options "cases seed" "$@"
[[ $cases =~ ^[1-9][0-9]*00$ ]] || fail "--cases must be a multiple of 100, not '$cases'."
[[ -z $seed || $seed =~ ^-?[0-9]+$ ]] || fail "--seed must be a whole number, not '$seed'."

prepare

# A new process for every 10,000 cases, to show the progress.
for ((done = 0; done < cases; done += now)); do
    now=$((cases - done < 10000 ? cases - done : 10000))
    say "$done of $cases cases passed"
    if ! (cd "$home" && ./mvnw -B -ntp -Pfull -pl analytics -am test -Dspotless.check.skip "-Dtest=CollisionDetectionTest#agrees*ManyCases" \
        -Dsurefire.failIfNoSpecifiedTests=false "-Dfurrow.collision.cases=$now" \
        ${seed:+"-Dfurrow.collision.seed=$((seed + done))"}) >"$logs/$done.log" 2>&1; then
        grep -E 'seed|ERROR' "$logs/$done.log" | head -n 10 >&2
        fail "a case differs, or the build failed: $logs/$done.log"
    fi
    grep -E 'cases of collisions|no difference' "$logs/$done.log" \
        || fail "The test has not logged its comparison: $logs/$done.log"
done
echo "collision-cases: passed"
