#!/usr/bin/env bash
# Random losses, repeats, disorder and restarts of a context broker against the repair of the NGSI source: the topic ends in its state.
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
Runs the test that every build runs 300 times, in one process without a network. It passes where after each run the newest state of
each entity on the topic is that of the context broker. 10,000 runs take some four minutes on two busy cores.

  --runs N  Default: $runs.
  --seed N  Of the first run, the next one has the next seed; a failure prints its own, to see it again with --runs 1. Default: random.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --runs) runs=${2-} ;;
        --seed) seed=${2-} ;;
        *) fail "repair-model knows no option $1. See: ./furrow soak repair-model --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak repair-model --help"
    shift 2
done
[[ $runs =~ ^[1-9][0-9]{0,8}$ ]] || fail "--runs must be a whole number from 1, not '$runs'."
[[ $seed =~ ^[0-9]{1,15}$ ]] || fail "--seed must be a whole number, not '$seed'."

logs=$home/target/soak/repair-model
rm -rf "$logs"
mkdir -p "$logs"

say "$runs runs from seed $seed"
if ! (cd "$home" && ./mvnw -B -ntp -pl ngsi-connector -am test -Dspotless.check.skip -Dtest=RepairModelTest \
    -Dsurefire.failIfNoSpecifiedTests=false "-Dfurrow.repair.runs=$runs" "-Dfurrow.repair.seed=$seed" \
    "-Dfurrow.repair.report=$logs/report.txt") >"$logs/test.log" 2>&1; then
    grep -E 'furrow.repair.seed|expected|but was|ERROR' "$logs/test.log" | head -n 10 >&2
    fail "repair-model: a run differs, or the build failed: $logs/test.log"
fi
cat "$logs/report.txt" || fail "The test did not say what it compared: $logs/test.log"
echo "repair-model: passed"
