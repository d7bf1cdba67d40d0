#!/usr/bin/env bash
# Replays a mission of 100 events per second at speed 1 for ten minutes, and compares the lateness of events with a bare loop.
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
Runs one turn of ./furrow bench replay --timing. Every event must arrive, and the median lateness of the last tenth of the events must be
at most --drift above that of the first tenth.

  --seconds N  Duration of the mission; the bare loop takes as long again. Default: $seconds.
  --drift MS   Maximum drift. Default: $drift.
USAGE
}

read_options "seconds drift" "$@"
check_numbers 1 seconds
check_numbers 0 drift

prepare
"$home/furrow" bench replay --timing --turns 1 --seconds "$seconds" --output "$logs/figures.json" | tee "$logs/out" ||
    fail "events are missing or the measurement failed, see above."
found=$(sed -n 's/.*"by":"replay","when":"appended"[^}]*"drift":\(-\{0,1\}[0-9]*\).*/\1/p' "$logs/figures.json")
[[ $found =~ ^-?[0-9]+$ ]] || fail "$logs/figures.json has no drift"
((found <= drift)) || fail "events were $found ms later at the end than at the beginning."
echo "replay-drift: passed"
