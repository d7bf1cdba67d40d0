#!/usr/bin/env bash
# Random worlds of devices under random rules through the stages of the job collision at parallelism 1, 2 and 4, against the definition.
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
Runs the test that every build runs with 1000 cases. Each case goes through the three exact stages, and those behind them, on a
Flink cluster in this process, its positions shuffled within the bound. It passes where every record of every case is that of the
definition. 100,000 cases take about a quarter of an hour on two cores.

  --cases N  A multiple of 100. Default: $cases.
  --seed N   The seed that a failure printed, to see it again (with --cases 10000).
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --cases) cases=${2-} ;;
        --seed) seed=${2-} ;;
        *) fail "collision-cases knows no option $1. See: ./furrow soak collision-cases --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak collision-cases --help"
    shift 2
done
[[ $cases =~ ^[1-9][0-9]*00$ ]] || fail "--cases must be a multiple of 100, not '$cases'."
[[ -z $seed || $seed =~ ^-?[0-9]+$ ]] || fail "--seed must be a whole number, not '$seed'."

logs=$home/target/soak/collision-cases
rm -rf "$logs"
mkdir -p "$logs"

# A new process for every 10,000, so that one shows how far it is.
for ((done = 0; done < cases; done += now)); do
    now=$((cases - done < 10000 ? cases - done : 10000))
    say "$done of $cases cases passed"
    if ! (cd "$home" && ./mvnw -B -ntp -pl analytics -am test -Dspotless.check.skip -Dtest=CollisionDetectionTest \
        -Dsurefire.failIfNoSpecifiedTests=false "-Dfurrow.collision.cases=$now" \
        ${seed:+"-Dfurrow.collision.seed=$((seed + done))"}) >"$logs/$done.log" 2>&1; then
        grep -E 'seed|ERROR' "$logs/$done.log" | head -n 10 >&2
        fail "collision-cases: a case differs, or the build failed: $logs/$done.log"
    fi
    grep -E 'cases of collisions|no difference' "$logs/$done.log" \
        || fail "The test did not say what it compared: $logs/$done.log"
done
echo "collision-cases: passed"
