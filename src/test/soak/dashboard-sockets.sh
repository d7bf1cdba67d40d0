#!/usr/bin/env bash
# Reads with 200 sockets, 20 of them slow, and opens and drops 10,000: no socket delays another, heap and threads do not grow.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

seconds=120
sockets=200
slow=20
rate=500
drops=10000
p99=500

usage() {
    cat <<USAGE
Usage: ./furrow soak dashboard-sockets [OPTION VALUE]…
Starts a Kafka broker and a dashboard with 256 MB of heap as processes. Sockets read a topic, some of them only one frame every two
seconds. Half of the slow sockets subscribe to every record: the dashboard closes them when too many records wait, and new ones replace
them. The other half subscribe to the newest record of each device. The fast sockets must miss no record and get 99 % of them in time.
Then sockets are opened and dropped, every tenth with a snapshot. Live heap (after a collection) must be at most 1.1 times that after a
shorter first round of both phases, which fills pools and caches, and the threads outside the server's pool must be as many.

  --seconds N  Duration of the reading phase. Default: $seconds.
  --sockets N  Sockets that read. Default: $sockets.
  --slow N     Slow ones among them. Default: $slow.
  --rate N     Records per second. Default: $rate.
  --drops N    Sockets that are opened and dropped. Default: $drops.
  --p99 MS     Maximum age of records at fast sockets (99 %). Default: $p99.
USAGE
}

read_options "seconds sockets slow rate drops p99" "$@"
check_numbers 1 seconds sockets slow rate drops p99
((sockets <= 240 && slow < sockets)) || fail "--sockets must be at most 240, the limit per address, and --slow must be less than --sockets."

prepare_source
run_program dashboard.DashboardSockets "$run" "$seconds" "$sockets" "$slow" "$rate" "$drops" "$p99" || fail "The faults are listed above."
echo "dashboard-sockets: passed"
