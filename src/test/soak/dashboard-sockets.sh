#!/usr/bin/env bash
# Reads with 200 sockets, 20 of them slow, and opens and drops 10,000: nobody waits for another, heap and threads are given back.
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
Runs a dashboard of 256 MB and a Kafka as processes. Sockets read a topic while some of them take one frame every two seconds: half of these
want every record and are closed when too many wait, another then takes their place; the others want the newest of each device. The
sockets that read must miss nothing and have 99 % of their records in time. Then sockets are opened and dropped, every tenth with
what was known before. After both, live heap (after a collection) must be at most 1.1 times that after a first, shorter round of both, which fills pools and
caches, and threads outside the server's pool must be as many.

  --seconds N  How long is read. Default: $seconds.
  --sockets N  Default: $sockets.
  --slow N     How many of them are slow. Default: $slow.
  --rate N     Records per second. Default: $rate.
  --drops N    Sockets that are opened and dropped. Default: $drops.
  --p99 MS     Age of records at those that read, at most. Default: $p99.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --seconds) seconds=${2-} ;;
        --sockets) sockets=${2-} ;;
        --slow) slow=${2-} ;;
        --rate) rate=${2-} ;;
        --drops) drops=${2-} ;;
        --p99) p99=${2-} ;;
        *) fail "dashboard-sockets knows no option $1. See: ./furrow soak dashboard-sockets --help" ;;
    esac
    [[ ${2-} =~ ^[1-9][0-9]{0,8}$ ]] || fail "$1 must be a whole number from 1, not '${2-}'."
    shift 2
done
((sockets <= 240 && slow < sockets)) || fail "--sockets must be at most 240, which one address may have, and --slow less."

prepare_source dashboard-sockets
suite=$home/suite/launcher/target
lib=$suite/furrow/lib
"$java" -Xmx768m -Dfurrow.log="$logs/driver.log" -cp "$home/src/target/test-classes:$lib/*:$suite/furrow/lib-last/*" \
    io.furrow.soak.dashboard.DashboardSockets "$run" "$seconds" "$sockets" "$slow" "$rate" "$drops" "$p99" \
    > >(while IFS= read -r line; do say "$line"; done) 2>>"$logs/driver.out" &
own $!
passed=true
wait $! || passed=false
cp "$run"/*.log "$run"/*.out "$logs" 2>/dev/null || true
$passed || fail "What was promised does not hold, as said above."
echo "dashboard-sockets: passed"
