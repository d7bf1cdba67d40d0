#!/usr/bin/env bash
# Plays one mission of 100 events a second at speed 1 for ten minutes, and shows how late events become, beside a bare loop.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"

seconds=600
drift=5

usage() {
    cat <<USAGE
Usage: ./furrow soak replay-drift [OPTION VALUE]…
One turn of ./furrow bench replay --timing. It passes where every event came and the median lateness of the last tenth of the events is
at most --drift above that of the first tenth.

  --seconds N  That the mission lasts; the bare loop takes as long again. Default: $seconds.
  --drift MS   Default: $drift.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --seconds) seconds=${2-} ;;
        --drift) drift=${2-} ;;
        *) fail "replay-drift knows no option $1. See: ./furrow soak replay-drift --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak replay-drift --help"
    shift 2
done
[[ $seconds =~ ^[1-9][0-9]*$ ]] || fail "--seconds must be a whole number from 1, not '$seconds'."
[[ $drift =~ ^[0-9]+$ ]] || fail "--drift must be a whole number, not '$drift'."

logs=$home/target/soak/replay-drift
rm -rf "$logs"
mkdir -p "$logs"
"$home/furrow" bench replay --timing --turns 1 --seconds "$seconds" --output "$logs/figures.json" | tee "$logs/out" ||
    fail "replay-drift: events are missing, as said above, or the measurement failed."
found=$(sed -n 's/.*"by":"replay","when":"appended"[^}]*"drift":\(-\{0,1\}[0-9]*\).*/\1/p' "$logs/figures.json")
[[ $found =~ ^-?[0-9]+$ ]] || fail "replay-drift: no figure of the drift in $logs/figures.json"
((found <= drift)) || fail "replay-drift: events were $found ms later in the end than in the beginning."
echo "replay-drift: passed"
