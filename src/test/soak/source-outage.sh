#!/usr/bin/env bash
# Stops Kafka for a minute while the NGSI source is under load; no notification may be lost, and the source must catch up in less time.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

rate=2000
seconds=60

usage() {
    cat <<USAGE
Usage: ./furrow soak source-outage [OPTION VALUE]…
Starts a Kafka broker and a distributed Connect worker with the NGSI source and default timeouts. While notifications are sent, the
broker is stopped and restarted. Every notification must be answered 200 and be on data.raw, and the source must catch up in less time
than the outage lasted. The worker has a heap of 384 MiB. On Linux its resident memory is printed and must stay below 700 MiB.

  --rate N      Notifications of 1 kB per second. Default: $rate.
  --seconds N   Duration of the outage. Default: $seconds.
USAGE
}

read_options "rate seconds" "$@"
check_numbers 1 rate seconds

prepare_source
run_program source.SourceOutage "$run/outage" "$rate" "$seconds" || fail "A notification was lost or rejected, or the source caught up too late."
echo "source-outage: passed"
